// Tests of contact loads for the choice of substeps: a load is shared among the particles below and varies
// smoothly.
#include "sim/collision/loads.hpp"

#include "sim/compile/compile.hpp"
#include "sim/runner.hpp"
#include "sim/stiffness/terms.hpp"
#include "sinew/bodies.hpp"
#include "sinew/substeps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

using namespace sinew;
using namespace sinew::sim;

namespace {

// A ball above a cloth with a fixed rim; lengths in m.
struct BallOnCloth {
    double radius = 0.05, spacing = 0.03, thickness = 0.02, density = 1000, speed = 0, height = 0.2;
    double x = 0.013, z = 0.017;
    std::uint32_t size = 21;

    double mass() const { return 4.0 / 3 * std::numbers::pi * radius * radius * radius * density; }
    Scene scene() const {
        Scene scene;
        const double half = spacing * (size - 1) / 2;
        ClothSheet sheet{.origin = {static_cast<float>(-half), 0, static_cast<float>(-half)},
                         .size = {size, size},
                         .spacing = static_cast<float>(spacing),
                         .thickness = static_cast<float>(thickness)};
        for (std::uint32_t i = 0; i < size * size; ++i)
            if (i % size == 0 || i % size + 1 == size || i < size || i >= size * (size - 1))
                sheet.pinned.push_back(i);
        addCloth(scene, sheet);
        scene.particles.push_back(
            {.position = {static_cast<float>(x), static_cast<float>(height), static_cast<float>(z)},
             .velocity = {0, static_cast<float>(-speed), 0},
             .inverseMass = static_cast<float>(1 / mass()),
             .radius = static_cast<float>(radius)});
        return scene;
    }
};

// Expects chosen substeps to vary by at most 4 % and 1 while a parameter grows from `first` to `last` in
// steps of `ratio`.
void expectSmooth(const char* what, double first, double last, double ratio,
                  const std::function<void(BallOnCloth&, double)>& set) {
    std::uint32_t before = 0;
    for (double value = first; value < last; value *= ratio) {
        BallOnCloth made;
        set(made, value);
        const std::uint32_t wanted = chooseSubsteps(made.scene(), {}).wanted;
        if (before > 0) {
            EXPECT_LE(wanted, 1.04 * before + 1) << what << ' ' << value;
            EXPECT_GE(1.04 * wanted + 1, before) << what << ' ' << value;
        }
        before = wanted;
    }
}

double sumOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<double> massesOnto(const Scene& scene) {
    return collision::loads::massesOnto(scene, inverseMasses(scene), stiffness::componentsOf(scene));
}

} // namespace

TEST(Loads, ChoiceIsSmoothInEveryParameterOfABallOnACloth) {
    expectSmooth("radius", 0.004, 0.15, 1.01, [](BallOnCloth& made, double v) { made.radius = v; });
    expectSmooth("spacing", 0.01, 0.1, 1.01, [](BallOnCloth& made, double v) {
        made.spacing = v;
        made.thickness = 0.66 * v;
    });
    expectSmooth("thickness", 0.002, 0.03, 1.01, [](BallOnCloth& made, double v) { made.thickness = v; });
    expectSmooth("density", 10, 1e5, 1.02, [](BallOnCloth& made, double v) { made.density = v; });
    expectSmooth("speed", 0.1, 1000, 1.1, [](BallOnCloth& made, double v) { made.speed = v; });
    expectSmooth("height", 0.07, 10, 1.02, [](BallOnCloth& made, double v) { made.height = v; });
    expectSmooth("place", 0.1, 0.2, 1.01, [](BallOnCloth& made, double v) { made.x = v - 0.15; });
    expectSmooth("small, place", 0.13, 0.17, 1.001, [](BallOnCloth& made, double v) {
        made.radius = 0.01;
        made.density = 2e4;
        made.x = made.z = v - 0.15;
    });
}

TEST(Loads, ABallSharesItsMassAmongAllBelowIt) {
    for (const double radius : {0.005, 0.05, 0.2})
        for (int k = 0; k < 20; ++k) {
            const BallOnCloth made{
                .radius = radius, .spacing = 0.02, .x = 0.001 * k, .z = 0.0007 * k, .size = 41};
            const std::vector<double> onto = massesOnto(made.scene());
            EXPECT_NEAR(sumOf(onto), made.mass(), 0.12 * made.mass()) << radius << ' ' << k;
            const double most = *std::max_element(onto.begin(), onto.end());
            if (radius == 0.2) {
                EXPECT_LT(most, 0.02 * made.mass());
            } else if (radius == 0.005) {
                EXPECT_GT(most, 0.2 * made.mass()) << "of a ball between four of them";
            }
        }
}

// A fixed table in between carries the load, although it has gaps between its corners.
TEST(Loads, WhatNeverMovesBearsWhatIsAboveIt) {
    BallOnCloth made;
    Scene scene = made.scene();
    EXPECT_GT(sumOf(massesOnto(scene)), 0);
    const auto at = [](float x, float z) { return Vec3{x, 0.1f, z}; };
    MeshCollider table{.thickness = 0.005f};
    for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 9; ++i)
            table.vertices.push_back(
                at(0.05f * static_cast<float>(i - 4), 0.05f * static_cast<float>(j - 4)));
    for (std::uint32_t j = 0; j < 8; ++j)
        for (std::uint32_t i = 0; i < 8; ++i) {
            const std::uint32_t v = 9 * j + i;
            table.triangles.push_back({v, v + 9, v + 1});
            table.triangles.push_back({v + 1, v + 9, v + 10});
        }
    const std::uint32_t first = addMeshCollider(scene, table);
    const std::vector<double> onto = massesOnto(scene);
    double onCloth = 0;
    for (std::uint32_t i = 0; i < made.size * made.size; ++i) onCloth += onto[i];
    EXPECT_LT(onCloth, 0.05 * made.mass());
    EXPECT_GT(sumOf({onto.begin() + first, onto.end()}), 0.8 * made.mass());
}

// The ball is up to 20,000 times as heavy as a particle of the cloth.
TEST(Loads, ABallIsCaughtByAClothWhateverItsSize) {
    for (const double radius : {0.015, 0.05, 0.1}) {
        const BallOnCloth made{.radius = radius, .speed = 1, .height = radius + 0.15};
        test::Runner runner(made.scene(), withSubsteps(made.scene(), {}));
        EXPECT_EQ(runner.run(30).nonFinite, 0u);
        EXPECT_GT(runner.positions().back().y(), -0.1) << radius;
    }
}

TEST(Loads, WhatLiesOnASheetPullsAtItsLinks) {
    const BallOnCloth made{.radius = 0.12, .thickness = 0.029};
    const Scene scene = made.scene();
    Scene apart = scene;
    apart.particles.back().position.x = 2;
    const SubstepChoice choice = chooseSubsteps(scene, {});
    EXPECT_EQ(choice.reason, SubstepReason::weight);
    EXPECT_GT(choice.wanted, 5 * chooseSubsteps(apart, {}).wanted);
}
