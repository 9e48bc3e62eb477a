// Ranges are those of the table that validates scenes.
#include "sinew/options.hpp"

#include "app/count_option.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/material.hpp"
#include "sinew/ranges.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace sinew::tools {

namespace {

CLI::Range within(const sim::Range& range) {
    return {static_cast<std::uint32_t>(range.low), static_cast<std::uint32_t>(range.high)};
}

// Sets one "key=number" of --forms. Throws CLI::ValidationError.
void setForm(FormOptions& options, const std::string& text) {
    const std::size_t sign = text.find('=');
    const std::string key = text.substr(0, sign);
    std::uint32_t value = 0;
    const auto take = [&](auto& option, const sim::Range& range) {
        if (sign == std::string::npos || !CLI::detail::lexical_cast(text.substr(sign + 1), value) ||
            !range.holds(value))
            throw CLI::ValidationError("--forms", key + " must be " + toText(range));
        option = value;
    };
    constexpr sim::Range flag{0, 1}, bytes{0, 1 << 20};
    if (key == "texels")
        take(options.usesTexels, flag);
    else if (key == "grids")
        take(options.usesGrids, flag);
    else if (key == "columns")
        take(options.columns, sim::ranges::columns);
    else if (key == "chunk")
        take(options.chunk, sim::ranges::chunk);
    else if (key == "resident")
        take(options.residentBytes, bytes);
    else
        throw CLI::ValidationError("--forms", key + " is none of texels, grids, columns, chunk, resident");
}

void sayNews(const scenes::LoadedScene& loaded) {
    for (const std::string& note : loaded.notes) std::fprintf(stderr, "%s\n", note.c_str());
    for (const std::string& warning : loaded.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

} // namespace

std::string checkPositive(const std::string& text) {
    double number = 0;
    const bool isRight = CLI::detail::lexical_cast(text, number) && number > 0 && number <= 1e6;
    return isRight ? "" : text + " is not a number above 0 and at most 1e6";
}

sim::Forms FormOptions::in(sim::Forms forms) const {
    forms.usesTexels = usesTexels.value_or(forms.usesTexels);
    forms.usesGrids = usesGrids.value_or(forms.usesGrids);
    forms.columns = columns.value_or(forms.columns);
    forms.chunk = chunk.value_or(forms.chunk);
    forms.residentBytes = residentBytes.value_or(forms.residentBytes);
    return forms;
}

void addFormOptions(CLI::App& command, FormOptions& options) {
    command
        .add_option_function<std::vector<std::string>>(
            "--forms",
            [&options](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) setForm(options, text);
            },
            "forms of kernels, as columns=1,chunk=1,texels=0,grids=1,resident=0, instead of the "
            "fastest; columns=1 with chunk=1 computes one node an invocation")
        ->delimiter(',')
        ->type_name("KEY=N,...");
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    scenes::Overrides& overrides = options.overrides;
    command
        .add_option("SCENE|MESH", options.file,
                    "scene file (TOML), or a mesh to drop (OBJ, STL, PLY, glTF, GLB)")
        ->required();
    command.add_option("--solver", overrides.solver, "solver, instead of the scene's")
        ->check(CLI::IsMember(sim::solverNames()));
    app::addCountOrAuto(command, "--substeps", overrides.substeps, sim::ranges::substeps, 0,
                        "substeps per step, instead of the scene's; auto: as many as its tolerance needs");
    command
        .add_option("--iterations", overrides.iterations,
                    "sweeps per substep of jacobi and gauss_seidel, instead of the scene's")
        ->check(within(sim::ranges::iterations));
    app::addCountOrAuto(
        command, "--levels", overrides.levels, sim::ranges::levels, sim::autoLevels,
        "coarse levels of split, instead of the scene's; auto: as many as win at equal error");
    command.add_flag_function( // add_flag would set an optional that nobody asks to set
        "--sharp-clamp,!--no-sharp-clamp",
        [&overrides](std::int64_t count) { overrides.hasSharpClamp = count > 0; },
        "clamp links of split by the directions in which they meet, instead of the scene's choice");
    command
        .add_option("--voxel", overrides.voxel,
                    "edge of the voxels of mesh bodies [m], instead of the scene's")
        ->check(checkPositive);
    command.add_flag("--reversed", overrides.isReversed,
                     "run kernels in reversed invocation order; the result must not change");
    addFormOptions(command, options.forms);
}

void addDeviceOptions(CLI::App& command, DeviceOptions& options) {
    options.hasValidation = SINEW_VALIDATION_DEFAULT;
    command.add_option("--device", options.device, "index as `sinew devices` prints it, or part of a name");
    command.add_flag("--validation,!--no-validation", options.hasValidation,
                     "check every Vulkan call with the Khronos validation layer (slow)");
}

scenes::LoadedScene loadScene(const SceneOptions& options) {
    scenes::LoadedScene loaded = scenes::load(options.file, options.overrides);
    loaded.settings.forms = options.forms.in(loaded.settings.forms);
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
    if (!overrides.levels) overrides.levels = run.settings.levels;
    overrides.takeClamp(run.hasSharpClamp);
    start.loaded = run.scene.starts_with('/') ? scenes::load(run.scene, overrides)
                                              : scenes::loadBuiltIn(run.scene, overrides);
    sayNews(start.loaded);
    start.loaded.scene = sim::withMaterial(std::move(start.loaded.scene), run.material);
    start.loaded.scene.gravity = run.gravity;
    start.loaded.settings = app::withRun(start.loaded.settings, run);
    start.loaded.settings.forms = options.forms.in(start.loaded.settings.forms);
    app::addRoomForUser(start.loaded.settings);
    return start;
}

} // namespace sinew::tools
