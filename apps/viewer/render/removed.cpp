// Uses the simulation's piece labels, if it has them.
#include "viewer/render/removed.hpp"

namespace sinew::viewer {

vk::BufferView removedParticles(const sim::Simulation& simulation) {
    vk::BufferView words = simulation.pieces();
    // If nothing can be cut, positions stand for labels: the bits of a finite number never equal
    // REMOVED_PIECE.
    if (words.size == 0) words = simulation.positions();
    words.stride = sizeof(std::uint32_t);
    return words;
}

} // namespace sinew::viewer
