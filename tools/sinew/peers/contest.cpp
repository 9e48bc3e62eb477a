#include "sinew/peers/contest.hpp"

#include "app/guard.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/bullet_body.hpp"
#include "sinew/gpu_tune.hpp"
#include "sinew/native/verlet.hpp"
#include "sinew/statistics.hpp"
#include "sinew/study/analysis.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sinew::tools::peers {

namespace {

using Clock = std::chrono::steady_clock;
using OnFrame = std::function<bool(const study::Positions&)>;

/// Explicit integration as a program to compare with.
class NativeVerlet : public CpuProgram {
public:
    NativeVerlet(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t threads)
        : verlet_(scene, substeps, threads) {}
    void step() override { verlet_.step(); }
    study::Positions positions() const override {
        study::Positions result;
        for (std::size_t i = 0; i < verlet_.size(); ++i) {
            const std::array<double, 3> x = verlet_.position(i);
            result.emplace_back(x[0], x[1], x[2]);
        }
        return result;
    }

private:
    native::Verlet<float> verlet_;
};

/// A program on the CPU by its name; null for our solvers.
std::unique_ptr<CpuProgram> makeCpuProgram(const std::string& name, const sim::Scene& scene,
                                           const sim::Settings& settings, std::uint32_t threads) {
    if (name == "verlet") return std::make_unique<NativeVerlet>(scene, settings.substeps, threads);
    if (name == "bullet") return std::make_unique<BulletBody>(scene, settings.substeps, settings.iterations);
    if (name == "jolt") return makeJoltBody(scene, settings.substeps, threads);
    return nullptr;
}

/// Times of the frames of a program on the CPU [ms], until `onFrame`, if there is one, returns false.
std::vector<double> runCpu(CpuProgram& program, std::size_t frames, const OnFrame& onFrame) {
    std::vector<double> ms;
    while (ms.size() < frames && !app::isInterrupted()) {
        const Clock::time_point start = Clock::now();
        program.step();
        ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        if (onFrame && !onFrame(program.positions())) break;
    }
    return ms;
}

} // namespace

double RunError::by(study::Scale scale) const {
    return scale == study::Scale::motion ? ofMotion.value_or(0) : ofBody;
}

Contest::Contest(Session& session, Session* single, const sim::Scene& scene, const study::Truth& truth)
    : session_(session), single_(single), scene_(scene), truth_(truth),
      threads_(std::max(1u, std::thread::hardware_concurrency())) {}

std::vector<Row> Contest::rows() const {
    std::vector<Row> rows{{"verlet", 1}};
    if (threads_ > 1) rows.push_back({"verlet", threads_});
    rows.push_back({"bullet", 1});
    if (hasJolt()) rows.push_back({"jolt", 1});
    if (hasJolt() && threads_ > 1) rows.push_back({"jolt", threads_});
    const bool isSoftware = session_.device.description().type == "software";
    for (const std::string& name : sim::solverNames()) {
        if (single_) rows.push_back({name, 1});
        rows.push_back({name, isSoftware ? driverThreads() : 0});
    }
    return rows;
}

std::vector<Variant> Contest::variantsOf(const std::string& program) const {
    if (program == "verlet" || program == "jolt") return {{}};
    if (program == "bullet") return {{}, {{}, 2}, {{}, 4}, {{}, 1, true}};
    sim::Solver solver{};
    sim::parseSolver(program, solver);
    constexpr std::uint32_t sweeps = 64; // has every split into substeps
    std::vector<Variant> variants;
    for (const sim::Settings& settings : study::settingsAt(solver, sweeps))
        if (sim::validate(scene_, settings).empty())
            variants.push_back({settings, settings.iterations, settings.substeps == 1});
    return variants;
}

sim::Forms Contest::formsOf(Session& session, const sim::Settings& settings) {
    const auto key = std::pair{static_cast<const Session*>(&session), settings.solver};
    if (!forms_.contains(key)) {
        sim::Settings probe = settings;
        probe.substeps = 8;
        probe.iterations = 1;
        forms_[key] = sim::tuned(session.device, session.queue, scene_, probe).forms;
    }
    return forms_[key];
}

std::vector<double> Contest::runDevice(Session& session, sim::Settings settings,
                                       const std::function<bool(Runner&)>& onFrame) {
    settings.forms = formsOf(session, settings);
    Runner runner(session, scene_, settings);
    while (runner.steps() < truth_.frames.size() && !app::isInterrupted() && !runner.divergence()) {
        runner.advance(1, 1);
        if (onFrame && !onFrame(runner)) break;
    }
    return runner.frameMs();
}

/// The session that runs a motion faster: the search uses it, since both give the same bits.
Session& Contest::quicker() {
    if (quicker_ || !single_) return quicker_ ? *quicker_ : session_;
    const auto median = [&](Session& session) {
        return summarise(runDevice(session, {.substeps = 8}, {})).value_or(Statistics{}).p50;
    };
    quicker_ = median(*single_) < median(session_) ? single_ : &session_;
    return *quicker_;
}

std::optional<RunError> Contest::errorOf(const std::string& program, const sim::Settings& settings,
                                         std::optional<double> enough, study::Scale scale) {
    const std::size_t frames = truth_.frames.size();
    // A run is given up once the squares of the frames so far exceed what all frames may have. With chaos in
    // sight, the number of frames that count is not known before the end.
    const double unit = scale == study::Scale::motion ? truth_.standingStill() : 1;
    const bool isCalm = enough && std::ranges::max(truth_.growth) < *enough * unit / 10;
    const double most = isCalm ? std::pow(*enough * unit, 2) * static_cast<double>(frames) : HUGE_VAL;
    double squares = 0;
    std::vector<double> frameRms;
    const auto add = [&](const study::Positions& x) {
        frameRms.push_back(study::distanceOf(truth_.frames[frameRms.size()], x).rms / truth_.bodySize);
        squares += frameRms.back() * frameRms.back();
        return std::isfinite(squares) && squares <= most;
    };
    if (const auto body = makeCpuProgram(program, scene_, settings, threads_)) {
        runCpu(*body, frames, add);
    } else {
        runDevice(quicker(), settings, [&](Runner& runner) {
            return runner.steps() > frameRms.size() && add(study::positionsOf(runner.readState()));
        });
    }
    if (frameRms.size() < frames || !std::isfinite(squares) || squares > most) return {};
    const std::size_t compared = study::comparableFrames(frameRms, truth_.growth, study::perturbation);
    RunError error{.ofBody = study::rmsOver(frameRms, compared)};
    if (const double still = truth_.standingStill(compared); still > 0) error.ofMotion = error.ofBody / still;
    return error;
}

std::vector<double> Contest::time(const Row& row, const sim::Settings& settings) {
    if (const auto body = makeCpuProgram(row.program, scene_, settings, row.threads))
        return runCpu(*body, truth_.frames.size(), {});
    return runDevice(single_ && row.threads == 1 ? *single_ : session_, settings, {});
}

} // namespace sinew::tools::peers
