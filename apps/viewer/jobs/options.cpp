// The options, and checks of their combinations.
#include "viewer/jobs/options.hpp"

#include "app/count_option.hpp"
#include "app/guard.hpp"
#include "scenes/suggestion.hpp"
#include "sinew/ranges.hpp"
#include "sinew/solver_names.hpp"
#include "viewer/input/bindings.hpp"
#include "viewer/jobs/second_simulation.hpp"
#include "viewer/ui/preferences.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sinew::viewer {

namespace {

constexpr const char* description =
    R"(Shows soft bodies: opens a scene (TOML) or a saved state, or drops a mesh (OBJ, STL, PLY, glTF,
GLB), simulates it on a Vulkan device and draws it, in a window or, with --headless, to pictures.)";

constexpr const char* exitCodes =
    R"(Exit codes: 0 done, 2 wrong usage, 3 bad scene or mesh, 4 no usable device or display, 5 device lost
or out of memory, 6 output could not be written, 7 the simulation diverged, 70 a fault of ours, 130 interrupted.)";

[[noreturn]] void refuse(const std::string& why) {
    throw app::Failure(app::wrongUsage, "wrong usage: " + why + ": see `sinew-viewer --help`");
}

// Parses "1280x720".
VkExtent2D parseSize(const std::string& text) {
    VkExtent2D size{};
    const char* end = text.data() + text.size();
    const auto [afterWidth, widthError] = std::from_chars(text.data(), end, size.width);
    const bool hasCross = widthError == std::errc() && afterWidth != end && *afterWidth == 'x';
    const auto [afterHeight, heightError] =
        std::from_chars(hasCross ? afterWidth + 1 : end, end, size.height);
    const auto isSensible = [](std::uint32_t length) { return length >= 16 && length <= 8192; };
    if (!hasCross || heightError != std::errc() || afterHeight != end || !isSensible(size.width) ||
        !isSensible(size.height))
        refuse("--size " + text + " is not WIDTHxHEIGHT between 16x16 and 8192x8192");
    return size;
}

// Parses X, Y, Z, OFFSET; the normal may have any length.
Section parseSection(const std::vector<float>& numbers) {
    const Vector3 normal(numbers[0], numbers[1], numbers[2]);
    if (!(normal.norm() > 0) || !std::isfinite(normal.norm()) || !std::isfinite(numbers[3]))
        refuse("--section needs a nonzero normal and finite numbers");
    return {normal.normalized(), numbers[3]};
}

void addSceneOptions(CLI::App& app, Options& options) {
    app.add_option("SCENE|MESH|STATE", options.scene,
                   "scene file, mesh or saved state; without one the built-in scenes/organ_draped.toml");
    app.add_option("--device", options.device, "index as `sinew devices` prints it, or part of a name");
    app.add_option("--solver", options.overrides.solver, "solver, instead of the scene's")
        ->check(CLI::IsMember(sim::solverNames()));
    app::addCountOrAuto(app, "--substeps", options.overrides.substeps, sim::ranges::substeps, 0,
                        "substeps per step, instead of the scene's; auto: as many as its tolerance needs");
    app::addCountOrAuto(
        app, "--levels", options.overrides.levels, sim::ranges::levels, sim::autoLevels,
        "coarse levels of split, instead of the scene's; auto: as many as win at equal error");
    options.hasValidation = SINEW_VALIDATION_DEFAULT;
    app.add_flag(
        "--validation,!--no-validation", options.hasValidation,
        "check every Vulkan call with the Khronos validation layer (slow); a message makes the exit code 70");
}

// Adds the options that keys can change in the window.
void addWindowOptions(CLI::App& app, Options& options) {
    constexpr const char* group = "In the window; the default is the last choice";
    const auto add = [&](const char* name, std::optional<bool>& value, const char* help) {
        app.add_flag_function(
               name, [&value](std::int64_t count) { value = count > 0; }, help)
            ->group(group);
    };
    add("--vsync,!--no-vsync", options.isVsync, "turn vsync on or off");
    add("--panels,!--no-panels", options.arePanelsShown, "show or hide the panels");
    app.add_option("--scale", options.scale, "scale of text and panels, times the scale of the screen")
        ->check(CLI::Range(Preferences::leastScale, Preferences::mostScale))
        ->group(group);
    app.add_flag("--full-screen", options.isFullScreen, "start in full screen")->group(group);
    app.add_option("--blade-depth", options.bladeDepth,
                   "depth of the blade below the surface [m]; default: that of the scene file, or through")
        ->check(CLI::PositiveNumber)
        ->excludes("--replay") // the log has its own
        ->group(group);
}

// Rejects options that have no effect without a window.
void checkWindow(const CLI::App& app, const Options& options) {
    if (!options.isHeadless) return;
    for (const char* name : {"--vsync", "--panels", "--scale", "--full-screen", "--blade-depth"})
        if (app.count(name) > 0) refuse(std::string(name) + " has no effect with --headless");
}

void addHeadlessOptions(CLI::App& app, Options& options) {
    constexpr const char* group = "Without a window";
    CLI::Option* headless = app.add_flag("--headless", options.isHeadless, "needs no display")->group(group);
    const CLI::Range positive(std::uint64_t{1}, std::uint64_t{1'000'000'000});
    const auto add = [&](const char* name, auto& value, const char* help) {
        return app.add_option(name, value, help)->group(group)->needs(headless);
    };
    add("--frames", options.frames, "steps to take")->check(positive)->capture_default_str();
    add("--out", options.folder, "folder for frame_0000.png (the start) and the following pictures");
    add("--video", options.video, "MP4 of all pictures; needs ffmpeg on the PATH");
    CLI::Option* every = add("--every", options.every, "frames from one picture to the next")
                             ->check(positive)
                             ->capture_default_str();
    add("--picture-frames", options.pictured, "only these frames, such as 0,60,120,240")
        ->delimiter(',')
        ->excludes(every);
}

// Rejects nan, which CLI11 accepts within any range.
void checkNumbers(const Options& options) {
    if (options.bladeDepth && std::isnan(*options.bladeDepth)) refuse("--blade-depth is not a number");
    if (options.scale && std::isnan(*options.scale)) refuse("--scale is not a number");
}

void checkHeadless(Options& options, bool hasFrames) {
    std::ranges::sort(options.pictured);
    if (!options.isHeadless) return;
    if (options.folder.empty() && options.video.empty() && options.replay.empty())
        refuse("--headless without --out DIR, --video FILE or --replay FILE has no output");
    if (options.pictured.empty()) return;
    if (!options.video.empty()) refuse("--video needs equal steps: use --every, not --picture-frames");
    const std::uint64_t last = options.pictured.back();
    if (hasFrames && last > options.frames)
        refuse("--picture-frames " + std::to_string(last) + " is beyond --frames " +
               std::to_string(options.frames));
    if (!hasFrames) options.frames = last;
}

} // namespace

bool Options::wantsPicture(std::uint64_t frame) const {
    return pictured.empty() ? frame % every == 0 : std::ranges::binary_search(pictured, frame);
}

std::optional<Options> parseOptions(int argc, const char* const* argv) {
    Options options;
    std::string size;
    std::vector<std::string> layers;
    std::vector<float> section;
    CLI::App app(description, "sinew-viewer");
    app.set_version_flag("--version", "sinew-viewer " SINEW_VERSION);
    app.footer("In the window:\n" + helpText() + "\n" + exitCodes);
    addSceneOptions(app, options);
    app.add_option("--size", size,
                   "size of the window or the pictures in pixels, WIDTHxHEIGHT (default 1280x720, or the "
                   "last size of the window)");
    app.add_option("--show", layers, "layers to draw over skins or instead of them")
        ->delimiter(',')
        ->check(CLI::IsMember(layerNames()));
    app.add_option(
           "--section", section,
           "a plane through the scene that hides everything in front of it: X,Y,Z of its normal and its "
           "distance from the origin along the normal [m]")
        ->delimiter(',')
        ->expected(4);
    app.add_option("--beside", options.beside,
                   "compare with a second solver side by side: SOLVER or SOLVER:SUBSTEPS");
    app.add_option("--replay", options.replay,
                   "replay an input log that the window has saved: opens its scene and repeats the input");
    app.add_flag(
        "--timing", options.isTimed,
        "print the time of the first picture, every delay of input above 0.1 s, and at the end the frame "
        "times");
    addWindowOptions(app, options);
    addHeadlessOptions(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) refuse(error.what() + scenes::suggestion(app));
        app.exit(error); // --help, --version
        return std::nullopt;
    }
    for (const std::string& layer : layers) addLayer(layer, options.layers);
    if (!section.empty()) options.layers.section = parseSection(section);
    if (!options.beside.empty() && !parseBeside(options.beside))
        refuse("--beside " + options.beside + " is not SOLVER or SOLVER:SUBSTEPS, such as gauss_seidel:4");
    if (app.count("--size") > 0) options.size = parseSize(size);
    options.hasSize = app.count("--size") > 0;
    options.hasFrames = app.count("--frames") + app.count("--picture-frames") > 0;
    checkWindow(app, options);
    checkNumbers(options);
    checkHeadless(options, app.count("--frames") > 0);
    return options;
}

} // namespace sinew::viewer
