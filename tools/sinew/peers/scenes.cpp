#include "sinew/peers/scenes.hpp"

#include "app/guard.hpp"
#include "scenes/load.hpp"
#include "sim/reference/elasticity.hpp"
#include "sim/reference/trajectory.hpp"
#include "sinew/bodies.hpp"
#include "sinew/native/verlet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::tools::peers {

namespace {

/// A cloth of 1 m held at two corners.
sim::Scene cloth(std::uint32_t side) {
    sim::Scene scene{.name = fmt::format("cloth {0}x{0}", side)};
    sim::addCloth(scene, {.origin = {-0.5f, 0, -0.5f},
                          .size = {side, side},
                          .spacing = 1.0f / static_cast<float>(side - 1),
                          .stretchCompliance = 1e-3f,
                          .shearCompliance = 1e-2f,
                          .skipStiffness = 10,
                          .pinned = {0, side - 1}});
    return scene;
}

/// A cube fixed to the ground: a drop would add contacts, in which engines differ for other reasons.
sim::Scene cube(std::uint32_t side) {
    sim::Scene scene{.name = fmt::format("cube {0}x{0}x{0}", side)};
    const sim::Lattice lattice{
        .name = "cube", .cells = {side - 1, side - 1, side - 1}, .spacing = 0.02f, .youngModulus = 1e5f};
    const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
    for (std::uint32_t k = 0; k < side; ++k)
        for (std::uint32_t i = 0; i < side; ++i) scene.fixed.push_back({corners.at(i, 0, k)});
    return scene;
}

constexpr PeerScene scenes[] = {{"cloth", [] { return cloth(64); }, 18, 5},
                                {"cloth", [] { return cloth(128); }, 18, 7},
                                {"cube", [] { return cube(16); }, 18, 4},
                                {"cube", [] { return cube(32); }, 18, 8},
                                {"cube", [] { return cube(64); }, 6, 12},
                                {"beam", [] { return scenes::loadBuiltIn("beam").scene; }, 18, 2},
                                {"chain", [] { return scenes::loadBuiltIn("chain").scene; }, 18, 1}};

std::vector<study::Positions> motion(const sim::Scene& scene, std::uint32_t frames, std::uint32_t substeps) {
    native::Verlet<double> verlet(scene, substeps, std::max(1u, std::thread::hardware_concurrency()));
    std::vector<study::Positions> result;
    while (result.size() < frames && !app::isInterrupted()) {
        verlet.step();
        study::Positions& positions = result.emplace_back();
        for (std::size_t i = 0; i < verlet.size(); ++i) {
            const std::array<double, 3> x = verlet.position(i);
            positions.emplace_back(x[0], x[1], x[2]);
        }
    }
    return result;
}

/// RMS distance of each frame by `size`.
std::vector<double> distances(const std::vector<study::Positions>& a, const std::vector<study::Positions>& b,
                              double size) {
    std::vector<double> result;
    for (std::size_t f = 0; f < std::min(a.size(), b.size()); ++f)
        result.push_back(study::distanceOf(a[f], b[f]).rms / size);
    return result;
}

} // namespace

std::span<const PeerScene> peerScenes() {
    return scenes;
}

study::Truth truthOf(const sim::Scene& scene, std::uint32_t frames) {
    constexpr int mostHalvings = 3;
    constexpr double accepted = 1e-4; // of the motion
    const sim::reference::Problem problem(scene);
    auto substeps = static_cast<std::uint32_t>(
        std::ceil(double{scene.dt} * sim::reference::largestFrequency(problem) / 0.4));
    study::Truth truth{.bodySize = sim::reference::bodySize(scene)};
    std::vector<study::Positions> coarse = motion(scene, frames, substeps);
    truth.growth = distances(
        coarse, motion(study::disturbed(scene, study::perturbation * truth.bodySize), frames, substeps),
        truth.bodySize);
    const std::vector<study::Positions> start(frames, study::startOf(scene));
    for (int halving = 0; halving < mostHalvings; ++halving) {
        substeps *= 2;
        truth.frames = motion(scene, frames, substeps);
        truth.h = double{scene.dt} / substeps;
        truth.motion = distances(truth.frames, start, truth.bodySize);
        const std::vector<double> change = distances(truth.frames, coarse, truth.bodySize);
        truth.selfDifference = change.empty() ? 0 : *std::ranges::max_element(change);
        if (app::isInterrupted() || truth.selfDifference <= accepted * truth.standingStill()) return truth;
        coarse = std::move(truth.frames);
    }
    throw app::Failure(
        app::badInput,
        fmt::format("cannot compare: {}: its motion still changes by {:.1g} of the body's size "
                    "when steps of {:.3g} us are halved",
                    scene.name, truth.selfDifference, 2e6 * truth.h));
}

} // namespace sinew::tools::peers
