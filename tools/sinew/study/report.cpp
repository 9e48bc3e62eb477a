// JSON, CSV and a few lines for a terminal.
#include "sinew/study/report.hpp"

#include "sinew/report.hpp"
#include "sinew/statistics.hpp"
#include "sinew/study/rest_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::tools::study {

const std::array<Price, 3> prices{
    {{"time", "device time of a frame [ms]", [](const Trial& trial) { return trial.medianMs(); }},
     {"sweeps", "sweeps of a frame", [](const Trial& trial) { return static_cast<double>(trial.sweeps); }},
     {"barriers", "barriers of a frame",
      [](const Trial& trial) { return static_cast<double>(trial.barriers); }}}};

std::vector<Offer> Curve::offers(const Price& price, Scale scale) const {
    std::vector<Offer> result;
    for (const CurvePoint& point : points) {
        std::optional<double> error;
        if (point.error)
            error = scale == Scale::motion ? point.error->ofMotion : std::optional(point.error->rms);
        result.push_back({price.of(*point.trial), error});
    }
    return result;
}

std::vector<std::size_t> Curve::front(const Price& price) const {
    return paretoFront(offers(price));
}

std::optional<double> Curve::costOf(double error, const Price& price, Scale scale) const {
    const std::vector<Offer> all = offers(price, scale);
    std::vector<Offer> best;
    for (const std::size_t i : paretoFront(all)) best.push_back(all[i]);
    return costOfError(best, error);
}

std::vector<Curve> curvesOf(const SceneResult& result) {
    std::vector<Curve> curves;
    const std::vector<std::string> names = curveNames();
    for (std::size_t slot = 0; slot < names.size(); ++slot) {
        Curve curve{.solver = names[slot], .slot = slot};
        for (const Trial& trial : result.trials)
            if (curveOf(trial.settings) == names[slot])
                curve.points.push_back({&trial, errorOf(trial, result.truth)});
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    return curves;
}

std::optional<Advantage> advantageOf(const Curve& curve, const std::vector<Curve>& curves) {
    const auto jacobi = std::ranges::find(curves, "jacobi", &Curve::solver);
    const std::optional<double> own = curve.costOf(targetError, prices[0]);
    if (jacobi == curves.end() || !own) return {};
    if (const auto cost = jacobi->costOf(targetError, prices[0])) return Advantage{*cost / *own, false};
    const std::vector<std::size_t> front = jacobi->front(prices[0]);
    if (front.empty()) return {};
    return Advantage{jacobi->points[front.back()].trial->medianMs() / *own, true};
}

namespace {

/// Least, median and greatest.
Json spreadJson(const std::vector<double>& values) {
    const std::optional<Statistics> spread = summarise(values);
    if (!spread) return nullptr;
    return {{"count", values.size()},
            {"least", spread->min},
            {"median", spread->p50},
            {"greatest", *std::ranges::max_element(values)}};
}

Json pointJson(const Curve& curve, std::size_t index) {
    const CurvePoint& point = curve.points[index];
    const Trial& trial = *point.trial;
    const sim::Settings& settings = trial.settings;
    const std::vector<std::size_t> front = curve.front(prices[0]);
    std::vector<double> loads;
    for (const Repeat& repeat : trial.repeats) loads.push_back(repeat.load);
    return {{"substeps", settings.substeps},
            {"iterations", settings.iterations},
            {"sweeps", trial.sweeps},
            {"barriers", trial.barriers},
            {"ms_per_frame", trial.medianMs()},
            {"ms_of_repeats", spreadJson(trial.repeatMs())},
            {"load", spreadJson(loads)},
            {"error_rms", point.error ? Json(point.error->rms) : Json(nullptr)},
            {"error_max", point.error ? Json(point.error->max) : Json(nullptr)},
            {"error_of_motion", point.error ? orNull(point.error->ofMotion) : Json(nullptr)},
            {"diverged", trial.isDiverged},
            {"frames_compared", point.error ? Json(point.error->frames) : Json(nullptr)},
            {"clamped", orNull(trial.clamped)},
            {"omega", settings.omega},
            {"theta", settings.theta},
            {"levels", settings.levels},
            {"sharp_clamp", settings.hasSharpClamp},
            {"weight", settings.weight},
            {"over_relaxation", settings.overRelaxation},
            {"warm_start", settings.warmStart},
            {"frames_timed", trial.frameMs.size()},
            {"clock", trial.hasDeviceClock ? "device" : "host"},
            {"on_front", std::ranges::find(front, index) != front.end()}};
}

Json curveJson(const Curve& curve) {
    Json points = Json::array();
    for (std::size_t i = 0; i < curve.points.size(); ++i) points.push_back(pointJson(curve, i));
    return {{"solver", curve.solver}, {"points", std::move(points)}};
}

Json sceneJson(const SceneResult& scene) {
    const std::vector<Curve> curves = curvesOf(scene);
    Json json{{"name", scene.name},
              {"particles", scene.particles},
              {"constraints", scene.constraints},
              {"frames", scene.frames},
              {"dt", scene.dt},
              {"body_size", scene.truth.bodySize},
              {"truth",
               {{"kind", scene.isOfContacts ? "split" : "verlet"},
                {"h", scene.truth.h},
                {"self_difference", scene.truth.selfDifference},
                {"perturbation", perturbation},
                {"growth", scene.truth.growth},
                {"halving", scene.truth.halving},
                {"motion", scene.truth.motion},
                {"standing_still", scene.truth.standingStill()},
                {"frames_at_1_percent", framesAtTarget(scene.truth)}}}};
    json["curves"] = Json::array();
    const char* headlines[] = {"ms_to_1_percent", "sweeps_to_1_percent", "barriers_to_1_percent"};
    for (const char* headline : headlines) json[headline] = Json::object();
    json["ms_to_1_percent_of_motion"] = Json::object();
    json["speedup_over_jacobi"] = Json::object();
    for (const Curve& curve : curves) {
        json["curves"].push_back(curveJson(curve));
        for (std::size_t i = 0; i < prices.size(); ++i)
            json[headlines[i]][curve.solver] = orNull(curve.costOf(targetError, prices[i]));
        json["ms_to_1_percent_of_motion"][curve.solver] =
            orNull(curve.costOf(targetError, prices[0], Scale::motion));
        const std::optional<Advantage> advantage = advantageOf(curve, curves);
        json["speedup_over_jacobi"][curve.solver] =
            advantage ? Json{{"ratio", advantage->ratio}, {"at_least", advantage->isBound}} : Json(nullptr);
    }
    json["rest"] = restJson(scene);
    json["notes"] = scene.notes;
    return json;
}

std::string csvOf(double value) {
    return fmt::format("{:.9g}", value);
}

} // namespace

std::string toJson(const StudyRecord& record) {
    Json json{
        {"schema", reportSchema},
        {"version", SINEW_VERSION},
        {"device",
         {{"name", record.device.name}, {"driver", record.device.driver}, {"type", record.device.type}}},
        {"complete", record.isComplete},
        {"scenes", Json::array()}};
    for (const SceneResult& scene : record.scenes) json["scenes"].push_back(sceneJson(scene));
    return dump(json);
}

std::string toCsv(const StudyRecord& record) {
    std::string text =
        "scene,solver,substeps,iterations,omega,theta,levels,sharp_clamp,weight,over_relaxation,warm_start,"
        "sweeps,barriers,clamped,"
        "ms_per_frame,error_rms,error_max,error_of_motion,frames_compared,frames_timed\n";
    for (const SceneResult& scene : record.scenes)
        for (const Curve& curve : curvesOf(scene))
            for (const CurvePoint& point : curve.points) {
                const Trial& trial = *point.trial;
                const sim::Settings& s = trial.settings;
                text += fmt::format(
                    "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", scene.name, curve.solver,
                    s.substeps, s.iterations, s.omega, s.theta, s.levels, s.hasSharpClamp ? 1 : 0, s.weight,
                    s.overRelaxation, s.warmStart, trial.sweeps, trial.barriers,
                    trial.clamped ? csvOf(*trial.clamped) : "", csvOf(trial.medianMs()),
                    point.error ? csvOf(point.error->rms) : "", point.error ? csvOf(point.error->max) : "",
                    point.error && point.error->ofMotion ? csvOf(*point.error->ofMotion) : "",
                    point.error ? std::to_string(point.error->frames) : "", trial.frameMs.size());
            }
    return text;
}

std::string toText(const StudyRecord& record) {
    std::string text =
        fmt::format("time of a frame to an error of 1 % of the body's size, and of the motion, on {} ({})\n",
                    record.device.name, record.device.type);
    for (const SceneResult& scene : record.scenes) {
        const std::vector<Curve> curves = curvesOf(scene);
        const auto msText = [](std::optional<double> ms) {
            return ms ? fmt::format("{:.3g} ms", *ms) : std::string("never");
        };
        text += fmt::format("{}: standing still is {:.3g} % off\n", scene.name,
                            100 * scene.truth.standingStill());
        for (const Curve& curve : curves) {
            const std::optional<Advantage> advantage = advantageOf(curve, curves);
            text += fmt::format("{:<16} {:<16} {:>12}, of the motion {:>10}", scene.name, curve.solver,
                                msText(curve.costOf(targetError, prices[0])),
                                msText(curve.costOf(targetError, prices[0], Scale::motion)));
            if (advantage && curve.solver != "jacobi")
                text += fmt::format("   {}{:.3g} x faster than jacobi",
                                    advantage->isBound ? "more than " : "", advantage->ratio);
            text += '\n';
        }
        text += restText(scene);
    }
    return text;
}

} // namespace sinew::tools::study
