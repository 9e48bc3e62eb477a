// Builds the shared scenes.
#include "sim/scenes.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <ostream>
#include <random>
#include <stdexcept>

namespace sinew::sim {

void PrintTo(Solver solver, std::ostream* stream) {
    *stream << solverName(solver);
}

} // namespace sinew::sim

namespace sinew::test {

using namespace sim;

Scene chain(std::uint32_t count, const ChainLinks& links) {
    Scene scene{.name = "chain of " + std::to_string(count)};
    for (std::uint32_t i = 0; i < count; ++i) {
        scene.particles.push_back({.position = {0.1f * static_cast<float>(i), 0.5f, 0},
                                   .inverseMass = 1 + 0.25f * static_cast<float>(i % 5)});
        if (i == 0) continue;
        const bool isRigid = links.isEverySecond && i % 2 == 0;
        scene.distances.push_back({i - 1, i, 0.1f, isRigid ? 0 : links.compliance});
    }
    return scene;
}

Scene hangingChain(std::uint32_t links, float spacing, float mass, float compliance) {
    Scene scene{.name = "hanging chain", .fixed = {{0}}};
    for (std::uint32_t i = 0; i <= links; ++i) {
        scene.particles.push_back(
            {.position = {0, -spacing * static_cast<float>(i), 0}, .inverseMass = 1 / mass});
        if (i > 0) scene.distances.push_back({i - 1, i, spacing, compliance});
    }
    return scene;
}

Scene block(std::uint32_t cells, float spacing, float youngModulus, float height) {
    Scene scene{.name = "block of " + std::to_string(cells)};
    const Lattice lattice{.name = "block",
                          .origin = {0, height, 0},
                          .cells = {cells, cells, cells},
                          .spacing = spacing,
                          .youngModulus = youngModulus};
    const LatticeCorners corners = addLattice(scene, lattice);
    addLatticeSkin(scene, lattice, corners, {0.5f, 0.5f, 0.5f});
    return scene;
}

Scene spinningBlock(const Vec3& speed) {
    Scene scene = block(3, 0.1f, 1e5f);
    scene.gravity = {0, 0, 0};
    const Eigen::Vector3d spin(1, 2, -1), centre(0.15, 0.15, 0.15); // [rad/s], [m]
    for (Particle& particle : scene.particles)
        particle.velocity = toFloats(toVector(speed) + spin.cross(toVector(particle.position) - centre));
    return scene;
}

std::vector<float> raggedFill(std::size_t cells) {
    std::vector<float> fill;
    for (std::uint32_t c = 0; c < cells; ++c) {
        const std::uint32_t hash = (c * 2654435761u) >> 24;
        fill.push_back(hash < 60 ? 0 : static_cast<float>(hash) / 255);
    }
    return fill;
}

Scene sheet(std::uint32_t size, float compliance) {
    Scene scene{.name = "sheet of " + std::to_string(size)};
    addCloth(scene, {.origin = {0, 1, 0},
                     .size = {size, size},
                     .spacing = 0.1f,
                     .stretchCompliance = compliance,
                     .shearCompliance = 10 * compliance,
                     .pinned = {0, size - 1}});
    return scene;
}

Scene cuttableSheet() {
    Scene scene{.name = "sheet", .gravity = {}};
    addCloth(scene, {.size = {9, 9},
                     .spacing = 0.1f,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-4f,
                     .skipStiffness = 100,
                     .bendingStiffness = 1e-3f,
                     .isCuttable = true});
    return scene;
}

Blade bladeAcrossSheet() {
    static constexpr std::array from{Vec3{0.45f, -1, -0.5f}, Vec3{0.45f, 1, -0.5f}},
        to{Vec3{0.45f, -1, 1.5f}, Vec3{0.45f, 1, 1.5f}};
    return {.from = from, .to = to};
}

Scene particleAt(Vec3 position, Vec3 velocity) {
    Scene scene{.name = "particle"};
    scene.particles.push_back({.position = position, .velocity = velocity});
    return scene;
}

void disturb(Scene& scene, float distance, float speed) {
    std::mt19937 random(42);
    const auto within = [&random](float bound) {
        // std::uniform_real_distribution gives different values in different libraries.
        return bound * (static_cast<float>(random() >> 8) / 8388608.0f - 1);
    };
    for (Particle& particle : scene.particles) {
        for (float* x : {&particle.position.x, &particle.position.y, &particle.position.z})
            *x += within(distance);
        for (float* v : {&particle.velocity.x, &particle.velocity.y, &particle.velocity.z})
            *v += within(speed);
    }
}

void addRoom(Scene& scene) {
    if (scene.particles.empty()) return;
    float lowest = scene.particles[0].position.y;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        lowest = std::min(lowest, scene.particles[i].position.y);
        scene.particles[i].contactOffset = 0.002f * static_cast<float>(i % 3) - 0.002f;
    }
    scene.planes.push_back(
        {.normal = {0, 1, 0}, .offset = lowest + 0.01f, .friction = 0.4f, .restitution = 0.6f});
    const Vec3 normal{0.8f, 0.6f, 0};
    const Vec3& first = scene.particles[0].position;
    scene.planes.push_back({.normal = normal,
                            .offset = normal.x * first.x + normal.y * first.y + 0.01f,
                            .friction = 0.1f,
                            .restitution = 0});
}

Vec3 toFloats(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Eigen::Vector3d toVector(const Vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

double sizeOf(const Scene& scene) {
    if (scene.particles.empty()) return 0.1;
    Eigen::Vector3d low = toVector(scene.particles[0].position), high = low;
    for (const Particle& particle : scene.particles) {
        low = low.cwiseMin(toVector(particle.position));
        high = high.cwiseMax(toVector(particle.position));
    }
    return std::max(0.1, (high - low).norm());
}

double massOf(const Scene& scene) {
    double mass = 0;
    for (const Particle& particle : scene.particles) {
        if (particle.inverseMass > 0) mass += 1 / double{particle.inverseMass};
    }
    return mass;
}

double kineticEnergy(const Scene& scene, const std::vector<Eigen::Vector3d>& v) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    double energy = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (inverseMass[i] > 0) energy += v[i].squaredNorm() / (2 * double{inverseMass[i]});
    return energy;
}

std::vector<NamedScene> allScenes() {
    std::vector<NamedScene> scenes{{"empty", {}},
                                   {"particle", particleAt({0, 1, 0})},
                                   {"rigid_chain", chain(65)},
                                   {"compliant_chain", chain(9, {1e-4f})},
                                   {"mixed_chain", chain(9, {1e-4f, true})},
                                   {"block", block(3, 0.1f, 1e5f)},
                                   {"sheet", sheet(8)}};
    const std::size_t kinds = scenes.size();
    for (std::size_t k = 1; k < kinds; ++k) {
        scenes.push_back({scenes[k].name + "_in_a_room", scenes[k].scene});
        addRoom(scenes.back().scene);
    }
    return scenes;
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "nothing was refused";
}

} // namespace sinew::test
