// Opens every device with an instance of its own, so that threads share none.
#include "viewer/jobs/devices.hpp"

#include "app/kept_pipelines.hpp"
#include "sinew/vk/check.hpp"
#include "viewer/jobs/opened_scene.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace sinew::viewer {

std::string requestFor(std::span<const vk::DeviceDescription> devices, std::size_t index) {
    const std::string& name = devices[index].name;
    const auto isCalledSo = [&](const vk::DeviceDescription& other) {
        return other.name.find(name) != std::string::npos; // see vk::DeviceRequest::device
    };
    return std::ranges::count_if(devices, isCalledSo) == 1 ? name : std::to_string(devices[index].index);
}

Devices::Devices(const Window& window, const Options& options, std::atomic<std::size_t>& messages)
    : request_(deviceRequest(options, messages)) {
    request_.instanceExtensions = window.surfaceExtensions();
    request_.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    request_.canUseFamily = Window::canPresent;
}

std::unique_ptr<vk::Device> Devices::open(const std::string& wanted) const {
    vk::DeviceRequest request = request_;
    request.device = wanted;
    return std::make_unique<vk::Device>(app::createDevice(loader_.getInstanceProcAddr(), request));
}

// Starts at the first request, when a device is already open: two threads that queried a display at once made
// about one start in a hundred hang, inside Mesa 22.3.
void Devices::search() const {
    vk::DeviceRequest search = request_;
    search.hasValidation = false; // not needed for a list
    search_ = std::async(std::launch::async, [this, search] {
        try {
            return vk::listDevices(loader_.getInstanceProcAddr(), search);
        } catch (const vk::Error&) { // opening a device reports the error
            return std::vector<vk::DeviceDescription>{};
        }
    });
}

const std::vector<vk::DeviceDescription>& Devices::list() const {
    if (!std::exchange(isSearched_, true)) search();
    if (search_.valid() && search_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        found_ = search_.get();
    return found_;
}

const std::vector<vk::DeviceDescription>& Devices::all() const {
    list();
    if (search_.valid()) search_.wait();
    return list();
}

} // namespace sinew::viewer
