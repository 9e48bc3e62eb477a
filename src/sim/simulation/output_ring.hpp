// Copies of the outputs of the newest steps: step N lies in buffers that step N + 1 does not write.
#pragma once

#include "sim/device/gpu_executor.hpp"
#include "sinew/simulation.hpp"

#include <optional>
#include <vector>

namespace sinew::sim {

class OutputRing {
public:
    /// Makes the copies for Settings::outputFrames steps; none for 0. `program` and `executor` must outlive
    /// the ring.
    OutputRing(const vk::Device& device, const StepProgram& program, const GpuExecutor& executor,
               const Settings& settings);

    /// Records the copies of what the step `frame` has left, behind a barrier after it.
    void recordStep(vk::Commands& commands, std::uint64_t frame) noexcept;
    /// Records the copies of what recordSkin() has left, behind a barrier after it, for the newest step.
    void recordSkin(vk::Commands& commands) noexcept;
    /// The state has come from elsewhere: no step has led to it.
    void forget() noexcept;
    /// As Simulation::outputs().
    Outputs outputs(std::uint64_t frame) const noexcept;
    bool areKept() const noexcept { return !slots_.empty(); }

private:
    enum class By { step, skin };
    struct Kept {
        BufferId buffer;
        By by;
    };
    struct Slot {
        std::optional<std::uint64_t> frame;
        bool hasSkin = false;
        std::vector<vk::Buffer> copies; // one for each of kept_
    };
    void record(vk::Commands& commands, const Slot& slot, By by) const noexcept;

    const StepProgram& program_;
    const GpuExecutor& executor_;
    std::vector<Kept> kept_;
    std::vector<Slot> slots_;
    std::optional<std::uint64_t> newest_;
};

} // namespace sinew::sim
