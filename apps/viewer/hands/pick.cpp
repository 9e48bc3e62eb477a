// Every triangle and every ball in turn: a click is rare, and a hundred thousand triangles take a millisecond
// or two.
#include "viewer/hands/pick.hpp"

#include "sim/compile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::viewer {

namespace {

constexpr float none = std::numeric_limits<float>::infinity();

Vector3 placeOf(const sim::layout::vec4& v) {
    return {v.x, v.y, v.z};
}

// Where along a ray something is seen; from `from` on, what a section has opened.
struct Seen {
    float from = 0, to = none;
    bool isOpened = false;
};

Seen seenOf(const Ray& ray, const std::optional<Opened>& opened) {
    if (!opened) return {};
    const Section& section = opened->section;
    const float height = section.normal.dot(ray.origin) - section.offset;
    const float approach = -section.normal.dot(ray.direction);
    if (height <= 0) return {.to = approach < 0 ? height / approach : none};
    return {.from = approach > 0 ? height / approach : none, .isOpened = true};
}

// Along the ray, from in front or behind (Moller and Trumbore 1997); `none` where it misses. `isBack`: from
// behind.
float meetsTriangle(const Ray& ray, const Vector3& a, const Vector3& b, const Vector3& c, bool& isBack) {
    const Vector3 ab = b - a, ac = c - a, p = ray.direction.cross(ac);
    const float volume = ab.dot(p);
    if (volume == 0) return none;
    isBack = volume < 0;
    const Vector3 from = ray.origin - a, q = from.cross(ab);
    const float u = from.dot(p) / volume, v = ray.direction.dot(q) / volume, t = ac.dot(q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : none;
}

float meetsBall(const Ray& ray, const Vector3& center, float radius, const Seen& seen) {
    const Vector3 from = ray.origin - center;
    const float along = -from.dot(ray.direction);
    const float apart = (from + along * ray.direction).squaredNorm();
    if (!(apart <= radius * radius)) return none;
    const float half = std::sqrt(radius * radius - apart), t = along - half;
    if (seen.isOpened && t <= seen.from && along + half > seen.from) return seen.from;
    return t > seen.from && t <= seen.to ? t : none;
}

// Of a skin's triangle, all particles that hold its corners.
void addHolders(const sim::Skin& skin, const std::array<std::uint32_t, 3>& triangle,
                std::vector<std::uint32_t>& holders) {
    for (const std::uint32_t corner : triangle)
        if (skin.cells.empty())
            holders.push_back(skin.particles[corner]);
        else
            holders.insert(holders.end(), skin.cells[corner].particles.begin(),
                           skin.cells[corner].particles.end());
}

struct Nearest {
    float distance = none;
    std::vector<std::uint32_t> holders;
};

// Of the body that a skin is of: what is laid open lies between them.
void addBody(const sim::Scene& scene, const sim::Skin& skin, std::vector<std::uint32_t>& holders) {
    const std::uint32_t one = skin.cells.empty() ? skin.particles[0] : skin.cells[0].particles[0];
    for (const sim::Body& body : scene.bodies)
        if (one - body.firstParticle < body.particleCount)
            for (std::uint32_t i = 0; i < body.particleCount; ++i) holders.push_back(body.firstParticle + i);
}

void lookAtSkin(const sim::Skin& skin, bool isWhole, const Ray& ray,
                std::span<const sim::layout::SkinVertex> vertices, const Seen& seen, Nearest& nearest,
                int& winding) {
    const bool isDrawnWhole = isWhole && !skin.wholeTriangles.empty();
    for (const auto& triangle : isDrawnWhole ? skin.wholeTriangles : skin.triangles) {
        const auto corner = [&](std::size_t i) { return placeOf(vertices[triangle[i]].position); };
        bool isBack = false;
        const float distance = meetsTriangle(ray, corner(0), corner(1), corner(2), isBack);
        if (distance == none || distance < seen.from || distance > seen.to) continue;
        winding += isBack ? 1 : -1;
        if (distance >= nearest.distance) continue;
        nearest.distance = distance;
        nearest.holders.clear();
        addHolders(skin, triangle, nearest.holders);
    }
}

void lookAtSkins(const sim::Scene& scene, const Ray& ray, const SeenState& state, const Seen& seen,
                 const std::optional<Opened>& opened, Nearest& nearest) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < scene.skins.size(); ++i) {
        const sim::Skin& skin = scene.skins[i];
        int winding = 0; // around where the ray enters what is left
        lookAtSkin(skin, state.isWhole, ray, state.vertices.subspan(first, skin.vertexCount()), seen, nearest,
                   winding);
        first += skin.vertexCount();
        if (!seen.isOpened || seen.from == none || winding == 0 || !opened->isClosed[i]) continue;
        nearest = {seen.from, {}};
        addBody(scene, skin, nearest.holders);
    }
}

void lookAtBalls(const BallList& balls, const Ray& ray, std::span<const sim::layout::vec4> positions,
                 const Seen& seen, Nearest& nearest) {
    for (const BallRange& range : balls.ranges)
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            const float distance = meetsBall(ray, placeOf(positions[i]), balls.radii[i], seen);
            if (distance < nearest.distance) nearest = {distance, {i}};
        }
}

} // namespace

std::optional<Pick> pick(const sim::Scene& scene, const BallList& balls, const Ray& ray,
                         const SeenState& state, Among among, const std::optional<Opened>& opened) {
    const Seen seen = seenOf(ray, opened);
    Nearest nearest;
    if (!state.vertices.empty()) lookAtSkins(scene, ray, state, seen, opened, nearest);
    lookAtBalls(balls, ray, state.positions, seen, nearest);
    if (nearest.distance == none) return std::nullopt;
    const Vector3 point = ray.origin + nearest.distance * ray.direction;
    if (among == Among::moving) {
        const std::vector<float> inverseMass = sim::inverseMasses(scene);
        std::erase_if(nearest.holders, [&](std::uint32_t i) { return inverseMass[i] == 0; });
    }
    if (nearest.holders.empty()) return std::nullopt;
    const auto apart = [&](std::uint32_t i) { return (placeOf(state.positions[i]) - point).squaredNorm(); };
    const std::uint32_t particle =
        *std::ranges::min_element(nearest.holders, {}, [&](std::uint32_t i) { return apart(i); });
    return Pick{particle, point, point - placeOf(state.positions[particle]), nearest.distance};
}

sim::Body bodyOf(const sim::Scene& scene, std::uint32_t particle) {
    const auto holds = [&](const sim::Body& body) {
        return particle - body.firstParticle < body.particleCount;
    };
    const auto found = std::ranges::find_if(scene.bodies, holds);
    return found == scene.bodies.end() ? sim::Body{} : *found;
}

float holdRadius(const sim::Scene& scene, std::uint32_t particle) {
    float next = none;
    for (const sim::DistanceConstraint& link : scene.distances)
        if ((link.a == particle || link.b == particle) && link.restLength > 0)
            next = std::min(next, link.restLength);
    if (next == none) return 0; // it alone
    Box box;
    for (const sim::Body& body : scene.bodies)
        if (particle - body.firstParticle < body.particleCount)
            for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
                const sim::Vec3& x = scene.particles[i].position;
                box.extend(Vector3(x.x, x.y, x.z));
            }
    const float size = box.isEmpty() ? 0 : box.diagonal().norm();
    return std::max(size / 8, 1.5f * next);
}

} // namespace sinew::viewer
