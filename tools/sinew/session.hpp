// A device of its own with loader and queue, declared in the order of construction.
#pragma once

#include "sinew/options.hpp"
#include "sinew/vk/device.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

namespace sinew::tools {

struct Session {
    vk::Loader loader;
    vk::Device device;
    vk::Queue queue;
    vk::KeptKernels kept; // for kernels of timing runs that are used again

    /// Throws vk::Error. Call before threads start: validation sets an environment variable.
    explicit Session(const DeviceOptions& options);
    /// A session on the Vulkan of `getInstanceProcAddr`, with the device of `request`.
    Session(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const vk::DeviceRequest& request);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
};

} // namespace sinew::tools
