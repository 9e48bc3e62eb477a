// Buffers of what rays and regions of the host need besides those of a simulation.
#pragma once

#include "common/layout.h"
#include "sinew/simulation.hpp"
#include "sinew/vk/buffer.hpp"

#include <cstring>
#include <string>
#include <vector>

namespace sinew::sim {

/// A table that kernels read. Buffers must not be empty: an empty table has one element.
template <typename T>
vk::Buffer tableOf(const vk::Device& device, const std::string& name, std::vector<T> elements) {
    if (elements.empty()) elements.resize(1);
    vk::Buffer buffer(
        device,
        {.name = name, .count = elements.size(), .stride = sizeof(T), .kind = vk::MemoryKind::upload});
    std::memcpy(buffer.mapped(), elements.data(), elements.size() * sizeof(T));
    buffer.flush();
    return buffer;
}

/// By particle: REMOVED_PIECE if it is part of a removed fragment. If nothing can be cut, positions stand for
/// the labels of pieces: the bits of a finite number never equal REMOVED_PIECE.
inline vk::BufferView removedParticles(const Simulation& simulation) {
    vk::BufferView words = simulation.pieces();
    if (words.size == 0) words = simulation.positions();
    words.stride = sizeof(std::uint32_t);
    return words;
}

} // namespace sinew::sim
