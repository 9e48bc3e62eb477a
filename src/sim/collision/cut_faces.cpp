// Faces and edges are recognised by the slots of their corners: halves of cells of a sheet and their sides,
// and halves of squares of a lattice.
#include "sim/collision/cut_faces.hpp"

#include "kernels.hpp"
#include "sim/lattice/link_masks.hpp"
#include "sim/program/first_contents.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

namespace sinew::sim::collision {

namespace {

namespace k = kernels;

bool isIn(const CutRun& run, std::uint32_t slot) {
    return slot >= run.first && slot - run.first < run.count;
}

// The face as half of the cell above a slot; none if it is not such a half.
std::optional<layout::CutFace> halfOf(const CutRun& run, const layout::ContactFace& face) {
    std::array<std::uint32_t, 3> slots{face.a, face.b, face.c};
    std::ranges::sort(slots);
    if (!isIn(run, slots[0]) || !isIn(run, slots[2])) return std::nullopt;
    const std::uint32_t middle = slots[1] - slots[0];
    if (slots[2] - slots[0] != run.sliceStride + 1 || (middle != 1 && middle != run.sliceStride))
        return std::nullopt;
    return layout::CutFace{slots[0], middle == 1 ? 1u : 0u, 0, 0, 0};
}

// The step in a lattice that leads `slots` slots further.
std::optional<std::array<int, 3>> stepOf(const CutRun& run, std::uint32_t slots) {
    for (std::uint32_t bit = lattice::firstOwned; bit < lattice::directionCount; ++bit) {
        const auto [x, y, z] = lattice::directionOf(bit);
        const std::int64_t way = x + y * std::int64_t{run.rowStride} + z * std::int64_t{run.sliceStride};
        if (way == slots) return std::array{x, y, z};
    }
    return std::nullopt;
}

// The face as half of a square between nodes of a lattice; none if it is not such a half.
std::optional<layout::CutSolidFace> solidOf(const CutRun& run, const layout::ContactFace& face) {
    std::array<std::uint32_t, 3> slots{face.a, face.b, face.c};
    std::ranges::rotate(slots, std::ranges::min_element(slots));
    if (!isIn(run, slots[0]) || !isIn(run, std::max(slots[1], slots[2]))) return std::nullopt;
    const auto b = stepOf(run, slots[1] - slots[0]), c = stepOf(run, slots[2] - slots[0]);
    if (!b || !c) return std::nullopt;
    const std::array<std::uint32_t, 3> strides{1, run.rowStride, run.sliceStride};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int normal = (*b)[u] * (*c)[v] - (*b)[v] * (*c)[u];
        if ((*b)[axis] != 0 || (*c)[axis] != 0 || normal == 0) continue;
        return layout::CutSolidFace{slots[0], strides[axis], normal > 0 ? 1u : 0u, 0, 0, 0};
    }
    return std::nullopt;
}

// Faces of one run, as converted by `partOf`, with their index in the lists of faces to search.
template <typename Part, typename PartOf>
std::vector<Part> facesOf(ProgramBuilder& program, const face_lists::Lists& lists, const PartOf& partOf) {
    const auto all = firstContents<layout::ContactFace>(program, lists.faces);
    std::vector<Part> result;
    for (const bool isLarge : {false, true}) {
        const auto searched = firstContents<std::uint32_t>(program, isLarge ? lists.large : lists.searched);
        for (std::uint32_t place = 0; place < searched.size(); ++place) {
            const std::uint32_t face = searched[place];
            if (face >= all.size()) continue; // padding
            std::optional<Part> part = partOf(face, all[face]);
            if (!part) continue;
            part->place = place;
            part->face = face;
            part->isLarge = isLarge ? 1 : 0;
            result.push_back(*part);
        }
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

void makeTopology(ProgramBuilder& program, BufferId seen, const std::vector<BufferId>& buffers) {
    CuttingBuffers& cutting = program.program().cutting;
    const auto has = [](const std::vector<BufferId>& list, BufferId buffer) {
        return std::ranges::find(list, buffer) != list.end();
    };
    if (has(cutting.topology, buffers.front())) return;                         // by another run
    if (!has(cutting.contactsSeen, seen)) cutting.contactsSeen.push_back(seen); // else fragments leave it too
    for (const BufferId buffer : buffers) {
        cutting.topology.push_back(buffer);
        program.addToState(buffer, buffer);
    }
}

// Appends the update by `code`, which removes faces of one run from the search and adds others to it.
template <typename Part, typename PartOf>
void appendFilter(std::vector<CutFilter>& filters, ProgramBuilder& program,
                  const face_contacts::Contacts& contacts, const CutRun& run, const vk::ShaderCode& code,
                  const PartOf& partOf) {
    const face_lists::Lists& lists = contacts.lists;
    const auto faces = facesOf<Part>(program, lists, partOf);
    if (faces.empty()) return;
    std::vector<BufferId> topology{lists.searched, lists.large, lists.faces};
    if (contacts.hasInner()) topology.push_back(contacts.rows.cornerEnds);
    makeTopology(program, lists.grid.detected, topology);
    const CuttingBuffers& cutting = program.program().cutting;
    std::vector<BufferId> buffers{cutting.links,     cutting.savedLinks, program.upload("cut.faces", faces),
                                  lists.searched,    lists.large,        lists.grid.bounds,
                                  cutting.particles, cutting.pieces};
    if (run.rowStride > 0)
        buffers.insert(buffers.end(),
                       {lists.faces, contacts.opened, contacts.rows.corners, contacts.rows.cornerEnds});
    const layout::CutFacesPush push{static_cast<std::uint32_t>(faces.size()), run.sliceStride, run.rowStride};
    filters.push_back({&code, std::move(buffers), push});
}

// Removes faces inside uncut bodies from the search.
void hideInner(ProgramBuilder& program, const face_contacts::Contacts& contacts) {
    if (!contacts.hasInner()) return;
    const BufferId list = contacts.lists.searched;
    auto faces = firstContents<std::uint32_t>(program, list);
    for (std::uint32_t& face : faces)
        if (face >= contacts.firstInner && face < contacts.rows.push.moving) face = ~0u;
    std::memcpy(program.program().buffers[list.index].initial.data(), faces.data(),
                faces.size() * sizeof(faces[0]));
}

} // namespace

std::vector<CutFilter> faceFilters(ProgramBuilder& program, const face_contacts::Contacts& contacts) {
    std::vector<CutFilter> filters;
    const std::vector<CutRun> runs = program.program().cutting.runs;
    for (const CutRun& run : runs)
        if (run.rowStride > 0)
            appendFilter<layout::CutSolidFace>(filters, program, contacts, run, k::updateSolidFaces,
                                               [&](std::uint32_t f, const layout::ContactFace& face) {
                                                   return contacts.isOfCells[f] ? solidOf(run, face)
                                                                                : std::nullopt;
                                               });
        else
            appendFilter<layout::CutFace>(
                filters, program, contacts, run, k::disableCutFaces,
                [&](std::uint32_t, const layout::ContactFace& face) { return halfOf(run, face); });
    hideInner(program, contacts);
    return filters;
}

void addFilters(ProgramBuilder& program, std::span<const CutFilter> filters) {
    program.only(When::cut, [&] {
        for (const CutFilter& filter : filters)
            program.dispatch(*filter.code, filter.push.count, filter.buffers, filter.push);
    });
}

void addFaceOpening(ProgramBuilder& program, const face_contacts::Contacts& contacts,
                    const ParticleBuffers& predicted) {
    if (!contacts.hasInner()) return;
    const face_lists::Lists& lists = contacts.lists;
    program.only(When::cut, [&] {
        program.dispatch(k::recordCutFaceOverlaps, contacts.rows.push.count,
                         {predicted.positions, predicted.velocities, lists.faces, lists.pooled.contacts,
                          lists.pooled.ranges, lists.pooled.memory->memory, predicted.step, contacts.opened,
                          contacts.rows.marks},
                         contacts.rows.push);
    });
}

std::vector<CutFilter> edgeFilters(ProgramBuilder& program, const edge_contacts::Contacts& contacts) {
    std::vector<CutFilter> filters;
    const CuttingBuffers cutting = program.program().cutting;
    const auto& lists = contacts.lists;
    for (const CutRun& run : cutting.runs) {
        if (run.rowStride > 0) continue;
        const auto edges = edgesOf(run, firstContents<layout::ContactEdge>(program, lists.edges));
        if (edges.empty()) continue;
        makeTopology(program, lists.grid.detected, {lists.edges});
        const BufferId uploaded = program.upload("cut.edges", edges);
        const layout::CutFacesPush push{static_cast<std::uint32_t>(edges.size()), run.sliceStride, 0};
        const BufferId radii = program.initialOf("cut.edge_radii", lists.radii); // absent bodies change them
        filters.push_back({&k::disableCutEdges,
                           {cutting.links, cutting.savedLinks, uploaded, radii, lists.edges,
                            lists.grid.bounds, cutting.particles, cutting.pieces},
                           push});
    }
    return filters;
}

} // namespace sinew::sim::collision
