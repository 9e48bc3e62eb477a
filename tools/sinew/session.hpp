// A device of our own with its loader and queue, in the order in which they must be destroyed.
#pragma once

#include "sinew/options.hpp"
#include "vk/device.hpp"
#include "vk/kernel_store.hpp"
#include "vk/loader.hpp"
#include "vk/queue.hpp"

namespace sinew::tools {

struct Session {
    vk::Loader loader;
    vk::Device device;
    vk::Queue queue;
    vk::KeptKernels kept; // of what is tried for speed and what is measured then

    /// Throws vk::Error. Call before threads start: validation sets an environment variable.
    explicit Session(const DeviceOptions& options);
    /// A session on the Vulkan that `getInstanceProcAddr` leads to; `request` says the rest.
    Session(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const vk::DeviceRequest& request);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
};

} // namespace sinew::tools
