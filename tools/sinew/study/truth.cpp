// Both kinds of truth run a second time from a start disturbed by a hash of the index.
#include "sinew/study/truth.hpp"

#include "app/guard.hpp"
#include "app/progress.hpp"
#include "sim/reference/trajectory.hpp"
#include "sinew/study/analysis.hpp"
#include "sinew/validate.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::tools::study {

namespace {

namespace reference = sim::reference;

[[noreturn]] void refuse(const StudyScene& scene, const std::string& why) {
    throw app::Failure(app::badInput, "cannot study " + scene.name + ": " + why);
}

/// RMS difference of each frame that both have, divided by `size`.
std::vector<double> differences(const std::vector<Positions>& a, const std::vector<Positions>& b,
                                double size) {
    std::vector<double> result;
    for (std::size_t f = 0; f < std::min(a.size(), b.size()); ++f)
        result.push_back(distanceOf(a[f], b[f]).rms / size);
    return result;
}

reference::Trajectory trajectory(const StudyScene& scene, double disturbance) {
    try {
        return reference::trueTrajectory(
            scene.loaded.scene,
            {.frames = scene.frames, .dt = double{scene.loaded.scene.dt}, .perturbation = disturbance});
    } catch (const std::invalid_argument& error) {
        refuse(scene, error.what() + std::string(": use a scene of elastic bodies without damping, or one "
                                                 "with contacts"));
    } catch (const std::runtime_error& error) {
        refuse(scene, error.what() + std::string(": use fewer --frames"));
    }
}

Truth elasticTruth(const StudyScene& scene) {
    const double size = reference::bodySize(scene.loaded.scene);
    reference::Trajectory truth = trajectory(scene, 0);
    const reference::Trajectory disturbed = trajectory(scene, perturbation);
    return {.bodySize = size,
            .h = truth.h,
            .selfDifference = truth.selfDifference,
            .growth = differences(truth.frames, disturbed.frames, size),
            .halving = {},
            .motion = {},
            .frames = std::move(truth.frames)};
}

std::vector<Positions> smallSteps(Session& session, const StudyScene& study, const sim::Scene& scene,
                                  std::uint32_t substeps, const std::function<void()>& onFrame) {
    sim::Settings settings = settingsOfContacts(study, {.solver = sim::Solver::split, .substeps = substeps});
    const std::vector<std::string> complaints = sim::validate(scene, settings);
    if (!complaints.empty()) refuse(study, complaints.front());
    Runner runner(session, scene, settings);
    std::vector<Positions> frames;
    while (frames.size() < study.frames && !app::isInterrupted()) {
        runner.advance(1, 1);
        if (runner.divergence())
            refuse(study, fmt::format("it diverges with {} substeps: use fewer --frames", substeps));
        if (runner.steps() > frames.size()) frames.push_back(positionsOf(runner.readState()));
        onFrame();
    }
    return frames;
}

Truth contactTruth(Session& session, const StudyScene& study) {
    const sim::Scene& scene = study.loaded.scene;
    const double size = largestBody(scene) > 0 ? largestBody(scene) : 1;
    app::Progress progress(3 * std::uint64_t{study.frames}, stderr, "frames");
    std::uint64_t done = 0;
    const auto onFrame = [&] { progress.update(++done); };
    std::vector<Positions> truth = smallSteps(session, study, scene, truthSubsteps, onFrame);
    const auto coarse = smallSteps(session, study, scene, truthSubsteps / 2, onFrame);
    const auto other =
        smallSteps(session, study, disturbed(scene, perturbation * size), truthSubsteps, onFrame);
    Truth result{.bodySize = size,
                 .h = double{scene.dt} / truthSubsteps,
                 .growth = differences(truth, other, size),
                 .halving = differences(truth, coarse, size),
                 .motion = {},
                 .frames = std::move(truth)};
    result.selfDifference = rmsOver(result.halving, result.halving.size());
    return result;
}

/// RMS distance of each frame from `start`, divided by `size`.
std::vector<double> motionFrom(const Positions& start, const std::vector<Positions>& frames, double size) {
    std::vector<double> result;
    for (const Positions& frame : frames) result.push_back(distanceOf(frame, start).rms / size);
    return result;
}

} // namespace

sim::Scene disturbed(sim::Scene scene, double most) {
    std::uint32_t state = 0x9e3779b9u;
    const auto offset = [&] {
        state ^= state << 13, state ^= state >> 17, state ^= state << 5;
        return static_cast<float>(most * (2.0 * state / 4294967295.0 - 1));
    };
    for (sim::Particle& particle : scene.particles) {
        const sim::Vec3 off{offset(), offset(), offset()};
        if (particle.inverseMass == 0) continue;
        particle.position = {particle.position.x + off.x, particle.position.y + off.y,
                             particle.position.z + off.z};
    }
    return scene;
}

Positions positionsOf(const State& state) {
    Positions positions;
    positions.reserve(state.positions.size());
    for (const auto& x : state.positions) positions.emplace_back(double{x[0]}, double{x[1]}, double{x[2]});
    return positions;
}

Distance distanceOf(const Positions& a, const Positions& b) {
    Distance result;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double square = (a[i] - b[i]).squaredNorm();
        result.rms += square;
        result.max = std::max(result.max, square);
    }
    result.rms = std::sqrt(result.rms / static_cast<double>(a.size()));
    result.max = std::sqrt(result.max);
    return result;
}

Positions startOf(const sim::Scene& scene) {
    Positions positions;
    positions.reserve(scene.particles.size());
    for (const sim::Particle& p : scene.particles)
        positions.emplace_back(double{p.position.x}, double{p.position.y}, double{p.position.z});
    return positions;
}

double Truth::standingStill(std::size_t count) const {
    return rmsOver(motion, std::min(count, motion.size()));
}

std::vector<double> Truth::doubt() const {
    std::vector<double> result = growth;
    for (std::size_t f = 0; f < std::min(growth.size(), halving.size()); ++f)
        result[f] = std::max(growth[f], halving[f]);
    return result;
}

std::size_t comparableFrames(std::span<const double> frameRms, const Truth& truth) {
    if (truth.halving.empty()) return comparableFrames(frameRms, truth.growth, perturbation);
    const std::vector<double> doubt = truth.doubt();
    const auto end = std::ranges::find_if(doubt, [](double d) { return d > targetError / 10; });
    const auto frames = static_cast<std::size_t>(end - doubt.begin());
    return std::clamp<std::size_t>(std::min(frames, frameRms.size()), 1,
                                   std::max<std::size_t>(frameRms.size(), 1));
}

std::size_t framesAtTarget(const Truth& truth) {
    return comparableFrames(std::vector<double>(truth.growth.size(), targetError), truth);
}

double largestBody(const sim::Scene& scene) {
    std::vector<std::uint32_t> root(scene.particles.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto rootOf = [&](std::uint32_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const sim::DistanceConstraint& d : scene.distances)
        root[std::max(rootOf(d.a), rootOf(d.b))] = std::min(rootOf(d.a), rootOf(d.b));
    std::vector<Eigen::AlignedBox3d> boxes(root.size());
    for (std::uint32_t i = 0; i < root.size(); ++i) {
        const sim::Particle& p = scene.particles[i];
        if (p.inverseMass == 0) continue; // fixed: a collider or a pinned particle
        const Eigen::Vector3d x(double{p.position.x}, double{p.position.y}, double{p.position.z});
        const Eigen::Vector3d reach = Eigen::Vector3d::Constant(double{p.radius} / std::sqrt(3.0));
        boxes[rootOf(i)].extend(x - reach).extend(x + reach);
    }
    double largest = 0;
    for (const Eigen::AlignedBox3d& box : boxes)
        if (!box.isEmpty()) largest = std::max(largest, box.diagonal().norm());
    return largest;
}

Truth truthOf(Session& session, const StudyScene& scene) {
    if (!scene.loaded.blades.empty()) refuse(scene, "it has a [[blade]], and cutting is not studied");
    Truth truth = isOfContacts(scene.loaded.scene) ? contactTruth(session, scene) : elasticTruth(scene);
    truth.motion = motionFrom(startOf(scene.loaded.scene), truth.frames, truth.bodySize);
    return truth;
}

} // namespace sinew::tools::study
