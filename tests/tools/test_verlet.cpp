// Tests that the native program integrates the same equations as the reference, in float and in double.
#include "sinew/native/verlet.hpp"

#include "scenes/load.hpp"
#include "sim/reference/trajectory.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew;
using tools::native::Verlet;

namespace {

template <typename Real> Eigen::Vector3d at(const Verlet<Real>& verlet, std::size_t i) {
    const std::array<double, 3> x = verlet.position(i);
    return {x[0], x[1], x[2]};
}

/// The largest distance after `steps` steps from velocity Verlet of the reference with equal substeps [m].
template <typename Real>
double distanceFromReference(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t threads) {
    constexpr std::uint32_t steps = 5;
    Verlet<Real> verlet(scene, substeps, threads);
    for (std::uint32_t i = 0; i < steps; ++i) verlet.step();
    sim::reference::State state = sim::reference::initialState(scene);
    sim::reference::stepVerlet(scene, double{scene.dt} / substeps, std::uint64_t{steps} * substeps, state);
    double largest = 0;
    for (std::size_t i = 0; i < verlet.size(); ++i)
        largest = std::max(largest, (at(verlet, i) - state.x[i]).norm());
    return largest;
}

sim::Scene cloth() {
    sim::Scene scene;
    sim::addCloth(scene, {.size = {33, 20}, // two tiles, rows that end within them
                          .spacing = 0.03f,
                          .stretchCompliance = 1e-3f,
                          .shearCompliance = 1e-2f,
                          .skipStiffness = 10,
                          .pinned = {0, 32}});
    return scene;
}

} // namespace

TEST(Verlet, IntegratesTheEquationsOfTheReference) {
    for (const sim::Scene& scene :
         {cloth(), scenes::loadBuiltIn("beam").scene, scenes::loadBuiltIn("chain").scene}) {
        const std::uint32_t substeps = scene.name == "chain" ? 401 : 101; // odd: the arrays swap
        EXPECT_LT(distanceFromReference<double>(scene, substeps, 1), 1e-9) << scene.name;
        EXPECT_LT(distanceFromReference<float>(scene, substeps, 1), 2e-4) << scene.name;
    }
}

TEST(Verlet, HasTheSameBitsWithAnyNumberOfThreads) {
    const sim::Scene scene = cloth();
    Verlet<float> one(scene, 100, 1), three(scene, 100, 3);
    for (int i = 0; i < 10; ++i) {
        one.step();
        three.step();
    }
    double moved = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one.position(i), three.position(i)) << i;
        moved = std::max(moved, std::abs(one.position(i)[1] - double{scene.particles[i].position.y}));
    }
    EXPECT_GT(moved, 0.05) << "the cloth falls";
}

TEST(Verlet, HoldsWhatIsFixedAndDivergesWithTooFewSubsteps) {
    const sim::Scene scene = cloth();
    Verlet<float> few(scene, 2, 1), enough(scene, 100, 1);
    for (int i = 0; i < 20; ++i) {
        few.step();
        enough.step();
    }
    EXPECT_EQ(enough.position(0)[1], double{scene.particles[0].position.y});
    EXPECT_TRUE(std::isfinite(enough.position(300)[1]));
    EXPECT_FALSE(std::isfinite(few.position(300)[1]) && std::abs(few.position(300)[1]) < 100);
}

TEST(Verlet, GivesEndsInOnePlaceNoForce) {
    sim::Scene scene;
    scene.gravity = {};
    scene.particles = {{.position = {1, 2, 3}}, {.position = {1, 2, 3}}};
    scene.distances = {{0, 1, 0.1f, 1e-3f}};
    Verlet<float> verlet(scene, 4, 1);
    verlet.step();
    EXPECT_EQ(verlet.position(1), (std::array<double, 3>{1, 2, 3}));
}
