// The bytes of a pipeline cache that a host keeps between two runs, with a seal: drivers may crash on damaged
// bytes, and Vulkan requires that none are passed to them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sinew::vk {

/// `data` with a seal behind it: a mark and a hash.
std::vector<std::byte> sealed(std::vector<std::byte> data);

/// The data of sealed(), in `bytes`; empty if these are cut short, changed or of another origin.
std::span<const std::byte> unsealed(std::span<const std::byte> bytes) noexcept;

} // namespace sinew::vk
