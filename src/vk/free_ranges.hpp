// The free part of one memory block as disjoint ranges, with adjacent ones merged. Pure arithmetic: includes
// no Vulkan.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace sinew::vk {

class FreeRanges {
public:
    explicit FreeRanges(std::uint64_t size) : size_(size), free_{{0, size}} {}

    /// Takes `size` > 0 bytes at the lowest possible multiple of `alignment` (a power of two), and returns
    /// their offset; empty if there is no room. Nothing has changed if it throws std::bad_alloc.
    std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment);
    /// Returns exactly what `take` gave for this size.
    void give(std::uint64_t offset, std::uint64_t size) noexcept;
    bool isAllFree() const noexcept { return free_.size() == 1 && free_.begin()->second == size_; }
    /// Free ranges, offset to size; disjoint and not adjacent.
    const std::map<std::uint64_t, std::uint64_t>& ranges() const noexcept { return free_; }

private:
    std::uint64_t size_;
    std::map<std::uint64_t, std::uint64_t> free_;
    std::map<std::uint64_t, std::uint64_t>
        taken_; // its nodes return to free_, so that give() allocates nothing
};

} // namespace sinew::vk
