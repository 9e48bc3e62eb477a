// One list for all mixed skins: whole triangles and then parts of each skin, each skin starting at a whole
// word.
#include "sim/surface/mixed_skin.hpp"

#include "kernels.hpp"
#include "sim/surface/skin.hpp"

#include <algorithm>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

using Triangle = std::array<std::uint32_t, 3>;

// Triangles of all skins, skin after skin, and the first of each.
struct Layout {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> wholes, parts; // by skin: number of triangles before them in the buffer
    std::vector<StepProgram::IndexRange> ranges;
    std::vector<layout::MixedWords> words;
    std::vector<layout::DrawArguments> draws; // those before the first cut
};

class Joiner {
public:
    void add(const Skin& skin, bool isMixed) {
        const auto first = static_cast<std::uint32_t>(layout_.indices.size());
        layout_.wholes.push_back(first / 3);
        const std::size_t drawn = isMixed ? skin.wholeTriangles.size() : skin.triangles.size();
        layout_.draws.push_back({static_cast<std::uint32_t>(3 * drawn), 1, first, 0, 0});
        if (isMixed)
            for (const Triangle& triangle : skin.wholeTriangles) append(triangle);
        layout_.parts.push_back(static_cast<std::uint32_t>(layout_.indices.size() / 3));
        for (const Triangle& triangle : skin.triangles)
            append(isMixed ? Triangle{} : triangle); // parts are drawn once something is cut
        while (layout_.indices.size() % (3 * MIXED_WORD) != 0) append({});
        const auto count = static_cast<std::uint32_t>(layout_.indices.size()) - first;
        layout_.ranges.push_back({first, count});
        layout_.words.push_back({first / (3 * MIXED_WORD), count / (3 * MIXED_WORD)});
        firstVertex_ += static_cast<std::uint32_t>(skin.vertexCount());
    }
    Layout finish() { return std::move(layout_); }

private:
    void append(const Triangle& triangle) {
        for (const std::uint32_t corner : triangle) layout_.indices.push_back(firstVertex_ + corner);
    }
    Layout layout_;
    std::uint32_t firstVertex_ = 0;
};

// Sets the indices of faces, which are in any order, and of whole triangles, in the order of bodies.mixed.
void place(const Scene& scene, const Layout& layout, CutBodies& bodies) {
    std::vector<std::uint32_t> skinOf; // by triangle of all skins
    std::vector<std::uint32_t> first;  // by skin
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s) {
        first.push_back(static_cast<std::uint32_t>(skinOf.size()));
        skinOf.insert(skinOf.end(), scene.skins[s].triangles.size(), s);
    }
    for (layout::SkinFace& face : bodies.faces) {
        const std::uint32_t s = skinOf[face.triangle];
        face.mixed = layout.parts[s] + face.triangle - first[s];
    }
    std::size_t next = 0;
    for (const std::uint32_t s : bodies.mixed)
        for (std::uint32_t t = 0; t < scene.skins[s].wholeTriangles.size(); ++t)
            bodies.wholes[next++].mixed = layout.wholes[s] + t;
}

// Flags of vertices while mixed skins are drawn as whole triangles only.
std::vector<std::uint32_t> shownAtFirst(const Scene& scene, const CutBodies& bodies) {
    std::vector<std::uint32_t> shown;
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s) {
        const Skin& skin = scene.skins[s];
        const std::size_t first = shown.size();
        const bool isMixed = std::ranges::count(bodies.mixed, s) > 0;
        shown.insert(shown.end(), skin.vertexCount(),
                     isMixed ? VERTEX_OF_PARTS : VERTEX_PLACED | VERTEX_SHOWN);
        if (!isMixed) continue;
        for (const Triangle& whole : skin.wholeTriangles)
            for (const std::uint32_t corner : whole) shown[first + corner] = VERTEX_PLACED;
    }
    return shown;
}

void uploadMixed(ProgramBuilder& program, CutSurface& surface, const Layout& layout) {
    StepProgram& built = program.program();
    built.mixedTriangles = program.upload("skin.mixed_triangles", layout.indices);
    built.mixedIndices = program.upload("skin.mixed_indices", layout.indices);
    built.mixedDraws = program.upload("skin.mixed_draws", layout.draws);
    built.mixedRanges = layout.ranges;
    surface.skinCount = static_cast<std::uint32_t>(layout.words.size());
    surface.words = static_cast<std::uint32_t>(layout.indices.size() / (3 * MIXED_WORD));
    surface.mixedWords = program.upload("surface.mixed_words", layout.words);
    surface.drawnWords = program.scratch<std::uint32_t>("surface.drawn_words", surface.words);
    surface.drawnStarts = program.scratch<std::uint32_t>("surface.drawn_starts", surface.words);
    // Passes of the surface rebuild the triangles from the topology, so they are not part of it.
}

void uploadWholes(ProgramBuilder& program, CutSurface& surface, const CutBodies& bodies) {
    std::vector<std::uint32_t> indices;
    for (const layout::WholeTriangle& whole : bodies.wholes)
        for (const std::uint32_t corner : whole.vertices) indices.push_back(bodies.vertices[corner].vertex);
    surface.wholeVertices = std::ranges::max(indices) + 1;
    surface.wholeIndices = program.upload("surface.whole_indices", indices);
    surface.wholeFans = uploadFans(program, indices, surface.wholeVertices, "surface.whole");
}

// Packs the drawn triangles: drawing collapsed ones takes a device almost as long.
void addPacking(ProgramBuilder& program, const CutSurface& surface) {
    const StepProgram& built = program.program();
    const bool usesTexels = surface.usesTexels;
    program.dispatch(usesTexels ? k::markDrawn : k::markDrawnLoads, surface.words,
                     {built.mixedTriangles, surface.drawnWords}, layout::CountPush{surface.words});
    const std::uint32_t lanes = surface.skinCount * GROUP_ITEMS;
    program.dispatch(k::scanDrawn, lanes,
                     {surface.mixedWords, surface.drawnWords, surface.drawnStarts, built.mixedDraws},
                     layout::CountPush{lanes});
    const std::uint32_t triangles = surface.words * MIXED_WORD;
    program.dispatch(usesTexels ? k::packDrawn : k::packDrawnLoads, triangles,
                     {built.mixedTriangles, surface.drawnWords, surface.drawnStarts, built.mixedIndices},
                     layout::CountPush{triangles});
}

// Adds the lists of drawn triangles.
void addMixedTriangles(ProgramBuilder& program, CutSurface& surface, const Scene& scene, CutBodies& bodies) {
    Joiner joiner;
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s)
        joiner.add(scene.skins[s], std::ranges::count(bodies.mixed, s) > 0);
    const Layout layout = joiner.finish();
    place(scene, layout, bodies);
    uploadMixed(program, surface, layout);
    const std::vector<std::uint32_t> shown = shownAtFirst(scene, bodies);
    program.program().shownVertices = program.upload("skin.shown_vertices", shown);
    surface.shownAtFirst = program.upload("skin.shown_at_first", shown);
}

} // namespace

void addMixedSkins(ProgramBuilder& program, CutSurface& surface, const Scene& scene, CutBodies& bodies) {
    StepProgram& built = program.program();
    if (bodies.wholes.empty()) return;
    std::vector<BufferId> topology;
    if (built.pieceDraws == BufferId{}) { // else those draw from skinIndices
        addMixedTriangles(program, surface, scene, bodies);
        topology = {built.mixedIndices, built.mixedDraws, built.shownVertices};
    }
    surface.wholeCount = static_cast<std::uint32_t>(bodies.wholes.size());
    surface.wholes = program.upload("surface.wholes", bodies.wholes);
    surface.wholeStates = program.scratch<std::uint32_t>("surface.whole_states", surface.wholeCount);
    surface.wholeMarks = program.scratch<std::uint32_t>("surface.whole_marks", bodies.vertices.size());
    topology.insert(topology.end(), {surface.wholeStates, surface.wholeMarks});
    for (const BufferId buffer : topology) {
        built.cutting.topology.push_back(buffer);
        program.carry(buffer, buffer);
    }
    uploadWholes(program, surface, bodies);
    surface.partCount = static_cast<std::uint32_t>(bodies.parts.size());
    if (surface.partCount > 0) surface.partVertices = program.upload("surface.part_vertices", bodies.parts);
}

void addWholeNormals(ProgramBuilder& program, const CutSurface& surface) {
    if (surface.wholeCount == 0) return;
    const std::uint32_t hung = surface.hung.vertexCount;
    addNormals(program, {&k::skinNormalsWhole, &k::skinNormalsWholeLoads}, surface.usesTexels,
               surface.wholeIndices, surface.wholeFans, {surface.hung.vertices, surface.wholeMarks},
               layout::WholePush{.count = hung, .vertices = surface.wholeVertices});
}

void addPartNormals(ProgramBuilder& program, const CutSurface& surface) {
    if (surface.partCount == 0) return;
    const StepProgram& built = program.program();
    std::vector<BufferId> buffers{
        surface.partVertices, built.cutting.links, surface.rest,   surface.source.particles,
        built.positions,      surface.gradients,   surface.near,   surface.hung.vertices,
        surface.hung.grids,   built.skinVertices,  surface.wholes, surface.wholeStates,
        surface.hung.rims};
    const bool isMixed = program.isOfMixedSkin();
    if (isMixed) buffers.push_back(built.shownVertices);
    program.dispatch(isMixed ? k::lightPartsShown : k::lightParts, surface.partCount, buffers,
                     layout::CountPush{surface.partCount});
}

void addFacePasses(ProgramBuilder& program, const CutSurface& surface) {
    const StepProgram& built = program.program();
    const BufferId state = built.cutSurface.state;
    const layout::CountPush faces{surface.faces}, wholes{surface.wholeCount};
    if (surface.wholeCount > 0) {
        program.fill(surface.wholeStates, 0);
        program.fill(surface.wholeMarks, 0);
        program.dispatch(surface.usesTexels ? k::openWholes : k::openWholesLoads, faces.count,
                         {surface.counts, state, surface.skinFaces, surface.hung.prisms,
                          surface.hung.vertices, surface.hung.moved, surface.partitions, surface.wholeStates},
                         layout::PrismPush{.first = surface.slots, .count = faces.count});
        program.dispatch(k::markWholes, wholes.count,
                         {surface.wholes, surface.wholeStates, surface.wholeMarks}, wholes);
    }
    if (surface.words == 0) {
        program.dispatch(surface.usesTexels ? k::hideFaces : k::hideFacesLoads, faces.count,
                         {surface.counts, state, surface.skinFaces, surface.allIndices, built.skinIndices},
                         faces);
        return;
    }
    program.copy(surface.shownAtFirst, built.shownVertices);
    program.dispatch(k::drawWholes, wholes.count,
                     {surface.wholes, surface.wholeMarks, surface.hung.vertices, surface.wholeStates,
                      built.mixedTriangles, built.shownVertices},
                     wholes);
    program.dispatch(surface.usesTexels ? k::hideFacesMixed : k::hideFacesMixedLoads, faces.count,
                     {surface.counts, state, surface.skinFaces, surface.allIndices, built.skinIndices,
                      surface.wholeStates, built.mixedTriangles, built.shownVertices},
                     faces);
    addPacking(program, surface);
}

} // namespace sinew::sim::surface
