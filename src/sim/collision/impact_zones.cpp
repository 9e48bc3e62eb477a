// The host side of impact zones: buffers, and the order of the passes.
#include "sim/collision/impact_zones.hpp"

#include "kernels.hpp"
#include "sim/forces/forces.hpp"

#include <algorithm>
#include <bit>

namespace sinew::sim::collision::impact_zones {

namespace k = kernels;

namespace {

std::vector<std::uint32_t> wordsOf(const Request& request) {
    std::vector<std::uint32_t> words(ZONE_WORDS + ZONE_OF_SLOT * request.slots, 0);
    const std::size_t first = words.size() - request.slots;
    for (std::size_t i = 0; i < request.slots; ++i)
        words[first + i] = std::bit_cast<std::uint32_t>(request.loose[i]);
    return words;
}

} // namespace

Zones add(ProgramBuilder& program, const Request& request) {
    const bool hasLoose = std::ranges::any_of(request.loose, [](float radius) { return radius != 0; });
    if (request.moving == 0 || !hasLoose) return {};
    const std::vector<layout::DispatchArguments> none(ZONE_SEARCHES, {0, 1, 1, 0}),
        unsolved(ZONE_ROUNDS, none[0]);
    return {.push = {.count = static_cast<std::uint32_t>(request.slots),
                     .moving = request.moving,
                     .sheets = request.sheets,
                     .large = request.large,
                     .round = 0},
            .finding = program.upload("zones.finding", none),
            .solving = program.upload("zones.solving", unsolved),
            .meeting = program.scratch<std::uint32_t>("zones.meeting", request.room),
            .words = program.upload("zones.words", wordsOf(request)),
            .pairs = program.scratch<layout::ZonePair>("zones.pairs", ZONE_PAIRS),
            .zones = program.scratch<layout::Zone>("zones", request.slots / 4 + 1), // four members at least
            .areBetweenSheets = request.areBetweenSheets};
}

void addPasses(ProgramBuilder& program, const Zones& zones, const FoundPoints& points,
               const std::optional<FoundEdges>& edges, const ParticleBuffers& predicted,
               const ParticleBuffers& state) {
    if (!zones.exist()) return;
    const std::vector<BufferId> shared{predicted.positions, predicted.velocities, state.positions,
                                       state.velocities,    state.step,           zones.words,
                                       zones.pairs};
    std::vector<BufferId> ofPoints = shared, ofEdges = shared, solving = shared;
    ofPoints.insert(ofPoints.end(),
                    {points.faces, points.contacts, points.lists, zones.solving, points.searched,
                     points.large, zones.meeting, points.sheets, points.groups});
    if (edges)
        ofEdges.insert(ofEdges.end(),
                       {edges->edges, edges->contacts, edges->owners, zones.solving, edges->meeting,
                        points.sheets, edges->thickness, edges->looked, edges->bounds});
    solving.insert(solving.end(), {zones.zones, zones.finding});
    ProgramBuilder::Constants constants = remainderConstants(state.layout);
    forces::bindTo(state, &forces::Forces::ofContacts, solving, constants);
    layout::ZonePush push = zones.push;
    for (push.round = 0; push.round < ZONE_ROUNDS; ++push.round) {
        program.dispatchIndirect(k::findPassingPoints, {zones.finding, push.round, push.count}, ofPoints,
                                 push, points.constants);
        if (edges)
            program.dispatchIndirect(k::findPassingEdges,
                                     {zones.finding, ZONE_OF_EDGES + push.round, edges->most}, ofEdges, push);
        program.dispatchIndirect(k::solveZones, {zones.solving, push.round, GROUP_ITEMS}, solving, push,
                                 constants);
    }
}

} // namespace sinew::sim::collision::impact_zones
