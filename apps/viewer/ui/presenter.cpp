// Swapchain and frames in flight.
#include "viewer/ui/presenter.hpp"

#include "app/guard.hpp"
#include "sinew/vk/check.hpp"
#include "viewer/render/image.hpp"
#include "viewer/render/renderer.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sinew::viewer {

namespace {

WindowFunctions loadFunctions(const vk::Device& device) {
    WindowFunctions functions;
    const auto load = [](PFN_vkVoidFunction function, const char* name) {
        if (function == nullptr)
            throw vk::Error(vk::Failure::noDevice,
                            std::string("the Vulkan driver lacks ") + name + ": update the driver");
        return function;
    };
    const auto deviceFunction = device.instanceFunctions().vkGetDeviceProcAddr;
#define SINEW_VK(name)                                                                                       \
    functions.name =                                                                                         \
        reinterpret_cast<PFN_##name>(load(device.getInstanceProcAddr()(device.instance(), #name), #name));
#define SINEW_VK_DEVICE(name)                                                                                \
    functions.name = reinterpret_cast<PFN_##name>(load(deviceFunction(device.handle(), #name), #name));
#include "viewer/ui/window_functions.inc"
    return functions;
}

// Calls a Vulkan list function twice: for the count, then for the elements.
template <typename Element, typename Call> std::vector<Element> list(const Call& call, const char* name) {
    std::uint32_t count = 0;
    vk::check(call(&count, nullptr), name, "the window");
    std::vector<Element> elements(count);
    vk::check(call(&count, elements.data()), name, "the window");
    elements.resize(count);
    return elements;
}

} // namespace

Presenter::Presenter(const vk::Device& device, const Window& window)
    : device_(device), functions_(loadFunctions(device)) {
    device.functions().vkGetDeviceQueue(device.handle(), device.queueFamily(), 0, &queue_);
    try {
        surface_ = window.createSurface(device.instance());
        chooseFormat();
        createSlots();
    } catch (...) {
        release();
        throw;
    }
}

Presenter::~Presenter() {
    drain();
    release();
}

void Presenter::release() noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    destroyViews();
    for (const Slot& slot : slots_) {
        functions.vkDestroyFence(device_.handle(), slot.finished, nullptr);
        functions.vkDestroySemaphore(device_.handle(), slot.acquired, nullptr);
    }
    functions.vkDestroyCommandPool(device_.handle(), pool_, nullptr);
    functions_.vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    functions_.vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

void Presenter::chooseFormat() {
    const auto formats = list<VkSurfaceFormatKHR>(
        [&](std::uint32_t* count, VkSurfaceFormatKHR* out) {
            return functions_.vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), surface_, count, out);
        },
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::array wanted{VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_UNORM,
                      VK_FORMAT_R8G8B8A8_UNORM};
    // A software device blends and copies sRGB by slow arithmetic; shaders encode only once.
    if (isSoftware(device_)) std::rotate(wanted.begin(), wanted.begin() + 2, wanted.end());
    for (const VkFormat one : wanted)
        for (const VkSurfaceFormatKHR& format : formats)
            if (format_.format == VK_FORMAT_UNDEFINED && format.format == one &&
                format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
                format_ = format;
    if (format_.format == VK_FORMAT_UNDEFINED)
        throw vk::Error(vk::Failure::noDevice, "the window has no 8-bit sRGB format: use --headless");
}

VkSemaphore Presenter::createSemaphore(const std::string& name) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    vk::check(device_.functions().vkCreateSemaphore(device_.handle(), &info, nullptr, &semaphore),
              "vkCreateSemaphore", name);
    device_.name(VK_OBJECT_TYPE_SEMAPHORE, vk::handleValue(semaphore), name);
    return semaphore;
}

void Presenter::createSlots() {
    const vk::DeviceFunctions& functions = device_.functions();
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                           .queueFamilyIndex = device_.queueFamily()};
    vk::check(functions.vkCreateCommandPool(device_.handle(), &poolInfo, nullptr, &pool_),
              "vkCreateCommandPool", "the window");
    const VkFenceCreateInfo fenceInfo{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                      .flags = VK_FENCE_CREATE_SIGNALED_BIT};
    for (Slot& slot : slots_) {
        slot.commands = allocateCommands();
        vk::check(functions.vkCreateFence(device_.handle(), &fenceInfo, nullptr, &slot.finished),
                  "vkCreateFence", "the window");
        slot.acquired = createSemaphore("window.acquired");
    }
}

VkCommandBuffer Presenter::allocateCommands() {
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool_,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vk::check(device_.functions().vkAllocateCommandBuffers(device_.handle(), &info, &commands),
              "vkAllocateCommandBuffers", "the window");
    device_.name(VK_OBJECT_TYPE_COMMAND_BUFFER, vk::handleValue(commands), "window.commands");
    return commands;
}

VkPresentModeKHR Presenter::presentMode(bool isVsync) const {
    if (isVsync) return VK_PRESENT_MODE_FIFO_KHR; // every surface has it
    const auto modes = list<VkPresentModeKHR>(
        [&](std::uint32_t* count, VkPresentModeKHR* out) {
            return functions_.vkGetPhysicalDeviceSurfacePresentModesKHR(device_.physical(), surface_, count,
                                                                        out);
        },
        "vkGetPhysicalDeviceSurfacePresentModesKHR");
    for (const VkPresentModeKHR wanted : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
        if (std::ranges::find(modes, wanted) != modes.end()) return wanted;
    return VK_PRESENT_MODE_FIFO_KHR;
}

VkSwapchainCreateInfoKHR Presenter::swapchainInfo(const VkSurfaceCapabilitiesKHR& capabilities,
                                                  bool isVsync) const {
    const std::uint32_t most = capabilities.maxImageCount > 0 ? capabilities.maxImageCount : 8;
    VkCompositeAlphaFlagBitsKHR alpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    if ((capabilities.supportedCompositeAlpha & alpha) == 0) alpha = VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    return {.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
            .surface = surface_,
            .minImageCount = std::min(capabilities.minImageCount + 1, most),
            .imageFormat = format_.format,
            .imageColorSpace = format_.colorSpace,
            .imageExtent = extent_,
            .imageArrayLayers = 1,
            .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
            .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
            .preTransform = capabilities.currentTransform,
            .compositeAlpha = alpha,
            .presentMode = presentMode(isVsync),
            .clipped = VK_TRUE,
            .oldSwapchain = swapchain_};
}

bool Presenter::resize(VkExtent2D pixels, bool isVsync) {
    waitIdle();
    VkSurfaceCapabilitiesKHR capabilities;
    vk::check(
        functions_.vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &capabilities),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", "the window");
    const bool isFree = capabilities.currentExtent.width == std::numeric_limits<std::uint32_t>::max();
    extent_ = isFree ? pixels : capabilities.currentExtent;
    extent_.width =
        std::clamp(extent_.width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width);
    extent_.height =
        std::clamp(extent_.height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height);
    isOutdated_ = true;
    if (extent_.width == 0 || extent_.height == 0) return false;
    const VkSwapchainCreateInfoKHR info = swapchainInfo(capabilities, isVsync);
    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    const VkResult result = functions_.vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain);
    destroyViews();
    functions_.vkDestroySwapchainKHR(device_.handle(), std::exchange(swapchain_, swapchain), nullptr);
    vk::check(result, "vkCreateSwapchainKHR", "the window");
    device_.name(VK_OBJECT_TYPE_SWAPCHAIN_KHR, vk::handleValue(swapchain_), "window.swapchain");
    createViews();
    isOutdated_ = false;
    return true;
}

void Presenter::retire() noexcept {
    drain();
    destroyViews();
    functions_.vkDestroySwapchainKHR(device_.handle(), std::exchange(swapchain_, VK_NULL_HANDLE), nullptr);
    isOutdated_ = true;
}

void Presenter::createViews() {
    const auto images = list<VkImage>(
        [&](std::uint32_t* count, VkImage* out) {
            return functions_.vkGetSwapchainImagesKHR(device_.handle(), swapchain_, count, out);
        },
        "vkGetSwapchainImagesKHR");
    for (const VkImage image : images) {
        views_.push_back(makeView(device_, image, format_.format, "window.picture"));
        drawn_.push_back(createSemaphore("window.drawn"));
    }
}

void Presenter::destroyViews() noexcept {
    for (const VkImageView view : views_)
        device_.functions().vkDestroyImageView(device_.handle(), view, nullptr);
    for (const VkSemaphore semaphore : drawn_)
        device_.functions().vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    views_.clear();
    drawn_.clear();
}

void Presenter::waitFor(Slot& slot) {
    if (!slot.isSubmitted) return;
    app::waitUntil([&](std::chrono::nanoseconds most) {
        const VkResult result = device_.functions().vkWaitForFences(
            device_.handle(), 1, &slot.finished, VK_TRUE, static_cast<std::uint64_t>(most.count()));
        vk::check(result, "vkWaitForFences", "the window");
        return result != VK_TIMEOUT;
    });
    slot.isSubmitted = false;
}

void Presenter::waitForSlot() {
    waitFor(slots_[slot_]);
}

bool Presenter::isFinished(std::size_t slot) const {
    return !slots_[slot].isSubmitted ||
           device_.functions().vkGetFenceStatus(device_.handle(), slots_[slot].finished) != VK_NOT_READY;
}

void Presenter::waitIdle() {
    for (Slot& slot : slots_) waitFor(slot);
    vk::check(device_.functions().vkQueueWaitIdle(queue_), "vkQueueWaitIdle", "the window");
}

void Presenter::drain() noexcept {
    device_.functions().vkQueueWaitIdle(queue_); // returns at once on a lost device
}

std::optional<Presenter::Frame> Presenter::begin() {
    Slot& slot = slots_[slot_];
    slot.usedOthers = 0;
    std::uint32_t image = 0;
    VkResult result = VK_SUCCESS;
    app::waitUntil([&](std::chrono::nanoseconds most) {
        result = functions_.vkAcquireNextImageKHR(device_.handle(), swapchain_,
                                                  static_cast<std::uint64_t>(most.count()), slot.acquired,
                                                  VK_NULL_HANDLE, &image);
        return result != VK_TIMEOUT && result != VK_NOT_READY;
    });
    isOutdated_ = result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR;
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::nullopt;
    vk::check(result, "vkAcquireNextImageKHR", "the window"); // a suboptimal image is used
    beginCommands(slot.commands);
    return Frame{slot.commands, slot_, image};
}

void Presenter::beginCommands(VkCommandBuffer commands) {
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk::check(device_.functions().vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer",
              "the window");
}

std::vector<VkCommandBuffer> Presenter::divide(const Frame& frame, std::uint32_t count) {
    Slot& slot = slots_[frame.slot];
    std::vector<VkCommandBuffer> parts{frame.commands};
    while (parts.size() < count) {
        if (slot.usedOthers == slot.others.size()) slot.others.push_back(allocateCommands());
        parts.push_back(slot.others[slot.usedOthers++]);
        beginCommands(parts.back());
    }
    return parts;
}

// The fence of the frame waits for all that was submitted before it.
void Presenter::submitParts(Frame& frame, std::span<const VkCommandBuffer> parts) {
    const vk::DeviceFunctions& functions = device_.functions();
    for (const VkCommandBuffer& commands : parts.first(parts.size() - 1)) {
        vk::check(functions.vkEndCommandBuffer(commands), "vkEndCommandBuffer", "the window");
        const VkSubmitInfo submission{
            .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
        vk::check(functions.vkQueueSubmit(queue_, 1, &submission, VK_NULL_HANDLE), "vkQueueSubmit",
                  "the window");
    }
    frame.commands = parts.back();
}

void Presenter::end(const Frame& frame) {
    const vk::DeviceFunctions& functions = device_.functions();
    Slot& slot = slots_[frame.slot];
    vk::check(functions.vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer", "the window");
    vk::check(functions.vkResetFences(device_.handle(), 1, &slot.finished), "vkResetFences", "the window");
    const VkPipelineStageFlags drawing = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    const VkSubmitInfo submission{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                  .waitSemaphoreCount = 1,
                                  .pWaitSemaphores = &slot.acquired,
                                  .pWaitDstStageMask = &drawing,
                                  .commandBufferCount = 1,
                                  .pCommandBuffers = &frame.commands,
                                  .signalSemaphoreCount = 1,
                                  .pSignalSemaphores = &drawn_[frame.image]};
    vk::check(functions.vkQueueSubmit(queue_, 1, &submission, slot.finished), "vkQueueSubmit", "the window");
    slot.isSubmitted = true;
    const VkPresentInfoKHR presentation{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                        .waitSemaphoreCount = 1,
                                        .pWaitSemaphores = &drawn_[frame.image],
                                        .swapchainCount = 1,
                                        .pSwapchains = &swapchain_,
                                        .pImageIndices = &frame.image};
    const VkResult result = functions_.vkQueuePresentKHR(queue_, &presentation);
    isOutdated_ = isOutdated_ || result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR;
    if (result != VK_ERROR_OUT_OF_DATE_KHR) vk::check(result, "vkQueuePresentKHR", "the window");
    slot_ = (slot_ + 1) % framesInFlight;
}

} // namespace sinew::viewer
