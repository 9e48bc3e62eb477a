// A second simulation of the scene on show, by another solver or with other substeps: it is played in step
// with the first, hands do in it what they do there, and both are measured alike, so that speed and error of
// the two can be compared while they play.
#pragma once

#include "viewer/draw/stage.hpp"
#include "viewer/gauges.hpp"
#include "viewer/hands/state_probe.hpp"
#include "viewer/tools.hpp"
#include "vk/timestamps.hpp"

namespace sinew::viewer {

/// What it differs in from the first.
struct BesideShape {
    sim::Solver solver = sim::Solver::gaussSeidel;
    std::uint32_t substeps = 0; ///< per step; 0 = as many as the scene needs
    bool operator==(const BesideShape&) const = default;
};

/// "SOLVER" or "SOLVER:SUBSTEPS"; nothing of what is neither.
std::optional<BesideShape> parseBeside(const std::string& text);
BesideKnobs knobsOf(const BesideShape& shape);
BesideShape shapeOf(const BesideKnobs& knobs);
/// "gauss_seidel, 4 substeps".
std::string toText(const BesideShape& shape);

/// Must not outlive its Device, which must not move. Made in any thread, then used by that of the first.
class Beside {
public:
    /// Of the scene, blades, material and room of `first`. `slots` pictures may be under way at a time.
    /// Throws std::invalid_argument with what the solver has no form for, and vk::Error.
    Beside(const vk::Device& device, const scenes::LoadedScene& loaded, const sim::Settings& settings,
           const sim::Material& material, const BesideShape& shape, std::uint32_t slots);

    /// Instead of a reset: goes on where `first` stands, all steps of both have finished.
    void recordTakeOver(VkCommandBuffer commands, const Stage& first);
    void recordReset(VkCommandBuffer commands) noexcept;
    /// The step that was recorded for `first` just now, and that of the first is timed.
    void recordStep(VkCommandBuffer commands, const Stage& first, const StepHands& hands, std::uint32_t slot,
                    bool isTimed) noexcept;
    /// What is drawn, for layers with that overlap, and with `isMeasured` a copy of where particles are.
    void recordPicture(VkCommandBuffer commands, std::uint32_t slot, bool isMeasured,
                       sim::Overlap overlap = sim::Overlap::none) noexcept;

    /// Why it cannot go on; where contacts need more room, for how many with one.
    struct Trouble {
        std::string why;
        std::uint32_t room = 0;
    };
    /// Of a slot that has finished. Nothing where all is well.
    std::optional<Trouble> settle(std::uint32_t slot);

    const sim::Simulation& simulation() const noexcept { return stage_.simulation(); }
    const Stage& stage() const noexcept { return stage_; }
    const BesideShape& shape() const noexcept { return shape_; }
    /// Warnings of loading the scene in this shape that loading it in its own does not give.
    const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    /// Notes on what bodies have in the first and do without here.
    const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// As far as gauges know them.
    Facts facts() const { return gauges_.facts(stage_); }

private:
    struct Flight {
        std::uint64_t firstStep = 0;
        std::uint32_t steps = 0;
        bool isTimed = false, isMeasured = false;
    };
    BesideShape shape_; // with a number of substeps
    Stage stage_;
    std::vector<std::string> warnings_, notes_;
    Gauges gauges_;
    StateProbe probe_;
    std::vector<vk::Timestamps> times_;
    std::vector<Flight> flights_;
};

} // namespace sinew::viewer
