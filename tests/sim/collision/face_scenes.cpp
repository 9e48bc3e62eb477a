#include "sim/collision/face_scenes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sinew::sim;
using Eigen::Vector3d;

namespace sinew::test {

namespace {

// A sphere of triangles with `rings` rings from pole to pole.
MeshCollider sphere(float size, std::uint32_t rings) {
    MeshCollider mesh{.name = "ball", .thickness = 0.005f};
    const std::uint32_t around = 2 * rings;
    for (std::uint32_t r = 0; r <= rings; ++r)
        for (std::uint32_t s = 0; s < around; ++s) {
            const double theta = std::numbers::pi * r / rings, phi = 2 * std::numbers::pi * s / around;
            mesh.vertices.push_back({size * static_cast<float>(std::sin(theta) * std::cos(phi)),
                                     size * static_cast<float>(std::cos(theta)),
                                     size * static_cast<float>(std::sin(theta) * std::sin(phi))});
        }
    for (std::uint32_t r = 0; r < rings; ++r) // triangles at the poles have zero area, which is tested, too
        for (std::uint32_t s = 0; s < around; ++s) {
            const std::uint32_t a = r * around + s, b = r * around + (s + 1) % around;
            mesh.triangles.push_back({a, b, b + around});
            mesh.triangles.push_back({a, b + around, a + around});
        }
    return mesh;
}

// Whether the segment from a to b passes through the interior of a triangle.
bool passes(const Vector3d& a, const Vector3d& b, const std::array<Vector3d, 3>& x) {
    const Vector3d n = (x[1] - x[0]).cross(x[2] - x[0]);
    const double ha = n.dot(a - x[0]), hb = n.dot(b - x[0]);
    if (!(ha * hb < 0)) return false;
    const Vector3d p = a + (b - a) * (ha / (ha - hb));
    for (int k = 0; k < 3; ++k)
        if (!((x[(k + 1) % 3] - x[k]).cross(p - x[k]).dot(n) > 0)) return false;
    return true;
}

// A cube of `side` around the origin with two triangles on each face.
MeshCollider box(float side) {
    MeshCollider mesh{.name = "box", .thickness = 0.01f};
    for (int k = 0; k < 8; ++k) {
        const auto at = [&](int bit) { return (k >> bit & 1) == 1 ? side / 2 : -side / 2; };
        mesh.vertices.push_back({at(0), at(1), at(2)});
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

// Rotates the box so that an edge is at the top, and by 0.3 rad about y.
void stand(MeshCollider& mesh) {
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.3, Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX()))
                                     .toRotationMatrix();
    for (Vec3& at : mesh.vertices) {
        const Vector3d v = turn * Vector3d(double{at.x}, double{at.y}, double{at.z});
        at = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
    }
}

} // namespace

Scene clothOnBall() {
    Scene scene;
    addMeshCollider(scene, sphere(0.3f, 12));
    addCloth(scene, {.origin = {-0.5f, 0.35f, -0.5f},
                     .size = {26, 26},
                     .spacing = 0.04f,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 1000,
                     .bendingStiffness = 1e-4f,
                     .thickness = 0.02f});
    scene.contacts.friction = 0.3f;
    scene.damping = 0.5f;
    scene.planes = {{.offset = -0.5f, .friction = 0.5f}};
    return scene;
}

Scene fallingFold() {
    Scene scene;
    addCloth(scene, {.origin = {-0.2f, 0.8f, 0},
                     .down = {0, -1, 0},
                     .size = {11, 41},
                     .spacing = 0.02f,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 500,
                     .bendingStiffness = 2e-5f,
                     .thickness = 0.01f});
    for (Particle& particle : scene.particles) // the sheet leans, so that it does not balance on its edge
        particle.position.z += 0.03f * std::sin(7 * particle.position.y);
    scene.contacts.friction = 0.2f;
    scene.damping = 1;
    scene.planes = {{.friction = 0.5f}};
    return scene;
}

Scene stackOfLayers(std::uint32_t count, std::uint32_t side, float pitch) {
    Scene scene;
    for (std::uint32_t layer = 0; layer < count; ++layer)
        addCloth(scene, {.name = "layer " + std::to_string(layer),
                         .origin = {0.004f * static_cast<float>(layer % 3),
                                    0.02f + pitch * static_cast<float>(layer),
                                    0.003f * static_cast<float>(layer % 5)},
                         .size = {side, side},
                         .spacing = 0.03f,
                         .areaDensity = 0.3f,
                         .membraneStiffness = 500,
                         .thickness = 0.01f});
    scene.contacts.friction = 0.2f;
    scene.damping = 1;
    scene.planes = {{.friction = 0.5f}};
    return scene;
}

Scene clothOnBox(float spacing) {
    Scene scene;
    MeshCollider mesh = box(0.5f);
    stand(mesh);
    addMeshCollider(scene, mesh);
    const auto side = static_cast<std::uint32_t>(0.9f / spacing) + 1;
    const float half = 0.5f * spacing * static_cast<float>(side - 1);
    addCloth(scene, {.origin = {-half + 0.013f, 0.42f, -half + 0.021f},
                     .size = {side, side},
                     .spacing = spacing,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 1000,
                     .thickness = 0.01f});
    scene.contacts.friction = 0.4f;
    scene.damping = 1;
    scene.planes = {{.offset = -0.6f, .friction = 0.5f}};
    return scene;
}

Scene crossedSheets(float spacing) {
    Scene scene;
    const auto side = static_cast<std::uint32_t>(0.6f / spacing) + 1;
    const float half = 0.5f * spacing * static_cast<float>(side - 1);
    ClothSheet lower{.name = "lower",
                     .origin = {-half, 0, -half},
                     .size = {side, side},
                     .spacing = spacing,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 500,
                     .thickness = 0.01f};
    for (std::uint32_t column = 0; column < side; ++column) {
        lower.pinned.push_back(column);
        lower.pinned.push_back(side * (side - 1) + column);
    }
    addCloth(scene, lower);
    const float c = std::cos(0.5f), s = std::sin(0.5f);
    addCloth(scene, {.name = "upper",
                     .origin = {-half * (c - s), 0.1f, -half * (c + s)},
                     .right = {c, 0, s},
                     .down = {-s, 0, c},
                     .size = {side, side},
                     .spacing = spacing,
                     .areaDensity = 0.6f,
                     .membraneStiffness = 500,
                     .thickness = 0.01f});
    scene.contacts.friction = 0.3f;
    scene.damping = 1;
    return scene;
}

Scene strip(float thickness) {
    Scene scene;
    constexpr std::uint32_t columns = 33, rows = 7;
    constexpr float spacing = 0.025f;
    addCloth(scene, {.origin = {-0.4f, 0, -0.075f},
                     .size = {columns, rows},
                     .spacing = spacing,
                     .areaDensity = 0.3f,
                     .membraneStiffness = 500,
                     .bendingStiffness = 2e-5f,
                     .thickness = thickness});
    for (std::uint32_t row = 0; row < rows; ++row)
        for (const std::uint32_t i : {row * columns, row * columns + columns - 1})
            scene.attachments.push_back({.particle = i, .anchor = scene.particles[i].position});
    scene.gravity = {};
    scene.contacts.friction = 0.2f;
    scene.damping = 2;
    return scene;
}

std::vector<Vec3> twistedEnds(const Scene& strip, double angle, double way) {
    std::vector<Vec3> anchors;
    for (const Attachment& attachment : strip.attachments) {
        const Vec3& at = attachment.anchor;
        const double turn = at.x < 0 ? -angle : angle, c = std::cos(turn), s = std::sin(turn);
        const double y = double{at.y}, z = double{at.z};
        anchors.push_back({static_cast<float>(double{at.x} + (at.x < 0 ? way : -way)),
                           static_cast<float>(c * y - s * z), static_cast<float>(s * y + c * z)});
    }
    return anchors;
}

int intersections(const Scene& scene, const std::vector<Vector3d>& x) {
    int found = 0;
    for (const Face& face : scene.faces) {
        const std::array<Vector3d, 3> at{x[face.particles[0]], x[face.particles[1]], x[face.particles[2]]};
        const Vector3d low = at[0].cwiseMin(at[1]).cwiseMin(at[2]),
                       high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
        for (const Face& other : scene.faces)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = other.particles[k], b = other.particles[(k + 1) % 3];
                const auto isCorner = [&](std::uint32_t i) {
                    return std::ranges::count(face.particles, i) > 0;
                };
                if (a > b || isCorner(a) || isCorner(b)) continue;
                if ((x[a].cwiseMax(x[b]) - low).minCoeff() < 0 || (high - x[a].cwiseMin(x[b])).minCoeff() < 0)
                    continue;
                found += passes(x[a], x[b], at) ? 1 : 0;
            }
    }
    return found;
}

double rms(const std::vector<Vector3d>& v) {
    double sum = 0;
    for (const Vector3d& one : v) sum += one.squaredNorm();
    return std::sqrt(sum / static_cast<double>(v.size()));
}

} // namespace sinew::test
