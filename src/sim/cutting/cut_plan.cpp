// Reads the grids, and makes runs of similar bodies.
#include "sim/cutting/cut_plan.hpp"

#include "sim/cutting/cut_lists.hpp"
#include "sim/cutting/tearing.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/lattice/pieces.hpp"
#include "sim/motions/pool.hpp"
#include "sim/sleep/sleep.hpp"
#include "sim/surface/cut_surface.hpp"
#include "sim/surface/sheet_pieces.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace sinew::sim::cutting {

namespace {

// Initial words by slot.
struct Initial {
    std::vector<std::uint32_t> links, cells, particles;
    lattice::PieceFinder pieces;
};

// Grids with cuttable ones among them, and their boxes.
struct Placed {
    std::vector<std::uint32_t> grids;
    std::vector<lattice::Box> boxes;
};

// The box of a sheet with consecutive particles.
lattice::Box listedBox(const Grid& grid, const StateLayout& layout) {
    lattice::Box box;
    box.sliceStride = grid.nodes[0];
    box.slots = grid.nodes[0] * grid.nodes[2];
    box.origin = layout.slot[grid.firstParticle];
    return box;
}

Placed cuttableGrids(const SceneModel& model) {
    const Scene& scene = model.scene;
    if (model.settings.solver != Solver::split || std::ranges::none_of(scene.grids, &Grid::isCuttable))
        return {};
    Placed placed{model.grids, model.boxes};
    for (std::uint32_t g = 0; g < scene.grids.size(); ++g) {
        if (!isListed(scene, model.settings, g, model.grids)) continue;
        placed.grids.push_back(g);
        placed.boxes.push_back(listedBox(scene.grids[g], model.layout));
    }
    return placed;
}

// Work of cutting a link along an edge, between four whole cells or two of a sheet; `shareOf` of cut_links
// has the others. A plane with unit normal n cuts A |n . e| / h^3 of the links with vector e on an area A, h
// the spacing. The sum of (n . e)^2 over edges and face diagonals is 5 h^2 for any n: if a link counts as |n
// . e| h / 5, all of them count as A. A line in a sheet cuts A |n . e| / h^2 of them on a length A: if an
// edge counts as h / 2.546 and a diagonal as 0.707 of that, all count as 0.95 to 1.03 A, in the mean over all
// directions as A.
double workOf(const Grid& grid) {
    const double spacing = double{grid.restLength[0]};
    return double{grid.toughness} * (lattice::isSheet(grid) ? spacing / 2.546 : spacing * spacing / 5);
}

Run runOf(const Grid& grid, const lattice::Box& box) {
    return {.push = {.first = box.origin,
                     .count = box.slots,
                     .rowStride = lattice::isSheet(grid) ? 0 : box.rowStride,
                     .sliceStride = box.sliceStride,
                     .stiffLinks = lattice::stiffLinks(grid),
                     .spacing = grid.restLength[0],
                     .run = 0,
                     .linkWork = static_cast<float>(workOf(grid))},
            .hasVolumes = hasCellVolumes(grid),
            .tearStrain = grid.tearStrain,
            .tearsPerStep = grid.tearsPerStep};
}

bool isAlike(const Run& a, const Run& b) {
    return a.push.rowStride == b.push.rowStride && a.push.sliceStride == b.push.sliceStride &&
           a.push.stiffLinks == b.push.stiffLinks && a.push.spacing == b.push.spacing &&
           a.push.linkWork == b.push.linkWork && a.hasVolumes == b.hasVolumes && a.tearStrain == 0 &&
           b.tearStrain == 0; // tears are counted by body
}

void addRun(std::vector<Run>& runs, Run run) {
    run.push.run = static_cast<std::uint32_t>(runs.size());
    runs.push_back(run);
}

// Joins each link once, from the node that owns it.
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

Initial readGrids(const Scene& scene, const Placed& placed, const StateLayout& layout,
                  std::vector<Run>& runs) {
    Initial initial{std::vector<std::uint32_t>(layout.count), std::vector<std::uint32_t>(layout.count),
                    std::vector<std::uint32_t>(layout.count, NO_PARTICLE),
                    lattice::PieceFinder(layout.count)};
    const auto& [grids, boxes] = placed;
    bool isRowOpen = false; // whether a run ends at the last grid
    for (std::size_t g = 0; g < grids.size(); ++g) {
        const Grid& grid = scene.grids[grids[g]];
        const Run run = runOf(grid, boxes[g]);
        const bool isBoxed = boxes[g].end > 0; // else a listed sheet, which need not be adjacent to others
        if (!grid.isCuttable) {
            isRowOpen = false;
            continue;
        }
        if (isRowOpen && isBoxed && isAlike(runs.back(), run))
            runs.back().push.count = run.push.first + run.push.count - runs.back().push.first;
        else
            addRun(runs, run);
        isRowOpen = isBoxed;
        lattice::writeLinks(grid, boxes[g], initial.links);
        joinLinks(run, initial);
        lattice::writeCells(grid, boxes[g], initial.cells);
        for (std::uint32_t i = 0; i < grid.node.size(); ++i)
            initial.particles[layout.slot[grid.firstParticle + i]] = grid.firstParticle + i;
    }
    return initial;
}

// Pieces without those of bodies that are absent at first.
std::uint32_t presentPieces(const Scene& scene, const lattice::Pieces& pieces) {
    std::uint32_t count = pieces.count;
    for (const Body& body : scene.bodies)
        for (std::uint32_t i = body.firstParticle;
             body.isAbsent && i < body.firstParticle + body.particleCount; ++i)
            count -= pieces.sizes[i] > 0 ? 1 : 0;
    return count;
}

void addPieces(ProgramBuilder& program, Cut& cut, Initial& initial, const Scene& scene) {
    const lattice::Pieces pieces = initial.pieces.finish(initial.particles, scene.particles.size());
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    std::vector<std::uint32_t> groups;
    for (const Run& run : cut.runs) groups.push_back(groupsOf(run.push.count));
    for (const Run& run : cut.runs) groups.push_back(groupsOf(chunksOf(run)));
    // Two rounds at least halve the number of labels that are not final; in a single round a low label may
    // take only its smallest neighbour.
    cut.rounds = 2 * static_cast<std::uint32_t>(std::bit_width(initial.links.size())) + 2;
    cut.labels = cut.buffers.labels = program.upload("pieces.labels", pieces.labels);
    cut.particles = cut.buffers.particles = program.upload("pieces.particles", initial.particles);
    cut.groups = program.upload("pieces.groups", groups);
    cut.arguments = program.scratch<layout::DispatchArguments>("pieces.arguments", 4 * std::uint64_t{runs});
    for (BufferId& rounds : cut.roundArguments) // the last round still writes arguments of another one
        rounds = program.scratch<layout::DispatchArguments>("pieces.rounds",
                                                            (cut.rounds / 2 + 1) * std::uint64_t{runs});
    cut.buffers.pieces = program.upload("pieces", pieces.ofParticles);
    cut.buffers.pieceSizes = program.upload("pieces.sizes", pieces.sizes);
    cut.buffers.counts =
        program.upload("cut.counts", std::vector{layout::CutCounts{.links = 0,
                                                                   .linksOfStep = 0,
                                                                   .pieces = presentPieces(scene, pieces),
                                                                   .missing = 0,
                                                                   .debris = 0,
                                                                   .debrisParticles = 0,
                                                                   .debrisMass = 0,
                                                                   .isWritten = 0}});
}

void addLists(ProgramBuilder& program, Cut& cut, std::size_t slots) {
    const std::size_t runs = cut.runs.size();
    cut.nears = program.scratch<std::array<std::uint32_t, 2>>("cut.near_nodes", slots);
    cut.nearCounts = program.scratch<std::uint32_t>("cut.near_counts", runs);
    cut.nearArguments = program.scratch<layout::DispatchArguments>("cut.near_arguments", runs);
    CuttingBuffers& buffers = cut.buffers;
    buffers.dirty = program.scratch<std::uint32_t>("cut.dirty", slots / 32 + 1);
    buffers.listed = program.scratch<std::uint32_t>("cut.listed", slots);
    buffers.listedCounts = program.scratch<std::uint32_t>("cut.listed_counts", runs);
    buffers.listedArguments = program.scratch<layout::DispatchArguments>("cut.listed_arguments", runs);
}

void addSurface(ProgramBuilder& program, const Scene& scene, const surface::CutBodies& bodies, Cut& cut) {
    surface::CutSource source{.runs = {},
                              .particles = cut.particles,
                              .groups = cut.groups,
                              .arguments = cut.arguments,
                              .firstArgument = 3 * static_cast<std::uint32_t>(cut.runs.size())};
    for (const Run& run : cut.runs) source.runs.push_back(run.push);
    cut.surface = surface::addCutSurface(program, scene, bodies, source);
}

void addGrabMasses(ProgramBuilder& program, Cut& cut, const grabs::Grabs& grabs) {
    const BufferSpec spec = program.program().buffers[grabs.bodies.index]; // copied: adding moves the list
    std::vector<layout::GrabBody> bodies(spec.count);
    std::memcpy(bodies.data(), spec.initial.data(), spec.initial.size());
    cut.uncutBodies = program.upload("pieces.uncut_bodies", bodies);
    cut.weights = program.scratch<std::uint32_t>("pieces.weights", spec.count);
    cut.buffers.topology.push_back(grabs.bodies);
}

// The unit of the sum is a power of two, such that it holds what all links give in the longest step to a
// blade that hardly moves: see addForce in cut_links.
void addBladeForce(ProgramBuilder& program, Cut& cut) {
    constexpr double linksOfNode = 9, leastWay = 1e-3; // leastWay in cells
    double most = 0;                                   // [N s]
    for (const Run& run : cut.runs)
        most += linksOfNode * double{run.push.linkWork} * run.push.count * ranges::dt.high /
                (leastWay * double{run.push.spacing});
    if (most == 0) return;
    cut.buffers.bladeForce = program.scratchOfStep<layout::ColliderForce>("cut.blade_force", 1);
    cut.buffers.bladeForceScale = static_cast<float>(std::exp2(std::floor(62 - std::log2(most))));
    for (Run& run : cut.runs) run.push.forceScale = cut.buffers.bladeForceScale;
}

} // namespace

Cut addBuffers(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles) {
    const Scene& scene = model.scene;
    const StateLayout& layout = model.layout;
    Cut cut;
    const Placed placed = cuttableGrids(model);
    if (placed.grids.empty()) return cut;
    Initial initial = readGrids(scene, placed, layout, cut.runs);
    if (cut.runs.empty()) return cut;
    cut.buffers.links = program.upload("cut.links", initial.links);
    const bool hasVolumes = std::ranges::any_of(cut.runs, &Run::hasVolumes);
    const bool hasTears = std::ranges::any_of(cut.runs, [](const Run& run) { return run.tearStrain > 0; });
    const bool keepsForce =
        model.settings.keepsForces && std::ranges::any_of(scene.grids, [](const Grid& grid) {
            return grid.isCuttable && grid.toughness > 0;
        });
    if (hasVolumes || hasTears || keepsForce) cut.cells = program.upload("cut.cells", initial.cells);
    if (hasVolumes) cut.buffers.wholeCells = program.upload("cut.whole_cells", initial.cells);
    cut.buffers.hits = program.scratch<layout::LinkHits>("cut.hits", layout.count);
    addLists(program, cut, layout.count);
    cut.buffers.savedLinks = program.scratch<std::uint32_t>("cut.saved_links", layout.count);
    cut.buffers.places = program.scratch<layout::vec4>("cut.places", layout.count);
    cut.placesBefore = program.scratch<layout::vec4>("cut.places_before", layout.count);
    cut.buffers.placesBefore = cut.placesBefore;
    cut.blade = program.scratch<layout::BladeHead>("cut.blade", 1);
    cut.points = program.scratch<layout::vec4>("cut.points", 2 * ranges::mostBladePoints);
    cut.work = program.scratch<layout::CutWork>("cut.work", 1);
    if (std::ranges::count(motions::restoredBodies(scene), true) > 0) {
        cut.whole = program.initialOf("cut.whole_links", cut.buffers.links);
        cut.replaced = program.scratch<layout::ReplacedNode>("cut.replaced", layout.count);
    }
    if (keepsForce) addBladeForce(program, cut);
    addPieces(program, cut, initial, scene);
    CuttingBuffers& buffers = cut.buffers;
    for (const Run& run : cut.runs)
        buffers.runs.push_back({run.push.first, run.push.count, run.push.rowStride, run.push.sliceStride});
    buffers.topology = {buffers.links,  buffers.hits,   cut.placesBefore,  cut.labels,
                        buffers.counts, buffers.pieces, buffers.pieceSizes};
    if (buffers.wholeCells != BufferId{}) buffers.topology.push_back(buffers.wholeCells);
    if (particles.sleep) buffers.topology.push_back(particles.sleep->components);
    if (particles.grabs) addGrabMasses(program, cut, *particles.grabs);
    const auto isCut = [&](BufferId buffer) { // the others follow from these
        return buffer == buffers.links || buffer == buffers.hits || buffer == cut.placesBefore;
    };
    for (const BufferId buffer : buffers.topology)
        program.addToState(buffer, buffer, {.of = isCut(buffer) ? Elements::slots : Elements::none});
    program.program().cutting = buffers;
    cut.sheets =
        surface::addSheetPieces(program, scene, layout, cut.particles, model.settings.cutSurfaceRoom);
    if (hasTears) cut.tearing = addTearing(program, cut, layout.count);
    std::vector<layout::CutPush> pushes;
    for (const Run& run : cut.runs) pushes.push_back(run.push);
    const surface::CutBodies bodies = surface::readCutBodies(model, pushes);
    if (bodies.cells > 0) addSurface(program, scene, bodies, cut);
    return cut;
}

} // namespace sinew::sim::cutting
