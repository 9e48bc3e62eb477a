// Cells are whole as part_solid_faces has it: a particle is inside as long as it is a corner of no face.
#include "sim/collision/insides.hpp"

#include "kernels.hpp"
#include "sim/lattice/depths.hpp"
#include "sim/lattice/placement.hpp"

#include <algorithm>
#include <string>

namespace sinew::sim::collision::insides {

namespace {

void addPass(ProgramBuilder& program, const std::vector<BufferId>& buffers) {
    const CuttingBuffers& cutting = program.program().cutting;
    program.beginCut();
    for (std::uint32_t r = 0; r < cutting.runs.size(); ++r) {
        const CutRun& run = cutting.runs[r];
        if (run.rowStride == 0) continue; // a sheet has no inside
        const layout::CutPush push{.first = run.first,
                                   .count = run.count,
                                   .rowStride = run.rowStride,
                                   .sliceStride = run.sliceStride,
                                   .stiffLinks = 0,
                                   .spacing = 0,
                                   .run = r};
        program.dispatchIndirect(kernels::openInsides, {cutting.listedArguments, r, push.count}, buffers,
                                 push);
    }
    program.endCut();
}

} // namespace

std::vector<bool> find(const Scene& scene) {
    std::vector<bool> isCorner(scene.particles.size()), isInside(scene.particles.size());
    for (const Face& face : scene.faces)
        for (const std::uint32_t i : face.particles) isCorner[i] = isCorner[i] || face.isSolid;
    for (const Grid& grid : scene.grids) {
        const auto first = isCorner.begin() + grid.firstParticle;
        if (lattice::isSheet(grid) ||
            std::none_of(first, first + static_cast<std::ptrdiff_t>(grid.node.size()),
                         [](bool is) { return is; }))
            continue;
        for (std::uint32_t n = 0; n < grid.node.size(); ++n)
            isInside[grid.firstParticle + n] =
                lattice::isInside(lattice::fillAround(grid, lattice::coordinates(grid, grid.node[n])));
    }
    return isInside;
}

std::vector<float> closed(std::span<const float> radii, const std::vector<bool>& isInside,
                          const StateLayout& layout) {
    std::vector<float> result(radii.begin(), radii.end());
    for (std::size_t i = 0; i < isInside.size(); ++i)
        if (isInside[i]) result[layout.slot[i]] = -1;
    return result;
}

void addOpening(ProgramBuilder& program, BufferId radii, std::span<const float> open,
                const hash_grid::Grid& grid) {
    CuttingBuffers& cutting = program.program().cutting;
    if (cutting.links == BufferId{}) return;
    const auto addOnce = [](std::vector<BufferId>& list, BufferId buffer) {
        if (std::ranges::find(list, buffer) != list.end()) return false;
        list.push_back(buffer);
        return true;
    };
    addOnce(cutting.contactsSeen, grid.detected);
    if (addOnce(cutting.topology, radii)) program.carry(radii, radii);
    const std::string name = program.program().buffers[radii.index].label + ".open";
    const std::vector<BufferId> buffers{
        cutting.links,  cutting.listedCounts,       cutting.listed, cutting.particles,
        cutting.pieces, program.upload(name, open), radii,          grid.bounds};
    addPass(program, buffers);
    program.atEnd([&program, buffers] { addPass(program, buffers); }); // after links were given back
}

} // namespace sinew::sim::collision::insides
