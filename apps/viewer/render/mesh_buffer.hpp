// Buffers of meshes that the host makes once.
#pragma once

#include "sinew/vk/buffer.hpp"

#include <cstring>

namespace sinew::viewer {

/// Makes a buffer of the elements. `usage`: vertices or indices.
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
