// Facts about a scene on show, out of the simulation: what its step consists of, what finished steps say.
#pragma once

#include "layout.h"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/state_probe.hpp"
#include "viewer/opening.hpp"
#include "viewer/panels/facts.hpp"

namespace sinew::viewer {

/// What stays the same. `settings` as the stage runs with them.
SceneFacts sceneFacts(const Opening& opening, const Stage& stage, const vk::Device& device);

/// How many links are clamped, and how soft the softest is; empty where none is elastic.
std::string stiffnessText(const Stage& stage);

/// What was turned of the material; what is as in the file is left as it is there.
sim::Material materialOf(const Knobs& knobs, const Knobs& fromFile);

/// `knobs` turned so that this is their material.
Knobs turnedTo(const sim::Material& material, Knobs knobs, const Knobs& fromFile);

/// Strain of the links that are not cut, in the state that `probe` recorded last.
Strain measureStrain(const sim::Scene& scene, StateProbe& probe);

/// Collects what changes.
class Gauges {
public:
    Gauges(const Stage& stage, double dt);

    /// A picture, `seconds` after the last, with `steps` before it.
    void frame(double seconds, std::uint32_t steps);
    /// GPU time of a step, by phase [ms].
    void stepTimed(std::span<const double> milliseconds);
    void stepFinished(const sim::Status& status);
    void stepsRepeated(std::uint64_t steps) { facts_.stepsRepeated += steps; }
    void strainMeasured(const Strain& strain);
    /// Sets the number of pieces that is shown until the next call.
    void piecesCounted(const app::PieceCount& count) { facts_.pieces = count; }
    const app::PieceCount& pieces() const { return facts_.pieces; }
    /// After a reset, or a way back.
    void restart();
    /// After the simulation of `before` was taken over from, which may have other phases.
    void goOn(const Gauges& before);

    /// Filled in but for what the window, the tools and the player know.
    Facts facts(const Stage& stage) const;

private:
    double dt_;
    Facts facts_;
    double seconds_ = 0, shown_ = 0; // of the clock and of the scene, for the pace
    std::uint32_t frames_ = 0;
};

} // namespace sinew::viewer
