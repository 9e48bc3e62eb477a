// Opens window, device and show in the order in which they must go.
#include "viewer/interactive.hpp"

#include "app/guard.hpp"
#include "viewer/replay.hpp"
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

float aspectOf(VkExtent2D size) {
    return static_cast<float>(size.width) / static_cast<float>(size.height);
}

// Started without a scene, the window goes on with the last one, in the size in which it was left.
Options recalled(Options options, const Preferences& preferences) {
    if (!options.hasSize && preferences.width > 0 && preferences.height > 0)
        options.size = {preferences.width, preferences.height};
    if (options.scene.empty() && options.replay.empty() && !preferences.scene.empty()) {
        const bool isFile = preferences.scene.front() == '/';
        (isFile ? options.scene : options.builtIn) = preferences.scene;
    }
    return options;
}

// A last scene that is no more costs a line, and the one built in is shown.
std::unique_ptr<Opening> openFirst(const Options& asked, Options& options) {
    try {
        return std::make_unique<Opening>(open(options, aspectOf(options.size)));
    } catch (const std::exception& error) {
        if (options.scene == asked.scene && options.builtIn == asked.builtIn) throw;
        std::fprintf(stderr, "warning: the last scene is not opened again: %s\n", error.what());
    }
    options.scene = asked.scene;
    options.builtIn = asked.builtIn;
    return std::make_unique<Opening>(open(options, aspectOf(options.size)));
}

// A size that was asked for is of this run alone.
Preferences leftBy(const Screen& screen, const Library& library, const Options& options,
                   const Preferences& before) {
    Preferences left = screen.preferences();
    left.scene = rememberedScene(library.shown().scene, library.shown().builtIn);
    if (options.hasSize || left.width == 0) {
        left.width = before.width;
        left.height = before.height;
    }
    return left;
}

} // namespace

int runInteractive(const Options& asked, std::size_t& messages) {
    const std::filesystem::path file = preferencesFile();
    const Preferences preferences = loadPreferences(file);
    Options options = recalled(asked, preferences);
    std::optional<InputFile> input;
    if (!options.replay.empty()) options = withReplay(options, *(input = loadInput(options.replay)));
    auto opening = openFirst(input ? options : asked, options);
    if (input) {
        prepareForReplay(opening->loaded.settings, *input);
        opening->input = std::move(input);
    }
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    Window window(options.size);
    const vk::Loader loader;
    const vk::Device device = createDevice(loader, window, options, messages);
    Screen screen(window, device, preferences);
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
    const Preferences left = leftBy(screen, library, options, preferences);
    if (left != preferences) savePreferences(file, left);
    return app::isInterrupted() ? app::interrupted : app::done;
}

} // namespace sinew::viewer
