// Keys that adjust the same parameters as the panels' sliders.
#pragma once

#include "viewer/input/bindings.hpp"
#include "viewer/ui/facts.hpp"

namespace sinew::viewer {

struct TurnedKnobs {
    Knobs knobs;
    std::string said; ///< text on the changed parameter
};

/// Changes a parameter by one notch; empty if the action changes none.
std::optional<TurnedKnobs> turnedBy(Action action, Knobs knobs);

/// Clamp gravity and material to sensible ranges.
void limitGravity(Knobs& knobs);
void limitMaterial(Knobs& knobs);

} // namespace sinew::viewer
