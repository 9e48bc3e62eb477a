// The motion that each body is expected to have, fitted once a step: an affine map of where its particles
// were when lists of contacts were made, and its rate. Lists are watched against it (hash_grid): two
// particles that follow one motion come no nearer each other, so what falls, turns or flies needs no new
// lists. A frame never changes a result, only how often lists are made.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <span>
#include <vector>

namespace sinew::sim::collision::body_frames {

/// Groups of particles that move together.
struct Bodies {
    std::vector<std::uint32_t> ofSlots; ///< by state slot; padding belongs to any
    std::vector<std::uint32_t> kinds;   ///< by body: FRAME_MOVES or FRAME_STANDS
    std::vector<bool> isMember;         ///< by state slot: whether a frame is fitted to it
};

/// The largest linked bodies, all else that moves, and all that never does.
Bodies bodiesOf(const Scene& scene, const StateLayout& layout);

struct Request {
    std::span<const float> radii; ///< by state slot; below 0 = touches nothing [m]
    float reach = 0;              ///< the largest at which two touch [m]
    float margin = 0;             ///< beyond it, up to which a pair is listed [m]
    std::uint32_t substeps = 1;   ///< of a step
    const char* name = "grid";    ///< of its buffers
};

constexpr std::uint32_t hasOneBodyId = 4; // constant_id in strays.glsl

/// `frames` are read by kernels that watch lists, `ofSlots`, the number of the body, by those that make them.
struct Frames {
    layout::FramePush push{};
    BufferId frames, ofSlots;
    /// Specialises kernels that watch lists.
    ProgramBuilder::Constants constants() const { return {{hasOneBodyId, push.bodies == 1}}; }
    BufferId members;                       ///< slots that are watched
    std::uint32_t memberCount = 0;          ///< how many
    BufferId chunks, bodies, partial, sums; ///< invalid where nothing is fitted
};

/// One frame for all, which stands still.
Frames addStanding(ProgramBuilder& program, const Request& request);

Frames add(ProgramBuilder& program, const Bodies& bodies, const Request& request);

/// The buffers that frames are fitted to.
struct Seen {
    BufferId positions;  ///< at the end of the first substep [m]
    BufferId velocities; ///< with which particles came there [m/s]
    BufferId detected;   ///< where particles were when lists were made [m]
    BufferId radii;      ///< by slot; below 0 = touches nothing any more [m]
    BufferId bounds;     ///< one layout::GridBounds
    BufferId step;       ///< layout::StepParams
};

/// Once a step, before lists are first watched in it; nothing where nothing is fitted.
void addFit(ProgramBuilder& program, const Frames& frames, const Seen& seen);

} // namespace sinew::sim::collision::body_frames
