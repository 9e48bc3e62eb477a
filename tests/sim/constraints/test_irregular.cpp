// Tests of `split` on graphs in which few particles have most of the links: these use lists instead of slots.
#include "sim/compile/compile.hpp"
#include "sim/constraints/agreement.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using namespace sinew::sim;

namespace {

// A wheel: `spokes` particles around a hub ten times as heavy, linked to the hub and to their neighbours.
Scene wheel(std::uint32_t spokes, float compliance) {
    Scene scene{.name = "wheel"};
    scene.particles.push_back({.position = {0, 1, 0}, .inverseMass = 0.1f});
    const double angle = 2 * 3.14159265358979 / spokes;
    const auto rim = static_cast<float>(2 * std::sin(angle / 2));
    for (std::uint32_t i = 0; i < spokes; ++i) {
        const auto x = static_cast<float>(std::cos(angle * i)), y = static_cast<float>(std::sin(angle * i));
        scene.particles.push_back({.position = {x, 1 + y, 0}});
        scene.distances.push_back({0, i + 1, 1, compliance});
        scene.distances.push_back({i + 1, (i + 1) % spokes + 1, rim, compliance});
    }
    return scene;
}

std::uint64_t bytesOf(const StepProgram& program, const std::string& label) {
    for (const BufferSpec& buffer : program.buffers)
        if (buffer.label == label) return buffer.bytes();
    return 0;
}

} // namespace

TEST(IrregularGraph, StepsAgreeWithDouble) {
    for (const std::uint32_t spokes : {127u, 200u, 1000u}) {
        for (const float compliance : {1e-3f, 1e-6f}) {
            Scene scene = wheel(spokes, compliance);
            test::disturb(scene, 0.2f / static_cast<float>(spokes), 0.5f);
            ASSERT_TRUE(test::usesKernel(scene, "gather_split_ranged"));
            test::expectAgreement(scene, Solver::split);
        }
    }
}

TEST(IrregularGraph, StepsAgreeWithDoubleOnAFloorWithBendsAndInternalDamping) {
    for (const bool bends : {false, true}) {
        for (const float dampingTime : {0.0f, 1e-3f}) {
            Scene scene = wheel(150, 1e-4f);
            if (bends)
                for (std::uint32_t i = 3; i <= 150; ++i) scene.bends.push_back({i - 2, i - 1, i, 1e-2f});
            scene.dampingTime = dampingTime;
            test::addRoom(scene);
            test::disturb(scene, 1e-3f, 0.5f);
            constexpr std::uint32_t hasDamping = 12; // constant_id in gather_terms.glsl
            ASSERT_TRUE(test::usesKernel(scene, "gather_split_ranged", {}, {{hasDamping, dampingTime > 0}}));
            test::expectAgreement(scene, Solver::split);
        }
    }
}

TEST(IrregularGraph, TakesMemoryForItsLinksAndNotForTheLargestNumberOfThem) {
    const Scene scene = wheel(50'000, 1e-3f);
    const StepProgram program = compile(scene, {.substeps = 4});
    EXPECT_EQ(bytesOf(program, "distance.links"), 2 * 16 * scene.distances.size());
    EXPECT_FALSE(test::usesKernel(test::chain(100), "gather_split_ranged"));
    EXPECT_FALSE(test::usesKernel(test::block(4, 0.1f, 1e5f), "gather_split_ranged"));
}

TEST(IrregularGraph, KeepsItsMomentum) {
    Scene scene = wheel(300, 1e-4f);
    scene.gravity = {0, 0, 0};
    test::disturb(scene, 1e-3f, 0.5f);
    const auto momentum = [&](const std::vector<Eigen::Vector3d>& v) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < v.size(); ++i) sum += v[i] / double{scene.particles[i].inverseMass};
        return sum;
    };
    test::Runner runner(scene, {.substeps = 16});
    const Eigen::Vector3d before = momentum(runner.velocities());
    runner.run(60);
    EXPECT_LE((momentum(runner.velocities()) - before).norm(), 1e-5 * 310 * 0.5);
}
