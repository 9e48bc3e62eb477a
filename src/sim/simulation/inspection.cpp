// Views of the buffers that the program names.
#include "sinew/inspection.hpp"

#include "sim/compile/compile.hpp"

namespace sinew::sim {

ParticleSlots particleSlots(const Scene& scene, const Settings& settings) {
    StateLayout layout = stateLayout(scene, settings);
    return {std::move(layout.slot), layout.count};
}

// If nothing can be cut, positions stand for the labels of pieces: the bits of a finite number never equal
// REMOVED_PIECE.
vk::BufferView removedParticles(const Simulation& simulation) {
    vk::BufferView words = simulation.pieces();
    if (words.size == 0) words = simulation.positions();
    words.stride = sizeof(std::uint32_t);
    return words;
}

InspectedBuffers inspect(const Simulation& simulation) {
    const StepProgram& program = simulation.program();
    const auto view = [&](BufferId buffer) { return simulation.view(buffer); };
    const ContactBuffers& contacts = program.contacts;
    InspectedBuffers all{.particles = program.particleCount,
                         .liveLinks = view(program.cutting.links),
                         .wholeIndices = view(program.wholeIndices),
                         .contacts = {.pairs = view(contacts.pairs),
                                      .pairLists = view(contacts.pairLists),
                                      .faces = view(contacts.faces),
                                      .facePairs = view(contacts.facePairs),
                                      .faceLists = view(contacts.faceLists),
                                      .edges = view(contacts.edges),
                                      .edgePairs = view(contacts.edgePairs),
                                      .edgeLists = view(contacts.edgeLists),
                                      .edgeCount = contacts.edgeCount}};
    for (const GridBuffers& grid : program.grids)
        all.grids.push_back(
            {grid.name, view(grid.bounds), view(grid.starts), view(grid.sorted), grid.count, grid.cells});
    for (const PieceVertices& sheet : program.pieceSkins)
        all.sheets.push_back({view(sheet.vertices), sheet.first});
    return all;
}

} // namespace sinew::sim
