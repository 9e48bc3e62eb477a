// `sinew study`: speed against error of every solver, as JSON, CSV, plots and a page. The output folder keeps
// results, which are not computed again.
#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sinew/commands.hpp"
#include "sinew/outputs.hpp"
#include "sinew/study/page.hpp"
#include "sinew/study/png.hpp"
#include "sinew/study/rest_report.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace sinew::tools {

namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    std::string scene = "all";
    std::string folder = "out/study";
    std::uint32_t points = study::mostPoints;
    std::optional<std::uint32_t> frames;
    std::string shard;
    std::vector<std::string> merged;
    DeviceOptions device;
};

/// For a name that is neither a shipped scene nor a file, lists the shipped ones.
void requireScene(const std::string& scene) {
    const std::vector<std::string> names = study::studySceneNames();
    std::error_code error;
    if (scene == "all" || std::ranges::count(names, scene) > 0 || fs::exists(scene, error)) return;
    throw app::Failure(app::badInput,
                       fmt::format("cannot study: {}: no such scene: possible are {}, all, or a "
                                   "scene file",
                                   scene, fmt::join(names, ", ")));
}

void write(const fs::path& file, const std::string& text) {
    mesh::writeWhole(file, [&](std::ostream& stream) { stream << text; });
}

void writePlot(const fs::path& folder, const std::string& name, const study::Plot& plot, bool& hasPng) {
    write(folder / (name + ".svg"), study::draw(plot, study::Style::own));
    hasPng = study::convertToPng(folder / (name + ".svg"), folder / (name + ".png")) && hasPng;
}

void writePlots(const fs::path& folder, const study::SceneResult& scene, bool& hasPng) {
    for (const study::Price& price : study::prices)
        writePlot(folder, scene.name + "-" + price.name, study::plotOf(scene, price), hasPng);
    for (const study::Plot& plot : study::restPlots(scene))
        writePlot(folder, scene.name + "-" + plot.name, plot, hasPng);
}

void writeAll(const fs::path& folder, const study::StudyRecord& record) {
    bool hasPng = true;
    for (const study::SceneResult& scene : record.scenes) writePlots(folder, scene, hasPng);
    write(folder / "study.csv", toCsv(record));
    if (std::ranges::any_of(record.scenes, [](const auto& scene) { return !scene.rest.empty(); }))
        write(folder / "rest.csv", restCsv(record));
    write(folder / "study.html", toHtml(record));
    write(folder / "study.json", toJson(record));
    if (!hasPng)
        fmt::print(stderr,
                   "warning: plots are SVG only: rsvg-convert is missing or failed: install librsvg2-bin\n");
}

int runStudy(const StudyOptions& options) {
    app::catchSignals();
    requireScene(options.scene);
    const OutputFolder folder(options.folder);
    const study::Store store(folder.path() / "runs");
    for (const std::string& other : options.merged) store.merge(fs::path(other) / "runs");
    const study::Shard shard =
        options.shard.empty() ? study::Shard{} : study::parseShard(options.shard).value();
    const std::vector<study::StudyScene> scenes = study::studyScenes(options.scene, options.frames);
    Session session(options.device);
    study::StudyRecord record{.device = session.device.description(), .scenes = {}};
    for (const study::StudyScene& scene : scenes)
        if (!app::isInterrupted())
            record.scenes.push_back(study::study(session, scene, options.points, store, shard));
    record.isComplete = !app::isInterrupted();
    const app::Writing writing;
    if (!options.shard.empty()) {
        TextOutput("-").write(fmt::format("part {} is in {}: give it to --merge when all parts are there\n",
                                          options.shard, folder.path().string()));
        return record.isComplete ? app::done : app::interrupted;
    }
    writeAll(folder.path(), record);
    TextOutput("-").write(toText(record) +
                          fmt::format("page: {}\n", (folder.path() / "study.html").string()));
    return record.isComplete ? app::done : app::interrupted;
}

} // namespace

void addStudy(CLI::App& app, Chosen& chosen) {
    CLI::App& command = *app.add_subcommand(
        "study", "measure speed against error of every solver; write JSON, CSV, plots and one HTML page");
    const auto options = std::make_shared<StudyOptions>();
    command
        .add_option("--scene", options->scene,
                    fmt::format("{}, all, or a scene file, without damping where nothing touches",
                                fmt::join(study::studySceneNames(), ", ")))
        ->capture_default_str();
    command
        .add_option("--out", options->folder,
                    "folder for the results; results of an earlier study in it are reused")
        ->capture_default_str();
    command
        .add_option("--points", options->points,
                    "sweep counts to try for each solver: 8, 16, 32 ... in every split into substeps")
        ->check(CLI::Range(1u, study::mostPoints))
        ->capture_default_str();
    command.add_option("--frames", options->frames, "length of the motion, instead of the scene's own")
        ->check(CLI::Range(1u, 600u));
    const auto isPart = [](const std::string& text) {
        return study::parseShard(text) ? std::string() : text + " is no part such as 1/4";
    };
    command
        .add_option("--shard", options->shard,
                    "run a part of the study, I/N, and write no page; for N programs or machines with equal "
                    "devices, each with a folder of its own")
        ->check(CLI::Validator(isPart, "I/N"));
    command.add_option("--merge", options->merged,
                       "output folders of parts, whose results are copied first; runs that none has follow");
    addDeviceOptions(command, options->device);
    command.callback([options, &chosen] { chosen = [options] { return runStudy(*options); }; });
}

} // namespace sinew::tools
