// The buffers of bodies that may be cut, what they hold of an uncut one, and the order of the passes.
#include "sim/cutting/cut.hpp"

#include "kernels.hpp"
#include "layout.h"
#include "sim/lattice/batches.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/lattice/pieces.hpp"
#include "sim/ranges.hpp"
#include "sim/sleep.hpp"
#include "sim/surface/cut_surface.hpp"

#include <algorithm>
#include <bit>

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

// A CutRun, with what else its passes say.
struct Run {
    layout::CutPush push{};
    bool hasVolumes = false;
};

// Words by slot.
struct Initial {
    std::vector<std::uint32_t> links, cells, particles;
    lattice::PieceFinder pieces;
};

struct Cut {
    std::vector<Run> runs;
    CuttingBuffers buffers;
    BufferId cells, placesBefore, blade, points, work;
    BufferId labels, particles, arguments, groups; // of pieces
    std::shared_ptr<surface::CutSurface> surface;  // none where no skin is clipped
    bool usesTexels = false;
    std::uint32_t rounds = 0;
};

std::vector<std::uint32_t> cuttableGrids(const Scene& scene, const Settings& settings) {
    if (settings.solver != Solver::split || std::ranges::none_of(scene.grids, &Grid::isCuttable)) return {};
    return lattice::computedGrids(scene, settings);
}

Run runOf(const Grid& grid, const lattice::Box& box) {
    return {.push = {.first = box.origin,
                     .count = box.slots,
                     .rowStride = lattice::isSheet(grid) ? 0 : box.rowStride,
                     .sliceStride = box.sliceStride,
                     .stiffLinks = lattice::stiffLinks(grid),
                     .spacing = grid.restLength[0],
                     .contactRow = 0},
            .hasVolumes = hasCellVolumes(grid)};
}

bool isAlike(const Run& a, const Run& b) {
    return a.push.rowStride == b.push.rowStride && a.push.sliceStride == b.push.sliceStride &&
           a.push.stiffLinks == b.push.stiffLinks && a.push.spacing == b.push.spacing &&
           a.hasVolumes == b.hasVolumes;
}

// Each link once, from the node that owns it.
void joinLinks(const Run& run, Initial& initial) {
    for (std::uint32_t i = run.push.first; i < run.push.first + run.push.count; ++i)
        for (std::uint32_t bit = lattice::firstOwned; bit < lattice::directionCount; ++bit) {
            if ((initial.links[i] >> bit & 1) == 0) continue;
            const auto [x, y, z] = lattice::directionOf(bit);
            initial.pieces.join(i,
                                i + static_cast<std::uint32_t>(x + y * static_cast<int>(run.push.rowStride) +
                                                               z * static_cast<int>(run.push.sliceStride)));
        }
}

Initial readGrids(const Scene& scene, std::span<const std::uint32_t> grids, const StateLayout& layout,
                  std::vector<Run>& runs) {
    Initial initial{std::vector<std::uint32_t>(layout.count), std::vector<std::uint32_t>(layout.count),
                    std::vector<std::uint32_t>(layout.count, NO_PARTICLE),
                    lattice::PieceFinder(layout.count)};
    const std::vector<lattice::Box> boxes = lattice::boxesOf(scene, grids);
    bool isRowOpen = false; // whether a run ends at the grid before
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        const Run run = runOf(grid, boxes[g]);
        if (!grid.isCuttable) {
            isRowOpen = false;
            continue;
        }
        if (isRowOpen && isAlike(runs.back(), run))
            runs.back().push.count = run.push.first + run.push.count - runs.back().push.first;
        else
            runs.push_back(run);
        isRowOpen = true;
        lattice::writeLinks(grid, boxes[g], initial.links);
        joinLinks(run, initial);
        lattice::writeCells(grid, boxes[g], initial.cells);
        for (std::uint32_t i = 0; i < grid.node.size(); ++i)
            initial.particles[layout.slot[grid.firstParticle + i]] = grid.firstParticle + i;
    }
    return initial;
}

std::uint32_t groupsOf(std::uint32_t items) {
    return (items - 1) / GROUP_ITEMS + 1;
}

std::uint32_t chunksOf(const Run& run) {
    return (run.push.count - 1) / PIECE_CHUNK + 1;
}

void addPieces(ProgramBuilder& program, Cut& cut, Initial& initial, std::size_t particles) {
    const lattice::Pieces pieces = initial.pieces.finish(initial.particles, particles);
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    std::vector<std::uint32_t> groups;
    for (const Run& run : cut.runs) groups.push_back(groupsOf(run.push.count));
    for (const Run& run : cut.runs) groups.push_back(groupsOf(chunksOf(run)));
    // every round leaves at most half of the pieces that are not yet whole
    cut.rounds = static_cast<std::uint32_t>(std::bit_width(initial.links.size())) + 1;
    cut.labels = program.upload("pieces.labels", pieces.labels);
    cut.particles = program.upload("pieces.particles", initial.particles);
    cut.groups = program.upload("pieces.groups", groups);
    cut.arguments = program.scratch<layout::DispatchArguments>("pieces.arguments", 3 * std::uint64_t{runs});
    cut.buffers.pieces = program.upload("pieces", pieces.ofParticles);
    cut.buffers.pieceSizes = program.upload("pieces.sizes", pieces.sizes);
    cut.buffers.counts = program.upload(
        "cut.counts",
        std::vector{layout::CutCounts{.links = 0, .linksOfStep = 0, .pieces = pieces.count, .missing = 0}});
}

void addSurface(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                const StateLayout& layout, Cut& cut) {
    surface::CutSource source{.runs = {},
                              .cells = cut.cells,
                              .particles = cut.particles,
                              .groups = cut.groups,
                              .arguments = cut.arguments,
                              .firstArgument = 2 * static_cast<std::uint32_t>(cut.runs.size())};
    for (const Run& run : cut.runs) source.runs.push_back(run.push);
    cut.surface = surface::addCutSurface(program, scene, settings, layout, source);
}

Cut addBuffers(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               std::span<const std::uint32_t> grids, const ParticleBuffers& particles) {
    const StateLayout& layout = particles.layout;
    Cut cut{.usesTexels = settings.forms.usesTexels};
    Initial initial = readGrids(scene, grids, layout, cut.runs);
    if (cut.runs.empty()) return cut;
    cut.buffers.links = program.upload("cut.links", initial.links);
    const bool hasVolumes = std::ranges::any_of(cut.runs, &Run::hasVolumes);
    const bool hasSurface = surface::hasCutSurface(scene, settings);
    if (hasVolumes || hasSurface) cut.cells = program.upload("cut.cells", initial.cells);
    if (hasVolumes) cut.buffers.wholeCells = program.upload("cut.whole_cells", initial.cells);
    cut.buffers.hits = program.scratch<layout::LinkHits>("cut.hits", layout.count);
    cut.buffers.dirty = program.scratch<std::uint32_t>("cut.dirty", layout.count / 32 + 1);
    cut.buffers.savedLinks = program.scratch<std::uint32_t>("cut.saved_links", layout.count);
    cut.buffers.places = program.scratch<layout::vec4>("cut.places", layout.count);
    cut.placesBefore = program.scratch<layout::vec4>("cut.places_before", layout.count);
    cut.blade = program.scratch<layout::BladeHead>("cut.blade", 1);
    cut.points = program.scratch<layout::vec4>("cut.points", 2 * ranges::mostBladePoints);
    cut.work = program.scratch<layout::CutWork>("cut.work", 1);
    addPieces(program, cut, initial, scene.particles.size());
    CuttingBuffers& buffers = cut.buffers;
    for (const Run& run : cut.runs)
        buffers.runs.push_back({run.push.first, run.push.count, run.push.rowStride, run.push.sliceStride});
    buffers.topology = {buffers.links,  buffers.hits,   cut.placesBefore,  cut.labels,
                        buffers.counts, buffers.pieces, buffers.pieceSizes};
    if (buffers.wholeCells != BufferId{}) buffers.topology.push_back(buffers.wholeCells);
    if (particles.sleep) buffers.topology.push_back(particles.sleep->components);
    for (const BufferId buffer : buffers.topology) program.carry(buffer, buffer);
    program.program().cutting = buffers;
    if (hasSurface) addSurface(program, scene, settings, layout, cut);
    return cut;
}

void addWholeCells(ProgramBuilder& program, const Cut& cut) {
    const CuttingBuffers& buffers = cut.buffers;
    for (const Run& run : cut.runs)
        if (run.hasVolumes)
            program.dispatch(k::findWholeCells, run.push.count,
                             {buffers.links, cut.cells, buffers.wholeCells, buffers.dirty}, run.push);
}

// What was cut wakes as the step begins.
void addWaking(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    if (!particles.sleep) return;
    const sleep::Sleep& sleep = *particles.sleep;
    for (const Run& run : cut.runs)
        program.dispatch(k::wakeCut, run.push.count,
                         {cut.buffers.links, cut.buffers.savedLinks, sleep.weights, particles.velocities,
                          sleep.islands, sleep.marks, sleep.state},
                         run.push);
}

void addOpening(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const CuttingBuffers& buffers = cut.buffers;
    program.updateBlade(cut.blade, cut.points);
    program.fill(cut.work, 0);
    program.fill(buffers.dirty, 0);
    for (const Run& run : cut.runs)
        program.dispatch(k::openCut, run.push.count,
                         {particles.positions, particles.velocities, particles.step, buffers.links,
                          buffers.savedLinks, buffers.places, cut.placesBefore, cut.work},
                         run.push);
    for (const Run& run : cut.runs)
        program.dispatch(cut.usesTexels ? k::cutLinks : k::cutLinksLoads, run.push.count,
                         {buffers.places, cut.placesBefore, buffers.links, buffers.hits, buffers.dirty,
                          cut.blade, cut.points, cut.work, buffers.savedLinks},
                         run.push);
    for (const Run& run : cut.runs)
        program.dispatch(k::settleLinks, run.push.count, {buffers.links, buffers.dirty}, run.push);
    addWholeCells(program, cut);
    addWaking(program, cut, particles);
}

void addPlan(ProgramBuilder& program, const Cut& cut, bool isFirst) {
    program.dispatch(k::planPieces, 1, {cut.work, cut.buffers.counts, cut.groups, cut.arguments},
                     layout::PiecesPush{isFirst, static_cast<std::uint32_t>(cut.runs.size())});
}

// `items` of every run, as many as the arguments from `first` on say.
template <typename Items>
void addIndirect(ProgramBuilder& program, const Cut& cut, const vk::ShaderCode& code, std::uint32_t first,
                 std::initializer_list<BufferId> buffers, const Items& items) {
    for (std::uint32_t r = 0; r < cut.runs.size(); ++r)
        program.dispatchIndirect(code, {cut.arguments, first + r, items(cut.runs[r])}, buffers,
                                 cut.runs[r].push);
}

void addFindingPieces(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const CuttingBuffers& buffers = cut.buffers;
    const auto slots = [](const Run& run) { return run.push.count; };
    addPlan(program, cut, true);
    addIndirect(program, cut, k::startPieces, 0, {cut.labels, cut.particles, buffers.pieceSizes}, slots);
    for (std::uint32_t round = 0; round < cut.rounds; ++round) {
        addIndirect(program, cut, k::hookPieces, 0, {buffers.links, cut.labels, cut.work}, slots);
        addIndirect(program, cut, k::jumpPieces, 0, {cut.labels}, slots);
        addPlan(program, cut, false);
    }
    addIndirect(program, cut, k::countPieces, static_cast<std::uint32_t>(cut.runs.size()),
                {cut.labels, cut.particles, buffers.pieces, buffers.pieceSizes, buffers.counts}, chunksOf);
    if (particles.sleep)
        addIndirect(program, cut, k::partIslands, 2 * static_cast<std::uint32_t>(cut.runs.size()),
                    {cut.labels, cut.particles, particles.sleep->components}, slots);
}

void addClosing(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const CuttingBuffers& buffers = cut.buffers;
    for (const Run& run : cut.runs)
        program.dispatch(k::closeCut, run.push.count,
                         {buffers.links, buffers.savedLinks, buffers.places, cut.placesBefore,
                          program.program().status, cut.work},
                         run.push);
    addWholeCells(program, cut); // those that an undone step has given back
    addFindingPieces(program, cut, particles);
    if (cut.surface) surface::addCutSurfacePasses(program, *cut.surface);
}

} // namespace

void add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
         const ParticleBuffers& particles) {
    const std::vector<std::uint32_t> grids = cuttableGrids(scene, settings);
    if (grids.empty()) return;
    const Cut cut = addBuffers(program, scene, settings, grids, particles);
    if (cut.runs.empty()) return;
    program.beginPhase("cut");
    program.beginCut();
    addOpening(program, cut, particles);
    program.endCut();
    program.atEnd([&program, cut, particles] {
        program.beginCut();
        addClosing(program, cut, particles);
        program.endCut();
    });
}

} // namespace sinew::sim::cutting
