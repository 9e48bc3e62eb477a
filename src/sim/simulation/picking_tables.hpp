// Buffers of what rays and regions of the host need besides those of a simulation.
#pragma once

#include "common/layout.h"
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

} // namespace sinew::sim
