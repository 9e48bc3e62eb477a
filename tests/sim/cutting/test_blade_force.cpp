// The impulse on a blade: its work is the toughness of a body times the area that is cut, at any speed and in
// any direction, and it changes no motion.
#include "cut_body.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ranges>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::Runner;

namespace {

constexpr float spacing = 0.02f, toughness = 400; // [m], [J/m^2]
constexpr std::uint32_t cells = 12;
constexpr double size = cells * double{spacing}; // of the cube [m]
const Vector3d middle = Vector3d::Constant(size / 2);
const Settings keeping{.substeps = 2, .keepsForces = true};

Scene boxOf(const std::array<std::uint32_t, 3>& sides, float tough) {
    Scene scene{.name = "box"};
    scene.gravity = {};
    addLattice(
        scene,
        {.cells = sides, .spacing = spacing, .youngModulus = 1e4f, .isCuttable = true, .toughness = tough});
    return scene;
}

Scene cube(float tough = toughness) {
    return boxOf({cells, cells, cells}, tough);
}

Vec3 toVec3(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// A straight edge along `edge` that goes along `way`, both of unit length, across the middle of a body.
struct Stroke {
    Vector3d edge, way;
    double length = 1; // of the path [m]
};

// The impulses on the blade, step by step.
std::vector<Vector3d> impulsesOf(Runner& runner, const Stroke& stroke, int steps, const Vector3d& center) {
    std::vector<Vector3d> impulses;
    for (int s = 0; s < steps; ++s) {
        const auto edgeAt = [&](int n) {
            const Vector3d at = center + (static_cast<double>(n) / steps - 0.5) * stroke.length * stroke.way;
            return std::vector<Vec3>{toVec3(at - stroke.edge), toVec3(at + stroke.edge)};
        };
        const test::Sweep sweep{edgeAt(s), edgeAt(s + 1)};
        const Status status = runner.cut(sweep.blade());
        const std::vector<Impulse> blade = runner.simulation().forces(status.frame).blade;
        EXPECT_EQ(blade.size(), 1u);
        if (blade.empty()) return {};
        impulses.emplace_back(blade[0].linear.x, blade[0].linear.y, blade[0].linear.z);
    }
    return impulses;
}

Vector3d sumOf(const std::vector<Vector3d>& impulses) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& impulse : impulses) sum += impulse;
    return sum;
}

} // namespace

TEST(BladeForce, DoesTheWorkOfTheAreaThatItCuts) {
    const double diagonal = std::sqrt(2.0);
    struct Case {
        const char* name;
        Stroke stroke;
        double area; // of the section [m^2]
    };
    const Case cases[] = {
        {"across", {Vector3d::UnitZ(), Vector3d::UnitX()}, size * size},
        {"aslant in its plane",
         {Vector3d(1, 0, 1).normalized(), Vector3d(1, 0, -1).normalized()},
         size * size},
        {"along face diagonals", {Vector3d::UnitZ(), Vector3d(1, 1, 0).normalized()}, diagonal * size * size},
        {"along space diagonals",
         {Vector3d(1, 0, -1).normalized(), Vector3d(1, -2, 1).normalized()},
         0.75 * std::sqrt(3.0) * size * size},
    };
    for (const auto& [name, stroke, area] : cases)
        for (const int steps : {5, 50}) {
            Runner runner(cube(), keeping);
            const double speed = stroke.length / (steps * double{Scene{}.dt});
            const Vector3d sum = sumOf(impulsesOf(runner, stroke, steps, middle));
            EXPECT_NEAR(sum.norm() * speed / (double{toughness} * area), 1, 0.045) << name << ", " << steps;
            EXPECT_LT((sum.normalized() + stroke.way).norm(), 1e-4) << name << ", " << steps;
        }
}

// Links at the surface count for what material they have beside them, so thin bodies are no exception.
TEST(BladeForce, DoesTheWorkInThinBodies) {
    struct Case {
        std::array<std::uint32_t, 3> sides;
        Stroke stroke;
        double area; // [cells]
    };
    const Case cases[] = {{{30, 1, 1}, {Vector3d::UnitZ(), Vector3d::UnitY()}, 1},
                          {{30, 4, 4}, {Vector3d::UnitZ(), Vector3d::UnitY()}, 16},
                          {{12, 1, 12}, {Vector3d::UnitY(), Vector3d::UnitX()}, 12},
                          {{12, 1, 12}, {Vector3d::UnitZ(), Vector3d::UnitX()}, 144}};
    for (const auto& [sides, stroke, area] : cases) {
        Runner runner(boxOf(sides, toughness), keeping);
        const Vector3d center = double{spacing} / 2 * Vector3d(sides[0], sides[1], sides[2]);
        const double speed = stroke.length / (40 * double{Scene{}.dt});
        const Vector3d sum = sumOf(impulsesOf(runner, stroke, 40, center + Vector3d::Constant(0.003)));
        EXPECT_NEAR(sum.norm() * speed / (double{toughness} * area * double{spacing} * double{spacing}), 1,
                    0.02)
            << sides[0] << " x " << sides[1] << " x " << sides[2] << ", " << area;
    }
}

// The area at rest counts, whatever the body is stretched by; only diagonals turn.
TEST(BladeForce, IsThatOfTheAreaAtRestOfAStretchedBody) {
    for (const float stretch : {0.8f, 1.3f}) {
        Scene scene = cube();
        for (Particle& particle : scene.particles) particle.position.y *= stretch;
        for (const std::uint32_t i : std::views::iota(0u, static_cast<std::uint32_t>(scene.particles.size())))
            scene.fixed.push_back({i});
        Runner runner(scene, keeping);
        const Stroke stroke{Vector3d::UnitZ(), Vector3d::UnitX()};
        const double speed = stroke.length / (20 * double{scene.dt});
        const Vector3d center(middle.x(), 0.97 * middle.y() * double{stretch}, middle.z());
        const Vector3d sum = sumOf(impulsesOf(runner, stroke, 20, center));
        EXPECT_NEAR(sum.norm() * speed / (double{toughness} * size * size), 1, 0.12) << stretch;
    }
}

// Each of two bodies of one run by its own.
TEST(BladeForce, OfTwoBodiesIsTheSum) {
    Scene scene = cube(100);
    addLattice(scene, {.origin = {0, 0, 0.5f},
                       .cells = {cells, cells, cells},
                       .spacing = spacing,
                       .youngModulus = 1e4f,
                       .isCuttable = true,
                       .toughness = 300});
    Runner runner(scene, keeping);
    const Stroke stroke{Vector3d::UnitZ(), Vector3d::UnitX()};
    const double speed = stroke.length / (20 * double{scene.dt});
    const Vector3d sum = sumOf(impulsesOf(runner, stroke, 20, middle + Vector3d::Constant(0.003)));
    EXPECT_NEAR(sum.norm() * speed / (400 * size * size), 1, 0.02);
}

// Force = toughness times width, but for what the grid of links makes of it from step to step.
TEST(BladeForce, IsToughnessTimesTheWidthOfTheCut) {
    Runner runner(cube(), keeping);
    const Stroke stroke{Vector3d::UnitZ(), Vector3d::UnitX(), 2 * size};
    const int steps = 96; // four a cell
    const std::vector<Vector3d> impulses = impulsesOf(runner, stroke, steps, middle);
    const double dt = double{Scene{}.dt}, expected = double{toughness} * size;
    const auto first = impulses.begin() + steps / 4 + 12;
    const Vector3d inside = sumOf({first, first + 24}) / (24 * dt);
    EXPECT_NEAR(-inside.x() / expected, 1, 0.07);
    EXPECT_EQ(sumOf({impulses.begin(), impulses.begin() + steps / 4 - 4}), Vector3d::Zero())
        << "before the body";
    EXPECT_EQ(sumOf({impulses.end() - steps / 4 + 4, impulses.end()}), Vector3d::Zero()) << "behind it";
}

// A blade that stands in the way of a body is pushed along.
TEST(BladeForce, IsThatOfTheMotionAgainstTheBody) {
    Scene scene = cube();
    constexpr float speed = 0.5f;
    for (Particle& particle : scene.particles) particle.velocity = {speed, 0, 0};
    Runner runner(scene, keeping);
    const double x = size + 0.011;
    const std::vector<Vec3> edge{toVec3({x, size / 2, -1}), toVec3({x, size / 2, 1})};
    Vector3d sum = Vector3d::Zero();
    for (int s = 0; s < 40; ++s) {
        const Status status = runner.cut(test::Sweep{edge, edge, true}.blade());
        const Vec3 one = runner.simulation().forces(status.frame).blade.at(0).linear;
        sum += Vector3d(one.x, one.y, one.z);
    }
    EXPECT_NEAR(sum.x() * double{speed} / (double{toughness} * size * size), 1, 0.07);
    EXPECT_LT(std::hypot(sum.y(), sum.z()), 1e-3 * sum.x());
}

TEST(BladeForce, OfASheetIsThatOfTheLengthOfTheCut) {
    for (const Vector3d& way :
         {Vector3d(1, 0, 0), Vector3d(1, 0, 1).normalized(), Vector3d(2, 0, 1).normalized()}) {
        Scene scene{.name = "sheet"};
        scene.gravity = {};
        addCloth(scene, {.size = {41, 41}, .spacing = spacing, .isCuttable = true, .toughness = toughness});
        Vector3d center = Vector3d::Zero();
        for (const Particle& p : scene.particles)
            center += Vector3d(p.position.x, p.position.y, p.position.z) /
                      static_cast<double>(scene.particles.size());
        const double side = 40 * double{spacing}, length = side / way.x();
        const Stroke stroke{Vector3d::UnitY(), way, 3 * side};
        Runner runner(scene, keeping);
        const double speed = stroke.length / (30 * double{scene.dt});
        const Vector3d sum = sumOf(impulsesOf(runner, stroke, 30, center));
        EXPECT_NEAR(sum.norm() * speed / (double{toughness} * length), 1, 0.07) << way.transpose();
    }
}

TEST(BladeForce, ChangesNoMotionAndHasOneSum) {
    const Stroke stroke{Vector3d(1, 0, -1).normalized(), Vector3d(1, -2, 1).normalized()};
    std::vector<std::vector<Vector3d>> impulses;
    std::vector<std::uint64_t> hashes;
    for (const bool isReversed : {false, true}) {
        Settings settings = keeping;
        settings.isReversed = isReversed;
        Runner runner(cube(), settings);
        impulses.push_back(impulsesOf(runner, stroke, 12, middle));
        hashes.push_back(runner.stateHash());
    }
    EXPECT_EQ(impulses[0], impulses[1]);
    EXPECT_EQ(hashes[0], hashes[1]);
    Runner free(cube(0), keeping);
    for (int s = 0; s < 12; ++s) {
        const auto edgeAt = [&](int n) {
            const Vector3d at = middle + (n / 12.0 - 0.5) * stroke.way;
            return std::vector<Vec3>{toVec3(at - stroke.edge), toVec3(at + stroke.edge)};
        };
        const Status status = free.cut(test::Sweep{edgeAt(s), edgeAt(s + 1)}.blade());
        EXPECT_TRUE(free.simulation().forces(status.frame).blade.empty());
    }
    EXPECT_EQ(free.stateHash(), hashes[0]);
}

TEST(BladeForce, IsNoneWithoutABladeAndOfARay) {
    Runner runner(cube(), keeping);
    const auto blade = [&](const Status& status) {
        const Vec3 one = runner.simulation().forces(status.frame).blade.at(0).linear;
        return Vector3d(one.x, one.y, one.z);
    };
    const test::Sweep sweep = test::sweepOf({middle, Vector3d::UnitY()}, 1);
    EXPECT_GT(blade(runner.cut(sweep.blade())).norm(), 0);
    EXPECT_EQ(blade(runner.run(1)), Vector3d::Zero()) << "the step after";
    const Status ray = runner.cut({}, {.from = {0.05f, -1, 0.05f}, .to = {0.05f, 1, 0.05f}, .radius = 0.01f});
    EXPECT_GT(ray.linksCut, 0u);
    EXPECT_EQ(blade(ray), Vector3d::Zero());
}
