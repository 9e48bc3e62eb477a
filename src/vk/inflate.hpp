// A decoder of deflate streams (RFC 1951): the build packs kernels, which are unpacked when they are made.
#pragma once

#include <cstdint>
#include <span>

namespace sinew::vk {

/// Unpacks a raw stream, without the head and the tail of gzip, and returns true if it is valid and fills
/// `out` exactly, without bytes behind its end. Reads and writes nothing outside of the spans; where it
/// fails, `out` may have been written in part. Allocates nothing. Any thread.
bool inflate(std::span<const std::uint8_t> packed, std::span<std::uint8_t> out) noexcept;

} // namespace sinew::vk
