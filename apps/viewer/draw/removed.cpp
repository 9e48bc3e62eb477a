// Names of pieces, where there are some.
#include "viewer/draw/removed.hpp"

namespace sinew::viewer {

vk::BufferView removedParticles(const sim::Simulation& simulation) {
    vk::BufferView words = simulation.pieces();
    // Where nothing can be cut, as many words of positions: those bits are of no number, which they all are.
    if (words.size == 0) words = simulation.positions();
    words.stride = sizeof(std::uint32_t);
    return words;
}

} // namespace sinew::viewer
