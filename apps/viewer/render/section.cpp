// Section planes, and tests for closed skins.
#include "viewer/render/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace sinew::viewer {

namespace {

constexpr float notchesAcross = 50;

Section through(const Vector3& normal, const Vector3& point) {
    return {normal, normal.dot(point)};
}

using Place = std::tuple<float, float, float>;

std::vector<Place> placesOf(const sim::Scene& scene, const sim::Skin& skin) {
    const auto particlePlace = [&](std::uint32_t particle) {
        const sim::Vec3& x = scene.particles[particle].position;
        return Place{x.x, x.y, x.z};
    };
    const auto cellPlace = [&](const sim::CellEmbedding& cell) {
        std::array<double, 3> sum{};
        for (unsigned k = 0; k < 8; ++k) {
            const auto share = [&](unsigned axis, float weight) {
                return double{(k >> axis & 1u) != 0 ? weight : 1 - weight};
            };
            const double part =
                share(0, cell.weights.x) * share(1, cell.weights.y) * share(2, cell.weights.z);
            const sim::Vec3& x = scene.particles[cell.particles[k]].position;
            sum[0] += part * double{x.x};
            sum[1] += part * double{x.y};
            sum[2] += part * double{x.z};
        }
        return Place{static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
    };
    std::vector<Place> places;
    for (const std::uint32_t particle : skin.particles) places.push_back(particlePlace(particle));
    for (const sim::CellEmbedding& cell : skin.cells) places.push_back(cellPlace(cell));
    return places;
}

// One number for each place: vertices at the same place share it.
std::vector<std::uint32_t> weldedVertices(const std::vector<Place>& places) {
    std::vector<std::uint32_t> order(places.size()), welded(places.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return places[i]; });
    for (std::size_t i = 0; i < order.size(); ++i)
        welded[order[i]] =
            i > 0 && places[order[i]] == places[order[i - 1]] ? welded[order[i - 1]] : order[i];
    return welded;
}

bool isClosed(const sim::Scene& scene, const sim::Skin& skin) {
    const std::vector<std::uint32_t> welded = weldedVertices(placesOf(scene, skin));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> forwards, backwards;
    for (const auto& triangle : skin.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = welded[triangle[i]], b = welded[triangle[(i + 1) % 3]];
            if (a == b) continue;
            forwards.emplace_back(a, b);
            backwards.emplace_back(b, a);
        }
    std::ranges::sort(forwards);
    std::ranges::sort(backwards);
    return !forwards.empty() && forwards == backwards;
}

// Six times the signed volume: the sum of the tetrahedra between the triangles and the first vertex.
double volumeOf(const sim::Scene& scene, const sim::Skin& skin) {
    const std::vector<Place> places = placesOf(scene, skin);
    const auto at = [&](std::uint32_t vertex) {
        const auto& [x, y, z] = places[vertex];
        return Eigen::Vector3d(double{x}, double{y}, double{z});
    };
    double volume = 0;
    for (const auto& [a, b, c] : skin.triangles)
        volume += (at(a) - at(0)).cross(at(b) - at(0)).dot(at(c) - at(0));
    return volume;
}

} // namespace

Section sectionFacing(const Camera& camera) {
    return through((eye(camera) - camera.target).normalized(), camera.target);
}

Section sectionAcross(const Camera& camera) {
    const Vector3 away = eye(camera) - camera.target;
    Eigen::Index axis = 0;
    away.cwiseAbs().maxCoeff(&axis);
    return through(std::copysign(1.0f, away[axis]) * Vector3::Unit(axis), camera.target);
}

Section turned(const Section& section, const Vector3& point) {
    Eigen::Index axis = 0;
    section.normal.cwiseAbs().maxCoeff(&axis);
    const bool isLast = axis == 2, isBackwards = section.normal[axis] < 0;
    const Vector3 next = Vector3::Unit(isLast ? 0 : axis + 1);
    return through(isBackwards != isLast ? Vector3(-next) : next, point);
}

Reach reachOf(const Section& section, const Box& bounds) {
    const float middle = section.normal.dot(bounds.center());
    const float half = 0.5f * section.normal.cwiseAbs().dot(bounds.sizes());
    return {middle - half, middle + half};
}

Section moved(Section section, float notches, const Box& bounds) {
    const auto [low, high] = reachOf(section, bounds);
    section.offset = std::clamp(section.offset + notches * (high - low) / notchesAcross, low, high);
    return section;
}

bool isCutAway(const Section& section, const Vector3& point) {
    return section.normal.dot(point) > section.offset;
}

std::vector<bool> closedSkins(const sim::Scene& scene) {
    std::vector<bool> closed;
    for (const sim::Skin& skin : scene.skins) closed.push_back(isClosed(scene, skin));
    return closed;
}

std::vector<bool> outwardSkins(const sim::Scene& scene) {
    std::vector<bool> outward = closedSkins(scene);
    for (std::size_t i = 0; i < outward.size(); ++i)
        outward[i] = outward[i] && volumeOf(scene, scene.skins[i]) > 0;
    return outward;
}

} // namespace sinew::viewer
