// Tests of coarse levels: their motion against the true one, their bits, their bounds, and cuts.
#include "sim/cutting/cut_body.hpp"
#include "sim/levels/blocks.hpp"
#include "sim/motion_error.hpp"
#include "sim/reference/reference.hpp"
#include "sim/reference/trajectory.hpp"
#include "sim/runner.hpp"
#include "sim/stiffness/shares.hpp"
#include "sim/world_play.hpp"
#include "sinew/bodies.hpp"
#include "sinew/inspection.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/material.hpp"
#include "sinew/ranges.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace sinew::sim {
namespace {

using Eigen::Vector3d;

constexpr float spacing = 0.05f;

// A sheet of 24 x 24 particles that hangs by two corners and starts horizontal.
Scene hungSheet() {
    Scene scene;
    addCloth(scene, {.size = {24, 24},
                     .spacing = spacing,
                     .stretchCompliance = 1e-3f,
                     .shearCompliance = 1e-2f,
                     .pinned = {0, 23}});
    return scene;
}

// A beam of 15 x 4 x 4 cells that is held at one end.
Scene heldBeam(bool isCuttable = false) {
    Scene scene;
    const Lattice lattice{
        .cells = {15, 4, 4}, .spacing = spacing, .youngModulus = 4e5f, .isCuttable = isCuttable};
    const LatticeCorners corners = addLattice(scene, lattice);
    for (std::uint32_t y = 0; y <= 4; ++y)
        for (std::uint32_t z = 0; z <= 4; ++z) scene.fixed.push_back({corners.at(0, y, z)});
    return scene;
}

Scene freeBlock(std::array<std::uint32_t, 3> cells, bool isCuttable = false) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    addLattice(scene, {.cells = cells, .spacing = spacing, .youngModulus = 1e6f, .isCuttable = isCuttable});
    return scene;
}

double farthest(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

void expectLikeReference(const Scene& scene, const Settings& settings, int steps) {
    test::Runner runner(scene, settings);
    reference::State state = reference::initialState(scene);
    for (int s = 0; s < steps; ++s) {
        runner.run(1);
        reference::stepSplit(scene, settings, double{scene.dt}, state);
    }
    EXPECT_LT(farthest(runner.positions(), state.x), 2e-5 * reference::bodySize(scene));
}

double kineticEnergy(const Scene& scene, const std::vector<Vector3d>& v) {
    double sum = 0;
    const std::vector<float> w = inverseMasses(scene);
    for (std::size_t i = 0; i < v.size(); ++i)
        if (w[i] > 0) sum += v[i].squaredNorm() / (2 * double{w[i]});
    return sum;
}

std::vector<levels::Level> levelsOf(const Scene& scene, const Settings& settings) {
    const std::vector<float> w = inverseMasses(scene);
    const stiffness::Shares shares = stiffness::sharesOf(scene, settings, w);
    return levels::levelsOf(scene, settings, 0, w, shares);
}

TEST(Levels, MoveASheetNearlyAsItsFullStiffness) {
    const Scene scene = hungSheet();
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 30, .tolerance = 1e-4});
    const double without = test::errorOf(scene, {.substeps = 8, .hasSharpClamp = false}, truth);
    const double with = test::errorOf(scene, {.substeps = 8, .levels = 3}, truth);
    EXPECT_GT(without, 0.2);
    EXPECT_LT(with, 0.07);
    EXPECT_LT(with, without / 6);
}

TEST(Levels, MoveABeamNearlyAsItsFullStiffness) {
    const Scene scene = heldBeam();
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 30, .tolerance = 1e-4});
    const double without = test::errorOf(scene, {.substeps = 10, .hasSharpClamp = false}, truth);
    const double with = test::errorOf(scene, {.substeps = 10, .levels = 2}, truth);
    EXPECT_GT(without, 0.5);
    EXPECT_LT(with, 0.11);
    EXPECT_LT(with, without / 6);
}

TEST(Levels, ChangeNothingWhereNoLinkLacksStiffness) {
    const Scene scene = heldBeam();
    const Settings exact{.substeps = chooseSubsteps(scene, {.tolerance = 0.001f}).substeps};
    Settings with = exact;
    with.levels = 3;
    EXPECT_EQ(test::hashOfRun(scene, with), test::hashOfRun(scene, exact));
}

TEST(Levels, AgreeWithTheReference) {
    expectLikeReference(hungSheet(), {.substeps = 6, .levels = 3}, 12);
    expectLikeReference(heldBeam(), {.substeps = 6, .levels = 2}, 12);
    Scene holes; // blocks with missing nodes, bodies of unequal size, links that are not on a grid
    Lattice lattice{.cells = {7, 5, 3}, .spacing = spacing, .youngModulus = 1e6f};
    lattice.fill.assign(std::size_t{7} * 5 * 3, 1);
    for (std::size_t c = 0; c < lattice.fill.size(); c += 4) lattice.fill[c] = c % 3 == 0 ? 0 : 0.3f;
    addLattice(holes, lattice);
    addLattice(holes, {.origin = {1, 0, 0}, .cells = {2, 2, 9}, .spacing = spacing, .youngModulus = 3e5f});
    addCloth(holes, {.origin = {2, 0, 0}, .size = {9, 6}, .spacing = spacing, .skipStiffness = 20});
    holes.planes.push_back({.normal = {0, 1, 0}, .offset = -0.05f, .friction = 0.4f});
    expectLikeReference(holes, {.substeps = 4, .levels = 6}, 12);
}

TEST(Levels, HaveTheSameBitsInEveryFormAndOrder) {
    for (const Scene& scene : {hungSheet(), heldBeam(), heldBeam(true)}) {
        const Settings settings{.substeps = 5, .levels = 3};
        const std::uint64_t hash = test::hashOfRun(scene, settings);
        for (const bool isReversed : {false, true})
            for (const bool usesTexels : {false, true})
                for (const std::uint32_t chunk : {1u, 4u}) {
                    Settings other = settings;
                    other.isReversed = isReversed;
                    other.forms = {.usesTexels = usesTexels, .columns = 1, .chunk = chunk};
                    EXPECT_EQ(test::hashOfRun(scene, other), hash) << isReversed << usesTexels << chunk;
                }
    }
}

TEST(Levels, KeepMomentum) {
    Scene scene = freeBlock({8, 6, 5});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> speed(-0.3f, 0.3f);
    for (Particle& particle : scene.particles) {
        const Vec3& x = particle.position;
        particle.velocity = {speed(random) - 3 * x.y, speed(random) + 3 * x.x, speed(random)};
    }
    test::Runner runner(scene, {.substeps = 4, .levels = 3});
    const auto sums = [&] {
        Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
        const std::vector<Vector3d> x = runner.positions(), v = runner.velocities();
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double m = 1 / double{scene.particles[i].inverseMass};
            linear += m * v[i];
            angular += m * x[i].cross(v[i]);
        }
        return std::pair(linear, angular);
    };
    const auto [linear, angular] = sums();
    runner.run(200);
    const auto [linearAfter, angularAfter] = sums();
    EXPECT_LT((linearAfter - linear).norm(), 2e-5 * angular.norm());
    EXPECT_LT((angularAfter - angular).norm(), 0.01 * angular.norm()); // velocities are half a substep old
}

// Collapsed, mirrored, scattered, stretched: kinetic energy never passes the energy that the links had.
TEST(Levels, StayStableFromAnyDeformation) {
    const Scene rest = freeBlock({6, 6, 6});
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
                                        return Vec3{-x.x, x.y, x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{10 * x.x, x.y, x.z};
                                    },
                                    [](const Vec3& x) {
                                        return Vec3{3 * x.x, 0.001f * x.y, 5 * x.z};
                                    }};
    for (std::size_t kind = 0; kind <= places.size(); ++kind)
        for (const std::uint32_t substeps : {1u, 2u, 4u, 8u}) {
            Scene scene = rest;
            for (Particle& particle : scene.particles)
                particle.position = kind < places.size()
                                        ? places[kind](particle.position)
                                        : Vec3{anywhere(random), anywhere(random), anywhere(random)};
            const double energy = reference::energy(scene, reference::initialState(scene)).elastic;
            test::Runner runner(scene, {.substeps = substeps, .levels = 3});
            for (int s = 0; s < 120; ++s) {
                runner.run(1);
                ASSERT_LE(kineticEnergy(scene, runner.velocities()), energy + 1e-6)
                    << "kind " << kind << ", " << substeps << " substeps, step " << s;
            }
        }
}

// sum of k (u . strain u)^2 L^2, u the direction of a link.
double energyOf(const levels::Level& level, const Eigen::Matrix3d& strain,
                const std::function<double(const levels::Link&)>& stiffness) {
    double sum = 0;
    for (const levels::Link& link : level.links) {
        const Vector3d u = Vector3d(link.step[0], link.step[1], link.step[2]).normalized();
        sum += stiffness(link) * std::pow(link.length * u.dot(strain * u), 2);
    }
    return sum;
}

// The links of a level have the energy of a uniform strain that the level below lacks, but for strains across
// a body of one block.
TEST(Levels, KeepTheEnergyOfUniformStrain) {
    std::array<Eigen::Matrix3d, 4> strains;
    for (Eigen::Matrix3d& strain : strains) strain.setZero();
    for (int axis = 0; axis < 3; ++axis) strains[axis](axis, axis) = 1;
    strains[3](0, 1) = strains[3](1, 0) = 0.5;
    for (const std::array<std::uint32_t, 3>& cells :
         {std::array{15u, 15u, 15u}, {16u, 1u, 1u}, {24u, 6u, 6u}, {6u, 6u, 1u}}) {
        const Scene scene = freeBlock(cells);
        const Settings settings{.substeps = 2, .levels = 1}; // more would reach the bound in a rod
        const std::vector<levels::Level> all = levelsOf(scene, settings);
        ASSERT_EQ(all.size(), 2u);
        const double h = double{scene.dt} / settings.substeps;
        const auto missing = [&](const levels::Link& link) {
            return std::max(link.stiffness - link.most / (h * h), 0.0);
        };
        for (std::size_t kind = 0; kind < strains.size(); ++kind) {
            const double below = energyOf(all[0], strains[kind], missing);
            const double here =
                energyOf(all[1], strains[kind], [](const levels::Link& link) { return link.stiffness; });
            const bool isFlat = kind < 3 ? cells[kind] == 1 : cells[0] == 1 || cells[1] == 1;
            if (isFlat)
                EXPECT_EQ(here, 0) << cells[0] << ", strain " << kind;
            else
                EXPECT_NEAR(here, below, 0.08 * below) << cells[0] << ", strain " << kind;
        }
    }
}

// Largest eigenvalue of h^2 M^-1 K of all levels together, links in random directions, by power iteration.
double largestEigenvalue(const std::vector<levels::Level>& all, std::mt19937& random, bool isFlat) {
    std::normal_distribution<double> normal;
    std::vector<std::vector<Vector3d>> direction(all.size());
    for (std::size_t l = 0; l < all.size(); ++l)
        for (std::size_t k = 0; k < all[l].links.size(); ++k)
            direction[l].push_back(
                isFlat ? Vector3d(1, 0, 0)
                       : Vector3d(normal(random), normal(random), normal(random)).normalized());
    std::vector<Vector3d> x(all[0].nodes.size());
    for (Vector3d& v : x) v = {normal(random), normal(random), normal(random)};
    double value = 0;
    for (int turn = 0; turn < 60; ++turn) {
        double norm = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            if (all[0].nodes[i].inverseMass > 0) norm += x[i].squaredNorm() / all[0].nodes[i].inverseMass;
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = all[0].nodes[i].inverseMass > 0 ? Vector3d(x[i] / std::sqrt(std::max(norm, 1e-300)))
                                                   : Vector3d::Zero();
        std::vector<std::vector<Vector3d>> places{x}, forces;
        for (std::size_t l = 0; l < all.size(); ++l) {
            if (l > 0) {
                places.emplace_back(all[l].nodes.size(), Vector3d::Zero());
                for (std::size_t i = 0; i < all[l - 1].nodes.size(); ++i)
                    places[l][all[l - 1].nodes[i].parent] += all[l - 1].nodes[i].weight * places[l - 1][i];
            }
            forces.emplace_back(all[l].nodes.size(), Vector3d::Zero());
            for (std::size_t k = 0; k < all[l].links.size(); ++k) {
                const levels::Link& link = all[l].links[k];
                const Vector3d& n = direction[l][k];
                const Vector3d pull = link.most * n.dot(places[l][link.a] - places[l][link.b]) * n;
                forces[l][link.a] += pull;
                forces[l][link.b] -= pull;
            }
        }
        for (std::size_t l = all.size() - 1; l > 0; --l)
            for (std::size_t i = 0; i < all[l - 1].nodes.size(); ++i)
                forces[l - 1][i] += all[l - 1].nodes[i].weight * forces[l][all[l - 1].nodes[i].parent];
        value = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            value += x[i].dot(forces[0][i]);
            x[i] = all[0].nodes[i].inverseMass * forces[0][i];
        }
    }
    return value;
}

TEST(Levels, KeepTheirBoundOnRandomBodies) {
    std::mt19937 random(11);
    const auto upTo = [&](std::uint32_t n) { return 1 + static_cast<std::uint32_t>(random()) % n; };
    double worst = 0;
    for (int trial = 0; trial < 10'000; ++trial) {
        Scene scene;
        Lattice lattice{.cells = {upTo(9), upTo(5), upTo(4)},
                        .spacing = spacing,
                        .youngModulus = std::pow(10.0f, 3 + static_cast<float>(random() % 5)),
                        .hasBodyDiagonals = random() % 2 == 0};
        lattice.fill.resize(std::size_t{lattice.cells[0]} * lattice.cells[1] * lattice.cells[2]);
        for (float& fill : lattice.fill) fill = random() % 4 == 0 ? 0.0f : random() % 2 == 0 ? 0.2f : 1.0f;
        lattice.fill[0] = 1;
        if (random() % 3 > 0)
            addLattice(scene, lattice);
        else
            addCloth(scene, {.size = {1 + upTo(12), 1 + upTo(12)},
                             .spacing = spacing,
                             .stretchCompliance = random() % 2 == 0 ? 0 : 1e-3f,
                             .shearCompliance = 1e-2f});
        for (Particle& particle : scene.particles)
            if (random() % 20 == 0) particle.inverseMass = 0;
        const Settings settings{.substeps = upTo(12), .levels = upTo(6)};
        if (std::ranges::none_of(scene.particles, [](const Particle& p) { return p.inverseMass > 0; }))
            continue;
        const std::vector<levels::Level> all = levelsOf(scene, settings);
        const double value = largestEigenvalue(all, random, trial % 2 == 0);
        worst = std::max(worst, value);
        ASSERT_LE(value, ranges::omegaBound(double{settings.theta})) << trial;
    }
    EXPECT_GT(worst, 2.5); // the search finds bodies that need the limit, or nearly
    RecordProperty("worst", std::to_string(worst));
}

// A blade parts a block at few substeps. Its halves fly apart as fast as the links let go of them.
TEST(Levels, LetCutHalvesGo) {
    Scene scene = freeBlock({7, 7, 7}, true);
    for (Particle& particle : scene.particles)
        particle.velocity = {particle.position.x < 3.5f * spacing ? -0.5f : 0.5f, 0, 0};
    const Settings settings{.substeps = 3, .levels = 3};
    test::CutBody body(scene, settings);
    const auto speeds = [&] {
        std::array<Vector3d, 2> sums{Vector3d::Zero(), Vector3d::Zero()};
        const std::vector<Vector3d> v = body.runner().velocities();
        for (std::size_t i = 0; i < v.size(); ++i)
            sums[scene.particles[i].position.x < 3.5f * spacing ? 0 : 1] +=
                v[i] / (static_cast<double>(v.size()) / 2);
        return sums;
    };
    const Vector3d middle(3.5 * double{spacing}, 3.5 * double{spacing}, 3.5 * double{spacing});
    const sim::Status status = body.cut(test::sweepOf({middle, Vector3d(1, 0, 0)}, 1));
    ASSERT_TRUE(status.isFinished);
    const auto before = speeds();
    body.runner().run(30);
    const auto after = speeds();
    for (std::size_t half = 0; half < 2; ++half) EXPECT_LT((after[half] - before[half]).norm(), 1e-5) << half;
    EXPECT_GT(after[1].x() - after[0].x(), 0.5);
}

// The topology before a cut makes the block whole again, with the motion of one that was never cut.
TEST(Levels, AreWholeAgainAfterACutIsUndone) {
    const Scene scene = heldBeam(true);
    const Settings settings{.substeps = 4, .levels = 2};
    test::CutBody cut(scene, settings);
    test::Runner whole(scene, settings);
    const vk::Buffer topology = cut.runner().saveTopology();
    const test::Runner::Saved start = cut.runner().save();
    cut.cut(test::sweepOf({Vector3d(0.3, 0.1, 0.1), Vector3d(1, 0, 0)}, 1));
    cut.runner().run(3);
    cut.runner().load(start);
    cut.runner().loadTopology(topology);
    cut.runner().run(5);
    whole.run(5);
    EXPECT_EQ(farthest(cut.runner().positions(), whole.positions()), 0);
}

// A cut body keeps its live block links when another body comes and goes, and moves to other blocks.
TEST(Levels, AreCarriedIntoOtherWorlds) {
    const Scene part = heldBeam(true);
    Scene other = freeBlock({4, 3, 5}, true), base;
    for (Particle& particle : other.particles) {
        particle.position.x += 40;
        particle.inverseMass = part.particles.back().inverseMass; // the mean of the scene enters the shares
    }
    const Settings settings{.substeps = 4, .levels = 2};
    test::Play alone(base, settings), busy(base, settings);
    const PartId first = busy.world().add(other), kept = busy.world().add(part),
                 expected = alone.world().add(part);
    alone.world().add(other);
    alone.settle();
    busy.settle();
    const test::Sweep sweep = test::sweepOf({Vector3d(0.3, 0.15, 0.1), Vector3d(1, 0, 0)}, 0.05);
    EXPECT_GT(alone.step({.blade = sweep.blade()}).linksCut, 0u);
    busy.step({.blade = sweep.blade()});
    alone.run(3);
    busy.run(3);
    busy.world().remove(first);
    busy.add(other); // behind what is kept
    alone.run(10);
    busy.run(10);
    EXPECT_TRUE(busy.bits(kept) == alone.bits(expected));
}

TEST(Levels, FollowAChangeOfStiffness) {
    const Scene scene = heldBeam();
    const Settings settings{.substeps = 4, .levels = 2};
    const Scene stiffer = withMaterial(scene, {.stiffness = 1.2f});
    test::Runner changed(scene, settings), fresh(stiffer, settings);
    ASSERT_TRUE(changed.change(stiffer));
    changed.reset();
    changed.run(5);
    fresh.run(5);
    EXPECT_EQ(changed.stateHash(), fresh.stateHash());
}

// Steps six times as long as the scene's: the limits hold for them as well.
TEST(Levels, StayStableInLongerSteps) {
    Scene scene = heldBeam();
    scene.gravity = {0, 0, 0};
    for (Particle& particle : scene.particles) particle.velocity.y = 8 * particle.position.x;
    for (const std::uint32_t substeps : {2u, 5u, 10u}) {
        test::Runner runner(scene, {.substeps = substeps, .levels = 3});
        const double energy = kineticEnergy(scene, runner.velocities());
        for (int s = 0; s < 60; ++s) {
            EXPECT_TRUE(runner.step(0.1f).isFinished);
            ASSERT_LE(kineticEnergy(scene, runner.velocities()), energy) << substeps << ", step " << s;
        }
    }
}

TEST(Levels, AreNotCountedOnWhereABodyHasNone) {
    const Scene small = freeBlock({1, 1, 1}), thin = freeBlock({3, 1, 1});
    const auto substeps = [](const Scene& scene, std::uint32_t levels) {
        return chooseSubsteps(scene, {.tolerance = 0.01f, .levels = levels}).wanted;
    };
    EXPECT_EQ(substeps(small, 3), substeps(small, 0));
    EXPECT_NEAR(substeps(thin, 3), substeps(thin, 0) / 2.0, 1);
}

// "auto" lets levels carry a part of what the sum needs, and the motion stays near the true one.
TEST(Levels, TakeHalfOrAThirdOfTheSubsteps) {
    const Scene scene = heldBeam();
    const reference::Trajectory truth = reference::trueTrajectory(scene, {.frames = 30, .tolerance = 1e-4});
    const auto substeps = [&](std::uint32_t levels) {
        return chooseSubsteps(scene, {.levels = levels, .hasSharpClamp = false}).substeps;
    };
    const std::uint32_t all = substeps(0);
    EXPECT_NEAR(substeps(1), all / 2.0, 1);
    EXPECT_NEAR(substeps(2), all / 3.0, 1);
    EXPECT_EQ(substeps(3), substeps(2));
    EXPECT_LT(test::errorOf(scene, {.hasSharpClamp = false}, truth), 0.001);
    EXPECT_LT(test::errorOf(scene, {.levels = 1}, truth), 0.07);
    EXPECT_LT(test::errorOf(scene, {.levels = 2}, truth), 0.1);
    EXPECT_GT(test::errorOf(scene, {.substeps = substeps(1), .hasSharpClamp = false}, truth), 0.5);
    const Settings settings{.levels = 1};
    EXPECT_EQ(toText(chooseSubsteps(scene, settings), settings),
              std::to_string(substeps(1)) +
                  " substeps: no link is more than 5 % softer than asked, one level carrying three quarters");
    EXPECT_EQ(inspectStiffness(scene, settings).soft, 0u);
}

TEST(Levels, AreRefusedWithASentence) {
    const auto complaintOf = [](const Scene& scene, const Settings& settings) {
        const std::vector<std::string> all = validate(scene, settings);
        return all.empty() ? std::string() : all.front();
    };
    Scene scene = heldBeam();
    EXPECT_EQ(complaintOf(scene, {.substeps = 4, .levels = 6}), "");
    EXPECT_EQ(complaintOf(scene, {.substeps = 4, .levels = 7}), "settings.levels: is 7, must be from 0 to 6");
    EXPECT_EQ(complaintOf(scene, {.substeps = 4, .omega = 3.1f, .levels = 1}),
              "settings.levels: is 1, but levels are stable only with an omega below 3");
    EXPECT_EQ(complaintOf(scene, {.substeps = 4, .levels = 1, .keepsForces = true}),
              "settings.levels: is 1, but impulses of levels on fixed particles are not kept: use levels 0, "
              "or keep "
              "no forces");
    scene.dampingTime = 0.01f;
    EXPECT_EQ(
        complaintOf(scene, {.substeps = 4, .levels = 1}),
        "settings.levels: is 1, but levels have no internal damping: use levels 0, or a dampingTime of 0");
    EXPECT_EQ(complaintOf(scene, {.solver = Solver::jacobi, .substeps = 4, .levels = 1}), "");
}

} // namespace
} // namespace sinew::sim
