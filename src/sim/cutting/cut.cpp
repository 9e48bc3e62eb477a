// The order of the passes of a step with a blade.
#include "sim/cutting/cut.hpp"

#include "kernels.hpp"
#include "sim/cutting/cut_plan.hpp"
#include "sim/cutting/debris.hpp"
#include "sim/cutting/restoring.hpp"
#include "sim/cutting/tearing.hpp"
#include "sim/events/events.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/sleep/sleep.hpp"
#include "sim/surface/cut_surface.hpp"
#include "sim/surface/sheet_pieces.hpp"

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

constexpr std::uint32_t hasDebrisId = 1;   // constant_id in find_near_links.comp
constexpr std::uint32_t keepsForceId = 1;  // constant_id in cut_links.comp
constexpr std::uint32_t mayBeAbsentId = 1; // constant_id in count_pieces.comp

void addWholeCells(ProgramBuilder& program, const Cut& cut) {
    const CuttingBuffers& buffers = cut.buffers;
    for (const Run& run : cut.runs)
        if (run.hasVolumes)
            program.dispatchIndirect(
                k::findWholeCells, {buffers.listedArguments, run.push.run, run.push.count},
                {buffers.links, cut.cells, buffers.wholeCells, buffers.listedCounts, buffers.listed},
                run.push);
}

// Wakes bodies that were cut, at the start of the step.
void addWaking(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    if (!particles.sleep) return;
    const sleep::Sleep& sleep = *particles.sleep;
    for (const Run& run : cut.runs)
        program.dispatch(k::wakeCut, run.push.count,
                         {cut.buffers.links, cut.buffers.savedLinks, sleep.weights, particles.velocities,
                          sleep.islands, sleep.marks, sleep.state},
                         run.push);
}

void planLists(ProgramBuilder& program, const Cut& cut, BufferId counts, BufferId arguments) {
    const layout::CountPush runs{static_cast<std::uint32_t>(cut.runs.size())};
    program.dispatch(k::planListed, runs.count, {counts, arguments}, runs);
}

void addNear(ProgramBuilder& program, const Cut& cut) {
    const bool hasDebris = program.program().cutting.debris > 0;
    const std::vector<BufferId> buffers{cut.bladePlaces,
                                        cut.buffers.links,
                                        cut.blade,
                                        cut.work,
                                        cut.nearCounts,
                                        cut.nears,
                                        boundIf(hasDebris, cut.particles),
                                        boundIf(hasDebris, cut.buffers.pieces)};
    for (const Run& run : cut.runs)
        program.dispatch(k::findNearLinks, run.push.count, buffers, run.push, {{hasDebrisId, hasDebris}});
}

// Cuts the links that the blade meets: first finds near nodes, and tests only these exactly.
void addBlade(ProgramBuilder& program, const Cut& cut) {
    const CuttingBuffers& buffers = cut.buffers;
    program.fill(cut.nearCounts, 0);
    addNear(program, cut);
    planLists(program, cut, cut.nearCounts, cut.nearArguments);
    const bool keepsForce = buffers.bladeForce != BufferId{};
    for (const Run& run : cut.runs)
        program.dispatchIndirect(k::cutLinks, {cut.nearArguments, run.push.run, run.push.count},
                                 {cut.bladePlaces, cut.placesBefore, cut.blade, cut.points, buffers.links,
                                  buffers.hits, buffers.dirty, cut.work, cut.nearCounts, cut.nears,
                                  boundIf(keepsForce, buffers.bladeForce), boundIf(keepsForce, cut.cells)},
                                 run.push, {{keepsForceId, keepsForce}});
}

// Lists the nodes with links that died: the passes that follow run only there.
void addListing(ProgramBuilder& program, const Cut& cut) {
    const CuttingBuffers& buffers = cut.buffers;
    program.fill(buffers.listedCounts, 0);
    for (const Run& run : cut.runs)
        program.dispatch(k::listDirty, wordsOf(run), {buffers.dirty, buffers.listedCounts, buffers.listed},
                         run.push);
    planLists(program, cut, buffers.listedCounts, buffers.listedArguments);
}

// Cuts links at the start of a step, and everything that follows before the substeps.
void addBladePasses(Build& build, Cut& cut) {
    ProgramBuilder& program = build.program;
    const ParticleBuffers& particles = build.particles;
    const CuttingBuffers& buffers = cut.buffers;
    program.updateBlade(cut.blade, cut.points);
    program.fill(cut.work, 0);
    program.fill(buffers.dirty, 0);
    addRestoring(build, cut);
    program.copy(buffers.links, buffers.savedLinks); // an undone step restores these
    events::addPiecesCleared(program, particles);
    for (const Run& run : cut.runs)
        program.dispatch(k::openCut, run.push.count,
                         {particles.positions, particles.velocities, cut.placesBefore, particles.step,
                          buffers.places, cut.work},
                         run.push);
    if (cut.surface)
        cut.bladePlaces = surface::addPulling(program, *cut.surface, cut.placesBefore, cut.work, cut.blade);
    addBlade(program, cut);
    events::addBladeEnd(program, particles);
    if (cut.tearing) addTearingPasses(program, *cut.tearing, cut);
    addListing(program, cut);
    for (const Run& run : cut.runs)
        program.dispatchIndirect(k::removeLooseLinks, {buffers.listedArguments, run.push.run, run.push.count},
                                 {buffers.links, buffers.dirty, buffers.listedCounts, buffers.listed},
                                 run.push);
    for (const Run& run : cut.runs) events::addCut(program, particles, run.push);
    addWholeCells(program, cut);
    addWaking(program, cut, particles);
}

// Appends a dispatch for every run, with the group counts in the arguments from `first` on.
template <typename Items>
void addIndirect(ProgramBuilder& program, const Cut& cut, const vk::ShaderCode& code, std::uint32_t first,
                 std::initializer_list<BufferId> buffers, const Items& items,
                 const ProgramBuilder::Constants& constants = {}) {
    for (std::uint32_t r = 0; r < cut.runs.size(); ++r)
        program.dispatchIndirect(code, {cut.arguments, first + r, items(cut.runs[r])}, buffers,
                                 cut.runs[r].push, constants);
}

// Updates sleep components and grab masses after a topology change.
void addParting(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const auto slots = [](const Run& run) { return run.push.count; };
    const auto first = 2 * static_cast<std::uint32_t>(cut.runs.size()); // arguments
    if (particles.sleep)
        addIndirect(program, cut, k::updateSleepComponents, first,
                    {cut.labels, cut.particles, particles.sleep->components}, slots);
    if (!particles.grabs) return;
    program.fill(cut.weights, 0);
    addIndirect(program, cut, k::sumPieceMasses, first,
                {cut.particles, cut.buffers.pieces, cut.uncutBodies, cut.weights}, slots);
    addIndirect(program, cut, k::updateGrabMasses, first,
                {cut.particles, cut.buffers.pieces, cut.uncutBodies, cut.weights, particles.grabs->bodies},
                slots);
}

// Appends a round of finding pieces: a run takes part if the last round changed one of its labels.
void addRound(ProgramBuilder& program, const Cut& cut, std::uint32_t round) {
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    const BufferId own = cut.roundArguments[round % 2], others = cut.roundArguments[(round + 1) % 2];
    const std::uint32_t first = round / 2 * runs;
    for (std::uint32_t r = 0; r < runs; ++r) {
        const layout::CutPush& push = cut.runs[r].push;
        program.dispatchIndirect(k::unionPieces, {own, first + r, push.count},
                                 {cut.buffers.links, cut.labels, others},
                                 layout::RoundPush{.first = push.first,
                                                   .count = push.count,
                                                   .rowStride = push.rowStride,
                                                   .sliceStride = push.sliceStride,
                                                   .stiffLinks = push.stiffLinks,
                                                   .next = (round + 1) / 2 * runs + r,
                                                   .groups = groupsOf(push.count)});
    }
    for (std::uint32_t r = 0; r < runs; ++r)
        program.dispatchIndirect(k::shortenPieces, {own, first + r, cut.runs[r].push.count}, {cut.labels},
                                 cut.runs[r].push);
}

void addFindingPieces(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const CuttingBuffers& buffers = cut.buffers;
    const auto slots = [](const Run& run) { return run.push.count; };
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    program.dispatch(k::planPieces, cut.rounds * runs,
                     {cut.work, buffers.counts, cut.groups, cut.arguments, buffers.listedCounts,
                      cut.roundArguments[0], cut.roundArguments[1]},
                     layout::PiecesPush{runs, cut.rounds});
    addIndirect(program, cut, k::initialisePieces, 0,
                {cut.labels, cut.particles, buffers.pieceSizes, buffers.links}, slots);
    addIndirect(program, cut, k::shortenPieces, 0, {cut.labels}, slots);
    for (std::uint32_t round = 0; round < cut.rounds; ++round) addRound(program, cut, round);
    addIndirect(program, cut, k::countPieces, runs,
                {cut.labels, cut.particles, buffers.pieces, buffers.pieceSizes, buffers.counts,
                 boundIf(cut.replaced != BufferId{}, particles.positions)},
                chunksOf, {{mayBeAbsentId, cut.replaced != BufferId{}}});
    addParting(program, cut, particles);
    addDebrisRemoval(program, cut, particles);
    for (std::uint32_t r = 0; r < runs; ++r)
        events::addPieces(program, particles, cut.runs[r].push,
                          {cut.arguments, 2 * runs + r, cut.runs[r].push.count}, cut.labels);
}

// Draws what the links leave: debris, the surface of cuts, the skins of sheets.
void addSurfaces(ProgramBuilder& program, const Cut& cut) {
    program.only(When::surface, [&] { addTriangleHiding(program, cut.debrisSkins); });
    if (cut.surface) surface::addCutSurfacePasses(program, *cut.surface, cut.blade);
    if (cut.sheets)
        program.only(When::surface, [&] { surface::addSheetPasses(program, *cut.sheets, !cut.surface); });
}

// Restores the links of an undone step, and updates what depends on the links.
void addUpdates(Build& build, const Cut& cut) {
    ProgramBuilder& program = build.program;
    const CuttingBuffers& buffers = cut.buffers;
    addSkinRestoring(build, cut);
    if (cut.surface)
        surface::addSkinHits(program, *cut.surface, cut.bladePlaces, cut.placesBefore, cut.blade, cut.points);
    for (const Run& run : cut.runs)
        program.dispatch(k::closeCut, run.push.count,
                         {buffers.savedLinks, cut.bladePlaces, buffers.links, cut.placesBefore,
                          program.program().status, cut.work, cut.blade},
                         run.push);
    addRestored(build, cut);
    addWholeCells(program, cut); // cells that an undone step has restored
    addFindingPieces(program, cut, build.particles);
    addSurfaces(program, cut);
}

} // namespace

void addBuffersOfCuts(Build& build) {
    ProgramBuilder& program = build.program;
    Cut added = addBuffers(program, build.model, build.particles);
    if (added.runs.empty()) return;
    Cut& cut = build.keep(std::move(added));
    cut.bladePlaces = cut.buffers.places;
    addDebris(program, build.model.scene, cut, build.particles);
    events::addCutBuffers(program, build.particles);
}

void addOpening(Build& build) {
    Cut* cut = build.find<Cut>();
    if (!cut) return;
    ProgramBuilder& program = build.program;
    program.beginPhase("cut");
    program.only(When::cut, [&] { addBladePasses(build, *cut); });
}

void addClosing(Build& build) {
    if (const Cut* cut = build.find<Cut>()) build.program.only(When::cut, [&] { addUpdates(build, *cut); });
}

// A step with a blade that cut every link missing from the uncut bodies: all slots count as near it.
void addRewriting(Build& build) {
    const Cut* cut = build.find<Cut>();
    if (!cut) return;
    ProgramBuilder& program = build.program;
    const CuttingBuffers& buffers = cut->buffers;
    program.copy(program.initialOf("cut.uncut_links", buffers.links), buffers.savedLinks);
    program.fill(cut->blade, 0);
    program.fill(cut->work, 1); // links were cut
    program.fill(buffers.dirty, ~0u);
    addListing(program, *cut);
    addWholeCells(program, *cut);
    if (cut->surface)
        surface::addSkinHits(program, *cut->surface, cut->bladePlaces, cut->placesBefore, cut->blade,
                             cut->points);
    events::addPiecesCleared(program, build.particles);
    addFindingPieces(program, *cut, build.particles);
    events::addPiecesKept(program, build.particles);
    addSurfaces(program, *cut);
}

void addSkinNormals(Build& build) {
    const Cut* cut = build.find<Cut>();
    if (cut && cut->surface) surface::addNormalsOfCuts(build.program, *cut->surface);
}

void addSkinEnd(Build& build) {
    const Cut* cut = build.find<Cut>();
    if (!cut) return;
    if (cut->sheets) surface::addSheetDrawing(build.program, *cut->sheets);
    if (cut->surface) surface::addCutDrawing(build.program, *cut->surface);
    addVertexHiding(build.program, *cut);
}

} // namespace sinew::sim::cutting
