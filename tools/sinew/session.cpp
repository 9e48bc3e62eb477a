// Opens the device that the options name.
#include "sinew/session.hpp"

#include "app/driver_threads.hpp"
#include "app/kept_pipelines.hpp"

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace sinew::tools {

namespace {

vk::Device create(const vk::Loader& loader, const DeviceOptions& options) {
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    return app::createDevice(loader.getInstanceProcAddr(),
                             {.device = options.device, .hasValidation = options.hasValidation});
}

} // namespace

Session::Session(const DeviceOptions& options)
    : device(create(loader, options)), queue(device), kept(device) {}

Session::Session(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const vk::DeviceRequest& request)
    : device(app::createDevice(getInstanceProcAddr, request)), queue(device), kept(device) {}

Session::~Session() {
    app::keepPipelines(device);
}

std::uint32_t driverThreads() {
    const char* asked = std::getenv(app::driverThreadsVariable);
    const unsigned long threads =
        asked ? std::strtoul(asked, nullptr, 10) : std::thread::hardware_concurrency();
    return static_cast<std::uint32_t>(std::clamp(threads, 1ul, 256ul));
}

std::unique_ptr<Session> oneThreadSession(const DeviceOptions& options) {
    const app::WithoutDriverThreads scope;
    return std::make_unique<Session>(options);
}

} // namespace sinew::tools
