// Prints the overlap of particles in columns, stacks, a collision and clutter with 8, 16 and 32 substeps.
// These scenes served to compare divisions of contacts; docs/accuracy.md has the figures. Not a test:
// test_particle_contacts and test_contact_cases check the same properties.
//   measure_contacts [part of a scene's name]
#include "sinew/overlap.hpp"
#include "sinew/runner.hpp"

#include "sinew/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

using namespace sinew;
using namespace sinew::tools;

namespace {

constexpr float spacing = 0.05f, half = spacing / 2; // of lattices, and the radius of their particles
constexpr std::uint32_t samples = 4;                 // a frame of 1/60 s, to see peaks

struct Measured {
    std::string name;
    double seconds;
    double radius; // unit of the printed depths [m]
    sim::Scene scene;
};

/// Adds a cube as in the prototype: particles keep their radius from the floor, and each has the mass of a
/// cell. (Particles on the faces of a lattice have half of it or less, and yield more.)
void addCube(sim::Scene& scene, std::uint32_t side, float youngModulus, const sim::Vec3& lowest) {
    const std::size_t first = scene.particles.size();
    sim::addLattice(scene, {.name = "cube",
                            .origin = lowest,
                            .cells = {side - 1, side - 1, side - 1},
                            .spacing = spacing,
                            .youngModulus = youngModulus,
                            .radius = half});
    for (std::size_t i = first; i < scene.particles.size(); ++i) {
        scene.particles[i].contactOffset = half;
        scene.particles[i].inverseMass = 1 / (1000 * spacing * spacing * spacing);
    }
}

sim::Scene onAFloor(float damping) {
    sim::Scene scene;
    scene.damping = damping;
    scene.contacts.friction = 0.5f;
    scene.planes = {{.friction = 0.5f}};
    return scene;
}

/// `count` cubes of 8^3 above each other, every second one shifted by `offset` of a cell along x and z.
sim::Scene stack(std::uint32_t count, float offset) {
    sim::Scene scene = onAFloor(1);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float aside = i % 2 == 1 ? offset * spacing : 0;
        addCube(scene, 8, 1e6f, {aside, half + static_cast<float>(8 * i) * spacing, aside});
    }
    return scene;
}

/// Two cubes of 8^3 that collide at 1 m/s each, without gravity and friction.
sim::Scene collision() {
    sim::Scene scene;
    scene.gravity = {};
    addCube(scene, 8, 1e6f, {0, 0, 0});
    addCube(scene, 8, 1e6f, {9 * spacing, 0, 0});
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        scene.particles[i].velocity.x = i < scene.particles.size() / 2 ? 1.0f : -1.0f;
    return scene;
}

/// 27 cubes of 5^3, a cell apart, 1 m above a floor; each layer is shifted by a third of a cell.
sim::Scene heap() {
    sim::Scene scene = onAFloor(1);
    for (std::uint32_t i = 0; i < 27; ++i) {
        const auto layer = static_cast<float>(i / 9);
        const auto at = [&](std::uint32_t index) {
            return (6 * static_cast<float>(index) + layer / 3) * spacing;
        };
        addCube(scene, 5, 1e5f, {at(i % 3), 1 + 6 * layer * spacing, at(i / 3 % 3)});
    }
    return scene;
}

sim::Scene drop() {
    sim::Scene scene = onAFloor(1);
    addCube(scene, 10, 1e5f, {0, 0.5f + half, 0});
    return scene;
}

sim::Scene column(float ratio) {
    sim::Scene scene = onAFloor(0);
    for (int i = 0; i < 4; ++i)
        scene.particles.push_back({.position = {0, half + static_cast<float>(i) * spacing, 0},
                                   .inverseMass = i == 3 ? 1 / ratio : 1,
                                   .contactOffset = half,
                                   .radius = half});
    return scene;
}

/// Balls in packed rows in a box that they fill, or `random` balls at random places above its floor up to
/// `high` [m].
sim::Scene clutter(std::uint32_t random, float wide = 0.6f, float high = 1.6f) {
    constexpr float radius = 0.05f, friction = 0.3f;
    sim::Scene scene;
    scene.contacts.friction = friction;
    scene.planes = {{.friction = friction}};
    for (const float sign : {1.0f, -1.0f}) {
        scene.planes.push_back({.normal = {sign, 0, 0}, .offset = -wide, .friction = friction});
        scene.planes.push_back({.normal = {0, 0, sign}, .offset = -wide, .friction = friction});
    }
    if (random > 0)
        sim::addParticles(scene, {.center = {0, 0.5f * high + 0.05f, 0},
                                  .random = random,
                                  .size = {2 * wide, high - 0.1f, 2 * wide}});
    else
        sim::addParticles(
            scene, {.center = {0, 0.6f, 0}, .count = {10, 10, 10}, .jitter = 0.0099f, .radius = radius});
    return scene;
}

double speedOf(const State& state) {
    double squares = 0;
    for (const auto& v : state.velocities)
        for (std::size_t axis = 0; axis < 3; ++axis) squares += double{v[axis]} * double{v[axis]};
    return std::sqrt(squares / static_cast<double>(state.velocities.size()));
}

struct Motion {
    std::array<double, 3> momentum{}; // [kg m/s]
    double sum = 0, kinetic = 0;      // sum of lengths [kg m/s], energy [J]
};

Motion motionOf(const sim::Scene& scene, const State& state) {
    Motion motion;
    for (std::size_t i = 0; i < state.velocities.size(); ++i) {
        const auto& v = state.velocities[i];
        const double mass = 1 / double{scene.particles[i].inverseMass};
        const double speed = std::hypot(double{v[0]}, double{v[1]}, double{v[2]});
        for (std::size_t axis = 0; axis < 3; ++axis) motion.momentum[axis] += mass * double{v[axis]};
        motion.sum += mass * speed;
        motion.kinetic += 0.5 * mass * speed * speed;
    }
    return motion;
}

double topOf(const State& state) {
    double top = -1e9;
    for (const auto& x : state.positions) top = std::max(top, double{x[1]});
    return top;
}

void measure(Session& session, Measured measured, std::uint32_t substeps) {
    sim::Scene& scene = measured.scene;
    scene.dt = 1.0f / 60 / samples;
    const auto steps = static_cast<std::uint32_t>(std::lround(measured.seconds * 60.0 * samples));
    Runner runner(session, scene, {.substeps = substeps / samples, .contactRoom = 64});
    double deepest = 0, highest = 0, squares = 0, slowSince = 0;
    std::uint32_t late = 0;
    Overlap last;
    State state = runner.readState();
    const Motion first = motionOf(scene, state);
    for (std::uint32_t step = 1; step <= steps; ++step) {
        runner.advance(1, 1);
        if (runner.divergence()) break;
        state = runner.readState();
        last = overlapOf(scene, state).value_or(Overlap{});
        deepest = std::max(deepest, last.max);
        highest = std::max(highest, topOf(state));
        const double speed = speedOf(state);
        if (speed > 0.01) slowSince = double{scene.dt} * step;
        if (step + 30 * samples <= steps) continue; // only the last half second counts
        squares += speed * speed;
        ++late;
    }
    std::printf("%-28s %2u substeps: deepest %6.3f, at the end %6.3f (RMS %6.4f) radii; v_rms %8.2e m/s over "
                "the last 0.5 s, below 1 cm/s after %4.2f s; top at %5.3f, at most %5.3f m%s\n",
                measured.name.c_str(), substeps, deepest / measured.radius, last.max / measured.radius,
                last.rms / measured.radius, std::sqrt(squares / std::max(late, 1u)), slowSince, topOf(state),
                highest, runner.divergence() ? "; diverged" : "");
    if (scene.gravity.y == 0) {
        const Motion motion = motionOf(scene, state);
        std::printf("  momentum off by %.1e of all that moved, %.3f of the kinetic energy kept\n",
                    std::hypot(motion.momentum[0], motion.momentum[1], motion.momentum[2]) / first.sum,
                    motion.kinetic / first.kinetic);
    }
    std::fflush(stdout);
}

std::vector<Measured> allMeasured() {
    constexpr double ball = 0.05, node = double{half};
    return {{"two cubes, offset", 1.5, node, stack(2, 0.5f)},
            {"five cubes, aligned", 2.5, node, stack(5, 0)},
            {"five cubes, offset", 2.5, node, stack(5, 0.5f)},
            {"drop of a cube", 2.5, node, drop()},
            {"column, ratio 1", 2, node, column(1)},
            {"column, ratio 10", 2, node, column(10)},
            {"column, ratio 100", 2, node, column(100)},
            {"column, ratio 1000", 2, node, column(1000)},
            {"clutter 1000, packed", 4, ball, clutter(0)},
            {"clutter 1000, random", 4, ball, clutter(1000)},
            {"clutter 8000, random", 4, ball, clutter(8000, 1.15f, 3.3f)},
            {"two cubes that meet", 0.5, node, collision()},
            {"27 cubes", 2.5, node, heap()}};
}

} // namespace

int main(int count, char** arguments) {
    const std::string part = count > 1 ? arguments[1] : "";
    Session session{DeviceOptions{}};
    for (const Measured& measured : allMeasured())
        if (measured.name.find(part) != std::string::npos)
            for (const std::uint32_t substeps : {8u, 16u, 32u}) measure(session, measured, substeps);
}
