// Which faces and edges are halves of cells of a sheet and their sides follows from the slots of their
// corners.
#include "sim/cutting/cut_faces.hpp"

#include "kernels.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

template <typename T> std::vector<T> initialOf(ProgramBuilder& program, BufferId buffer) {
    const BufferSpec& spec = program.program().buffers[buffer.index];
    std::vector<T> values(spec.initial.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), spec.initial.data(), spec.initial.size());
    return values;
}

bool isIn(const CutRun& run, std::uint32_t slot) {
    return slot >= run.first && slot - run.first < run.count;
}

// Of the halves of the cell above a slot; none between others.
std::optional<layout::SheetTriangle> halfOf(const CutRun& run, const layout::ContactFace& face) {
    std::array<std::uint32_t, 3> slots{face.a, face.b, face.c};
    std::ranges::sort(slots);
    if (!isIn(run, slots[0]) || !isIn(run, slots[2])) return std::nullopt;
    const std::uint32_t middle = slots[1] - slots[0];
    if (slots[2] - slots[0] != run.sliceStride + 1 || (middle != 1 && middle != run.sliceStride))
        return std::nullopt;
    return layout::SheetTriangle{slots[0], middle == 1 ? 1u : 0u};
}

// Faces of one run, with where they stand in the list that they are searched by.
std::vector<layout::CutFace> facesOf(const CutRun& run, std::span<const layout::ContactFace> faces,
                                     std::span<const std::uint32_t> searched, bool isLarge) {
    std::vector<layout::CutFace> result;
    for (std::uint32_t place = 0; place < searched.size(); ++place) {
        const std::uint32_t face = searched[place];
        if (face >= faces.size()) continue; // padding
        const auto half = halfOf(run, faces[face]);
        if (half) result.push_back({half->slot, half->kind, place, face, isLarge ? 1u : 0u});
    }
    return result;
}

std::vector<layout::CutEdge> edgesOf(const CutRun& run, std::span<const layout::ContactEdge> edges) {
    std::vector<layout::CutEdge> result;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const auto [low, high] = std::minmax(edges[e].a, edges[e].b);
        if (low == high || !isIn(run, low) || !isIn(run, high)) continue;
        const std::uint32_t way = high - low;
        if (way == 1 || way == run.sliceStride || way == run.sliceStride + 1) result.push_back({low, way, e});
    }
    return result;
}

// A dispatch before the substeps and one after links were given back.
void addTwice(ProgramBuilder& program, const std::function<void()>& addPass) {
    const auto add = [&program, addPass] {
        program.beginCut();
        addPass();
        program.endCut();
    };
    add();
    program.atEnd(add);
}

void makeTopology(ProgramBuilder& program, BufferId seen, std::initializer_list<BufferId> buffers) {
    CuttingBuffers& cutting = program.program().cutting;
    const auto has = [](const std::vector<BufferId>& list, BufferId buffer) {
        return std::ranges::find(list, buffer) != list.end();
    };
    if (has(cutting.topology, *buffers.begin())) return;                        // by another run
    if (!has(cutting.contactsSeen, seen)) cutting.contactsSeen.push_back(seen); // else crumbs leave it too
    for (const BufferId buffer : buffers) {
        cutting.topology.push_back(buffer);
        program.carry(buffer, buffer);
    }
}

} // namespace

void addFaceFilter(ProgramBuilder& program, const collision::face_contacts::Contacts& contacts) {
    const CuttingBuffers cutting = program.program().cutting;
    const auto& lists = contacts.lists;
    for (const CutRun& run : cutting.runs) {
        if (run.rowStride > 0) continue; // no sheet
        const auto all = initialOf<layout::ContactFace>(program, lists.faces);
        auto faces = facesOf(run, all, initialOf<std::uint32_t>(program, lists.searched), false);
        const auto large = facesOf(run, all, initialOf<std::uint32_t>(program, lists.large), true);
        faces.insert(faces.end(), large.begin(), large.end());
        if (faces.empty()) continue;
        makeTopology(program, lists.grid.detected, {lists.searched, lists.large});
        const BufferId uploaded = program.upload("cut.faces", faces);
        const layout::CutFacesPush push{static_cast<std::uint32_t>(faces.size()), run.sliceStride};
        addTwice(program, [&program, cutting, lists, uploaded, push] {
            program.dispatch(
                k::partFaces, push.count,
                {cutting.links, cutting.savedLinks, uploaded, lists.searched, lists.large, lists.grid.bounds},
                push);
        });
    }
}

void addEdgeFilter(ProgramBuilder& program, const collision::edge_contacts::Contacts& contacts) {
    const CuttingBuffers cutting = program.program().cutting;
    const auto& lists = contacts.lists;
    for (const CutRun& run : cutting.runs) {
        if (run.rowStride > 0) continue;
        const auto edges = edgesOf(run, initialOf<layout::ContactEdge>(program, lists.edges));
        if (edges.empty()) continue;
        makeTopology(program, lists.grid.detected, {lists.edges});
        const BufferId uploaded = program.upload("cut.edges", edges);
        const layout::CutFacesPush push{static_cast<std::uint32_t>(edges.size()), run.sliceStride};
        addTwice(program, [&program, cutting, lists, uploaded, push] {
            program.dispatch(
                k::partEdges, push.count,
                {cutting.links, cutting.savedLinks, uploaded, lists.radii, lists.edges, lists.grid.bounds},
                push);
        });
    }
}

} // namespace sinew::sim::cutting
