// Small functions behind every figure of the study page; each has a test.
#include "sinew/study/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::tools::study {

std::vector<std::size_t> paretoFront(std::span<const Offer> offers) {
    std::vector<std::size_t> order(offers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return !offers[i].error; });
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        if (offers[a].cost != offers[b].cost) return offers[a].cost < offers[b].cost;
        return *offers[a].error < *offers[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || *offers[i].error < *offers[front.back()].error) front.push_back(i);
    return front;
}

std::optional<double> costOfError(std::span<const Offer> front, double error) {
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (*front[i].error > error) continue;
        if (i == 0) return front[0].cost;
        const Offer &before = front[i - 1], &after = front[i];
        const double share = std::log(*before.error / error) / std::log(*before.error / *after.error);
        return before.cost * std::pow(after.cost / before.cost, share);
    }
    return {};
}

double rmsOver(std::span<const double> frameRms, std::size_t frames) {
    double squares = 0;
    for (const double rms : frameRms.first(frames)) squares += rms * rms;
    return frames == 0 ? 0 : std::sqrt(squares / static_cast<double>(frames));
}

std::size_t comparableFrames(std::span<const double> frameRms, std::span<const double> growth,
                             double perturbation) {
    std::size_t frames = std::min(frameRms.size(), growth.size());
    // A shorter run has a smaller error, which may in turn require a shorter run.
    while (frames > 1) {
        const double limit = std::max(rmsOver(frameRms, frames) / 10, 10 * perturbation);
        const auto grown = std::ranges::find_if(growth.first(frames), [&](double g) { return g > limit; });
        const auto before = static_cast<std::size_t>(grown - growth.begin());
        if (before == frames) break;
        frames = std::max<std::size_t>(1, before);
    }
    return std::max<std::size_t>(frames, 1);
}

} // namespace sinew::tools::study
