// Hard cases 4 to 7: a cube that is flattened, mirrored, scattered or collapsed to a point recovers its
// shape, and its energy never grows. Runs with cell volumes (Poisson ratio 0.45), and with links alone and
// recovery pressure.
#include "sim/reference/cells.hpp"
#include "sim/reference/trajectory.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr std::uint32_t cells = 4;
constexpr float spacing = 0.1f;
const Vector3d middle = Vector3d::Constant(double{spacing} * cells / 2);

struct Material {
    const char* name;
    float poissonRatio, recovery;
};

class Recovery : public testing::TestWithParam<Material> {};

Scene cube(const Material& material) {
    Scene scene{.name = "cube"};
    scene.gravity = {0, 0, 0};
    scene.damping = 3; // otherwise it oscillates for seconds, which hides the rest shape
    addLattice(scene, {.cells = {cells, cells, cells},
                       .spacing = spacing,
                       .poissonRatio = material.poissonRatio,
                       .recovery = material.recovery});
    return scene;
}

Vec3 toVec3(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

template <typename Move> Scene moved(const Material& material, const Move& move) {
    Scene scene = cube(material);
    for (Particle& particle : scene.particles)
        particle.position = toVec3(middle + move(Vector3d(test::toVector(particle.position) - middle)));
    return scene;
}

struct Shape {
    double leastVolume = 0, volume = 0; // signed volumes of a cell and of the body, over those at rest
    double rms = 0;                     // distance from the rest shape, over the body's diagonal
};

Shape shapeOf(const Scene& rest, const std::vector<Vector3d>& x) {
    Shape shape{.leastVolume = HUGE_VAL};
    const auto all = reference::cellsOf(rest);
    for (const reference::Cell& cell : all) {
        const double ratio = reference::volumeRatio(cell, reference::cornersOf(cell, x));
        shape.leastVolume = std::min(shape.leastVolume, ratio);
        shape.volume += ratio / static_cast<double>(all.size());
    }
    Eigen::Matrix3Xd from(3, x.size()), to(3, x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        from.col(static_cast<Eigen::Index>(i)) = test::toVector(rest.particles[i].position);
        to.col(static_cast<Eigen::Index>(i)) = x[i];
    }
    const Eigen::Matrix4d fit = Eigen::umeyama(from, to, false); // a rotation without reflection
    const Eigen::Matrix3Xd apart =
        (fit.topLeftCorner<3, 3>() * from).colwise() + fit.topRightCorner<3, 1>() - to;
    shape.rms = apart.norm() / std::sqrt(static_cast<double>(x.size())) / test::sizeOf(rest);
    return shape;
}

// Shape after a run. Makes four runs, the last in reversed order, which must end with equal bits; the energy
// of the first must never exceed its initial value. (32 substeps give full stiffness with a margin. With 8
// substeps, slightly fewer than the automatic choice, the kinetic energy also stays below 0.53 of it. The
// sum, however, uses stiffness that a clamped cell lacks, and exceeds the initial value by 17 % in the first
// frame of a flattened cube.)
Shape shapeAfter(const Scene& scene, const Material& material, int seconds) {
    std::uint64_t hash = 0;
    std::vector<Vector3d> x;
    for (int repeat = 0; repeat < 4; ++repeat) {
        test::Runner runner(scene, {.substeps = 32, .isReversed = repeat == 3});
        double start = 0;
        for (int step = 0; step < 60 * seconds; ++step) {
            if (repeat == 0) {
                const reference::Energy energy =
                    reference::energy(scene, {runner.positions(), runner.velocities()});
                if (step == 0) start = energy.total();
                EXPECT_LE(energy.kinetic, 1.01 * start) << "step " << step;
                EXPECT_LE(energy.total(), 1.01 * start) << "step " << step;
            }
            EXPECT_EQ(runner.run(1).nonFinite, 0u);
        }
        x = runner.positions();
        if (repeat > 0) {
            EXPECT_EQ(runner.stateHash(), hash) << "repeat " << repeat;
        }
        hash = runner.stateHash();
    }
    const Shape shape = shapeOf(cube(material), x);
    testing::Test::RecordProperty("least cell volume", std::to_string(shape.leastVolume));
    testing::Test::RecordProperty("volume", std::to_string(shape.volume));
    testing::Test::RecordProperty("rms", std::to_string(shape.rms));
    return shape;
}

} // namespace

TEST_P(Recovery, Case04_ACubeFlattenedToAPlaneHasItsVolumeAfterTwoSeconds) {
    const auto flatten = [](Vector3d x) { return Vector3d(x.x(), 0, x.z()); };
    const Shape shape = shapeAfter(moved(GetParam(), flatten), GetParam(), 2);
    EXPECT_GE(shape.volume, 0.95);
    EXPECT_GT(shape.leastVolume, 0);
}

TEST_P(Recovery, Case05_AMirroredCubeHasNoMirroredCellAfterTwoSeconds) {
    const auto mirror = [](Vector3d x) { return Vector3d(-x.x(), x.y(), x.z()); };
    const Shape shape = shapeAfter(moved(GetParam(), mirror), GetParam(), 2);
    EXPECT_GT(shape.leastVolume, 0);
}

TEST_P(Recovery, Case06_AScatteredCubeComesBackToItsRestShape) {
    std::mt19937 random(7);
    const auto number = [&random] { return static_cast<double>(random() >> 8) / 8388608.0 - 1; };
    const auto scatter = [&](const Vector3d&) {
        Vector3d x(2, 0, 0);
        while (x.norm() > 1) x = {number(), number(), number()};
        return Vector3d(x * double{spacing} * cells / 2);
    };
    const Shape shape = shapeAfter(moved(GetParam(), scatter), GetParam(), 4);
    EXPECT_LE(shape.rms, 0.02);
    EXPECT_GT(shape.leastVolume, 0);
}

TEST_P(Recovery, Case07_ACubeInOnePointComesBackToItsRestShape) {
    const auto collapse = [](const Vector3d&) { return Vector3d(0, 0, 0); };
    const Shape shape = shapeAfter(moved(GetParam(), collapse), GetParam(), 6);
    EXPECT_LE(shape.rms, 0.02);
    EXPECT_GT(shape.leastVolume, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Recovery,
                         testing::Values(Material{"Volumes", 0.45f, 0}, Material{"Pressure", 0.25f, 2}),
                         [](const auto& parameter) { return parameter.param.name; });

namespace {

// Remaining volume of a box that was pressed to a part of its height and released.
double volumeAfterBeingPressed(float poissonRatio, float recovery, float part) {
    constexpr float side = 0.3f;
    Scene scene;
    addLattice(scene, {.origin = {-side / 2, 0, -side / 2},
                       .cells = {6, 6, 6},
                       .spacing = side / 6,
                       .youngModulus = 1e5f,
                       .poissonRatio = poissonRatio,
                       .recovery = recovery});
    const Scene rest = scene;
    scene.damping = 2;
    scene.planes = {{.friction = 0.3f}};
    const float low = 0.5f + part * side; // centre of a block of 1 m
    scene.colliders = {
        {.shape = ColliderShape::box,
         .halfExtents = {1, 0.5f, 1},
         .path = {{0, {{0, 0.51f + side, 0}, {}}}, {1, {{0, low, 0}, {}}}, {2, {{0, 1.5f, 0}, {}}}}}};
    test::Runner runner(scene, {});
    EXPECT_EQ(runner.run(300).nonFinite, 0u);
    return shapeOf(rest, runner.positions()).volume;
}

} // namespace

// docs/scene-files.md gives the ratio above which cells unfold without recovery.
TEST(PressedBox, UnfoldsFromAPoissonsRatioOf032On) {
    for (const float part : {0.27f, 0.4f})
        for (const float ratio : {0.32f, 0.36f})
            EXPECT_GE(volumeAfterBeingPressed(ratio, 0, part), 0.95) << ratio << ", to " << part;
    EXPECT_LE(volumeAfterBeingPressed(0.3f, 0, 0.4f), 0.75) << "the docs say so";
    EXPECT_GE(volumeAfterBeingPressed(0.3f, 0.5f, 0.4f), 0.95);
    EXPECT_GE(volumeAfterBeingPressed(0.25f, 2, 0.27f), 0.95);
}
