// Bodies at rest cost nothing (contacts: 6). What has rested for half a second sleeps, an island at a time:
// all that is linked or touches. It is then to every pass a thing that never moves, and dispatches of the
// step become indirect: they run for work groups in which somebody is awake, or not at all. Islands wake
// before somebody touches them, and when a step begins with another gravity or length, a moved anchor or
// collider nearby, or a host that says so. A scene that does not ask for it (Settings::sleeps) has none of
// this.
#pragma once

#include "sim/collision/colliders.hpp"
#include "sim/compile.hpp"
#include "sim/constraints/attachment.hpp"

namespace sinew::sim::sleep {

/// Contacts by which particles are judged, between faces and points or between edges: kernels that wake and
/// join their islands, and the buffers that both end with.
struct SeenRows {
    const vk::ShaderCode* wake = nullptr;
    const vk::ShaderCode* join = nullptr;
    std::vector<BufferId> buffers;
};

struct Sleep {
    layout::SleepPush push{};
    BufferId state, weights, limits, rests, components, islands, least, marks;
    BufferId groups, listed, passes, arguments, waking;
    BufferId attachments, anchors, seenAnchors, colliders, contactOffsets, ways, seenPoses;
    /// What particles that touch are judged by: their lists, and where contacts are counted. Invalid without.
    struct {
        BufferId contacts, lists, touching, bounds;
    } pairs;
    std::vector<SeenRows> rows;                ///< likewise of contacts with faces and between edges
    std::vector<layout::SleepPass> passesSeen; ///< by element of `arguments`
};

/// Before the passes of the solver, whose state is `particles`.
std::shared_ptr<Sleep> add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                           const ParticleBuffers& particles);

/// Where a step begins; nothing where particles.sleep is none. From here on passes run only while somebody is
/// awake.
void addOpening(ProgramBuilder& program, const ParticleBuffers& particles,
                const constraints::attachment::Attachments& attachments = {},
                const collision::colliders::Colliders& colliders = {});

/// The form of a kernel over particles that runs for the work groups in a list, which it binds last.
const vk::ShaderCode& listedForm(const vk::ShaderCode& code);

/// In a substep, before contacts of `predicted` are counted: what is touched wakes.
void addTouches(ProgramBuilder& program, const ParticleBuffers& predicted);
/// Likewise, after contacts with faces, or between edges, were found.
void addRowTouches(ProgramBuilder& program, const ParticleBuffers& predicted, const SeenRows& rows);

/// After publishing: ends what addOpening began.
void finish(ProgramBuilder& program, const ParticleBuffers& particles);

} // namespace sinew::sim::sleep
