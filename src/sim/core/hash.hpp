// FNV-1a [Fowler, Noll, Vo 1991], 64 bits: compares the final states of runs, and identifies programs and
// files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::sim {

/// Hash of all bytes; `before` is the hash of the bytes that precede them.
constexpr std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t before = 0xcbf29ce484222325u) {
    for (const std::byte byte : bytes) before = (before ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3u;
    return before;
}

} // namespace sinew::sim
