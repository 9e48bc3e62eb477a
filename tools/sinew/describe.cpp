// `sinew describe`: prints the step program of a scene. Needs no device.
#include "sim/compile/compile.hpp"
#include "sinew/commands.hpp"
#include "sinew/options.hpp"
#include "sinew/outputs.hpp"
#include "sinew/predict/flushes.hpp"
#include "sinew/predict/predict.hpp"
#include "sinew/report.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace sinew::tools {

namespace {

struct DescribeOptions : SceneOptions {
    std::string card, cards;
    bool showsFlushes = false;
};

// The program with the forms that a GPU starts with.
sim::StepProgram programOfAGpu(const DescribeOptions& options) {
    scenes::LoadedScene loaded = loadScene(options);
    loaded.settings.forms = sim::completed(loaded.settings.forms, sim::DeviceKind::gpu);
    return sim::compile(loaded.scene, loaded.settings);
}

int predict(const DescribeOptions& options) {
    const Card card =
        findCard(options.cards.empty() ? shippedCards() : loadCards(options.cards), options.card);
    TextOutput("-").write(predictionText(programOfAGpu(options), card, shippedKernels()));
    return 0;
}

int describeBarriers(const DescribeOptions& options) {
    TextOutput("-").write(flushText(programOfAGpu(options)));
    return 0;
}

int describe(const DescribeOptions& options) {
    if (!options.card.empty()) return predict(options);
    if (options.showsFlushes) return describeBarriers(options);
    const scenes::LoadedScene loaded = loadScene(options);
    TextOutput("-").write(sim::describe(sim::compile(loaded.scene, loaded.settings)) + stiffnessText(loaded) +
                          errorText({}));
    return 0;
}

} // namespace

void addDescribe(CLI::App& app, Chosen& chosen) {
    CLI::App& command = *app.add_subcommand(
        "describe", "print the passes, buffers and barriers of a scene's step; needs no device");
    const auto options = std::make_shared<DescribeOptions>();
    addSceneOptions(command, *options);
    CLI::Option* card = command.add_option("--predict", options->card,
                                           "instead, predict the time of each pass on a card that need not "
                                           "be there: h200, rx6900xt, rtx4060m, xelp96");
    command.add_option("--cards", options->cards, "file with other cards, as tools/sinew/predict/cards.csv")
        ->needs(card);
    command
        .add_flag(
            "--barriers", options->showsFlushes,
            "instead, count the barriers of a step by pass, and what they flush on GPUs of AMD and Intel")
        ->excludes(card);
    command.callback([options, &chosen] { chosen = [options] { return describe(*options); }; });
}

} // namespace sinew::tools
