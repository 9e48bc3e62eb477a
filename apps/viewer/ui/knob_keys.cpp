// Sizes of a notch: two double the stiffness; others are a twentieth to a fortieth of the slider's range.
#include "viewer/ui/knob_keys.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew::viewer {

namespace {

constexpr float ofDamping = 0.5f, ofFriction = 0.1f, ofGravity = 0.5f;

std::string textOf(const char* format, float value) {
    char text[60];
    std::snprintf(text, sizeof text, format, double{value});
    return text;
}

// Changes a value by whole notches, so that the way back ends at the start.
float notched(float value, float notch, int by) {
    return notch * (std::round(value / notch) + static_cast<float>(by));
}

// Changes a factor by the square root of two, in whole notches.
float multiplied(float factor, int by) {
    return std::exp2((std::round(2 * std::log2(factor)) + static_cast<float>(by)) / 2);
}

std::string turnStiffness(Knobs& knobs, int by) {
    const bool isOne = knobs.body >= 0 && static_cast<std::size_t>(knobs.body) < knobs.bodies.size();
    float& factor = isOne ? knobs.bodies[static_cast<std::size_t>(knobs.body)] : knobs.stiffness;
    factor = multiplied(factor, by);
    limitMaterial(knobs);
    return textOf(isOne ? "stiffness of this body x %.3g" : "stiffness x %.3g", factor);
}

std::string turn(Knobs& knobs, Action action) {
    const auto by = [action](Action more) { return action == more ? 1 : -1; };
    switch (action) {
    case Action::stiffer:
    case Action::softer:
        return turnStiffness(knobs, by(Action::stiffer));
    case Action::moreDamping:
    case Action::lessDamping:
        knobs.damping = notched(knobs.damping, ofDamping, by(Action::moreDamping));
        limitMaterial(knobs);
        return textOf("damping %.2f 1/s", knobs.damping);
    case Action::moreFriction:
    case Action::lessFriction:
        knobs.friction = notched(knobs.friction, ofFriction, by(Action::moreFriction));
        limitMaterial(knobs);
        return textOf("friction %.2f", knobs.friction);
    case Action::moreGravity:
    case Action::lessGravity:
        knobs.gravity = notched(knobs.gravity, ofGravity, by(Action::moreGravity));
        limitGravity(knobs);
        return textOf("gravity %.2f m/s\u00b2", knobs.gravity);
    default:
        return {};
    }
}

} // namespace

std::optional<TurnedKnobs> turnedBy(Action action, Knobs knobs) {
    std::string said = turn(knobs, action);
    if (said.empty()) return std::nullopt;
    return TurnedKnobs{std::move(knobs), std::move(said)};
}

void limitGravity(Knobs& knobs) {
    knobs.gravity = std::clamp(knobs.gravity, 0.0f, 1000.0f);
}

void limitMaterial(Knobs& knobs) {
    constexpr float least = 1e-4f, most = 1e4f, mostDamping = 100, mostFriction = 10;
    knobs.stiffness = std::clamp(knobs.stiffness, least, most);
    for (float& factor : knobs.bodies) factor = std::clamp(factor, least, most);
    knobs.damping = std::clamp(knobs.damping, 0.0f, mostDamping);
    knobs.friction = std::clamp(knobs.friction, 0.0f, mostFriction);
}

} // namespace sinew::viewer
