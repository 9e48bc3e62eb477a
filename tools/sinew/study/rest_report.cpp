// A missing figure is null in JSON, nothing in CSV and a dash in text.
#include "sinew/study/rest_report.hpp"

#include "sim/compile/compile.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::tools::study {

namespace {

std::string nameOf(const RestRun& run) {
    return fmt::format("{} {}", sim::solverName(run.settings.solver), run.settings.substeps);
}

/// A length as text.
std::string millimetres(const std::optional<double>& value) {
    return value ? fmt::format("{:.3g} mm", 1000 * *value) : "–";
}

std::optional<double> lastRms(const RestRun& run) {
    return run.samples.empty() ? std::nullopt : run.samples.back().penetrationRms;
}

std::optional<double> lastMax(const RestRun& run) {
    return run.samples.empty() ? std::nullopt : run.samples.back().penetrationMax;
}

std::optional<double> lastEnergy(const RestRun& run) {
    return run.samples.empty() ? std::nullopt : std::optional(run.samples.back().kineticEnergy);
}

using Figure = std::optional<double> (*)(const Sample&);

struct Shown {
    const char* name; // in file names
    const char* what;
    Figure figure;
};
constexpr Shown shown[] = {
    {"penetration", "deepest penetration [m]", [](const Sample& s) { return s.penetrationMax; }},
    {"energy", "kinetic energy [J]", [](const Sample& s) { return std::optional(s.kineticEnergy); }}};

Plot plotOf(const SceneResult& scene, const Shown& of) {
    Plot plot{.title = scene.name + ": " + of.what,
              .xLabel = "time [s]",
              .kind = PlotKind::overTime,
              .name = of.name,
              .curves = {}};
    for (std::size_t slot = 0; slot < scene.rest.size(); ++slot) {
        const RestRun& run = scene.rest[slot];
        PlotCurve curve{.label = nameOf(run), .slot = slot};
        for (const Sample& sample : run.samples)
            if (const std::optional<double> y = of.figure(sample))
                curve.points.push_back({sample.time, *y, true});
        if (!run.isDiverged && !curve.points.empty()) plot.curves.push_back(std::move(curve));
    }
    return plot;
}

} // namespace

Json restJson(const SceneResult& scene) {
    Json runs = Json::array();
    for (const RestRun& run : scene.rest) {
        Json json{{"solver", sim::solverName(run.settings.solver)},
                  {"substeps", run.settings.substeps},
                  {"iterations", run.settings.iterations},
                  {"diverged", run.isDiverged},
                  {"penetration_max", orNull(deepest(run))},
                  {"penetration_max_at_end", orNull(lastMax(run))},
                  {"penetration_rms_at_end", orNull(lastRms(run))},
                  {"kinetic_energy_at_end", orNull(lastEnergy(run))},
                  {"time_to_rest", orNull(timeToRest(run, restShare))}};
        json["samples"] = Json::array();
        for (const Sample& sample : run.samples)
            json["samples"].push_back({{"time", sample.time},
                                       {"kinetic_energy", sample.kineticEnergy},
                                       {"penetration_max", orNull(sample.penetrationMax)},
                                       {"penetration_rms", orNull(sample.penetrationRms)}});
        runs.push_back(std::move(json));
    }
    return runs;
}

std::string restCsv(const StudyRecord& record) {
    const auto text = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.9g}", *value) : std::string();
    };
    std::string csv =
        "scene,solver,substeps,iterations,time,kinetic_energy,penetration_max,penetration_rms\n";
    for (const SceneResult& scene : record.scenes)
        for (const RestRun& run : scene.rest)
            for (const Sample& s : run.samples)
                csv += fmt::format("{},{},{},{},{:.9g},{:.9g},{},{}\n", scene.name,
                                   sim::solverName(run.settings.solver), run.settings.substeps,
                                   run.settings.iterations, s.time, s.kineticEnergy, text(s.penetrationMax),
                                   text(s.penetrationRms));
    return csv;
}

std::string restText(const SceneResult& scene) {
    std::string text;
    for (const RestRun& run : scene.rest) {
        const std::optional<double> rest = timeToRest(run, restShare);
        text += fmt::format("{:<16} {:<16} ", scene.name, nameOf(run));
        text +=
            run.isDiverged
                ? "diverged\n"
                : fmt::format("deepest {}, at the end {} (RMS {}), {:.2g} J; at rest after {}\n",
                              millimetres(deepest(run)), millimetres(lastMax(run)), millimetres(lastRms(run)),
                              lastEnergy(run).value_or(0), rest ? fmt::format("{:.2g} s", *rest) : "longer");
    }
    return text;
}

std::vector<Plot> restPlots(const SceneResult& scene) {
    std::vector<Plot> plots;
    for (const Shown& of : shown) plots.push_back(plotOf(scene, of));
    std::erase_if(plots, [](const Plot& plot) { return plot.curves.empty(); });
    return plots;
}

std::string restTable(const SceneResult& scene) {
    if (scene.rest.empty()) return {};
    std::string rows;
    for (const RestRun& run : scene.rest) {
        const std::optional<double> rest = timeToRest(run, restShare);
        rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            escaped(nameOf(run)), run.isDiverged ? "diverged" : millimetres(deepest(run)),
                            millimetres(lastMax(run)), millimetres(lastRms(run)),
                            lastEnergy(run) ? fmt::format("{:.2g} J", *lastEnergy(run)) : "–",
                            rest ? fmt::format("{:.2g} s", *rest) : "–");
    }
    return "<div class=\"wide\"><table>\n<thead><tr><th>solver, substeps</th><th>deepest</th><th>at the "
           "end</th><th>RMS</th><th>kinetic energy</th><th>at rest after</th></tr></thead>\n<tbody>\n" +
           rows + "</tbody></table></div>\n";
}

} // namespace sinew::tools::study
