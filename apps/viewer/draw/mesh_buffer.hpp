// Meshes that the host makes once, as buffers to draw from.
#pragma once

#include "vk/buffer.hpp"

#include <cstring>

namespace sinew::viewer {

/// A buffer of the elements. `usage` as vertices or indices.
template <typename T>
vk::Buffer filledBuffer(const vk::Device& device, const std::string& name, const std::vector<T>& elements,
                        VkBufferUsageFlags usage) {
    vk::Buffer buffer(device, {.name = name,
                               .count = elements.size(),
                               .stride = sizeof(T),
                               .kind = vk::MemoryKind::upload,
                               .usage = usage});
    std::memcpy(buffer.mapped(), elements.data(), elements.size() * sizeof(T));
    return buffer;
}

} // namespace sinew::viewer
