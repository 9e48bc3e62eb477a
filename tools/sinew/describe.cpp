// `sinew describe`: prints the step program of a scene. Needs no device.
#include "sim/compile/compile.hpp"
#include "sinew/commands.hpp"
#include "sinew/options.hpp"
#include "sinew/outputs.hpp"
#include "sinew/report.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace sinew::tools {

namespace {

int describe(const SceneOptions& options) {
    const scenes::LoadedScene loaded = loadScene(options);
    TextOutput("-").write(sim::describe(sim::compile(loaded.scene, loaded.settings)) + stiffnessText(loaded) +
                          errorText({}));
    return 0;
}

} // namespace

void addDescribe(CLI::App& app, Chosen& chosen) {
    CLI::App& command = *app.add_subcommand(
        "describe", "print the passes, buffers and barriers of a scene's step; needs no device");
    const auto options = std::make_shared<SceneOptions>();
    addSceneOptions(command, *options);
    command.callback([options, &chosen] { chosen = [options] { return describe(*options); }; });
}

} // namespace sinew::tools
