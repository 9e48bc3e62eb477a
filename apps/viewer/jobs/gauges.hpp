// Statistics of the scene on show for the panels: what a step consists of, and the results of finished steps.
#pragma once

#include "common/layout.h"
#include "viewer/document/document.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/ui/facts.hpp"

#include <map>

namespace sinew::viewer {

/// Young's modulus of the material of a voxel body, as Lattice::youngModulus [Pa]; 0 for sheets and rigid
/// links.
float youngModulusOf(const sim::Grid& grid);

/// Facts that stay constant while a scene is shown. `settings` are those the document runs with.
SceneFacts sceneFacts(const OpenedScene& opening, const Document& document, const vk::Device& device);

/// Sets SceneFacts::stiffness and neededSubsteps.
void setStiffness(SceneFacts& facts, const sim::StiffnessReport& report);

/// The material that the knobs ask for; values equal to those of the file leave the file's own.
sim::Material materialOf(const Knobs& knobs, const Knobs& fromFile);

/// `knobs` with the values of `material`.
Knobs turnedTo(const sim::Material& material, Knobs knobs, const Knobs& fromFile);

/// Strain of the live links, in the state that `probe` recorded last.
Strain measureStrain(const sim::Scene& scene, StateProbe& probe);

/// The distance between the same particles in two states of a scene, over those that both show; empty if they
/// show none.
std::optional<Distance> measureDistance(const StateProbe& first, const StateProbe& second);

/// Collects the facts that change.
class Gauges {
public:
    Gauges(const Document& document, double dt);

    /// Adds a picture, `seconds` after the last one, with `steps` before it.
    void frame(double seconds, std::uint32_t steps);
    /// GPU time of one step, by phase [ms].
    void stepTimed(std::span<const double> milliseconds);
    void stepFinished(const sim::Status& status);
    void stepsRepeated(std::uint64_t steps) { facts_.stepsRepeated += steps; }
    void strainMeasured(const Strain& strain);
    /// Sets the number of pieces that is shown until the next call.
    void piecesCounted(const app::PieceCount& count) { facts_.pieces = count; }
    const app::PieceCount& pieces() const { return facts_.pieces; }
    /// Keeps the counts of cuts of the states to return to (see History::times()), which are the present ones
    /// where none are kept, and forgets all others.
    void keepCuts(const std::vector<std::uint64_t>& times);
    /// Shows the counts of the state at `played`: those kept for the first time from there on, since cuts
    /// follow such a time at once. Without one the present counts are those.
    void returnTo(std::uint64_t played);
    /// Call after a reset, or after an earlier state was restored.
    void restart();
    /// Call after the simulation of `before` was taken over; the new one may have other phases.
    void goOn(const Gauges& before);

    /// All facts except those of window, tools and player.
    Facts facts(const Document& document) const;

private:
    struct Cuts {
        app::PieceCount pieces;
        std::uint32_t linksCut, debris, debrisParticles;
        float debrisMass;
    };
    Cuts cuts() const;

    double dt_;
    Facts facts_;
    std::map<std::uint64_t, Cuts> cutsAt_; // by the times of states to return to
    double seconds_ = 0, shown_ = 0;       // of the clock and of the scene, for the pace
    std::uint32_t frames_ = 0;
};

} // namespace sinew::viewer
