// The shared Vulkan device of a test binary, under core, synchronisation and queue-submit validation. A test
// fails if the layer reports anything during it, unless it takes the messages. Including this header
// suffices.
//
// The layer uses more than half of the time of tests that play a scene for thousands of steps with the same
// commands. If SINEW_PLAYED is in the environment (PLAYED of sinew_test) and SINEW_FULL is not, device() has
// no layer, and Runner records the first steps of each kind on a second device with the layer.
#pragma once

#include "sinew/vk/queue.hpp"

#include <string>
#include <vector>

namespace sinew::test {

/// The device, made on first use and destroyed after the last test. A failure to make it fails the requesting
/// test.
const vk::Device& device();
vk::Queue& queue();

/// Whether device() has no layer.
bool isPlayed();
/// Like device() and queue(), but always under validation.
const vk::Device& validatedDevice();
vk::Queue& validatedQueue();

/// Returns the validation messages since the last call or the start of the test, for tests of known hazards.
/// The test no longer fails for them.
std::vector<std::string> takeMessages();

/// Makes a device buffer with these elements.
template <typename T> vk::Buffer upload(const std::string& name, const std::vector<T>& elements) {
    vk::Buffer buffer(device(), {.name = name, .count = elements.size(), .stride = sizeof(T)});
    queue().upload(buffer.view(), elements.data(), elements.size() * sizeof(T));
    return buffer;
}

} // namespace sinew::test
