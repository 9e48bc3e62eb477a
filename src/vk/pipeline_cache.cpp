// The seal of the bytes of a pipeline cache.
#include "vk/pipeline_cache.hpp"

#include <cstdint>
#include <cstring>

namespace sinew::vk {

namespace {

struct Seal {
    std::uint64_t mark = 0x31656863'6177656e; // says that what stands before it is such data
    std::uint64_t hash = 0;
};

// FNV-1a over 64 bits.
std::uint64_t hashOf(std::span<const std::byte> data) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::byte byte : data) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3;
    return hash;
}

} // namespace

std::vector<std::byte> sealed(std::vector<std::byte> data) {
    const Seal seal{.hash = hashOf(data)};
    const std::size_t size = data.size();
    data.resize(size + sizeof(Seal));
    std::memcpy(data.data() + size, &seal, sizeof(Seal));
    return data;
}

std::span<const std::byte> unsealed(std::span<const std::byte> bytes) noexcept {
    if (bytes.size() < sizeof(Seal)) return {};
    const std::span<const std::byte> data = bytes.first(bytes.size() - sizeof(Seal));
    const Seal expected{.hash = hashOf(data)};
    return std::memcmp(bytes.data() + data.size(), &expected, sizeof(Seal)) == 0
               ? data
               : std::span<const std::byte>{};
}

} // namespace sinew::vk
