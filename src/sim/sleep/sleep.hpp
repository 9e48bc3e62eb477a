// Island sleeping: detection of rest, dispatched groups, wake conditions. An island consists of all bodies
// that are linked or in contact; it sleeps after half a second at rest. Its particles then count as static in
// every pass, and dispatches of the step become indirect: they run only for work groups with an awake
// particle. An island wakes before something touches it, and when a step begins with another gravity or
// length, a moved anchor or collider nearby, or Step::wakes. A scene without Settings::sleeps has none of
// these passes.
#pragma once

#include "sim/model/feature.hpp"

namespace sinew::sim::sleep {

/// Face or edge contacts that wake and join islands: the buffers that both kernels bind last, and their
/// constants.
struct SeenRows {
    std::vector<BufferId> buffers;
    ProgramBuilder::Constants constants;
};

struct Sleep {
    layout::SleepPush push{};
    BufferId state, weights, limits, rests, components, islands, least, marks;
    BufferId loose = unbound; ///< by slot: 1 = a particle without links; unbound if all have some
    BufferId groups, listed, passes, arguments, waking;
    BufferId attachments, anchors, seenAnchors, colliders, contactOffsets, ways, seenPoses;
    /// Particles that touch: their lists, which candidates touch, with which positions, and the ways of
    /// hash_grid::Grid. Invalid without.
    struct {
        BufferId contacts, lists, hits, touching, bounds, ways;
    } pairs;
    std::vector<SeenRows> rows;                ///< contacts with faces and between edges
    std::vector<layout::SleepPass> passesSeen; ///< by element of `arguments`
};

/// Largest drift of a resting particle by slot [m]: 0.02 radii, or without a radius 0.01 of the mean length
/// of its links.
std::vector<float> restLimits(const Scene& scene, const StateLayout& layout);
/// Inverse masses by slot, also of sleeping particles [1/kg]; unbound if none can sleep.
BufferId weightsOf(const ParticleBuffers& particles);
/// By work group of particles: 0 if passes over listed groups leave it out; unbound if none can sleep.
BufferId groupsOf(const ParticleBuffers& particles);

/// The listed groups alone, of a scene in which nothing sleeps but bodies may be absent (motions/pool.hpp):
/// all run at first.
std::shared_ptr<Sleep> addGroups(Build& build);
/// Appends the pass that lists groups anew. Direct dispatches that follow run for listed groups, or whole.
void addListing(ProgramBuilder& program, const std::shared_ptr<Sleep>& sleep, const IndirectItems& items);
/// Ends that range.
void finishListing(ProgramBuilder& program, const Sleep& sleep);

/// Sets build.particles.sleep: adds the buffers. Nothing unless Settings::sleeps; the functions below then
/// add nothing either.
void add(Build& build);

/// Appends the passes at the start of a step, after attachments and colliders were added. Later passes run
/// only while a particle is awake.
void addOpening(Build& build);
/// Appends passes in a substep, before contacts of `predicted` are counted: touched particles wake.
void addTouches(ProgramBuilder& program, const ParticleBuffers& predicted);
/// Appends passes in a substep, after contacts with faces, or between edges, were found: touched particles
/// wake.
void addRowTouches(ProgramBuilder& program, const ParticleBuffers& predicted, const SeenRows& rows);

/// Appends passes after the check of a step: detect rest, and put islands to sleep.
void addDetection(Build& build);
/// Appends passes after publishing, and ends the range that addOpening began.
void finish(Build& build);

} // namespace sinew::sim::sleep
