// The second simulation of a comparison: the same scene by another solver or with other substeps. It steps
// together with the first one, receives the same input, and both are measured in the same way, so that speed
// and error can be compared while they play.
#pragma once

#include "sinew/vk/timestamps.hpp"
#include "viewer/document/document.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/jobs/gauges.hpp"
#include "viewer/tools/tools.hpp"

namespace sinew::viewer {

/// The settings in which it differs from the first.
struct BesideShape {
    sim::Solver solver = sim::Solver::gaussSeidel;
    std::uint32_t substeps = 0; ///< per step; 0 = as many as the scene needs
    bool operator==(const BesideShape&) const = default;
};

/// A comparison that every scene allows: the solver of the first with 8 substeps, or with half as many as the
/// first if that has no more than 8. Empty if the first has one substep.
std::optional<BesideShape> shapeInstead(const sim::Settings& first);

/// Parses "SOLVER" or "SOLVER:SUBSTEPS"; empty for any other text.
std::optional<BesideShape> parseBeside(const std::string& text);
BesideKnobs knobsOf(const BesideShape& shape);
BesideShape shapeOf(const BesideKnobs& knobs);
/// Text such as "gauss_seidel, 4 substeps".
std::string toText(const BesideShape& shape);

/// Must not outlive its Device, which must not move. May be made in any thread; afterwards used by the thread
/// of the first.
class SecondSimulation {
public:
    /// Takes scene, blades, material and capacities of `first`. At most `slots` pictures may be in flight at
    /// a time. Throws std::invalid_argument naming what the solver has no form for, and vk::Error.
    SecondSimulation(const vk::Device& device, const scenes::LoadedScene& loaded,
                     const sim::Settings& settings, const sim::Material& material, const BesideShape& shape,
                     std::uint32_t slots);

    /// Instead of a reset: continues from the state of `first`. All steps of both must have finished.
    void recordTakeOver(VkCommandBuffer commands, const Document& first);
    void recordReset(VkCommandBuffer commands) noexcept;
    /// Records the step that was just recorded for `first`. `isTimed`: the step of the first is timed too.
    void recordStep(VkCommandBuffer commands, const Document& first, const StepHands& hands,
                    std::uint32_t slot, bool isTimed) noexcept;
    /// Records the skins and, if `isMeasured`, a copy of the particle positions.
    void recordPicture(VkCommandBuffer commands, std::uint32_t slot, bool isMeasured) noexcept;

    /// Why it cannot continue; if contacts need more room, for how many.
    struct Trouble {
        std::string why;
        std::uint32_t room = 0;
    };
    /// Call when the picture in the slot has finished. `first`: the state that the first had in that picture,
    /// if it was measured too; null = it is not to be compared. Empty if all is well.
    std::optional<Trouble> settle(std::uint32_t slot, const StateProbe* first);

    const sim::Simulation& simulation() const noexcept { return document_.simulation(); }
    const Document& document() const noexcept { return document_; }
    const BesideShape& shape() const noexcept { return shape_; }
    /// Warnings that loading the scene with these settings gives and loading it with its own does not.
    const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    /// Notes on features that bodies have in the first simulation and do without here.
    const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// The facts that gauges know.
    Facts facts() const { return gauges_.facts(document_); }
    /// How far it is from the first; empty until it is measured.
    const std::optional<Distance>& apart() const noexcept { return apart_; }

private:
    struct Flight {
        std::uint64_t firstStep = 0;
        std::uint32_t steps = 0;
        bool isTimed = false, isMeasured = false;
    };
    void restart() noexcept;
    BesideShape shape_; // with the number of substeps filled in
    Document document_;
    std::vector<std::string> warnings_, notes_;
    Gauges gauges_;
    StateProbe probe_;
    std::optional<Distance> apart_;
    std::vector<vk::Timestamps> times_;
    std::vector<Flight> flights_;
};

} // namespace sinew::viewer
