// GPU time per phase: a query pool with one pair of timestamps per phase (each write costs a flush on
// software devices).
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/commands.hpp"

namespace sinew::vk {

/// Records begin and end of numbered spans in one command buffer; they can be read after that submission has
/// finished.
class SINEW_API Timestamps {
public:
    /// For at most `spans` spans; on a family without timestamps every call is a no-op and `milliseconds` is
    /// empty.
    Timestamps(const Device& device, std::uint32_t spans);
    Timestamps(Timestamps&& other) noexcept;
    Timestamps& operator=(Timestamps&& other) noexcept;
    ~Timestamps();

    void reset(Commands& commands) noexcept;
    /// Spans must begin in the order 0, 1, 2 ... and end within the same command buffer.
    void begin(Commands& commands, std::uint32_t span) noexcept;
    void end(Commands& commands, std::uint32_t span) noexcept;
    /// Durations [ms] of the spans recorded since reset. Waits only for the queries: call it after the
    /// submission has finished.
    std::vector<double> milliseconds() const;

private:
    void release() noexcept;
    VkDevice device_ = VK_NULL_HANDLE;
    const DeviceFunctions* functions_ = nullptr;
    VkQueryPool pool_ = VK_NULL_HANDLE; ///< null if the family has no timestamps
    std::uint32_t spans_ = 0, recorded_ = 0;
    std::uint32_t bits_ = 0; ///< valid bits of a timestamp
    double period_ = 0;      ///< [ns]
};

} // namespace sinew::vk
