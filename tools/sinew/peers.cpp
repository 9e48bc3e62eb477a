// Every program runs the motion with many choices of substeps and iterations, in turns (A B A B): the first
// round gives the errors against the reference trajectory R1, all rounds the times of a frame, by the wall
// clock, with submission and wait for the device.
#include "sinew/peers.hpp"

#include "app/guard.hpp"
#include "app/progress.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/bodies.hpp"
#include "sinew/bullet_body.hpp"
#include "sinew/clutter/bullet.hpp"
#include "sinew/runner.hpp"
#include "sinew/statistics.hpp"
#include "sinew/study/analysis.hpp"
#include "sinew/study/trial.hpp"
#include "sinew/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace sinew::tools {

namespace {

using study::Offer;

constexpr std::uint32_t frames = 18; // of 1/60 s
constexpr std::uint32_t rounds = 3;
constexpr double targets[] = {0.1, 0.01, 0.001};
constexpr const char* targetNames[] = {"10_percent", "1_percent", "0.1_percent"};

sim::Scene elasticCloth() {
    sim::Scene scene{.name = "cloth 64x64"};
    sim::addCloth(scene, {.origin = {-0.5f, 0, -0.5f},
                          .size = {64, 64},
                          .spacing = 1.0f / 63,
                          .stretchCompliance = 1e-3f,
                          .shearCompliance = 1e-2f,
                          .skipStiffness = 10,
                          .pinned = {0, 63}});
    return scene;
}

/// A cube fixed to the ground: a drop would add contacts, in which engines differ for other reasons.
sim::Scene elasticCube(std::uint32_t side) {
    sim::Scene scene{.name = fmt::format("cube {0}x{0}x{0}", side)};
    const sim::Lattice lattice{
        .name = "cube", .cells = {side - 1, side - 1, side - 1}, .spacing = 0.02f, .youngModulus = 1e5f};
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    for (std::uint32_t k = 0; k < side; ++k)
        for (std::uint32_t i = 0; i < side; ++i) scene.fixed.push_back({corners.at(i, 0, k)});
    return scene;
}

struct PeerScene {
    const char* group; // of --scene
    sim::Scene (*make)();
    std::uint32_t mostSweeps;
};
constexpr PeerScene peerScenes[] = {{"cloth", elasticCloth, 256},
                                    {"cube", [] { return elasticCube(16); }, 128},
                                    {"cube", [] { return elasticCube(32); }, 64}};

/// One program with one choice of settings.
struct Entrant {
    std::string program; // one of our solvers, or "bullet"
    sim::Settings settings;
    std::vector<double> frameRms, frameMs;
    std::optional<double> error; // over the frames before chaos; empty = diverged
    bool isDiverged = false;

    std::uint64_t sweeps() const { return std::uint64_t{settings.substeps} * settings.iterations; }
    double medianMs() const { return summarise(frameMs).value_or(Statistics{}).p50; }
    Offer offer() const { return {medianMs(), error}; }
};

std::vector<Entrant> entrantsFor(const sim::Scene& scene, std::uint32_t mostSweeps) {
    std::vector<Entrant> entrants;
    for (std::uint32_t sweeps = 4; sweeps <= mostSweeps; sweeps *= 2) {
        for (const std::uint32_t iterations : {1u, 2u, 4u, sweeps})
            if (iterations <= sweeps && (iterations < sweeps || sweeps > 4))
                entrants.push_back(
                    {"bullet", {.substeps = sweeps / iterations, .iterations = iterations}, {}, {}});
        for (const std::string& name : sim::solverNames()) {
            sim::Solver solver{};
            sim::parseSolver(name, solver);
            for (const sim::Settings& settings : study::settingsAt(solver, sweeps))
                if (sim::validate(scene, settings).empty()) entrants.push_back({name, settings, {}, {}});
        }
    }
    return entrants;
}

double rmsDistance(const std::vector<Eigen::Vector3d>& x, const std::vector<Eigen::Vector3d>& truth) {
    double squares = 0;
    for (std::size_t i = 0; i < x.size(); ++i) squares += (x[i] - truth[i]).squaredNorm();
    return std::sqrt(squares / static_cast<double>(x.size()));
}

std::vector<Eigen::Vector3d> positionsOf(Runner& runner) {
    std::vector<Eigen::Vector3d> result;
    for (const auto& x : runner.readState().positions)
        result.emplace_back(double{x[0]}, double{x[1]}, double{x[2]});
    return result;
}

void record(Entrant& entrant, std::uint32_t frame, double ms, const study::Truth* truth,
            const std::vector<Eigen::Vector3d>& x) {
    entrant.frameMs.push_back(ms);
    if (!truth) return;
    const double error = rmsDistance(x, truth->frames[frame]) / truth->bodySize;
    if (std::isfinite(error))
        entrant.frameRms.push_back(error);
    else
        entrant.isDiverged = true;
}

void runBullet(const sim::Scene& scene, Entrant& entrant, const study::Truth* truth) {
    using Clock = std::chrono::steady_clock;
    BulletBody(scene, 1, 1).step(); // warm caches, as the device has
    BulletBody body(scene, entrant.settings.substeps, entrant.settings.iterations);
    for (std::uint32_t frame = 0; frame < frames && !app::isInterrupted() && !entrant.isDiverged; ++frame) {
        const Clock::time_point start = Clock::now();
        body.step();
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        record(entrant, frame, ms, truth, truth ? body.positions() : std::vector<Eigen::Vector3d>{});
    }
}

void runDevice(Session& session, const sim::Scene& scene, Entrant& entrant, const study::Truth* truth) {
    Runner runner(session, scene, entrant.settings);
    for (std::uint32_t frame = 0; frame < frames && !app::isInterrupted() && !entrant.isDiverged; ++frame) {
        runner.advance(1, 1);
        if (runner.steps() <= frame) {
            entrant.isDiverged = runner.divergence().has_value();
            return;
        }
        record(entrant, frame, runner.frameMs().back(), truth,
               truth ? positionsOf(runner) : std::vector<Eigen::Vector3d>{});
    }
}

void runOnce(Session& session, const sim::Scene& scene, Entrant& entrant, const study::Truth* truth) {
    if (entrant.program == "bullet")
        runBullet(scene, entrant, truth);
    else
        runDevice(session, scene, entrant, truth);
}

std::vector<std::string> programsOf(const std::vector<Entrant>& entrants) {
    std::vector<std::string> names;
    for (const Entrant& entrant : entrants)
        if (std::ranges::find(names, entrant.program) == names.end()) names.push_back(entrant.program);
    return names;
}

std::vector<std::size_t> frontOf(const std::vector<Entrant>& entrants, const std::string& program) {
    std::vector<Offer> offers; // programs of others are empty, to keep indices
    for (const Entrant& entrant : entrants)
        offers.push_back(entrant.program == program ? entrant.offer() : Offer{});
    return study::paretoFront(offers);
}

/// The first round measures errors; the others time each program's front, in turns.
void runAll(Session& session, const sim::Scene& scene, const study::Truth& truth,
            std::vector<Entrant>& entrants) {
    std::uint64_t total = 0, done = 0;
    for (const Entrant& entrant : entrants) total += entrant.sweeps() * frames;
    app::Progress progress(total, stderr, "sweeps");
    for (Entrant& entrant : entrants) {
        runOnce(session, scene, entrant, &truth);
        if (app::isInterrupted()) return;
        if (!entrant.isDiverged)
            entrant.error =
                study::rmsOver(entrant.frameRms,
                               study::comparableFrames(entrant.frameRms, truth.growth, study::perturbation));
        progress.update(done += entrant.sweeps() * frames);
    }
    progress.finish();
    std::vector<std::size_t> best;
    for (const std::string& program : programsOf(entrants))
        for (const std::size_t i : frontOf(entrants, program)) best.push_back(i);
    std::ranges::sort(best);
    for (std::uint32_t round = 1; round < rounds; ++round)
        for (const std::size_t i : best) runOnce(session, scene, entrants[i], nullptr);
}

Json pointJson(const Entrant& entrant, bool isOnFront) {
    const Offer offer = entrant.offer();
    Json json{{"substeps", entrant.settings.substeps},
              {"iterations", entrant.settings.iterations},
              {"ms_per_frame", offer.cost},
              {"error_rms", orNull(offer.error)},
              {"on_front", isOnFront}};
    if (entrant.program != "bullet") {
        json["theta"] = entrant.settings.theta;
        json["weight"] = entrant.settings.weight;
        json["over_relaxation"] = entrant.settings.overRelaxation;
        json["warm_start"] = entrant.settings.warmStart;
    }
    return json;
}

Json curveJson(const std::vector<Entrant>& entrants, const std::string& program) {
    const std::vector<std::size_t> front = frontOf(entrants, program);
    Json points = Json::array(), reach = Json::object();
    std::vector<Offer> offers;
    for (const std::size_t i : front) offers.push_back(entrants[i].offer());
    for (std::size_t i = 0; i < entrants.size(); ++i)
        if (entrants[i].program == program)
            points.push_back(pointJson(entrants[i], std::ranges::find(front, i) != front.end()));
    for (std::size_t i = 0; i < std::size(targets); ++i)
        reach[targetNames[i]] = orNull(study::costOfError(offers, targets[i]));
    return {{"program", program}, {"points", std::move(points)}, {"ms_to", std::move(reach)}};
}

Json compare(Session& session, const sim::Scene& scene, std::uint32_t mostSweeps) {
    fmt::print(stderr, "{}: computing the true motion\n", scene.name);
    study::StudyScene studied{.name = scene.name, .frames = frames};
    studied.loaded.scene = scene;
    const study::Truth truth = study::truthOf(session, studied);
    std::vector<Entrant> entrants = entrantsFor(scene, mostSweeps);
    fmt::print(stderr, "{}: {} runs\n", scene.name, entrants.size());
    runAll(session, scene, truth, entrants);
    Json json{{"scene", scene.name},
              {"particles", scene.particles.size()},
              {"constraints", scene.distances.size()},
              {"frames", frames},
              {"device", session.device.description().name},
              {"truth", {{"h", truth.h}, {"self_difference", truth.selfDifference}}},
              {"curves", Json::array()}};
    for (const std::string& program : programsOf(entrants))
        json["curves"].push_back(curveJson(entrants, program));
    return json;
}

} // namespace

void requirePeers() {}

ClutterEntrant bulletClutter(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations) {
    return onCpu("bullet", std::make_shared<clutter::Bullet>(clutter::ballsOf(scene, substeps, iterations)),
                 substeps, iterations);
}

Json comparePeers(const std::string& scene, Session& session) {
    Json comparisons = Json::array();
    for (const PeerScene& peer : peerScenes)
        if ((scene == "all" || scene == peer.group) && !app::isInterrupted())
            comparisons.push_back(compare(session, peer.make(), peer.mostSweeps));
    return comparisons;
}

std::string peersTable(const Json& comparisons) {
    std::string text = fmt::format("\nms of a frame to equal error   {:>10} {:>10} {:>10}   at 1 %\n", "10 %",
                                   "1 %", "0.1 %");
    for (const Json& comparison : comparisons) {
        const Json bullet = comparison["curves"][0]["ms_to"]["1_percent"];
        for (const Json& curve : comparison["curves"]) {
            text += fmt::format("{:<16} {:<13}", comparison["scene"].get<std::string>(),
                                curve["program"].get<std::string>());
            for (const char* target : targetNames) {
                const Json& ms = curve["ms_to"][target];
                text +=
                    fmt::format(" {:>10}", ms.is_null() ? "never" : fmt::format("{:.3g}", ms.get<double>()));
            }
            const Json& own = curve["ms_to"]["1_percent"];
            if (curve["program"] != "bullet" && !own.is_null() && !bullet.is_null())
                text += fmt::format("   {:.2f} x Bullet's speed", bullet.get<double>() / own.get<double>());
            text += '\n';
        }
    }
    return text;
}

} // namespace sinew::tools
