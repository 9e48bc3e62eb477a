// The expected motion of each body, fitted once a step: an affine map from the positions of its particles
// when contact lists were made, and the rate of this map. The validity of lists is checked relative to it
// (hash_grid): two particles that follow one motion come no nearer to each other, so a body that falls, turns
// or flies needs no new lists. A frame never changes a result, only how often lists are made.
#pragma once

#include "common/layout.h"
#include "sim/model/scene_model.hpp"

#include <span>
#include <vector>

namespace sinew::sim::collision::body_frames {

/// Groups of particles that move together.
struct Bodies {
    std::vector<std::uint32_t> ofSlots; ///< by state slot; padding belongs to any body
    std::vector<std::uint32_t> kinds;   ///< by body: FRAME_MOVES or FRAME_STANDS
    std::vector<bool> isMember;         ///< by state slot: whether a frame is fitted to it
    std::vector<bool> isAbsent;         ///< by state slot, Body::isAbsent; a body starts at another if it can

    /// Whether a body is one linked component, not all that have no frame of their own.
    static bool isAlone(std::uint32_t body);
};

/// One body each for the largest linked components, one for all other moving particles, and one for all
/// static ones.
Bodies bodiesOf(const SceneModel& model);

struct Request {
    std::span<const float> radii; ///< by state slot; below 0 = touches nothing [m]
    float reach = 0;              ///< the largest distance at which two touch [m]
    float margin = 0;             ///< additional distance up to which pairs are listed [m]
    std::uint32_t substeps = 1;   ///< of a step
    const char* name = "grid";    ///< of its buffers
};

constexpr std::uint32_t hasOneBodyId = 4; // constant_id in strays.glsl

/// Kernels that check lists read `frames`; kernels that make lists read `ofSlots`, the index of each slot's
/// body.
struct Frames {
    layout::FramePush push{};
    BufferId frames, ofSlots;
    /// Constants of kernels that check lists.
    ProgramBuilder::Constants constants() const { return {{hasOneBodyId, push.bodies == 1}}; }
    BufferId members;                       ///< slots that are checked
    std::uint32_t memberCount = 0;          ///< their number
    BufferId chunks, bodies, partial, sums; ///< invalid if nothing is fitted
};

/// A single frame for all particles, which stands still.
Frames addStanding(ProgramBuilder& program, const Request& request);

Frames add(ProgramBuilder& program, const Bodies& bodies, const Request& request);

/// Inputs of the fit.
struct Seen {
    BufferId positions;  ///< at the end of the first substep [m]
    BufferId velocities; ///< during that substep [m/s]
    BufferId detected;   ///< positions when lists were made [m]
    BufferId headings;   ///< velocities relative to frames when lists were made [m/s]; unbound = none
    BufferId radii;      ///< by slot; below 0 = touches nothing any more [m]
    BufferId bounds;     ///< one layout::GridBounds
    BufferId step;       ///< layout::StepParams
    BufferId weights;    ///< by slot: inverse mass, also of sleeping particles [1/kg]; unbound = none sleeps
    BufferId groups;     ///< sleep::Sleep::groups; unbound = all particles are checked
};

/// Appends the fit: once a step, before the first check of lists in it; nothing if nothing is fitted.
void addFit(ProgramBuilder& program, const Frames& frames, const Seen& seen);

} // namespace sinew::sim::collision::body_frames
