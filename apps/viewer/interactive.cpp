// Opens window, device and show in the order in which they must go.
#include "viewer/interactive.hpp"

#include "app/guard.hpp"
#include "viewer/show.hpp"
#include "vk/check.hpp"
#include "vk/loader.hpp"

#include <cstdio>
#include <stdexcept>

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

// As on the command line, and in the window: what is known of a scene before it plays.
void announce(const Opening& opening, const vk::Device& device, Screen& screen) {
    std::printf("%s\n", headline(opening, device).c_str());
    std::fflush(stdout);
    if (!opening.loaded.warnings.empty()) screen.tell(opening.loaded.warnings.front());
}

// A scene that cannot be shown leaves the one before it on show.
std::unique_ptr<Show> change(std::unique_ptr<Show> show, std::unique_ptr<Opening> next, Screen& screen,
                             Library& library, const vk::Device& device) {
    const std::string name = next->loaded.scene.name;
    const auto refuse = [&](const std::exception& error) {
        library.putBack();
        screen.warn("cannot show " + name + ": " + error.what());
    };
    try {
        announce(*next, device, screen);
        return std::make_unique<Show>(screen, library, device, std::move(next));
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        refuse(error);
    } catch (const std::exception& error) {
        refuse(error);
    }
    return show;
}

} // namespace

int runInteractive(const Options& options, std::size_t& messages) {
    const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
    auto opening = std::make_unique<Opening>(open(options, aspect));
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    Window window(options.size);
    const vk::Loader loader;
    const vk::Device device = createDevice(loader, window, options, messages);
    Screen screen(window, device);
    screen.layers() = options.layers;
    announce(*opening, device, screen);
    if (isSoftware(device))
        std::printf("software device: small shadow maps and no multisampling while things move, all of it "
                    "when paused\n");
    std::printf("H shows help, Ctrl + Q quits\n");
    std::fflush(stdout);
    Library library(options);
    auto show = std::make_unique<Show>(screen, library, device, std::move(opening));
    while (auto next = show->run()) show = change(std::move(show), std::move(next), screen, library, device);
    return app::isInterrupted() ? app::interrupted : app::done;
}

} // namespace sinew::viewer
