// A device of its own with loader and queue, declared in the order of construction.
#pragma once

#include "sinew/options.hpp"
#include "sinew/vk/device.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <memory>

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
    ~Session(); ///< keeps the pipelines for the next run (app::keepPipelines)
};

/// The threads with which lavapipe computes in this process: LP_NUM_THREADS, or as many as processors; 1 if
/// it computes on the thread that it submits from.
std::uint32_t driverThreads();

/// A second session whose lavapipe computes on one thread (app::WithoutDriverThreads says when to call it).
std::unique_ptr<Session> oneThreadSession(const DeviceOptions& options);

} // namespace sinew::tools
