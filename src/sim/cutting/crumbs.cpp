// A piece that was removed stays a piece by its links, and is found again as one in every step with a cut:
// what it is after each does not depend on what was before.
#include "sim/cutting/crumbs.hpp"

#include "kernels.hpp"
#include "sim/collision/hash_grid.hpp"
#include "sim/surface/cut_surface.hpp"

#include <algorithm>

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

// Of each vertex of all skins the slot that it goes with, NO_PARTICLE where its skin is not clipped.
std::vector<std::uint32_t> vertexSlots(const Scene& scene, const Cut& cut, const StateLayout& layout) {
    std::vector<std::uint32_t> slots;
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s) {
        const Skin& skin = scene.skins[s];
        const std::vector<std::uint32_t>& particles = skin.particles.empty() ? skin.anchors : skin.particles;
        const bool isClipped = std::ranges::find(cut.surface->skins, s) != cut.surface->skins.end();
        for (std::size_t v = 0; v < skin.vertexCount(); ++v)
            slots.push_back(isClipped ? layout.slot[particles[v]] : NO_PARTICLE);
    }
    return slots;
}

void addHiding(ProgramBuilder& program, const Cut& cut, BufferId slots, std::uint32_t vertices) {
    const StepProgram& built = program.program();
    const CutSurfaceBuffers& drawn = built.cutSurface;
    program.dispatch(
        k::hideCrumbs, vertices,
        {slots, cut.particles, cut.buffers.pieces, cut.labels, built.positions, built.skinVertices},
        layout::CountPush{vertices});
    const layout::SurfacePush& push = cut.surface->push;
    program.dispatchIndirect(k::hideCrumbSurface,
                             {cut.surface->arguments, push.runs + SURFACE_VERTICES, push.room},
                             {slots, cut.particles, cut.buffers.pieces, cut.labels, built.positions,
                              drawn.vertices, drawn.state, drawn.rest},
                             layout::CountPush{push.room});
}

} // namespace

void addCrumbs(ProgramBuilder& program, const Scene& scene, const Cut& cut, const StateLayout& layout) {
    const auto isLattice = [](const Run& run) { return run.push.rowStride > 0; };
    if (scene.crumbs < 2 || std::ranges::none_of(cut.runs, isLattice)) return;
    program.program().cutting.crumbs = scene.crumbs;
    if (!cut.surface) return;
    const std::vector<std::uint32_t> slots = vertexSlots(scene, cut, layout);
    const BufferId uploaded = program.upload("crumbs.vertex_slots", slots);
    program.atSkin([&program, cut, uploaded, count = static_cast<std::uint32_t>(slots.size())] {
        addHiding(program, cut, uploaded, count);
    });
}

void addCrumbRemoval(ProgramBuilder& program, const Cut& cut) {
    const CuttingBuffers& buffers = program.program().cutting;
    if (buffers.crumbs == 0) return;
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    const auto add = [&](const vk::ShaderCode& code, std::initializer_list<BufferId> bound) {
        for (std::uint32_t r = 0; r < runs; ++r) {
            const layout::CutPush& push = cut.runs[r].push;
            if (push.rowStride == 0) continue; // a sheet
            program.dispatchIndirect(code, {cut.arguments, 2 * runs + r, push.count}, bound,
                                     layout::CrumbPush{push.first, push.count, buffers.crumbs});
        }
    };
    add(k::removeCrumbs, {cut.labels, cut.particles, buffers.pieceSizes, buffers.pieces, buffers.counts});
    add(k::forgetCrumbs, {cut.particles, buffers.pieces, buffers.pieceSizes});
    for (const ContactGrid& grid : buffers.contactGrids)
        add(k::leaveContacts, {cut.particles, buffers.pieces, grid.radii, grid.bounds});
}

void letCrumbsLeave(ProgramBuilder& program, BufferId radii, const collision::hash_grid::Grid& grid) {
    CuttingBuffers& buffers = program.program().cutting;
    if (buffers.crumbs == 0) return;
    buffers.contactGrids.push_back({radii, grid.bounds});
    buffers.topology.push_back(radii);
    program.carry(radii, radii);
    if (std::ranges::find(buffers.contactsSeen, grid.detected) == buffers.contactsSeen.end())
        buffers.contactsSeen.push_back(grid.detected);
}

} // namespace sinew::sim::cutting
