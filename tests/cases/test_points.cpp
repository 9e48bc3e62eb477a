// Cases 1 and 2: free fall and one rigid link.
#include "cases/cases.hpp"

using namespace sinew;
using namespace sinew::sim;
using namespace sinew::test;
using Eigen::Vector3d;

namespace {

constexpr float frame = 1.0f / 60;

class Case01FreeFall : public SolverCase {};
class Case02RigidLink : public SolverCase {};

} // namespace

TEST_P(Case01FreeFall, IsExactForAnyStep) {
    Scene scene = particleAt({0.3f, 0, -2}, {1, 4, 0.5f});
    scene.gravity = {0.5f, -9.81f, 0};
    for (const std::uint32_t substeps : {1u, 7u, 10u}) {
        CaseRunner runner(scene, accurate(GetParam(), substeps));
        double t = 0;
        float dt = frame;
        for (int step = 0; step < 60; ++step) {
            dt = frame * static_cast<float>(1 + step * 7 % 5) / 3;
            runner.step(dt);
            t += double{dt};
        }
        const Vector3d g = toVector(scene.gravity), v = toVector(scene.particles[0].velocity);
        const Vector3d path = t * v + t * t / 2 * g;
        const Vector3d x = toVector(scene.particles[0].position) + path;
        RecordProperty("position", std::to_string((runner.positions()[0] - x).norm() / path.norm()));
        EXPECT_LE((runner.positions()[0] - x).norm(), 1e-5 * path.norm()) << substeps << " substeps";
        const double lag = GetParam() == Solver::split ? double{dt} / substeps / 2 : 0; // leapfrog
        EXPECT_LE((runner.velocities()[0] - v - (t - lag) * g).norm(), 1e-5 * (t * g).norm());
    }
}

TEST_P(Case02RigidLink, HasItsLengthAfterOneProjectionAroundAFixedCentre) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.particles = {{.position = {-0.31f, 0.12f, 0.05f}}, {.position = {0.24f, -0.2f, 0.4f}}};
    scene.distances = {{0, 1, 0.5f, 0}};
    // `split` applies half of omega in its starting half-kick, so omega 2 is one full projection.
    CaseRunner runner(scene, {.solver = GetParam(), .substeps = 1, .omega = 2, .theta = 0});
    const Vector3d before = (runner.positions()[0] + runner.positions()[1]) / 2;
    runner.step(frame);
    const auto x = runner.positions();
    EXPECT_NEAR((x[1] - x[0]).norm(), 0.5, 4 * ulp(0.5));
    EXPECT_LE(((x[0] + x[1]) / 2 - before).cwiseAbs().maxCoeff(), 2 * ulp(0.3));
}

INSTANTIATE_TEST_SUITE_P(Of, Case01FreeFall, testing::ValuesIn(caseSolvers), solverOf);
INSTANTIATE_TEST_SUITE_P(Of, Case02RigidLink, testing::ValuesIn(caseSolvers), solverOf);
