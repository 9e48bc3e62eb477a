// Knobs that keys turn, as sliders of the panels do.
#pragma once

#include "viewer/hands/bindings.hpp"
#include "viewer/panels/facts.hpp"

namespace sinew::viewer {

struct TurnedKnobs {
    Knobs knobs;
    std::string said; ///< of the one that was turned
};

/// By one notch of a key; nothing where the action is not of a knob.
std::optional<TurnedKnobs> turnedBy(Action action, Knobs knobs);

/// Gravity and material within reason, whatever was typed.
void limitGravity(Knobs& knobs);
void limitMaterial(Knobs& knobs);

} // namespace sinew::viewer
