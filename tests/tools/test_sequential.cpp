// Compares the sequential program with the reference in double precision, which shares no code with it.
#include "sinew/sequential.hpp"

#include "scenes/load.hpp"
#include "sim/reference/reference.hpp"

#include <gtest/gtest.h>

using namespace sinew;
using tools::ConstraintOrder;
using tools::Sequential;

namespace {

/// Largest distance [m] between a sequential run and the reference after some steps.
double distanceFromReference(const scenes::LoadedScene& loaded, int steps) {
    Sequential sequential(loaded.scene, loaded.settings, ConstraintOrder::natural);
    sim::reference::State state = sim::reference::initialState(loaded.scene);
    sim::Settings cold = loaded.settings;
    cold.warmStart = 0; // the sequential rows time this form, which starts every substep cold
    sim::reference::GaussSeidel reference(loaded.scene, cold);
    double largest = 0;
    for (int step = 0; step < steps; ++step) {
        sequential.step();
        reference.step(double{loaded.scene.dt}, state);
    }
    for (std::size_t i = 0; i < state.x.size(); ++i) {
        const auto& x = sequential.positions()[i];
        largest = std::max(largest,
                           (Eigen::Vector3d(double{x[0]}, double{x[1]}, double{x[2]}) - state.x[i]).norm());
    }
    return largest;
}

} // namespace

TEST(Sequential, FollowsTheReferenceOnElasticBodies) {
    // Few substeps: v = corrections / h turns the rounding of a position (1.2e-7 m at 1 m) into 6e-5 m/s a
    // substep. 32 substeps in 0.07 s would add it up to a random walk of about 2e-5 m.
    for (const char* name : {"beam", "cloth_study"}) {
        const scenes::LoadedScene loaded = scenes::loadBuiltIn(name, {.substeps = 8});
        EXPECT_LT(distanceFromReference(loaded, 4), 3e-5) << name;
    }
}

TEST(Sequential, FollowsTheReferenceOntoAPlaneWithFrictionAndDamping) {
    scenes::LoadedScene cube = scenes::loadBuiltIn("cube");
    for (sim::Particle& particle : cube.scene.particles) {
        particle.position.y -= 0.27f; // the lowest layer starts 3 cm above the floor
        particle.velocity = {1, -0.5f, 0};
    }
    cube.scene.planes[0].restitution = 0.5f;
    EXPECT_LT(distanceFromReference(cube, 4), 1e-4);
}

TEST(Sequential, MovesAsMuchInEitherOrder) {
    const scenes::LoadedScene beam = scenes::loadBuiltIn("beam");
    Sequential natural(beam.scene, beam.settings, ConstraintOrder::natural),
        color(beam.scene, beam.settings, ConstraintOrder::color);
    for (int step = 0; step < 6; ++step) {
        natural.step();
        color.step();
    }
    double largest = 0, moved = 0;
    for (std::size_t i = 0; i < beam.scene.particles.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            largest = std::max(largest,
                               double{std::abs(natural.positions()[i][axis] - color.positions()[i][axis])});
            moved = std::max(moved, 0.5 - double{natural.positions()[i][1]});
        }
    EXPECT_GT(moved, 0.03);
    EXPECT_LT(largest, 0.02 * moved);
    EXPECT_GT(largest, 0) << "orders differ";
}

TEST(Sequential, SaysHowItWasCompiled) {
    EXPECT_EQ(std::string(tools::sequentialFlags()).substr(0, 3), "-O3");
}
