// Opens window, device and show in the order in which they must go.
#include "viewer/interactive.hpp"

#include "app/guard.hpp"
#include "viewer/show.hpp"
#include "vk/loader.hpp"

#include <cstdio>

namespace sinew::viewer {

namespace {

vk::Device createDevice(const vk::Loader& loader, const Window& window, const Options& options,
                        std::size_t& messages) {
    vk::DeviceRequest request = deviceRequest(options, messages);
    request.instanceExtensions = window.surfaceExtensions();
    request.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    request.canUseFamily = Window::canPresent;
    return vk::Device::create(loader.getInstanceProcAddr(), request);
}

} // namespace

int runInteractive(const Options& options, std::size_t& messages) {
    const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
    const Opening opening = open(options, aspect);
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    Window window(options.size);
    const vk::Loader loader;
    const vk::Device device = createDevice(loader, window, options, messages);
    std::printf("%s\n", headline(opening, device).c_str());
    if (isSoftware(device))
        std::printf("software device: small shadow maps and no multisampling while things move, all of it "
                    "when paused\n");
    std::printf("H shows help, Ctrl + Q quits\n");
    std::fflush(stdout);
    Screen screen(window, device);
    Show show(screen, device, opening);
    show.run();
    return app::isInterrupted() ? app::interrupted : app::done;
}

} // namespace sinew::viewer
