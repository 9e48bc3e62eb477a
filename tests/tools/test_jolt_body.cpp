// Tests that Jolt simulates the same scene, where Sinew is built with it.
#include "sinew/bodies.hpp"
#include "sinew/cpu_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sinew;

TEST(JoltBody, HasTheStiffnessOfTheSceneWhateverTheSubsteps) {
    // Two equal masses hang on links of 1 m and 1 mm/N. The lower one swings about 3 m g c below its place:
    // two weights stretch the upper link, one the lower link.
    sim::Scene scene;
    sim::addChain(scene, {.particles = 3, .length = 2, .mass = 2, .compliance = 0.001f, .pinned = {0}});
    double mass = 0;
    for (const sim::Particle& particle : scene.particles)
        if (particle.inverseMass > 0) mass = 1 / double{particle.inverseMass};
    for (const std::uint32_t threads : {1u, 2u})
        for (const std::uint32_t substeps : {16u, 48u}) {
            const auto body = tools::makeJoltBody(scene, substeps, threads);
            ASSERT_NE(body, nullptr);
            constexpr int frames = 600;
            double sum = 0;
            for (int frame = 0; frame < frames; ++frame) {
                body->step();
                EXPECT_EQ(body->positions()[0].norm(), 0) << "the pinned end";
                sum += body->positions()[2].y() + 2;
            }
            EXPECT_NEAR(sum / frames, -9.81 * 0.001 * 3 * mass, 0.02 * 9.81 * 0.001 * 3 * mass)
                << substeps << " substeps, " << threads << " threads";
        }
}
