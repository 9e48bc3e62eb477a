// Ranges come from the table that scenes are validated against.
#include "sinew/options.hpp"

#include "sim/compile.hpp"
#include "sim/material.hpp"
#include "sim/ranges.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace sinew::tools {

namespace {

CLI::Range within(const sim::Range& range) {
    return {static_cast<std::uint32_t>(range.low), static_cast<std::uint32_t>(range.high)};
}

// Empty where it is right, as CLI11 wants it.
std::string checkSubsteps(const std::string& text) {
    if (text == "auto") return {};
    const std::string complaint = within(sim::ranges::substeps)(text);
    return complaint.empty() ? "" : "is " + text + ", must be " + toText(sim::ranges::substeps) + ", or auto";
}

void sayNews(const scenes::LoadedScene& loaded) {
    for (const std::string& note : loaded.notes) std::fprintf(stderr, "%s\n", note.c_str());
    for (const std::string& warning : loaded.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

} // namespace

std::string checkPositive(const std::string& text) {
    double number = 0;
    const bool isRight = CLI::detail::lexical_cast(text, number) && number > 0 && number <= 1e6;
    return isRight ? "" : text + " is no number above 0 and at most 1e6";
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    scenes::Overrides& overrides = options.overrides;
    command
        .add_option("SCENE|MESH", options.file,
                    "scene file (TOML), or a mesh to drop (OBJ, STL, PLY, glTF, GLB)")
        ->required();
    command.add_option("--solver", overrides.solver, "instead of the scene's")
        ->check(CLI::IsMember(sim::solverNames()));
    command
        .add_option_function<std::string>(
            "--substeps",
            [&overrides](const std::string& text) {
                overrides.substeps = text == "auto" ? 0 : static_cast<std::uint32_t>(std::stoul(text));
            },
            "per step, instead of the scene's; auto: as many as its tolerance asks for")
        ->check(checkSubsteps);
    command
        .add_option("--iterations", overrides.iterations,
                    "sweeps per substep of jacobi and gauss_seidel, instead of the scene's")
        ->check(within(sim::ranges::iterations));
    command
        .add_option("--voxel", overrides.voxel,
                    "edge of the voxels of mesh bodies [m], instead of the scene's")
        ->check(checkPositive);
    command.add_flag("--reversed", overrides.isReversed,
                     "run kernels in reversed invocation order; the result must not change");
}

void addDeviceOptions(CLI::App& command, DeviceOptions& options) {
    options.hasValidation = SINEW_VALIDATION_DEFAULT;
    command.add_option("--device", options.device, "index as `sinew devices` prints it, or part of a name");
    command.add_flag("--validation,!--no-validation", options.hasValidation,
                     "check every Vulkan call with the Khronos validation layer (slow)");
}

scenes::LoadedScene loadScene(const SceneOptions& options) {
    scenes::LoadedScene loaded = scenes::load(options.file, options.overrides);
    sayNews(loaded);
    return loaded;
}

Start loadStart(const SceneOptions& options) {
    if (!app::isRunFile(options.file))
        return {loadScene(options), std::filesystem::absolute(options.file).lexically_normal().string(), {}};
    Start start{{}, {}, app::readRun(options.file)};
    const app::SavedRun& run = *start.run;
    start.scene = run.scene;
    scenes::Overrides overrides = options.overrides;
    if (!overrides.solver) overrides.solver = sim::solverName(run.settings.solver);
    if (!overrides.substeps) overrides.substeps = run.settings.substeps;
    start.loaded = run.scene.starts_with('/') ? scenes::load(run.scene, overrides)
                                              : scenes::loadBuiltIn(run.scene, overrides);
    sayNews(start.loaded);
    start.loaded.scene = sim::withMaterial(std::move(start.loaded.scene), run.material);
    start.loaded.scene.gravity = run.gravity;
    start.loaded.settings = app::withRun(start.loaded.settings, run);
    app::addHands(start.loaded.settings);
    return start;
}

} // namespace sinew::tools
