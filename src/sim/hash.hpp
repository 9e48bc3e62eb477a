// FNV-1a [Fowler, Noll, Vo 1991], 64 bits: says whether two runs ended alike, and tells programs and files
// apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::sim {

/// Of all bytes; `before` goes on from a hash of those before them.
constexpr std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t before = 0xcbf29ce484222325u) {
    for (const std::byte byte : bytes) before = (before ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
    return before;
}

} // namespace sinew::sim
