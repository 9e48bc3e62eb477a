// The Vulkan devices that can draw in a window, and the opening of one of them.
#pragma once

#include "viewer/options.hpp"
#include "viewer/window/window.hpp"
#include "vk/loader.hpp"

#include <atomic>
#include <future>
#include <memory>

namespace sinew::viewer {

/// How a device that was found is asked for again: what it is called or, where two are called alike, its
/// index.
std::string requestFor(std::span<const vk::DeviceDescription> devices, std::size_t index);

/// `window` and `messages` must outlive it and every device.
class Devices {
public:
    /// Main thread. `options` and `messages` as deviceRequest().
    Devices(const Window& window, const Options& options, std::atomic<std::size_t>& messages);

    Devices(const Devices&) = delete;
    Devices& operator=(const Devices&) = delete;

    /// As vk::DeviceRequest::device. Any thread. Throws vk::Error.
    std::unique_ptr<vk::Device> open(const std::string& wanted) const;

    /// Every device with what it lacks for this window; empty until all were found, for which another thread
    /// looks from the first call on. The thread that made this.
    const std::vector<vk::DeviceDescription>& list() const;

    /// The same, after waiting for that thread.
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
