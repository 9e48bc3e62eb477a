// Submission for programs without an engine (apps and tests): one queue, a timeline semaphore, reusable
// command buffers.
#pragma once

#include "sinew/export.hpp"
#include "sinew/vk/commands.hpp"

#include <functional>

namespace sinew::vk {

/// Owns a command pool and a timeline semaphore on queue 0 of the device's family. One thread. The Device may
/// be moved, but must outlive the Queue. Needs the feature timelineSemaphore, which Device::create enables.
class SINEW_API Queue {
public:
    /// Throws Error if Vulkan cannot create pool or semaphore.
    explicit Queue(const Device& device);
    ~Queue(); ///< waits for all submissions
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;

    /// Begins a command buffer for one submission; reuses finished ones.
    VkCommandBuffer begin();
    /// Ends and submits; returns the timeline value for wait(). Throws Error(deviceLost / outOfMemory).
    std::uint64_t submit(VkCommandBuffer commands);
    /// Blocks until the submission with this value has finished. Throws Error(deviceLost / outOfMemory);
    /// even then nothing is left in flight.
    void wait(std::uint64_t value);
    void waitIdle();
    /// waitIdle() for destructors: never throws. A lost device has nothing in flight.
    void drain() noexcept;
    VkQueue handle() const noexcept { return queue_; }
    /// The semaphore and the value of the newest submission, for a presenter that must run after it.
    VkSemaphore timeline() const noexcept { return timeline_; }
    std::uint64_t submitted() const noexcept { return submitted_; }

    /// Set-up and tests: copies bytes to or from a buffer through staging memory and waits, ordered after all
    /// earlier submissions and before all later ones. `size` is a multiple of 4 within the view.
    void upload(const BufferView& target, const void* bytes, VkDeviceSize size);
    void download(const BufferView& source, void* bytes, VkDeviceSize size);
    template <typename T> std::vector<T> download(const BufferView& source) {
        std::vector<T> elements(static_cast<std::size_t>(source.size / sizeof(T)));
        download(source, elements.data(), elements.size() * sizeof(T));
        return elements;
    }

private:
    struct Submission {
        VkCommandBuffer commands;
        std::uint64_t value;
    };
    void transfer(const BufferView& from, const BufferView& to);
    void release() noexcept;
    const Device& device_;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkSemaphore timeline_ = VK_NULL_HANDLE;
    std::uint64_t submitted_ = 0;
    std::vector<Submission> submissions_; ///< in order of value; the first ones may have finished
};

/// Waits for all submissions to a queue in its destructor. Declare it after the buffers, pipelines and
/// queries that the submissions use: these then outlive them, also if an exception leaves the scope or the
/// constructor.
class SINEW_API Drain {
public:
    explicit Drain(Queue& queue) noexcept : queue_(queue) {}
    ~Drain() { queue_.drain(); }
    Drain(const Drain&) = delete;
    Drain& operator=(const Drain&) = delete;

private:
    Queue& queue_;
};

} // namespace sinew::vk
