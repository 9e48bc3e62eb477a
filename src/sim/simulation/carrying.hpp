// The state that passes between simulations of scenes with different bodies: entries of buffers move to the
// indices that their elements have in the other scene.
#pragma once

#include "sim/device/gpu_executor.hpp"
#include "sinew/scene.hpp"
#include "sinew/vk/commands.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace sinew::sim {

/// By index of an element in a scene: its index in the scene before, or NO_ELEMENT.
using Origin = std::vector<std::uint32_t>;

/// The elements of a scene that were part of the scene before.
struct Origins {
    Origin particles, attachments, skins, bodies, planes;
    Origin movers; ///< host colliders, colliders, driven bodies
};

/// One side of a take-over.
struct CarriedState {
    const StepProgram& program;
    const GpuExecutor& executor;
};

/// The dispatches that carry a state, with their tables. May be made on any thread. Must outlive the commands
/// that record() adds; both sides must, too.
class Carrying {
public:
    /// Throws vk::Error if the device has no memory for the tables.
    Carrying(const vk::Device& device, const CarriedState& from, const CarriedState& to,
             const Origins& origins);

    /// Records the dispatches, after the initial contents of the other side were uploaded.
    void record(vk::Commands& commands) const noexcept;
    /// Records what makes the initial state of new particles one between two steps of `split`. `halfKick` is
    /// the velocity that gravity adds in half a substep [m/s], `thetaH` as in layout::StepParams [s].
    void recordArrivals(vk::Commands& commands, const Vec3& halfKick, float thetaH) const noexcept;
    /// Records the copy of the number of links that were cut, which List::rewrite does not know.
    void recordCounts(vk::Commands& commands) const noexcept;

private:
    // Elements that follow each other on both sides.
    struct Run {
        std::uint32_t from = 0, to = 0, count = 0;
    };
    // Indices of one kind of element, in both directions.
    struct Table {
        Origin origins, targets;
        std::vector<Run> runs;                   // of all that are carried
        vk::BufferView originsView, targetsView; // made at first use
        /// A number that all indices before are below.
        std::uint32_t before() const {
            std::uint32_t end = 0;
            for (const std::uint32_t origin : origins) // NO_ELEMENT + 1 is 0
                end = std::max(end, origin + 1);
            return end;
        }
    };
    struct Move {
        const vk::Kernel* kernel = nullptr;
        std::uint32_t items = 0;
        std::vector<std::uint32_t> push;
    };
    struct Copy {
        vk::BufferView from, to;
    };
    class Plan;

    std::shared_ptr<const vk::Kernel> ofElements_, ofContacts_, ofArrivals_;
    std::vector<vk::Buffer> tables_;
    std::vector<Move> moves_, arrivals_;
    std::vector<vk::BindingSets> sets_; // one: of moves, then of arrivals
    std::vector<Copy> copies_;
    Copy counts_{};
};

} // namespace sinew::sim
