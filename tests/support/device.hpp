// The one Vulkan device of a test binary, under core, synchronisation and queue-submit validation. Including
// this is enough: a test during which the layer says anything fails, unless it took the messages.
//
// The layer takes more than half of the time of tests that play a scene for thousands of steps, whose
// commands are the same from step to step. Where SINEW_PLAYED is in the environment (PLAYED of sinew_test)
// and SINEW_FULL is not, device() is without the layer, and Runner takes the first steps of each kind on a
// second device that has it.
#pragma once

#include "vk/queue.hpp"

#include <string>
#include <vector>

namespace sinew::test {

/// Made on first use, destroyed after the last test. A device that cannot be made fails the test that asked
/// for it.
const vk::Device& device();
vk::Queue& queue();

/// Whether device() is without the layer.
bool isPlayed();
/// As device() and queue(), always under validation.
const vk::Device& validatedDevice();
vk::Queue& validatedQueue();

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
