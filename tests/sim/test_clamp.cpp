// Tests of the sharp clamp (docs/clamp.md): its bound on random graphs and in the worst deformations found,
// its bits, its motion against the true one, and its energy.
#include "sim/compile/compile.hpp"
#include "sim/motion_error.hpp"
#include "sim/program/program.hpp"
#include "sim/reference/reference.hpp"
#include "sim/reference/trajectory.hpp"
#include "sim/runner.hpp"
#include "sim/stiffness/bearing.hpp"
#include "sim/stiffness/shares.hpp"
#include "sinew/bodies.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/material.hpp"
#include "sinew/ranges.hpp"
#include "sinew/substeps.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr float spacing = 0.05f;

Vector3d at(const Scene& scene, std::uint32_t particle) {
    const Vec3& x = scene.particles[particle].position;
    return {double{x.x}, double{x.y}, double{x.z}};
}

Vec3 toVec3(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// An estimate from below of the largest eigenvalue of h^2 M^-1 K in the scene's own state, each link with the
// stiffness that a substep gives it, by power iteration. A stretched link resists turning; that a compressed
// one yields to it is left out, since that only lowers the eigenvalue.
double largestEigenvalue(const Scene& scene, const Settings& settings, std::mt19937& random, int turns) {
    const std::vector<float> w = inverseMasses(scene);
    const stiffness::Shares shares = stiffness::sharesOf(scene, settings, w);
    const double h = double{scene.dt} / settings.substeps;
    std::vector<Matrix3d> blocks;
    for (std::size_t c = 0; c < scene.distances.size(); ++c) {
        const DistanceConstraint& link = scene.distances[c];
        const Vector3d d = at(scene, link.b) - at(scene, link.a), n = d.stableNormalized();
        const double clamp = double{shares.ofLinks[c]} *
                             double{std::min(shares.startTimes[link.a], shares.startTimes[link.b])};
        const double k = std::min(double{stiffness::stiffnessOf(link.compliance)} * h * h, clamp);
        const double turning = d.norm() > 0 ? std::max(1 - double{link.restLength} / d.norm(), 0.0) : 0;
        blocks.emplace_back(k * ((1 - turning) * n * n.transpose() + turning * Matrix3d::Identity()));
    }
    std::normal_distribution<double> normal;
    std::vector<Vector3d> x(w.size());
    for (Vector3d& v : x) v = {normal(random), normal(random), normal(random)};
    double value = 0;
    for (int turn = 0; turn < turns; ++turn) {
        double norm = 0;
        for (std::size_t i = 0; i < x.size(); ++i) norm += w[i] > 0 ? x[i].squaredNorm() / double{w[i]} : 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = w[i] > 0 ? Vector3d(x[i] / std::sqrt(std::max(norm, 1e-300))) : Vector3d::Zero();
        std::vector<Vector3d> forces(x.size(), Vector3d::Zero());
        for (std::size_t c = 0; c < blocks.size(); ++c) {
            const DistanceConstraint& link = scene.distances[c];
            const Vector3d pull = blocks[c] * (x[link.a] - x[link.b]);
            forces[link.a] += pull;
            forces[link.b] -= pull;
        }
        value = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            value += x[i].dot(forces[i]);
            x[i] = double{w[i]} * forces[i];
        }
    }
    return value;
}

TEST(SharpClamp, FindsLargestEigenvalues) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    double most = 0;
    for (int trial = 0; trial < 10'000; ++trial) {
        Matrix3d a = Matrix3d::Zero();
        for (int rank = 0; rank <= trial % 4; ++rank) {
            const Vector3d v(normal(random), normal(random), normal(random));
            a += v * v.transpose() * std::pow(10.0, trial % 7 - 3);
        }
        const double exact = Eigen::SelfAdjointEigenSolver<Matrix3d>(a).eigenvalues()[2];
        const double found =
            stiffness::largestEigenvalue({a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(0, 2), a(1, 2)});
        EXPECT_GE(found, exact * (1 - 1e-9));
        most = std::max(most, found / exact);
    }
    EXPECT_LE(most, 1.005);
}

// A graph of 2 to 15 particles with masses and stiffnesses over six powers of ten, scattered in space, a
// plane or a line, with links at rest or, if not isAtRest, compressed or stretched up to tenfold. Some
// particles never move.
Scene randomGraph(std::mt19937& random, bool isAtRest) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto power = [&](double range) { return static_cast<float>(std::pow(10.0, range * unit(random))); };
    Scene scene;
    const std::uint32_t count = 2 + static_cast<std::uint32_t>(random()) % 14;
    const std::uint32_t shape = static_cast<std::uint32_t>(random()) % 3;
    const bool isEven = random() % 3 == 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector3d x(unit(random), shape < 2 ? unit(random) : 0, shape < 1 ? unit(random) : 0);
        scene.particles.push_back({.position = toVec3(x), .inverseMass = isEven ? 1 : power(3)});
        if (random() % 8 == 0) scene.fixed.push_back({i});
    }
    const std::uint32_t links = 1 + static_cast<std::uint32_t>(random()) % (3 * count);
    for (std::uint32_t c = 0; c < links; ++c) {
        const std::uint32_t a = static_cast<std::uint32_t>(random()) % count,
                            b = static_cast<std::uint32_t>(random()) % count;
        if (a == b) continue;
        const double length = (at(scene, b) - at(scene, a)).norm();
        const double rest = isAtRest || random() % 2 == 0 ? length : length * std::pow(10.0, unit(random));
        scene.distances.push_back(
            {a, b, static_cast<float>(rest), random() % 8 == 0 ? 0 : power(isEven ? 1 : 3)});
    }
    return scene;
}

TEST(SharpClamp, KeepsItsBoundOnRandomGraphs) {
    std::mt19937 random(17);
    double worst = 0, worstAtRest = 0, sum = 0;
    for (int trial = 0; trial < 12'000; ++trial) {
        const bool isAtRest = trial % 3 == 0;
        const Scene scene = randomGraph(random, isAtRest);
        Settings settings{.substeps = 1 + static_cast<std::uint32_t>(random()) % 64, .hasSharpClamp = true};
        const double most = stiffness::mostOfLinks(scene, settings);
        const double value = largestEigenvalue(scene, settings, random, 60);
        ASSERT_LE(value, (isAtRest ? double{settings.omega} : most) * (1 + 1e-5)) << trial;
        double& greatest = isAtRest ? worstAtRest : worst;
        greatest = std::max(greatest, value);
        settings.hasSharpClamp = false;
        sum = std::max(sum, largestEigenvalue(scene, settings, random, 60));
    }
    std::printf("12,000 random graphs: at rest at most %.4f of 2, stretched %.4f of %.4f; by the sum %.4f\n",
                worstAtRest, worst, stiffness::mostOfLinks({}, {}), sum);
    EXPECT_GT(worstAtRest, 1.99) << "the bound is not sharp";
    EXPECT_GT(worst, 2) << "no graph uses the reserve";
}

// Random displacements that raise the eigenvalue are kept. It never passes the bound, at rest never omega.
TEST(SharpClamp, KeepsItsBoundInTheWorstDeformationFound) {
    std::mt19937 random(23);
    std::normal_distribution<double> normal;
    for (const bool isSheet : {false, true}) {
        Scene scene;
        if (isSheet)
            addCloth(
                scene,
                {.size = {5, 5}, .spacing = spacing, .stretchCompliance = 1e-3f, .shearCompliance = 1e-2f});
        else
            addLattice(scene, {.cells = {2, 2, 2}, .spacing = spacing, .youngModulus = 1e6f});
        const Settings settings{.substeps = 2, .hasSharpClamp = true};
        const double most = stiffness::mostOfLinks(scene, settings);
        double value = largestEigenvalue(scene, settings, random, 200);
        EXPECT_LE(value, 2 * (1 + 1e-5));
        EXPECT_GE(value, 1.2);
        const double atRest = value;
        for (int trial = 0; trial < 3000; ++trial) {
            Scene moved = scene;
            const double size = double{spacing} * std::pow(10.0, -0.5 * (trial % 4));
            for (Particle& particle : moved.particles)
                particle.position = toVec3(Vector3d(double{particle.position.x}, double{particle.position.y},
                                                    double{particle.position.z}) +
                                           size * Vector3d(normal(random), normal(random), normal(random)));
            const double other = largestEigenvalue(moved, settings, random, 60);
            ASSERT_LE(other, most * (1 + 1e-5));
            if (other <= value) continue;
            value = other;
            scene = moved;
        }
        std::printf("%s: at rest %.3f, in the worst deformation found %.3f of %.3f\n",
                    isSheet ? "sheet" : "solid", atRest, value, most);
    }
}

Scene hungSheet(float skipStiffness = 0) {
    Scene scene;
    addCloth(scene, {.size = {12, 14},
                     .spacing = spacing,
                     .stretchCompliance = 1e-3f,
                     .shearCompliance = 1e-2f,
                     .skipStiffness = skipStiffness,
                     .pinned = {0, 11}});
    return scene;
}

Scene heldBeam(float poissonRatio = 0.25f, bool isCuttable = false) {
    Scene scene;
    const LatticeCorners corners = addLattice(scene, {.cells = {11, 4, 3},
                                                      .spacing = spacing,
                                                      .youngModulus = 4e5f,
                                                      .poissonRatio = poissonRatio,
                                                      .isCuttable = isCuttable});
    for (std::uint32_t y = 0; y <= 4; ++y)
        for (std::uint32_t z = 0; z <= 3; ++z) scene.fixed.push_back({corners.at(0, y, z)});
    return scene;
}

// Stretched along x and squeezed along y about the origin.
Scene deformed(Scene scene) {
    for (Particle& particle : scene.particles) {
        particle.position.x *= 2.5f;
        particle.position.y *= 0.7f;
    }
    return scene;
}

Settings sharp(std::uint32_t substeps) {
    return {.substeps = substeps, .hasSharpClamp = true};
}

Settings bySum(std::uint32_t substeps) {
    return {.substeps = substeps, .hasSharpClamp = false};
}

TEST(SharpClamp, IsToldWithItsReason) {
    Scene damped = heldBeam();
    damped.dampingTime = 0.01f;
    Settings levels = sharp(5), jacobi = sharp(5);
    levels.levels = 2;
    jacobi.solver = Solver::jacobi;
    EXPECT_EQ(toText(clampOf(heldBeam(), sharp(5))), "sharp");
    EXPECT_EQ(toText(clampOf(heldBeam(), bySum(5))), "sum: as asked");
    EXPECT_EQ(toText(clampOf(heldBeam(), levels)), "sum: levels");
    EXPECT_EQ(toText(clampOf(damped, sharp(5))), "sum: internal damping");
    EXPECT_EQ(toText(clampOf(heldBeam(), sharp(64))), "sum: nothing is clamped");
    EXPECT_EQ(toText(clampOf({}, sharp(1))), "sum: nothing is clamped");
    EXPECT_EQ(toText(clampOf(heldBeam(), jacobi)), "none");
    EXPECT_EQ(clampOf(heldBeam(), sharp(0)), Clamp::sharp) << "with the number that is chosen";
}

TEST(SharpClamp, AgreesWithTheReference) {
    // From large deformations roundings grow tenfold a step.
    for (const auto& [scene, steps] : {std::pair(hungSheet(), 6),
                                       {hungSheet(20), 6},
                                       {heldBeam(), 6},
                                       {heldBeam(0.4f), 6},
                                       {deformed(hungSheet()), 1},
                                       {deformed(hungSheet(20)), 1},
                                       {deformed(heldBeam()), 1},
                                       {deformed(heldBeam(0.4f)), 1}}) {
        test::Runner runner(scene, sharp(11));
        reference::State state = reference::initialState(scene);
        for (int s = 0; s < steps; ++s) {
            runner.run(1);
            reference::stepSplit(scene, sharp(11), double{scene.dt}, state);
        }
        double most = 0;
        const std::vector<Vector3d> x = runner.positions();
        for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - state.x[i]).norm());
        EXPECT_LT(most, 2e-5 * reference::bodySize(scene));
    }
}

TEST(SharpClamp, HasTheSameBitsInEveryFormAndOrder) {
    for (const Scene& scene : {deformed(hungSheet()), deformed(heldBeam()), deformed(heldBeam(0.4f)),
                               deformed(heldBeam(0.25f, true)), deformed(heldBeam(0.4f, true))}) {
        const std::uint64_t hash = test::hashOfRun(scene, sharp(11));
        for (const bool isReversed : {false, true})
            for (const std::uint32_t chunk : {1u, 4u})
                for (const std::uint32_t residentBytes : {0u, 32'768u}) {
                    if (residentBytes > 0 && scene.grids[0].isCuttable) continue; // has no such form
                    Settings other = sharp(11);
                    other.isReversed = isReversed;
                    other.forms = {.usesTexels = chunk == 1,
                                   .columns = 1,
                                   .chunk = chunk,
                                   .residentBytes = residentBytes};
                    EXPECT_EQ(test::hashOfRun(scene, other), hash) << isReversed << chunk << residentBytes;
                }
    }
}

TEST(SharpClamp, NeedsFewerSubsteps) {
    for (const auto& [scene, ratio] : {std::pair(heldBeam(), 0.78), std::pair(hungSheet(), 0.75)}) {
        const reference::Trajectory truth =
            reference::trueTrajectory(scene, {.frames = 20, .tolerance = 1e-4});
        const std::uint32_t ofSum = chooseSubsteps(scene, bySum(0)).substeps;
        const std::uint32_t substeps = chooseSubsteps(scene, sharp(0)).substeps;
        EXPECT_LE(substeps, ratio * ofSum);
        const double without = test::errorOf(scene, bySum(substeps), truth);
        const double with = test::errorOf(scene, sharp(substeps), truth);
        std::printf("%u substeps in place of %u: error %.3g %% of the motion, with the sum %.3g %%\n",
                    substeps, ofSum, 100 * with, 100 * without);
        EXPECT_LT(with, 0.02);
        EXPECT_GT(without, 5 * with);
    }
}

// Clamps that the state has lowered are part of it.
TEST(SharpClamp, IsRememberedByASavedState) {
    const Scene scene = deformed(heldBeam());
    test::Runner runner(scene, sharp(5)), other(scene, sharp(5));
    runner.run(3);
    other.load(runner.save());
    runner.run(3);
    other.run(3);
    EXPECT_EQ(other.stateHash(), runner.stateHash());
}

// The directions of links are not followed where they cannot matter.
TEST(SharpClamp, LeavesAsItIsWhatTheSumDoesNotClamp) {
    for (const Scene& scene : {heldBeam(), heldBeam(0.4f), hungSheet()}) {
        const std::uint32_t exact =
            chooseSubsteps(scene, {.tolerance = 1e-4f, .hasSharpClamp = false}).substeps;
        EXPECT_EQ(test::hashOfRun(scene, sharp(exact)), test::hashOfRun(scene, bySum(exact)));
        EXPECT_EQ(describe(compile(scene, sharp(exact))), describe(compile(scene, bySum(exact))));
        EXPECT_NE(test::hashOfRun(scene, sharp(exact / 2)), test::hashOfRun(scene, bySum(exact / 2)));
    }
    Scene loose; // without links there is nothing to clamp
    loose.particles = {{.position = {0, 1, 0}, .inverseMass = 1, .radius = 0.1f},
                       {.position = {0.5f, 1, 0}, .inverseMass = 1, .radius = 0.1f}};
    EXPECT_EQ(describe(compile(loose, sharp(4))), describe(compile(loose, bySum(4))));
}

// A particle that hangs on a fixed one. With excess 0 the sum clamps the link to exactly what it asks for.
Scene pairAtTheThreshold(float inverseMass, float dt, std::uint32_t substeps, double excess) {
    Scene scene;
    scene.dt = dt;
    scene.particles = {{.position = {0, 0, 0}, .inverseMass = 0},
                       {.position = {0, -1, 0}, .inverseMass = inverseMass}};
    const double h = double{dt} / substeps;
    scene.distances = {{0, 1, 1, static_cast<float>(double{inverseMass} * h * h / (1 + excess))}};
    return scene;
}

// A link that is softer than asked by the rounding of float32 alone does not make a scene follow directions.
TEST(SharpClamp, IsNotChosenByRounding) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int trial = 0; trial < 2000; ++trial) {
        const auto w = static_cast<float>(std::pow(10.0, 3 * unit(random))),
                   dt = static_cast<float>(std::pow(10.0, unit(random) - 2));
        const std::uint32_t substeps = 1 + static_cast<std::uint32_t>(random()) % 64;
        const auto clampAt = [&](double excess) {
            return clampOf(pairAtTheThreshold(w, dt, substeps, excess), sharp(substeps));
        };
        ASSERT_EQ(clampAt(0), Clamp::sumWhole) << w << ' ' << dt << ' ' << substeps;
        ASSERT_EQ(clampAt(-1e-5), Clamp::sumWhole) << w << ' ' << dt << ' ' << substeps;
        ASSERT_EQ(clampAt(1e-5), Clamp::sharp) << w << ' ' << dt << ' ' << substeps;
    }
}

// Substeps in which the sum clamps nothing, but would with four times the stiffness.
std::uint32_t wholeSubsteps(const Scene& scene) {
    return chooseSubsteps(scene, {.tolerance = 1e-4f, .hasSharpClamp = false}).substeps;
}

// A material that crosses the threshold needs other passes. The new simulation takes the state over, and what
// moves never has more energy than the state had with the new material.
TEST(SharpClamp, ComesAndGoesWithTheMaterialAndKeepsTheState) {
    for (const Scene& soft : {heldBeam(), heldBeam(0.4f), hungSheet()}) {
        const Scene stiff = withMaterial(soft, {.stiffness = 4});
        const std::uint32_t substeps = wholeSubsteps(soft);
        ASSERT_EQ(clampOf(soft, sharp(substeps)), Clamp::sumWhole);
        ASSERT_EQ(clampOf(stiff, sharp(substeps)), Clamp::sharp);
        for (const auto& [before, after] :
             {std::pair(soft, stiff), {stiff, soft}, {deformed(soft), deformed(stiff)}}) {
            test::Runner first(before, sharp(substeps)), second(after, sharp(substeps));
            first.run(12);
            EXPECT_FALSE(first.change(after));
            second.takeOver(first);
            EXPECT_EQ(second.stateHash(), first.stateHash());
            reference::State state = reference::initialState(after);
            const auto energyNow = [&] {
                state.x = second.positions();
                state.v = second.velocities();
                return reference::energy(after, state);
            };
            const reference::Energy start = energyNow();
            for (int s = 0; s < 240; ++s) {
                ASSERT_EQ(second.run(1).nonFinite, 0u);
                const reference::Energy now = energyNow();
                ASSERT_LE(now.kinetic + now.gravitational, start.total() + 1e-3 * start.elastic) << s;
            }
        }
    }
}

// The choice is made for steps of Scene::dt; a longer one is clamped by what was chosen.
TEST(SharpClamp, StaysStableInStepsLongerThanThoseOfTheScene) {
    for (const Scene& scene : {heldBeam(), heldBeam(0.4f), hungSheet()})
        for (const bool isWhole : {true, false}) {
            const std::uint32_t substeps = isWhole ? wholeSubsteps(scene) : 11;
            test::Runner runner(scene, sharp(substeps)), sum(scene, bySum(substeps));
            reference::State state = reference::initialState(scene), moved = state;
            const double energy = reference::energy(scene, state).total();
            for (int s = 0; s < 120; ++s) {
                const float dt = 3 * scene.dt;
                ASSERT_EQ(runner.step(dt).nonFinite, 0u);
                moved.x = runner.positions();
                moved.v = runner.velocities();
                const reference::Energy now = reference::energy(scene, moved);
                ASSERT_LE(now.kinetic + now.gravitational, energy + 1e-3 * std::abs(energy) + 1e-6) << s;
                if (isWhole) {
                    sum.step(dt);
                    ASSERT_EQ(runner.stateHash(), sum.stateHash()) << s;
                }
                if (s > 2) continue; // roundings grow
                reference::stepSplit(scene, sharp(substeps), double{dt}, state);
                double most = 0;
                for (std::size_t i = 0; i < moved.x.size(); ++i)
                    most = std::max(most, (moved.x[i] - state.x[i]).norm());
                EXPECT_LT(most, 2e-5 * reference::bodySize(scene)) << s;
            }
        }
}

TEST(SharpClamp, LeavesLevelsAsTheyAre) {
    const Scene scene = heldBeam();
    Settings settings{.substeps = 5, .levels = 2, .hasSharpClamp = false};
    const std::uint64_t hash = test::hashOfRun(scene, settings);
    settings.hasSharpClamp = true;
    EXPECT_EQ(test::hashOfRun(scene, settings), hash);
}

// Dampers take what the sum leaves of the bound for stability.
TEST(SharpClamp, LeavesInternalDampingAsItIs) {
    for (const float dampingTime : {0.001f, 0.1f}) {
        Scene scene = heldBeam();
        scene.dampingTime = dampingTime;
        for (const std::uint32_t substeps : {5u, 11u}) {
            EXPECT_EQ(test::hashOfRun(scene, sharp(substeps)), test::hashOfRun(scene, bySum(substeps)));
            EXPECT_EQ(describe(compile(scene, sharp(substeps))), describe(compile(scene, bySum(substeps))));
        }
        EXPECT_EQ(chooseSubsteps(scene, sharp(0)).substeps, chooseSubsteps(scene, bySum(0)).substeps);
    }
}

double kineticEnergy(const Scene& scene, const std::vector<Vector3d>& v) {
    double sum = 0;
    const std::vector<float> w = inverseMasses(scene);
    for (std::size_t i = 0; i < v.size(); ++i)
        if (w[i] > 0) sum += v[i].squaredNorm() / (2 * double{w[i]});
    return sum;
}

// Collapsed, mirrored, scattered, stretched: kinetic energy never passes the energy that the links had.
TEST(SharpClamp, StaysStableFromAnyDeformation) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(-0.3f, 0.3f);
    using Place = Vec3 (*)(const Vec3&);
    const std::vector<Place> places{[](const Vec3& x) {
                                        return Vec3{x.x, 0.01f * x.y, x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{0.01f * x.x, 0.01f * x.y, x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{0.01f * x.x, 0.01f * x.y, 0.01f * x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{-x.x, x.y, x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{10 * x.x, x.y, x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{10 * x.x, 10 * x.y, 10 * x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{3 * x.x, 0.001f * x.y, 5 * x.z};
                                    }};
    for (const bool isSheet : {false, true})
        for (std::size_t kind = 0; kind <= places.size(); ++kind)
            for (const std::uint32_t substeps : {1u, 3u, 10u}) {
                Scene scene;
                scene.gravity = {0, 0, 0};
                if (isSheet)
                    addCloth(scene, {.size = {9, 9},
                                     .spacing = spacing,
                                     .stretchCompliance = 1e-3f,
                                     .shearCompliance = 1e-2f});
                else
                    addLattice(scene, {.cells = {6, 6, 6}, .spacing = spacing, .youngModulus = 1e6f});
                for (Particle& particle : scene.particles)
                    particle.position = kind < places.size()
                                            ? places[kind](particle.position)
                                            : Vec3{anywhere(random), anywhere(random), anywhere(random)};
                const double energy = reference::energy(scene, reference::initialState(scene)).elastic;
                test::Runner runner(scene, sharp(substeps));
                double most = 0, last = 0;
                for (int s = 0; s < 120; ++s) {
                    runner.run(1);
                    last = kineticEnergy(scene, runner.velocities());
                    most = std::max(most, last);
                    ASSERT_LE(last, energy + 1e-6) << (isSheet ? "sheet" : "solid") << ", kind " << kind
                                                   << ", " << substeps << " substeps, step " << s;
                }
                EXPECT_LE(last, 0.2 * energy + 1e-6) << kind << ", " << substeps;
            }
}

} // namespace
} // namespace sinew::sim
