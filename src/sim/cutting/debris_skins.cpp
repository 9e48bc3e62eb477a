// The skins of all bodies are consecutive in the buffers of vertices and indices.
#include "sim/cutting/debris_skins.hpp"

#include "kernels.hpp"
#include "sim/cutting/cut_plan.hpp"
#include "sim/surface/cut_surface.hpp"
#include "sim/surface/sheet_pieces.hpp"
#include "sim/surface/skin.hpp"

#include <algorithm>

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

// By skin: whether it has separate pieces after a cut.
std::vector<bool> areParted(const Scene& scene, const Cut& cut) {
    std::vector<bool> result(scene.skins.size());
    if (cut.surface)
        for (const std::uint32_t s : cut.surface->skins) result[s] = true;
    if (cut.sheets)
        for (const surface::SheetSkin& sheet : cut.sheets->skins) result[sheet.push.skin] = true;
    return result;
}

// By vertex of all skins: the slot that it follows, NO_PARTICLE if its skin stretches.
std::vector<std::uint32_t> vertexSlots(const Scene& scene, const std::vector<bool>& parted,
                                       const StateLayout& layout) {
    std::vector<std::uint32_t> slots;
    for (std::size_t s = 0; s < scene.skins.size(); ++s) {
        const Skin& skin = scene.skins[s];
        const std::vector<std::uint32_t>& particles = skin.particles.empty() ? skin.anchors : skin.particles;
        for (std::size_t v = 0; v < skin.vertexCount(); ++v)
            slots.push_back(parted[s] ? layout.slot[particles[v]] : NO_PARTICLE);
    }
    return slots;
}

void addHiding(ProgramBuilder& program, const Cut& cut, BufferId slots, std::uint32_t vertices) {
    const StepProgram& built = program.program();
    const auto bound = [&](BufferId target) {
        return std::vector{slots, cut.particles, cut.buffers.pieces, cut.labels, built.positions, target};
    };
    const auto with = [](std::vector<BufferId> buffers, std::initializer_list<BufferId> more) {
        buffers.insert(buffers.end(), more);
        return buffers;
    };
    program.dispatch(k::hideDebris, vertices, bound(built.skinVertices), layout::CountPush{vertices});
    if (cut.surface) {
        const CutSurfaceBuffers& drawn = built.cutSurface;
        const layout::SurfacePush& push = cut.surface->push;
        program.dispatchIndirect(
            k::hideDebrisSurface, {cut.surface->arguments, push.runs + SURFACE_VERTICES, push.room},
            with(bound(drawn.vertices), {drawn.state, drawn.rest}), layout::CountPush{push.room});
    }
    if (!cut.sheets) return;
    for (const surface::SheetSkin& sheet : cut.sheets->skins)
        program.dispatchIndirect(
            k::hideDebrisSheet, {cut.sheets->arguments, 2 * sheet.push.skin + 1, sheet.push.vertexRoom},
            with(bound(built.skinVertices), {sheet.state, sheet.vertices}), sheet.skinPush);
}

// Appends the particles that move a vertex.
void addHolders(const Skin& skin, std::uint32_t vertex, std::vector<std::uint32_t>& holders) {
    if (!skin.particles.empty()) return holders.push_back(skin.particles[vertex]);
    const CellEmbedding& cell = skin.cells[vertex];
    for (std::size_t c = 0; c < cell.particles.size(); ++c)
        if (cell.share(c) > 0) holders.push_back(cell.particles[c]);
}

// Triangles of stretching skins that depend on a cuttable particle.
struct Stretched {
    std::vector<layout::DebrisTriangle> triangles;
    std::vector<std::uint32_t> holders;

    void add(const Skin& skin, std::uint32_t firstVertex, std::uint32_t firstIndex,
             const std::vector<bool>& mayGo) {
        for (const auto& [a, b, c] : skin.triangles) {
            const auto first = static_cast<std::uint32_t>(holders.size());
            for (const std::uint32_t corner : {a, b, c}) addHolders(skin, corner, holders);
            std::sort(holders.begin() + first, holders.end());
            holders.erase(std::unique(holders.begin() + first, holders.end()), holders.end());
            const bool isFixed = std::none_of(holders.begin() + first, holders.end(),
                                              [&](std::uint32_t i) { return mayGo[i]; });
            if (isFixed)
                holders.resize(first);
            else
                triangles.push_back({{firstVertex + a, firstVertex + b, firstVertex + c},
                                     firstIndex,
                                     first,
                                     static_cast<std::uint32_t>(holders.size()) - first});
            firstIndex += 3;
        }
    }
};

std::vector<bool> particlesThatMayGo(const Scene& scene, const Cut& cut, const StateLayout& layout) {
    std::vector<bool> result(scene.particles.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = std::ranges::any_of(cut.runs, [&](const Run& run) {
            return layout.slot[i] >= run.push.first && layout.slot[i] - run.push.first < run.push.count;
        });
    return result;
}

// Gives the skins an index buffer of their own, unless other cuts already need one.
void makeIndices(ProgramBuilder& program, const Scene& scene) {
    StepProgram& built = program.program();
    if (built.skinIndices != BufferId{}) return;
    built.skinIndices = program.upload("skin.indices", surface::joinIndices(scene.skins));
    built.cutting.topology.push_back(built.skinIndices);
    program.addToState(built.skinIndices, built.skinIndices);
}

void addStretched(ProgramBuilder& program, const Scene& scene, const Cut& cut,
                  const std::vector<bool>& parted, const StateLayout& layout, DebrisSkins& skins) {
    const std::vector<bool> mayGo = particlesThatMayGo(scene, cut, layout);
    Stretched stretched;
    std::uint32_t firstVertex = 0, firstIndex = 0;
    for (std::size_t s = 0; s < scene.skins.size(); ++s) {
        const Skin& skin = scene.skins[s];
        if (!parted[s]) stretched.add(skin, firstVertex, firstIndex, mayGo);
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
        firstIndex += static_cast<std::uint32_t>(3 * skin.triangles.size());
    }
    if (stretched.triangles.empty()) return;
    makeIndices(program, scene);
    skins.triangles = program.upload("debris.triangles", stretched.triangles);
    skins.holders = program.upload("debris.holders", stretched.holders);
    skins.triangleCount = static_cast<std::uint32_t>(stretched.triangles.size());
}

} // namespace

DebrisSkins addDebrisSkins(ProgramBuilder& program, const Scene& scene, const Cut& cut,
                           const StateLayout& layout) {
    DebrisSkins skins;
    const std::vector<bool> parted = areParted(scene, cut);
    if (std::ranges::count(parted, true) > 0) {
        const std::vector<std::uint32_t> slots = vertexSlots(scene, parted, layout);
        skins.vertexSlots = program.upload("debris.vertex_slots", slots);
        skins.vertexCount = static_cast<std::uint32_t>(slots.size());
    }
    addStretched(program, scene, cut, parted, layout, skins);
    return skins;
}

void addTriangleHiding(ProgramBuilder& program, const DebrisSkins& skins) {
    if (skins.triangleCount == 0) return;
    const StepProgram& built = program.program();
    program.dispatch(k::hideDebrisTriangles, skins.triangleCount,
                     {skins.triangles, skins.holders, built.cutting.pieces, built.skinIndices},
                     layout::CountPush{skins.triangleCount});
}

void addVertexHiding(ProgramBuilder& program, const Cut& cut) {
    const DebrisSkins& skins = cut.debrisSkins;
    if (skins.vertexCount > 0) addHiding(program, cut, skins.vertexSlots, skins.vertexCount);
}

} // namespace sinew::sim::cutting
