// Pipelines of the programs, kept between runs in the user's cache folder for each device, version of its
// driver and set of kernels.
#pragma once

#include "app/user_cache.hpp"
#include "sinew/vk/device.hpp"

namespace sinew::app {

/// Key of results that hold for this device, its driver and the kernels of this build.
std::string deviceKey(const vk::DeviceDescription& device);

/// Creates a device that begins with the pipelines kept for it, and makes others on several threads. Throws
/// vk::Error.
vk::Device createDevice(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const vk::DeviceRequest& request,
                        const UserCache& cache = {});

/// Keeps the pipelines that were made or loaded so far. Any thread.
void keepPipelines(const vk::Device& device, const UserCache& cache = {}) noexcept;

} // namespace sinew::app
