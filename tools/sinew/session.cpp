// Opens the device that the options name.
#include "sinew/session.hpp"

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

} // namespace sinew::tools
