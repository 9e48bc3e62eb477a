// Opens the device that the options name.
#include "sinew/session.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>

namespace sinew::tools {

namespace {

vk::Device create(const vk::Loader& loader, const DeviceOptions& options) {
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    return vk::Device::create(loader.getInstanceProcAddr(),
                              {.device = options.device, .hasValidation = options.hasValidation});
}

} // namespace

Session::Session(const DeviceOptions& options)
    : device(create(loader, options)), queue(device), kept(device) {}

Session::Session(PFN_vkGetInstanceProcAddr getInstanceProcAddr, const vk::DeviceRequest& request)
    : device(vk::Device::create(getInstanceProcAddr, request)), queue(device), kept(device) {}

std::uint32_t driverThreads() {
    const char* asked = std::getenv("LP_NUM_THREADS");
    const unsigned long threads =
        asked ? std::strtoul(asked, nullptr, 10) : std::thread::hardware_concurrency();
    return static_cast<std::uint32_t>(std::clamp(threads, 1ul, 256ul));
}

std::unique_ptr<Session> oneThreadSession(const DeviceOptions& options) {
    constexpr const char* name = "LP_NUM_THREADS";
    const char* before = std::getenv(name);
    const std::optional<std::string> kept = before ? std::optional(std::string(before)) : std::nullopt;
    setenv(name, "0", 1);
    const auto restore = [&] { kept ? setenv(name, kept->c_str(), 1) : unsetenv(name); };
    try {
        auto session = std::make_unique<Session>(options);
        restore();
        return session;
    } catch (...) {
        restore();
        throw;
    }
}

} // namespace sinew::tools
