// The tables of events, and the passes that count and compare.
#include "sim/events/events.hpp"

#include "kernels.hpp"
#include "sim/program/first_contents.hpp"
#include "sim/rigid/colliders.hpp"
#include "sinew/events.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>

namespace sinew::sim::events {

namespace {

namespace k = kernels;

static_assert(static_cast<int>(EventKind::contactBegins) == EVENT_CONTACT_BEGINS &&
              static_cast<int>(EventKind::contactEnds) == EVENT_CONTACT_ENDS &&
              static_cast<int>(EventKind::cut) == EVENT_CUT &&
              static_cast<int>(EventKind::tear) == EVENT_TEAR &&
              static_cast<int>(EventKind::pieces) == EVENT_PIECES &&
              static_cast<int>(EventKind::sleeps) == EVENT_SLEEPS &&
              static_cast<int>(EventKind::wakes) == EVENT_WAKES &&
              static_cast<int>(EventKind::lacksRoom) == EVENT_FRAGMENTS);

// constant_ids of the kernels of events, and of colliders.glsl
constexpr std::uint32_t maySleepId = 1, haveContactsId = 2, mayBeCutId = 3, mayComeBackId = 4, tearsId = 1,
                        planeCountId = 1, colliderCountId = 2, hostColliderCountId = 4, isOpenId = 5;

std::uint32_t partnersOf(const Scene& scene, const Settings& settings) {
    return static_cast<std::uint32_t>(scene.bodies.size() + scene.planes.size() + scene.colliders.size()) +
           settings.hostColliders;
}

bool listsContacts(const Settings& settings) {
    return (settings.events & contactEvents) != 0;
}

// Distance up to which a particle counts as lying on a surface [m]; particles that never move lie on none.
std::vector<float> reachesOf(const SceneModel& model, const std::vector<float>& limits) {
    constexpr float never = -1e38f;
    const StateLayout& layout = model.layout;
    std::vector<float> reaches(layout.count, never);
    for (std::size_t i = 0; i < model.scene.particles.size(); ++i) {
        const std::uint32_t slot = layout.slot[i];
        if (model.moves(static_cast<std::uint32_t>(i)) && model.inverseMass[i] > 0)
            reaches[slot] = model.scene.particles[i].contactOffset + limits[slot];
    }
    return reaches;
}

BufferId uploadPlanes(ProgramBuilder& program, const Scene& scene) {
    if (scene.planes.empty()) return unbound;
    std::vector<layout::vec4> planes;
    for (const Plane& plane : scene.planes)
        planes.push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset});
    return program.upload("events.planes", planes);
}

void addContactBuffers(Build& build, Events& events) {
    ProgramBuilder& program = build.program;
    const SceneModel& model = build.model;
    const Scene& scene = model.scene;
    layout::EventPush& push = events.push;
    push.partners = partnersOf(scene, model.settings);
    push.rowWords = (push.partners + 31) / 32;
    events.planes = static_cast<std::uint32_t>(scene.planes.size());
    events.colliders = push.partners - push.bodies - events.planes;
    events.hostColliders = model.settings.hostColliders;
    const std::uint64_t pairs = std::uint64_t{push.bodies} * push.rowWords * 32;
    events.contacts = program.scratch<std::uint32_t>("events.contacts", pairs);
    events.touching = program.scratch<std::uint32_t>("events.touching", pairs);
    program.addToState(events.touching, events.touching, {.of = Elements::bodyPartners});
    if (events.planes + events.colliders == 0) return;
    const std::vector<float> limits = sleep::restLimits(scene, model.layout);
    events.reaches = program.upload("events.reaches", reachesOf(model, limits));
    build.particles.supportReach = *std::ranges::max_element(limits);
    events.planeTable = uploadPlanes(program, scene);
}

layout::EventCutPush pushOf(const layout::CutPush& run, const Events& events) {
    return {run.first, run.count, run.stiffLinks, run.run, events.push.bodies};
}

// Bits of the kinds that the device lists.
std::uint32_t listedKinds(std::uint32_t asked) {
    std::uint32_t kinds = 0;
    for (std::uint32_t kind = 0; kind < EVENT_KINDS; ++kind)
        if ((asked & bitOf(kindOf(kind))) != 0) kinds |= 1u << kind;
    return kinds;
}

ProgramBuilder::Constants constantsOf(const Events& events) {
    return {{haveContactsId, events.haveContacts}, {mayBeCutId, events.mayBeCut}};
}

const Events* cutEventsOf(const ParticleBuffers& particles) {
    return particles.events && particles.events->mayBeCut ? particles.events.get() : nullptr;
}

const Events* contactEventsOf(const ParticleBuffers& particles) {
    return particles.events && particles.events->haveContacts ? particles.events.get() : nullptr;
}

} // namespace

EventKind kindOf(std::uint32_t listed) {
    return listed == EVENT_FRAGMENTS ? EventKind::fragments : static_cast<EventKind>(listed);
}

void check(const Scene& scene, const Settings& settings, Complaints& complaints) {
    if ((settings.events & ~allEvents) != 0)
        complaints.add("settings.events", "has bits of no kind of event: use those of EventKind");
    complaints.check(static_cast<double>(settings.eventRoom), ranges::eventRoom,
                     [] { return "settings.eventRoom"; });
    if (!listsContacts(settings)) return;
    const std::uint64_t pairs = std::uint64_t{scene.bodies.size()} * partnersOf(scene, settings);
    if (pairs <= ranges::mostEventPairs) return;
    complaints.add("settings.events", "lists contacts, but " + number(pairs) +
                                          " pairs of bodies, planes and colliders are more than " +
                                          number(ranges::mostEventPairs) + ": leave out contactEvents");
}

void add(Build& build) {
    const SceneModel& model = build.model;
    const Settings& settings = model.settings;
    const std::uint32_t kinds = listedKinds(settings.events);
    if (kinds == 0 || model.scene.bodies.empty()) return;
    ProgramBuilder& program = build.program;
    auto events = std::make_shared<Events>();
    layout::EventPush& push = events->push;
    push.count = static_cast<std::uint32_t>(model.layout.count);
    push.bodies = static_cast<std::uint32_t>(model.scene.bodies.size());
    push.kinds = kinds;
    push.room = settings.eventRoom;
    events->haveContacts = listsContacts(settings);
    events->maySleep = settings.sleeps;
    events->bodies = program.upload("events.bodies", bodiesOfSlots(model.scene, model.layout, NO_BODY));
    events->noted = program.scratch<layout::BodyEvents>("events.noted", push.bodies);
    if (events->haveContacts) addContactBuffers(build, *events);
    if (events->maySleep) {
        events->slept = program.scratch<std::uint32_t>("events.slept", push.bodies);
        program.addToState(events->slept, events->slept, {.of = Elements::bodies});
    }
    events->found = program.scratch<std::uint32_t>(
        "events.found", events->contactWords() + Events::otherKinds * events->bodyWords());
    events->list = program.scratch<layout::EventEntry>("events.list", 1 + std::uint64_t{push.room});
    program.program().events = {.list = events->list,
                                .bodies = push.bodies,
                                .planes = events->planes,
                                .hostColliders = events->hostColliders,
                                .colliders = events->colliders - events->hostColliders,
                                .rowWords = push.rowWords};
    build.particles.events = events;
}

void addClearing(Build& build) {
    const auto& events = build.particles.events;
    if (!events) return;
    build.program.fill(events->list, 0);
    build.program.fill(events->noted, 0);
    if (events->haveContacts) build.program.fill(events->contacts, 0);
}

void addSupports(Build& build, const Substep& substep) {
    const Events* events = contactEventsOf(build.particles);
    if (!events || events->planes + events->colliders == 0) return;
    const auto* colliders = build.find<rigid::colliders::Colliders>();
    const bool haveColliders = events->colliders > 0;
    layout::EventPush push = events->push;
    if (haveColliders && colliders->areMoving) push.poses = (substep.index + 1) * colliders->placed;
    const ParticleBuffers& particles = substep.particles;
    build.program.dispatch(
        k::noteSupports, push.count,
        {events->bodies, events->contacts, events->reaches, particles.positions, particles.velocities,
         particles.step, events->planeTable, haveColliders ? colliders->shapes : unbound,
         haveColliders ? colliders->poses : unbound, boundIf(substep.isOpen(), substep.corrections),
         haveColliders ? colliders->near : unbound},
        push,
        {{planeCountId, events->planes},
         {colliderCountId, events->colliders},
         {hostColliderCountId, events->hostColliders},
         {isOpenId, substep.isOpen()}});
}

void addPairs(ProgramBuilder& program, const ParticleBuffers& predicted, const SeenPairs& pairs) {
    const Events* events = contactEventsOf(predicted);
    if (!events) return;
    const std::vector<BufferId> buffers{events->bodies, events->contacts, predicted.velocities,
                                        pairs.contacts, pairs.lists,      pairs.hits,
                                        pairs.touching, pairs.bounds};
    if (pairs.items)
        program.dispatchListed(k::notePairs, *pairs.items, buffers, pairs.listed, events->push,
                               {{RUNS_OVER_ID, RUNS_OVER_COUNTED}});
    else
        program.dispatch(k::notePairs, events->push.count, buffers, events->push);
}

void addRows(ProgramBuilder& program, const ParticleBuffers& predicted, const sleep::SeenRows& rows) {
    const Events* events = contactEventsOf(predicted);
    if (!events) return;
    std::vector<BufferId> buffers{events->bodies, events->contacts, predicted.velocities};
    buffers.insert(buffers.end(), rows.buffers.begin(), rows.buffers.end());
    program.dispatch(k::noteRows, events->push.count, buffers, events->push, rows.constants);
}

void addCutBuffers(ProgramBuilder& program, const ParticleBuffers& particles) {
    if (!particles.events || (particles.events->push.kinds & listedKinds(cutEvents)) == 0) return;
    Events& events = *particles.events;
    const auto sizes = firstContents<std::uint32_t>(program, program.program().cutting.pieceSizes);
    const auto bodies = firstContents<std::uint32_t>(program, events.bodies);
    std::vector<std::uint32_t> pieces(2 * std::size_t{events.push.bodies}); // then fragments: none
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const std::uint32_t body = bodies[program.program().slots[i]];
        if (sizes[i] > 0 && body != NO_BODY) ++pieces[body];
    }
    events.mayBeCut = true;
    events.pieces = program.scratch<std::uint32_t>("events.pieces", pieces.size());
    events.piecesBefore = program.upload("events.pieces_before", pieces);
    events.wholePieces = program.upload("events.whole_pieces", pieces);
    program.addToState(events.piecesBefore, events.piecesBefore);
    program.program().cutting.topology.push_back(events.piecesBefore);
    if (program.program().cutting.tears)
        events.cutLinks = program.scratch<std::uint32_t>("events.cut_links", events.push.count);
}

void addPiecesCleared(ProgramBuilder& program, const ParticleBuffers& particles) {
    if (const Events* events = cutEventsOf(particles)) program.fill(events->pieces, 0);
}

void addBladeEnd(ProgramBuilder& program, const ParticleBuffers& particles) {
    const Events* events = cutEventsOf(particles);
    if (events && events->cutLinks != BufferId{})
        program.copy(program.program().cutting.links, events->cutLinks);
}

void addCut(ProgramBuilder& program, const ParticleBuffers& particles, const layout::CutPush& run) {
    const Events* events = cutEventsOf(particles);
    if (!events) return;
    const CuttingBuffers& cutting = program.program().cutting;
    const bool tears = events->cutLinks != BufferId{};
    program.dispatchIndirect(k::noteCuts, {cutting.listedArguments, run.run, run.count},
                             {events->bodies, cutting.savedLinks, boundIf(tears, events->cutLinks),
                              cutting.links, cutting.listedCounts, cutting.listed, events->noted},
                             pushOf(run, *events), {{tearsId, tears}});
}

void addPieces(ProgramBuilder& program, const ParticleBuffers& particles, const layout::CutPush& run,
               const IndirectItems& items, BufferId labels) {
    const Events* events = cutEventsOf(particles);
    if (!events) return;
    const CuttingBuffers& cutting = program.program().cutting;
    program.dispatchIndirect(
        k::notePieces, items,
        {events->bodies, cutting.particles, cutting.pieceSizes, events->pieces, cutting.pieces, labels},
        pushOf(run, *events));
}

void addPiecesKept(ProgramBuilder& program, const ParticleBuffers& particles) {
    if (const Events* events = cutEventsOf(particles)) program.copy(events->pieces, events->piecesBefore);
}

void addListing(Build& build) {
    if (!build.particles.events) return;
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    const Events& events = *particles.events;
    const BufferId status = program.program().status;
    if (events.maySleep)
        program.dispatch(k::noteSleep, events.push.count,
                         {events.bodies, particles.sleep->weights, particles.velocities, events.noted,
                          particles.positions},
                         events.push);
    layout::EventPush push = events.push;
    push.count = events.contactWords() / 2 + events.bodyWords();
    ProgramBuilder::Constants constants = constantsOf(events);
    constants.insert({maySleepId, events.maySleep});
    const bool mayComeBack = events.mayBeCut && events.changes != unbound;
    constants.insert({mayComeBackId, mayComeBack});
    const BufferId contacts = boundIf(events.haveContacts, events.contacts);
    const BufferId pieces = boundIf(events.mayBeCut, events.pieces);
    program.dispatch(k::findEvents, push.count,
                     {contacts, boundIf(events.haveContacts, events.touching), events.noted,
                      boundIf(events.maySleep, events.slept), pieces,
                      boundIf(events.mayBeCut, events.piecesBefore), status, events.found,
                      boundIf(mayComeBack, events.changes), boundIf(mayComeBack, events.wholePieces)},
                     push, constants);
    push.count = events.contactWords() + Events::otherKinds * events.bodyWords();
    program.dispatch(k::listEvents, GROUP_ITEMS,
                     {events.found, contacts, events.noted, pieces, status, events.list}, push,
                     constantsOf(events));
}

} // namespace sinew::sim::events
