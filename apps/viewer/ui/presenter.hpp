// Presentation of pictures in a window: surface, swapchain and frames in flight. Submits to the device's
// queue 0 itself: a presented frame waits for an acquired image and signals a binary semaphore, which
// vk::Queue does not support.
#pragma once

#include "viewer/ui/window.hpp"

#include <array>
#include <optional>

namespace sinew::viewer {

struct WindowFunctions {
#define SINEW_VK(name) PFN_##name name = nullptr;
#define SINEW_VK_DEVICE(name) PFN_##name name = nullptr;
#include "viewer/ui/window_functions.inc"
};

/// Owns the surface. One thread. Must not outlive its Device, which must not move.
class Presenter {
public:
    static constexpr std::uint32_t framesInFlight = 2;

    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE; ///< recording
        std::uint32_t slot = 0;                    ///< < framesInFlight; its previous commands have finished
        std::uint32_t image = 0;                   ///< of the swapchain
    };

    /// Throws vk::Error. Uses `window` only in the constructor.
    Presenter(const vk::Device& device, const Window& window);
    ~Presenter(); ///< waits for the queue
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /// 8 bits per channel; sRGB on a GPU if the surface has it, preferably not on a software device.
    VkFormat format() const noexcept { return format_.format; }

    /// Makes the swapchain for a window of `pixels`. False if the surface has no size now: try again later.
    /// Waits for the queue; destroys the views of the old images.
    bool resize(VkExtent2D pixels, bool isVsync);
    /// Releases the window for another presenter; no swapchain until resize(). Waits for the queue.
    void retire() noexcept;
    bool isOutdated() const noexcept { return isOutdated_; } ///< resize() is due
    VkExtent2D extent() const noexcept { return extent_; }
    std::span<const VkImageView> views() const noexcept { return views_; }

    /// The slot of the next begin().
    std::uint32_t nextSlot() const noexcept { return slot_; }
    /// Waits until the commands of the next slot have finished. Throws vk::Error, and app::Failure
    /// (interrupted) if a signal has asked the program to end and the wait is long.
    void waitForSlot();
    /// Whether no commands of that slot are in flight.
    bool isFinished(std::size_t slot) const;
    /// Call after waitForSlot(): acquires an image and begins its commands. Empty if the swapchain became
    /// outdated.
    std::optional<Frame> begin();
    /// Command buffers for a long step: that of the frame, then `count` - 1 others, which are recording.
    std::vector<VkCommandBuffer> divide(const Frame& frame, std::uint32_t count);
    /// Submits those that divide() returned, each by itself, but the last, in which the frame goes on.
    void submitParts(Frame& frame, std::span<const VkCommandBuffer> parts);
    /// Submits and presents. The picture must be in PRESENT_SRC_KHR layout.
    void end(const Frame& frame);
    /// Waits for all frames. Throws like waitForSlot().
    void waitIdle();
    /// Waits for all frames without limit and exceptions, for destructors.
    void drain() noexcept;

private:
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence finished = VK_NULL_HANDLE;
        VkSemaphore acquired = VK_NULL_HANDLE;
        bool isSubmitted = false;            // since the last wait
        std::vector<VkCommandBuffer> others; // of divide()
        std::size_t usedOthers = 0;          // since begin()
    };
    void beginCommands(VkCommandBuffer commands);
    VkCommandBuffer allocateCommands();
    void waitFor(Slot& slot);
    void chooseFormat();
    void createSlots();
    VkSemaphore createSemaphore(const std::string& name);
    VkSwapchainCreateInfoKHR swapchainInfo(const VkSurfaceCapabilitiesKHR& capabilities, bool isVsync) const;
    VkPresentModeKHR presentMode(bool isVsync) const;
    void createViews();
    void destroyViews() noexcept;
    void release() noexcept;

    const vk::Device& device_;
    WindowFunctions functions_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::array<Slot, framesInFlight> slots_{};
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<VkImageView> views_;
    std::vector<VkSemaphore> drawn_; ///< one per image: free again when that image is acquired again
    std::uint32_t slot_ = 0;
    bool isOutdated_ = true;
};

} // namespace sinew::viewer
