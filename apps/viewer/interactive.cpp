// Opens window, device and player in the reverse order of their destruction.
#include "viewer/interactive.hpp"

#include "app/guard.hpp"
#include "app/kept_pipelines.hpp"
#include "app/thread_advice.hpp"
#include "sinew/vk/check.hpp"
#include "sinew/vk/loader.hpp"
#include "viewer/jobs/devices.hpp"
#include "viewer/jobs/prepared_player.hpp"
#include "viewer/jobs/replay.hpp"
#include "viewer/jobs/shipped_pictures.hpp"
#include "viewer/player/scene_player.hpp"

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>

namespace sinew::viewer {

namespace {

// Prints the headline of a scene on the command line.
void say(const OpenedScene& opening, const vk::Device& device) {
    std::printf("%s\n", headline(opening, device).c_str());
    std::fflush(stdout);
}

// Shows its warnings and notes in the window.
void tell(const OpenedScene& opening, Session& session) {
    std::vector<std::string> texts = opening.loaded.warnings;
    texts.insert(texts.end(), opening.loaded.notes.begin(), opening.loaded.notes.end());
    session.announce(texts);
}

// The player and its device.
struct Playing {
    std::unique_ptr<vk::Device>& device;
    std::unique_ptr<ScenePlayer>& player;
};

// Replaces the scene on show. The new scene has a device of its own, so that an exception leaves the old one
// as it is.
void put(std::unique_ptr<OpenedScene> opening, const Playing& playing, Session& session,
         SceneLoader& sceneLoader, const Devices& devices) {
    std::unique_ptr<vk::Device> device = std::move(opening->device);
    std::unique_ptr<OpenedScene> next = std::move(opening);
    const bool goesOn = next->reload.has_value();
    say(*next, *device);
    tell(*next, session);
    std::unique_ptr<WindowOutput> output = std::move(next->output);
    auto player = std::make_unique<ScenePlayer>(session, sceneLoader, devices, *device, std::move(next));
    if (goesOn) player->takeOver(*playing.player);
    output = session.moveTo(std::move(output)); // on the old device
    output.reset();
    playing.player = std::move(player);
    playing.device = std::move(device);
}

// Replaces the scene on show; on an error everything stays as it is.
void change(std::unique_ptr<OpenedScene> opening, const Playing& playing, Session& session,
            SceneLoader& sceneLoader, const Devices& devices) {
    const std::string name = opening->loaded.scene.name;
    try {
        put(std::move(opening), playing, session, sceneLoader, devices);
    } catch (const std::exception& error) {
        sceneLoader.putBack();
        session.warn("cannot show " + name + ": " + error.what());
    }
}

float aspectOf(VkExtent2D size) {
    return static_cast<float>(size.width) / static_cast<float>(size.height);
}

// Applies the options of the command line over the remembered preferences.
Preferences asAsked(Preferences preferences, const Options& options) {
    preferences.isVsync = options.isVsync.value_or(preferences.isVsync);
    if (options.arePanelsShown) preferences.arePanelsShown = options.arePanelsShown;
    preferences.scale = options.scale.value_or(preferences.scale);
    return preferences;
}

// Options of a window without a scene argument: the last scene, in the last size.
Options recalled(Options options, const Preferences& preferences) {
    if (!options.hasSize && preferences.width > 0 && preferences.height > 0)
        options.size = {preferences.width, preferences.height};
    if (options.scene.empty() && options.replay.empty() && !preferences.scene.empty()) {
        const bool isFile = preferences.scene.front() == '/';
        (isFile ? options.scene : options.builtIn) = preferences.scene;
    }
    return options;
}

// If the last scene cannot be opened, prints a line and opens the built-in one.
std::unique_ptr<OpenedScene> openFirst(const Options& asked, Options& options) {
    try {
        return std::make_unique<OpenedScene>(open(options, aspectOf(options.size)));
    } catch (const std::exception& error) {
        if (options.scene == asked.scene && options.builtIn == asked.builtIn) throw;
        std::fprintf(stderr, "warning: the last scene cannot be opened: %s\n", error.what());
    }
    options.scene = asked.scene;
    options.builtIn = asked.builtIn;
    return std::make_unique<OpenedScene>(open(options, aspectOf(options.size)));
}

// Preferences to remember: options of the command line apply to this run only, unless the user changed them
// in the window.
Preferences leftBy(const Session& session, const SceneLoader& sceneLoader, const Options& options,
                   const Preferences& before) {
    Preferences left = session.preferences();
    left.scene = rememberedScene(sceneLoader.shown().scene, sceneLoader.shown().builtIn);
    left.recent = sceneLoader.recent();
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

// Saves the input once if the program ends unexpectedly, and holds the line about it.
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
    /// Call when the program continues after an error: it may end again.
    void renew() { said_.reset(); }

private:
    Window& window_;
    std::function<std::string()> keep_;
    std::optional<std::string> said_;
};

// Throws the present exception again, with `kept` at the end of its message.
[[noreturn]] void throwAgain(const std::string& kept) {
    try {
        throw;
    } catch (const app::Failure& error) {
        throw app::Failure(error.code(), error.what() + kept);
    } catch (const vk::Error& error) {
        throw vk::Error(error.failure(), error.what() + kept);
    }
}

// The device of the previews, without a window; made at the first preview, in their thread.
class PreviewDevice {
public:
    PreviewDevice(const Options& options, std::atomic<std::size_t>& messages)
        : request_(deviceRequest(options, messages)) {}

    std::optional<Picture> operator()(const Options& scene, const std::stop_token& stop) {
        if (auto shipped = shippedPicture(scene)) return shipped;
        if (!device_) {
            loader_ = std::make_shared<vk::Loader>();
            device_ =
                std::make_shared<vk::Device>(app::createDevice(loader_->getInstanceProcAddr(), request_));
        }
        try {
            return drawPreview(*device_, scene, stop);
        } catch (const vk::Error& error) {
            if (error.failure() == vk::Failure::deviceLost) device_.reset(); // the next preview uses another
            throw;
        }
    }

private:
    vk::DeviceRequest request_;
    std::shared_ptr<vk::Loader> loader_; // shared, since std::function must be copyable
    std::shared_ptr<vk::Device> device_;
};

// A device lost twice within this time is not used again.
constexpr std::chrono::seconds betweenLosses{10};

// Restarts the scene on show after its device was lost: on the same device, opened again, or on another.
// Throws the error of the last one.
void beginAnew(const Options& shown, const Playing& playing, Session& session, SceneLoader& sceneLoader,
               const Devices& devices) {
    const auto begin = [&](const std::string& request) {
        auto next = std::make_unique<OpenedScene>(open(shown, aspectOf(session.window().pixels())));
        next->device = devices.open(request);
        next->camera = playing.player->camera();
        next->isFirstView = false;
        prepare(*next, *next->device, session.window());
        put(std::move(next), playing, session, sceneLoader, devices);
        sceneLoader.moveTo(request);
    };
    std::vector<std::string> requests{shown.device};
    for (std::size_t d = 0; d < devices.all().size(); ++d) requests.push_back(requestFor(devices.all(), d));
    for (std::size_t r = 0; r < requests.size(); ++r) try {
            return begin(requests[r]);
        } catch (const vk::Error&) {
            if (r + 1 == requests.size()) throw;
        }
}

// Runs until the window is closed; changes to another device if one is lost.
class MainLoop {
public:
    MainLoop(const Playing& playing, Session& session, SceneLoader& sceneLoader, const Devices& devices,
             Keeping& keeping)
        : playing_(playing), session_(session), sceneLoader_(sceneLoader), devices_(devices),
          keeping_(keeping) {}

    void run() {
        for (bool isOver = false; !isOver;) try {
                auto next = playing_.player->run();
                isOver = !next;
                if (next) change(std::move(next), playing_, session_, sceneLoader_, devices_);
            } catch (const vk::Error& error) {
                playing_.player->finishFilm();
                const std::string kept = keeping_();
                if (!goesOnAfter(error, kept)) throwAgain(kept);
            } catch (const app::Failure& failure) {
                const app::Writing writing;
                playing_.player->finishFilm();
                const std::string kept = keeping_();
                if (failure.code() == app::interrupted) app::leaveInterrupted(failure.what() + kept);
                throwAgain(kept);
            } catch (...) {
                playing_.player->finishFilm();
                throwAgain(keeping_());
            }
    }

private:
    bool goesOnAfter(const vk::Error& error, const std::string& kept) {
        const bool isAgain = lost_ && std::chrono::steady_clock::now() - *lost_ < betweenLosses;
        const bool isEnding = session_.window().isClosing() || app::isInterrupted();
        if (error.failure() != vk::Failure::deviceLost || isAgain || isEnding) return false;
        try {
            beginAnew(Options(sceneLoader_.shown()), playing_, session_, sceneLoader_, devices_);
        } catch (const std::exception&) { // the first error is reported
            return false;
        }
        lost_ = std::chrono::steady_clock::now();
        keeping_.renew();
        session_.warn(error.what() +
                      (": the scene restarts on " + playing_.device->description().name + kept));
        return true;
    }

    Playing playing_;
    Session& session_;
    SceneLoader& sceneLoader_;
    const Devices& devices_;
    Keeping& keeping_;
    std::optional<std::chrono::steady_clock::time_point> lost_; // the newest time
};

// Prints whether steps of the scene on show would be faster without the driver's threads. Measured when the
// window is gone: the trial compiles all kernels again, which would delay the first picture, and beside a
// scene that plays it would measure that, too.
void adviseOnThreads(Session& session, const ScenePlayer& player, const vk::Device& device) try {
    session.presenter().waitIdle();
    if (const auto advice =
            app::adviseOnThreads(device, player.document().scene(), player.document().settings()))
        std::printf("%s\n", advice->c_str()); // not stderr: nothing is wrong
} catch (const std::exception&) {
    // no trial, so nothing to say: the device may lack the memory for one
}

// Runs until the window is closed. Objects declared later are destroyed earlier.
void play(std::unique_ptr<OpenedScene> opening, const Options& options, const Preferences& preferences,
          std::atomic<std::size_t>& messages) {
    Window window(options.size);
    const Devices devices(window, options, messages);
    std::unique_ptr<vk::Device> device = devices.open(options.device);
    std::unique_ptr<OpenedScene> first = std::move(opening);
    say(*first, *device);
    window.setTitle("Sinew - preparing " + first->loaded.scene.name); // takes seconds if drivers compile
    Session session(window, std::make_unique<WindowOutput>(*device, window), {options.isTimed, options.start},
                    asAsked(preferences, options));
    if (options.isFullScreen) window.toggleFullScreen();
    session.showText(*device, "Preparing view...");
    prepare(*first, *device, session.presenter().format());
    session.layers() = options.layers;
    session.beside() = parseBeside(options.beside);
    tell(*first, session);
    if (isSoftware(*device))
        std::printf("software device: small shadow maps, no multisampling and fewer pixels during "
                    "motion; full quality when paused\n");
    std::printf("H shows help, Ctrl + Q quits\n");
    std::fflush(stdout);
    SceneLoader sceneLoader(
        options,
        [&](OpenedScene& next, const Options& wanted) {
            next.device = devices.open(wanted.device);
            prepare(next, *next.device, window);
        },
        PreviewDevice(options, messages));
    sceneLoader.addRecent(preferences.recent);
    session.expectPreviews(sceneLoader.names().size());
    auto player = std::make_unique<ScenePlayer>(session, sceneLoader, devices, *device, std::move(first));
    const auto keepSettings = [&] {
        const Preferences left = leftBy(session, sceneLoader, options, preferences);
        if (left != preferences) savePreferences(preferencesFile(), left);
    };
    Keeping keeping(window, [&] {
        keepSettings();
        return player->keepInput(preferencesFile().parent_path());
    });
    MainLoop({device, player}, session, sceneLoader, devices, keeping).run();
    if (options.isTimed) session.timing().printTable();
    keepSettings();
    window.hide(); // threads may end slowly
    if (!app::isInterrupted()) adviseOnThreads(session, *player, *device);
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
