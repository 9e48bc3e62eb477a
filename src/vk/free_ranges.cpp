// First fit, with merging on return.
#include "vk/free_ranges.hpp"

#include <cassert>

namespace sinew::vk {

std::optional<std::uint64_t> FreeRanges::take(std::uint64_t size, std::uint64_t alignment) {
    for (auto range = free_.begin(); range != free_.end(); ++range) {
        const auto [begin, length] = *range;
        const std::uint64_t offset = (begin + alignment - 1) & ~(alignment - 1);
        const std::uint64_t padding = offset - begin;
        if (padding > length || length - padding < size) continue;
        const auto taken = taken_.emplace(offset, size).first;
        if (const std::uint64_t rest = length - padding - size; rest > 0) {
            try {
                free_.emplace(offset + size, rest);
            } catch (...) {
                taken_.erase(taken);
                throw;
            }
        }
        if (padding > 0)
            range->second = padding;
        else
            free_.erase(range);
        return offset;
    }
    return std::nullopt;
}

void FreeRanges::give(std::uint64_t offset, std::uint64_t size) noexcept {
    auto node = taken_.extract(offset);
    assert(!node.empty() && node.mapped() == size);
    const auto range = free_.insert(std::move(node)).position;
    if (const auto next = std::next(range); next != free_.end() && offset + size == next->first) {
        range->second += next->second;
        free_.erase(next);
    }
    if (range == free_.begin()) return;
    if (const auto previous = std::prev(range); previous->first + previous->second == offset) {
        previous->second += range->second;
        free_.erase(range);
    }
}

} // namespace sinew::vk
