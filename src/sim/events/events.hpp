// Events of a step (sinew/events.hpp): which pairs of bodies, planes and colliders begin and cease to touch,
// which bodies were cut, torn and parted, and which fell asleep and woke. Passes count during a step what
// happens, by body and by pair of a body and a partner: another body of a higher index, a plane, a host
// collider or a collider. Two passes at its end compare that with the step before, and list what is new in a
// fixed order. Nothing else reads any of these buffers, so that motion keeps its bits. A scene without
// Settings::events has none of these passes.
#pragma once

#include "events/events.h"
#include "sim/core/complaints.hpp"
#include "sim/model/feature.hpp"
#include "sim/sleep/sleep.hpp"
#include "sinew/events.hpp"

namespace sinew::sim::events {

struct Events {
    static constexpr std::uint32_t otherKinds = EVENT_KINDS - EVENT_CUT; ///< sets of bodies

    layout::EventPush push{}; ///< count: slots
    bool haveContacts = false, maySleep = false, mayBeCut = false;
    std::uint32_t planes = 0, colliders = 0; ///< partners behind the bodies
    std::uint32_t hostColliders = 0;         ///< the first of the colliders
    BufferId bodies;                         ///< by slot
    BufferId noted;                          ///< layout::BodyEvents, by body, of this step
    BufferId contacts, touching;             ///< by body and partner: of this step; state (find_events.comp)
    BufferId reaches, planeTable;
    BufferId slept;    ///< by body: state
    BufferId cutLinks; ///< by slot: links after the blade, if others may tear
    /// By body, then removed fragments by body: of this step, where links died; state.
    BufferId pieces, piecesBefore;
    BufferId wholePieces;       ///< the same, uncut
    BufferId changes = unbound; ///< by body: POOL_...; unbound if none comes back whole (cutting/restoring)
    BufferId found, list;       ///< sets; layout::EventEntry
    /// Words of the sets of contacts, of those that begin and of those that end, and of one of bodies.
    std::uint32_t contactWords() const { return haveContacts ? 2 * push.bodies * push.rowWords : 0; }
    std::uint32_t bodyWords() const { return (push.bodies + 31) / 32; }
};

/// The kind of an entry that the device lists as EVENT_....
EventKind kindOf(std::uint32_t listed);

/// Complains about the settings of events, and about more pairs than ranges::mostEventPairs.
void check(const Scene& scene, const Settings& settings, Complaints& complaints);

/// Sets build.particles.events: adds the buffers. Nothing unless Settings::events has a bit for something
/// that the scene has; the functions below then add nothing either.
void add(Build& build);
/// Appends what clears the counts of a step.
void addClearing(Build& build);
/// Appends the count of particles at planes and colliders, after the last pass of a substep that moves them.
void addSupports(Build& build, const Substep& substep);

/// Candidates of contacts of particles, which of them touch, and with which positions.
struct SeenPairs {
    BufferId contacts, lists, hits, touching, bounds;
    std::optional<IndirectItems> items = {}; ///< of passes over contacts, which run for `listed` slots alone
    BufferId listed = {};
};
/// Appends the count of contacts of `predicted`, after the pass that says which candidates touch.
void addPairs(ProgramBuilder& program, const ParticleBuffers& predicted, const SeenPairs& pairs);
/// Appends the count of contacts with faces, or between edges, after they were found.
void addRows(ProgramBuilder& program, const ParticleBuffers& predicted, const sleep::SeenRows& rows);

/// Adds the buffers of cuts, once the scene has some; pieces are those of uncut bodies.
void addCutBuffers(ProgramBuilder& program, const ParticleBuffers& particles);
/// Appends what clears the counts of pieces, before addPieces().
void addPiecesCleared(ProgramBuilder& program, const ParticleBuffers& particles);
/// Appends what tells links that a blade cut from those that tear, between the two.
void addBladeEnd(ProgramBuilder& program, const ParticleBuffers& particles);
/// Appends the count of links that died among the slots of a run, after all of them have.
void addCut(ProgramBuilder& program, const ParticleBuffers& particles, const layout::CutPush& run);
/// Appends the count of pieces among the slots of a run, after pieces were found. `items`: of a pass over
/// them. `labels`: by slot, the slot that its piece is named after.
void addPieces(ProgramBuilder& program, const ParticleBuffers& particles, const layout::CutPush& run,
               const IndirectItems& items, BufferId labels);
/// Appends, to the list `rewrite`, what makes these counts the state, so that they cause no event.
void addPiecesKept(ProgramBuilder& program, const ParticleBuffers& particles);

/// Appends the list of events.
void addListing(Build& build);

} // namespace sinew::sim::events
