// The one Vulkan device of a test binary, under core, synchronisation and queue-submit validation. Including
// this is enough: a test during which the layer says anything fails, unless it took the messages.
#pragma once

#include "vk/queue.hpp"

#include <string>
#include <vector>

namespace sinew::test {

/// Made on first use, destroyed after the last test. A device that cannot be made fails the test that asked
/// for it.
const vk::Device& device();
vk::Queue& queue();

/// Validation messages since the last call or the start of the test; the test no longer fails for them. For
/// canaries.
std::vector<std::string> takeMessages();

/// A device buffer with these elements in it.
template <typename T> vk::Buffer upload(const std::string& name, const std::vector<T>& elements) {
    vk::Buffer buffer(device(), {.name = name, .count = elements.size(), .stride = sizeof(T)});
    queue().upload(buffer.view(), elements.data(), elements.size() * sizeof(T));
    return buffer;
}

} // namespace sinew::test
