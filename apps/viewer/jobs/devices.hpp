// The Vulkan devices that can draw in a window, and the opening of one of them.
#pragma once

#include "sinew/vk/loader.hpp"
#include "viewer/jobs/options.hpp"
#include "viewer/ui/window.hpp"

#include <atomic>
#include <future>
#include <memory>

namespace sinew::viewer {

/// The name that asks for a found device again: its name or, if two devices have the same name, its index.
std::string requestFor(std::span<const vk::DeviceDescription> devices, std::size_t index);

/// `window` and `messages` must outlive this object and every device.
class Devices {
public:
    /// Main thread. `options` and `messages`: see deviceRequest().
    Devices(const Window& window, const Options& options, std::atomic<std::size_t>& messages);

    Devices(const Devices&) = delete;
    Devices& operator=(const Devices&) = delete;

    /// `wanted`: see vk::DeviceRequest::device. Any thread. Throws vk::Error.
    std::unique_ptr<vk::Device> open(const std::string& wanted) const;

    /// Every device with what it lacks for this window. The first call starts the search in another thread;
    /// empty until it ends. Call from the thread that made this object.
    const std::vector<vk::DeviceDescription>& list() const;

    /// The same list, after waiting for the search.
    const std::vector<vk::DeviceDescription>& all() const;

private:
    void search() const;

    vk::Loader loader_;
    vk::DeviceRequest request_;
    mutable std::future<std::vector<vk::DeviceDescription>> search_;
    mutable std::vector<vk::DeviceDescription> found_;
    mutable bool isSearched_ = false;
};

} // namespace sinew::viewer
