// The host side of separations: buffers, and the order of the passes.
#include "sim/collision/separations.hpp"

#include "collision/sheet_marks.h"
#include "collision/touched.h"
#include "kernels.hpp"

#include <algorithm>
#include <iterator>

namespace sinew::sim::collision::separations {

namespace k = kernels;

namespace {

ProgramBuilder::Constants speedConstants(const Separations& separations) {
    constexpr std::uint32_t hasBodiesId = 1; // constant_id in body_speeds.glsl
    return {{hasBodiesId, separations.hasBodies()}};
}

std::vector<BufferId> buffersOf(const Separations& separations) {
    return {separations.sheets, boundIf(separations.hasBodies(), separations.frames.sums),
            separations.frames.ofSlots};
}

void addSearch(ProgramBuilder& program, const Separations& separations, const row_contacts::Rows& rows,
               const ParticleBuffers& predicted, const ParticleBuffers& state) {
    const pooled_lists::Lists& lists = rows.lists;
    std::vector<BufferId> buffers{predicted.positions, predicted.velocities, rows.shapes,
                                  lists.contacts,      state.positions,      state.velocities,
                                  rows.directions,     separations.parts,    state.step};
    std::ranges::copy(buffersOf(separations), std::back_inserter(buffers));
    if (rows.kind->areEdges) {
        buffers.push_back(lists.links->owners);
        row_contacts::addOverTouched(program, rows, TOUCHED_ROWS, k::findEdgeSeparations, std::move(buffers),
                                     speedConstants(separations));
    } else {
        buffers.push_back(lists.ranges);
        row_contacts::addOverTouched(program, rows, TOUCHED_POINTS, k::findFaceSeparations,
                                     std::move(buffers), speedConstants(separations));
    }
}

// By slot, as in sheet_marks.h.
std::vector<std::uint32_t> sheetsOf(const SceneModel& model, std::span<const layout::ContactFace> faces) {
    const body_frames::Bodies bodies = body_frames::bodiesOf(model);
    std::vector<bool> isHeld(bodies.kinds.size(), false);
    for (std::size_t i = 0; i < model.inverseMass.size(); ++i)
        if (model.inverseMass[i] == 0) isHeld[bodies.ofSlots[model.layout.slot[i]]] = true;
    std::vector<std::uint32_t> sheets(model.layout.count, 0);
    for (const layout::ContactFace& face : faces)
        for (const std::uint32_t corner : {face.a, face.b, face.c}) {
            const std::uint32_t slot = model.layout.slot[corner], body = bodies.ofSlots[slot];
            if (bodies.isAlone(body)) sheets[slot] = body | (isHeld[body] ? SHEET_HELD : 0u);
        }
    return sheets;
}

} // namespace

Separations add(ProgramBuilder& program, const SceneModel& model, std::span<const layout::ContactFace> sheets,
                const body_frames::Frames& frames) {
    std::vector<std::uint32_t> ofSlots = sheetsOf(model, sheets);
    if (std::ranges::count(ofSlots, 0u) == std::ssize(ofSlots)) return {};
    return {.sheets = program.upload("faces.sheets", ofSlots),
            .ofSlots = ofSlots,
            .parts = program.upload("separations.parts", std::vector<float>(ofSlots.size(), 1)),
            .frames = frames};
}

void addPasses(ProgramBuilder& program, const Separations& separations, const row_contacts::Rows& rows,
               const ParticleBuffers& predicted, const ParticleBuffers& state) {
    if (!separations.exist()) return;
    addSearch(program, separations, rows, predicted, state);
    std::vector<BufferId> buffers{predicted.positions, predicted.velocities, state.positions,
                                  state.velocities,    separations.parts,    state.step};
    std::ranges::copy(buffersOf(separations), std::back_inserter(buffers));
    ProgramBuilder::Constants constants = remainderConstants(state.layout);
    constants.merge(speedConstants(separations));
    // Corners of faces within reach that do not touch are in no list of what touches; ends of edges are.
    if (rows.kind->areEdges)
        row_contacts::addOverTouched(program, rows, TOUCHED_PARTICLES, k::keepApart, std::move(buffers),
                                     std::move(constants));
    else
        row_contacts::addOverParticles(program, rows, k::keepApart, std::move(buffers), constants);
}

} // namespace sinew::sim::collision::separations
