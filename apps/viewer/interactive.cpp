// Opens window, device and show in the order in which they must go.
#include "viewer/interactive.hpp"

#include "app/guard.hpp"
#include "viewer/devices.hpp"
#include "viewer/prepared_show.hpp"
#include "viewer/replay.hpp"
#include "viewer/show.hpp"
#include "vk/check.hpp"
#include "vk/loader.hpp"

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>

namespace sinew::viewer {

namespace {

// What is known of a scene before it plays: on the command line,
void say(const Opening& opening, const vk::Device& device) {
    std::printf("%s\n", headline(opening, device).c_str());
    std::fflush(stdout);
}

// and in the window.
void tell(const Opening& opening, Screen& screen) {
    std::vector<std::string> texts = opening.loaded.warnings;
    texts.insert(texts.end(), opening.loaded.notes.begin(), opening.loaded.notes.end());
    screen.announce(texts);
}

// What plays, and the device that it plays on.
struct Playing {
    std::unique_ptr<vk::Device>& device;
    std::unique_ptr<Show>& show;
};

// On show next. Its device is another one, so that whatever is wrong with it, which is thrown, leaves what is
// on show as it is.
void put(std::unique_ptr<Opening> opening, const Playing& playing, Screen& screen, Library& library,
         const Devices& devices) {
    std::unique_ptr<vk::Device> device = std::move(opening->device);
    std::unique_ptr<Opening> next = std::move(opening);
    const bool goesOn = next->again.has_value();
    say(*next, *device);
    tell(*next, screen);
    std::unique_ptr<Place> place = std::move(next->place);
    auto show = std::make_unique<Show>(screen, library, devices, *device, std::move(next));
    if (goesOn) show->takeOver(*playing.show);
    place = screen.moveTo(std::move(place)); // on the device that goes now
    place.reset();
    playing.show = std::move(show);
    playing.device = std::move(device);
}

// What cannot be shown leaves all as it is.
void change(std::unique_ptr<Opening> opening, const Playing& playing, Screen& screen, Library& library,
            const Devices& devices) {
    const std::string name = opening->loaded.scene.name;
    try {
        put(std::move(opening), playing, screen, library, devices);
    } catch (const std::exception& error) {
        library.putBack();
        screen.warn("cannot show " + name + ": " + error.what());
    }
}

float aspectOf(VkExtent2D size) {
    return static_cast<float>(size.width) / static_cast<float>(size.height);
}

// What the command line says goes before what is remembered.
Preferences asAsked(Preferences preferences, const Options& options) {
    preferences.isVsync = options.isVsync.value_or(preferences.isVsync);
    if (options.arePanelsShown) preferences.arePanelsShown = options.arePanelsShown;
    preferences.scale = options.scale.value_or(preferences.scale);
    return preferences;
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

// A size that was asked for is of this run alone; so is all else that was, unless somebody has changed it
// since.
Preferences leftBy(const Screen& screen, const Library& library, const Options& options,
                   const Preferences& before) {
    Preferences left = screen.preferences();
    left.scene = rememberedScene(library.shown().scene, library.shown().builtIn);
    if (options.hasSize || left.width == 0) {
        left.width = before.width;
        left.height = before.height;
    }
    if (left.isVsync == options.isVsync) left.isVsync = before.isVsync;
    if (options.arePanelsShown && left.arePanelsShown == options.arePanelsShown)
        left.arePanelsShown = before.arePanelsShown;
    if (left.scale == options.scale) left.scale = before.scale;
    return left;
}

// What is kept when something else than its user ends the program, or what hands did in it, once, and what is
// said of it.
class Keeping {
public:
    Keeping(Window& window, std::function<std::string()> keep) : window_(window), keep_(std::move(keep)) {
        window_.setFarewell([this] { return (*this)(); });
    }
    ~Keeping() {
        window_.setFarewell([said = said_.value_or("")] { return said; });
    }
    Keeping(const Keeping&) = delete;
    Keeping& operator=(const Keeping&) = delete;

    const std::string& operator()() {
        if (!said_) said_ = keep_();
        return *said_;
    }
    /// The program goes on: it may end another time.
    void renew() { said_.reset(); }

private:
    Window& window_;
    std::function<std::string()> keep_;
    std::optional<std::string> said_;
};

// The exception at hand, with `kept` at the end of its line.
[[noreturn]] void throwAgain(const std::string& kept) {
    try {
        throw;
    } catch (const app::Failure& error) {
        throw app::Failure(error.code(), error.what() + kept);
    } catch (const vk::Error& error) {
        throw vk::Error(error.failure(), error.what() + kept);
    }
}

// Without a window, and made when the first preview is wanted, in their thread.
class PreviewDevice {
public:
    PreviewDevice(const Options& options, std::atomic<std::size_t>& messages)
        : request_(deviceRequest(options, messages)) {}

    std::optional<Picture> operator()(const Options& scene, const std::stop_token& stop) {
        if (!device_) {
            loader_ = std::make_shared<vk::Loader>();
            device_ =
                std::make_shared<vk::Device>(vk::Device::create(loader_->getInstanceProcAddr(), request_));
        }
        try {
            return drawPreview(*device_, scene, stop);
        } catch (const vk::Error& error) {
            if (error.failure() == vk::Failure::deviceLost) device_.reset(); // the next has another one
            throw;
        }
    }

private:
    vk::DeviceRequest request_;
    std::shared_ptr<vk::Loader> loader_; // shared as std::function wants to be copied
    std::shared_ptr<vk::Device> device_;
};

// A device that is lost again as soon as that is no better than none.
constexpr std::chrono::seconds betweenLosses{10};

// After the device was lost: what was on show from its beginning, on the same device opened anew or on
// another one. Throws what is wrong with the last of them.
void beginAnew(const Options& shown, const Playing& playing, Screen& screen, Library& library,
               const Devices& devices) {
    const auto begin = [&](const std::string& request) {
        auto next = std::make_unique<Opening>(open(shown, aspectOf(screen.window().pixels())));
        next->device = devices.open(request);
        next->camera = playing.show->camera();
        prepare(*next, *next->device, screen.window());
        put(std::move(next), playing, screen, library, devices);
        library.moveTo(request);
    };
    std::vector<std::string> requests{shown.device};
    for (std::size_t d = 0; d < devices.all().size(); ++d) requests.push_back(requestFor(devices.all(), d));
    for (std::size_t r = 0; r < requests.size(); ++r) try {
            return begin(requests[r]);
        } catch (const vk::Error&) {
            if (r + 1 == requests.size()) throw;
        }
}

// Plays until the window is closed, on another device where one is lost.
class MainLoop {
public:
    MainLoop(const Playing& playing, Screen& screen, Library& library, const Devices& devices,
             Keeping& keeping)
        : playing_(playing), screen_(screen), library_(library), devices_(devices), keeping_(keeping) {}

    void run() {
        for (bool isOver = false; !isOver;) try {
                auto next = playing_.show->run();
                isOver = !next;
                if (next) change(std::move(next), playing_, screen_, library_, devices_);
            } catch (const vk::Error& error) {
                playing_.show->finishFilm();
                const std::string kept = keeping_();
                if (!goesOnAfter(error, kept)) throwAgain(kept);
            } catch (const app::Failure& failure) {
                const app::Writing writing;
                playing_.show->finishFilm();
                const std::string kept = keeping_();
                if (failure.code() == app::interrupted) app::leaveInterrupted(failure.what() + kept);
                throwAgain(kept);
            } catch (...) {
                playing_.show->finishFilm();
                throwAgain(keeping_());
            }
    }

private:
    bool goesOnAfter(const vk::Error& error, const std::string& kept) {
        const bool isAgain = lost_ && std::chrono::steady_clock::now() - *lost_ < betweenLosses;
        const bool isEnding = screen_.window().isClosing() || app::isInterrupted();
        if (error.failure() != vk::Failure::deviceLost || isAgain || isEnding) return false;
        try {
            beginAnew(Options(library_.shown()), playing_, screen_, library_, devices_);
        } catch (const std::exception&) { // the first error is the one to be told
            return false;
        }
        lost_ = std::chrono::steady_clock::now();
        keeping_.renew();
        screen_.warn(error.what() +
                     (": the scene begins anew on " + playing_.device->description().name + kept));
        return true;
    }

    Playing playing_;
    Screen& screen_;
    Library& library_;
    const Devices& devices_;
    Keeping& keeping_;
    std::optional<std::chrono::steady_clock::time_point> lost_; // the newest time
};

// Until the window is closed. What is declared later is gone earlier.
void play(std::unique_ptr<Opening> opening, const Options& options, const Preferences& preferences,
          std::atomic<std::size_t>& messages) {
    Window window(options.size);
    const Devices devices(window, options, messages);
    std::unique_ptr<vk::Device> device = devices.open(options.device);
    std::unique_ptr<Opening> first = std::move(opening);
    say(*first, *device);
    window.setTitle("Sinew - preparing " + first->loaded.scene.name); // for seconds, if drivers compile
    prepare(*first, *device, window);
    Screen screen(window, std::move(first->place), {options.isTimed, options.start},
                  asAsked(preferences, options));
    if (options.isFullScreen) window.toggleFullScreen();
    screen.layers() = options.layers;
    screen.beside() = parseBeside(options.beside);
    tell(*first, screen);
    if (isSoftware(*device))
        std::printf("software device: small shadow maps, no multisampling and fewer pixels while things "
                    "move, all of it when paused\n");
    std::printf("H shows help, Ctrl + Q quits\n");
    std::fflush(stdout);
    Library library(
        options,
        [&](Opening& next, const Options& wanted) {
            next.device = devices.open(wanted.device);
            prepare(next, *next.device, window);
        },
        PreviewDevice(options, messages));
    screen.expectPreviews(library.names().size());
    auto show = std::make_unique<Show>(screen, library, devices, *device, std::move(first));
    const auto keepSettings = [&] {
        const Preferences left = leftBy(screen, library, options, preferences);
        if (left != preferences) savePreferences(preferencesFile(), left);
    };
    Keeping keeping(window, [&] {
        keepSettings();
        return show->keepInput(preferencesFile().parent_path());
    });
    MainLoop({device, show}, screen, library, devices, keeping).run();
    if (options.isTimed) screen.timing().printTable();
    keepSettings();
    window.hide(); // threads end in their time
}

} // namespace

int runInteractive(const Options& asked, std::atomic<std::size_t>& messages) {
    const Preferences preferences = loadPreferences(preferencesFile());
    Options options = recalled(asked, preferences);
    std::optional<InputFile> input;
    if (!options.replay.empty()) options = withReplay(options, *(input = loadInput(options.replay)));
    auto opening = openFirst(input ? options : asked, options);
    if (input) {
        prepareForReplay(*opening, *input);
        opening->input = std::move(input);
    }
    if (options.hasValidation) vk::enableQueueSubmitValidation();
    play(std::move(opening), options, preferences, messages);
    return app::isInterrupted() ? app::interrupted : app::done;
}

} // namespace sinew::viewer
