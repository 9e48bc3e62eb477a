// Each plane is a large rectangle, clipped by the others and by the sides of a box.
#include "viewer/render/walls.hpp"

#include "viewer/render/mesh_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::viewer {

namespace {

constexpr float level = 0.9999f;    // of the vertical part of a normal: floors and lids are no walls
constexpr float packing = 0.6f;     // share of the room that bodies at rest fill
constexpr float freeHeight = 1.4f;  // height of walls / height that bodies at rest fill
constexpr float lowest = 0.2f;      // least height of walls / width of the ground
constexpr float barShare = 0.0013f; // half the width of a bar / diagonal of the region

using Polygon = std::vector<Vector3>;

struct HalfSpace {
    Vector3 normal; // into the half space that is kept
    float offset;
};

HalfSpace halfSpaceOf(const sim::Plane& plane) {
    return {{plane.normal.x, plane.normal.y, plane.normal.z}, plane.offset};
}

bool isLevel(const sim::Plane& plane) {
    return std::abs(plane.normal.y) > level;
}

Polygon clipped(const Polygon& polygon, const HalfSpace& by) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const float inA = by.normal.dot(a) - by.offset, inB = by.normal.dot(b) - by.offset;
        if (inA >= 0) kept.push_back(a);
        if ((inA >= 0) != (inB >= 0)) kept.push_back(a + inA / (inA - inB) * (b - a));
    }
    return kept;
}

std::array<HalfSpace, 6> sidesOf(const Box& box) {
    std::array<HalfSpace, 6> sides;
    for (int axis = 0; axis < 3; ++axis) {
        sides[static_cast<std::size_t>(2 * axis)] = {Vector3::Unit(axis), box.min()[axis]};
        sides[static_cast<std::size_t>(2 * axis + 1)] = {-Vector3::Unit(axis), -box.max()[axis]};
    }
    return sides;
}

// The part of a plane inside `box` and in front of the other planes, counter-clockwise seen from its free
// side.
Polygon sideOf(const sim::Scene& scene, const sim::Plane& plane, const Box& box) {
    const HalfSpace own = halfSpaceOf(plane);
    const Vector3 u = own.normal.unitOrthogonal(), v = own.normal.cross(u);
    const Vector3 middle = box.center() + (own.offset - own.normal.dot(box.center())) * own.normal;
    const float reach = 2 * box.diagonal().norm();
    Polygon side{middle + reach * (-u - v), middle + reach * (u - v), middle + reach * (u + v),
                 middle + reach * (v - u)};
    for (const HalfSpace& by : sidesOf(box)) side = clipped(side, by);
    for (const sim::Plane& other : scene.planes)
        if (&other != &plane) side = clipped(side, halfSpaceOf(other));
    return side.size() < 3 ? Polygon() : side;
}

float areaOf(const Polygon& polygon) {
    Vector3 twice = Vector3::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i)
        twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
    return 0.5f * twice.norm();
}

// The volume of bodies and of loose balls.
float volumeOf(const sim::Scene& scene) {
    float volume = 0;
    for (const sim::Body& body : scene.bodies) {
        volume += body.restVolume;
        if (body.restVolume > 0) continue;
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
            volume += 4 * std::numbers::pi_v<float> / 3 * std::pow(scene.particles[i].radius, 3.0f);
    }
    return volume;
}

// Height at which walls end.
float topOf(const sim::Scene& scene, const Box& region) {
    const float floor = groundHeight(scene).value_or(region.min().y());
    Polygon ground{{region.min().x(), floor, region.min().z()},
                   {region.min().x(), floor, region.max().z()},
                   {region.max().x(), floor, region.max().z()},
                   {region.max().x(), floor, region.min().z()}};
    for (const sim::Plane& plane : scene.planes)
        if (!isLevel(plane)) ground = clipped(ground, halfSpaceOf(plane));
    const float area = std::max(areaOf(ground), 1e-9f);
    const float filled = freeHeight * volumeOf(scene) / (packing * area);
    return std::min(floor + std::max(filled, lowest * std::sqrt(area)),
                    std::max(particleBounds(scene).max().y(), floor + 1e-3f));
}

// Twice as wide as the region: bodies need not start near the walls.
Box around(const Box& region) {
    const Vector3 aside(0.5f * region.sizes().x(), 0, 0.5f * region.sizes().z());
    return Box(Vector3(region.min() - aside), Vector3(region.max() + aside));
}

void addSide(ColliderMesh& mesh, const Polygon& side, const Vector3& normal) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vector3& x : side)
        mesh.vertices.push_back({{x.x(), x.y(), x.z(), 1}, {normal.x(), normal.y(), normal.z(), 0}});
    for (std::uint32_t i = 2; i < side.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
}

// A square bar, a little longer than the edge, so that bars meet in corners.
void addBar(ColliderMesh& mesh, const Vector3& from, const Vector3& to, float half) {
    if ((to - from).norm() < 1e-6f) return;
    const Vector3 w = (to - from).normalized(), u = w.unitOrthogonal(), v = w.cross(u);
    const Vector3 middle = 0.5f * (from + to), along = (0.5f * (to - from).norm() + half) * w;
    const std::array axes{Vector3(half * u), Vector3(half * v), along};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            const Vector3 out = sign * axes[axis], a = axes[(axis + 1) % 3], b = sign * axes[(axis + 2) % 3];
            addSide(mesh,
                    {middle + out - a - b, middle + out + a - b, middle + out + a + b, middle + out - a + b},
                    out.normalized());
        }
}

} // namespace

WallMesh wallsOf(const sim::Scene& scene, const Box& region) {
    WallMesh mesh;
    if (std::ranges::all_of(scene.planes, isLevel)) return mesh;
    Box box = around(region);
    box.max().y() = topOf(scene, box);
    const float half = barShare * region.diagonal().norm();
    for (const sim::Plane& plane : scene.planes) {
        if (isLevel(plane)) continue;
        const Polygon side = sideOf(scene, plane, box);
        if (side.empty()) continue;
        addSide(mesh.sides, side, halfSpaceOf(plane).normal);
        for (std::size_t i = 0; i < side.size(); ++i)
            addBar(mesh.bars, side[i], side[(i + 1) % side.size()], half);
    }
    return mesh;
}

Walls::Walls(const vk::Device& device, const WallMesh& mesh) {
    if (mesh.isEmpty()) return;
    ColliderMesh all = mesh.bars;
    bars_ = {0, static_cast<std::uint32_t>(all.indices.size()), 0};
    sides_ = {bars_.indexCount, static_cast<std::uint32_t>(mesh.sides.indices.size()),
              static_cast<std::int32_t>(all.vertices.size())};
    all.vertices.insert(all.vertices.end(), mesh.sides.vertices.begin(), mesh.sides.vertices.end());
    all.indices.insert(all.indices.end(), mesh.sides.indices.begin(), mesh.sides.indices.end());
    vertices_ = filledBuffer(device, "walls.vertices", all.vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices_ = filledBuffer(device, "walls.indices", all.indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
}

} // namespace sinew::viewer
