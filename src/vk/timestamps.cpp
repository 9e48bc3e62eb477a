// Two queries per span.
#include "sinew/vk/timestamps.hpp"

#include "sinew/vk/check.hpp"

#include <cassert>
#include <utility>

namespace sinew::vk {

Timestamps::Timestamps(const Device& device, std::uint32_t spans)
    : device_(device.handle()), functions_(&device.functions()), spans_(spans),
      bits_(device.limits().timestampBits), period_(static_cast<double>(device.limits().timestampPeriod)) {
    if (bits_ == 0 || spans == 0) return;
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2 * spans};
    check(functions_->vkCreateQueryPool(device_, &info, functions_->allocation, &pool_), "vkCreateQueryPool",
          "timestamps");
    device.name(VK_OBJECT_TYPE_QUERY_POOL, handleValue(pool_), "sinew.timestamps");
}

Timestamps::Timestamps(Timestamps&& other) noexcept
    : device_(other.device_), functions_(other.functions_), pool_(std::exchange(other.pool_, VK_NULL_HANDLE)),
      spans_(other.spans_), recorded_(other.recorded_), bits_(other.bits_), period_(other.period_) {}

Timestamps& Timestamps::operator=(Timestamps&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(functions_, other.functions_);
    std::swap(pool_, other.pool_);
    std::swap(spans_, other.spans_);
    std::swap(recorded_, other.recorded_);
    std::swap(bits_, other.bits_);
    std::swap(period_, other.period_);
    return *this;
}

Timestamps::~Timestamps() {
    release();
}

void Timestamps::release() noexcept {
    functions_->vkDestroyQueryPool(device_, pool_, functions_->allocation);
}

void Timestamps::reset(Commands& commands) noexcept {
    recorded_ = 0;
    if (pool_ != VK_NULL_HANDLE) commands.resetTimestamps(pool_, 2 * spans_);
}

void Timestamps::begin(Commands& commands, std::uint32_t span) noexcept {
    assert(pool_ == VK_NULL_HANDLE || (span == recorded_ && span < spans_));
    if (pool_ == VK_NULL_HANDLE) return;
    commands.timestamp(pool_, 2 * span);
    recorded_ = span + 1;
}

void Timestamps::end(Commands& commands, std::uint32_t span) noexcept {
    assert(pool_ == VK_NULL_HANDLE || span < recorded_);
    if (pool_ != VK_NULL_HANDLE) commands.timestamp(pool_, 2 * span + 1);
}

std::vector<double> Timestamps::milliseconds() const {
    if (recorded_ == 0) return {};
    std::vector<std::uint64_t> ticks(2 * recorded_);
    check(functions_->vkGetQueryPoolResults(
              device_, pool_, 0, 2 * recorded_, ticks.size() * sizeof(std::uint64_t), ticks.data(),
              sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults", "timestamps");
    const std::uint64_t mask = bits_ >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits_) - 1;
    std::vector<double> durations(recorded_);
    for (std::size_t span = 0; span < durations.size(); ++span) // the counter may wrap in between
        durations[span] =
            static_cast<double>((ticks[2 * span + 1] - ticks[2 * span]) & mask) * period_ * 1e-6;
    return durations;
}

} // namespace sinew::vk
