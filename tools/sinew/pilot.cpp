#include "sinew/pilot.hpp"

#include "app/guard.hpp"
#include "sinew/ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::tools {

namespace {

const auto mostSubsteps = static_cast<std::uint32_t>(sim::ranges::substeps.high);

double rmsBetween(const std::vector<study::Positions>& a, const std::vector<study::Positions>& b) {
    double squares = 0;
    for (std::size_t f = 0; f < a.size(); ++f) squares += std::pow(study::distanceOf(a[f], b[f]).rms, 2);
    return std::sqrt(squares / static_cast<double>(a.size()));
}

} // namespace

std::optional<Richardson> extrapolate(double coarseDifference, double fineDifference) {
    if (!(fineDifference <= 0.75 * coarseDifference)) return {};
    if (fineDifference == 0) return Richardson{HUGE_VAL, 0};
    const double ratio = coarseDifference / fineDifference;
    return Richardson{std::log2(ratio), fineDifference / (ratio - 1)};
}

Pilot::Pilot(Session& session, const scenes::LoadedScene& loaded, std::uint32_t steps)
    : session_(session), loaded_(loaded), steps_(steps) {}

const Pilot::Motion& Pilot::motion(std::uint32_t substeps) {
    if (motions_.contains(substeps)) return motions_[substeps];
    Motion& motion = motions_[substeps];
    fmt::print(stderr, "pilot run: {} steps with {} substeps\n", steps_, substeps);
    sim::Settings settings = loaded_.settings;
    settings.substeps = substeps;
    Runner runner(session_, loaded_.scene, settings, {loaded_.blades, loaded_.scene.dt});
    while (runner.steps() < steps_ && !runner.divergence() && !app::isInterrupted()) {
        runner.advance(1, 1);
        if (runner.steps() > motion.frames.size())
            motion.frames.push_back(study::positionsOf(runner.readState()));
    }
    motion.isWhole = motion.frames.size() == steps_;
    return motion;
}

std::optional<double> Pilot::difference(std::uint32_t a, std::uint32_t b) {
    const Motion &first = motion(a), &second = motion(b);
    if (!first.isWhole || !second.isWhole) return {};
    return rmsBetween(first.frames, second.frames);
}

std::optional<double> Pilot::moved(std::uint32_t substeps) {
    const Motion& run = motion(substeps);
    if (!run.isWhole) return {};
    const double distance =
        rmsBetween(run.frames, std::vector(run.frames.size(), study::startOf(loaded_.scene)));
    return distance > 0 ? std::optional(distance) : std::nullopt;
}

std::optional<ErrorEstimate> Pilot::estimateOf(std::uint32_t chosen, std::uint32_t finest) {
    const auto coarse = difference(finest / 4, finest / 2), fine = difference(finest / 2, finest);
    const auto motion = moved(finest);
    const auto own = chosen == finest ? fine : difference(chosen, finest);
    if (!coarse || !fine || !motion || !own) return {};
    ErrorEstimate result{.steps = steps_,
                         .substeps = {finest / 4, finest / 2, finest},
                         .chosen = chosen,
                         .difference = *own / *motion};
    if (const auto limit = extrapolate(*coarse, *fine)) {
        const double size = study::largestBody(loaded_.scene);
        const double error = chosen == finest ? limit->finest : *own + limit->finest;
        result.order = limit->order;
        result.ofMotion = error / *motion;
        if (size > 0) result.ofBody = error / size;
    }
    return result;
}

std::optional<ErrorEstimate> Pilot::estimate(std::uint32_t substeps) {
    const std::uint32_t factor = substeps % 2 == 0 ? 2 : 4;
    if (factor * substeps > mostSubsteps) return estimateOf(substeps / 4 * 4, substeps / 4 * 4);
    for (std::uint32_t finest = factor * substeps;; finest *= 2) {
        std::optional<ErrorEstimate> result = estimateOf(substeps, finest);
        if (!result || result->ofMotion || 2 * finest > mostSubsteps || finest > 8 * substeps) return result;
    }
}

std::optional<ErrorEstimate> Pilot::find(double error) {
    std::uint32_t finest = 4;
    std::optional<ErrorEstimate> limit;
    for (;; finest *= 2) {
        if (finest > mostSubsteps || app::isInterrupted()) return {};
        if (motion(finest).isWhole && !moved(finest)) return {}; // nothing moves
        limit = estimateOf(finest, finest);
        if (limit && limit->ofMotion && *limit->ofMotion <= error / 4) break;
    }
    std::optional<ErrorEstimate> best = limit;
    std::uint32_t low = 0; // misses the error
    while (best->chosen - low > std::max(1u, best->chosen / 16)) {
        // First the numbers that have run, by halves; then those between.
        const std::uint32_t middle = low == 0 ? best->chosen / 2 : (low + best->chosen) / 2;
        const auto tried = estimateOf(middle, finest);
        if (app::isInterrupted()) return {};
        if (tried && tried->ofMotion && *tried->ofMotion <= error)
            best = tried;
        else
            low = middle;
    }
    return best;
}

std::string toText(const ErrorEstimate& e) {
    const std::string runs = fmt::format("measured over {} steps: {} and {} substeps differ by {:.2g} %",
                                         e.steps, e.chosen == e.substeps.back() ? e.substeps[1] : e.chosen,
                                         e.substeps.back(), 100 * e.difference);
    if (!e.ofMotion) return fmt::format("not known: {} of the motion, and half as many by no less", runs);
    const std::string body = e.ofBody ? fmt::format(" ({:.2g} % of the largest body)", 100 * *e.ofBody) : "";
    return fmt::format("about {:.2g} % of the motion{}, estimated with order {:.2g}; {}", 100 * *e.ofMotion,
                       body, std::min(*e.order, 99.0), runs);
}

} // namespace sinew::tools
