// Tests of many colliders, of which each work group looks for those near it: they act as if every particle
// tested all of them one by one, which it does with two.
#include "sim/collision/collider_shapes.hpp"
#include "sim/collision/contact_scenes.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/colliders.hpp"
#include "sinew/events.hpp"
#include "sinew/ranges.hpp"
#include "sinew/solver_names.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr std::uint32_t many = 256;
constexpr float endless = std::numeric_limits<float>::infinity();

class ManyColliders : public testing::TestWithParam<Solver> {
protected:
    Settings settings(std::uint32_t hostColliders, std::uint32_t substeps = 4) const {
        return {.solver = GetParam(), .substeps = substeps, .hostColliders = hostColliders};
    }
};

// Random numbers that are the same with every standard library.
class Draw {
public:
    explicit Draw(std::uint32_t seed) : random_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
    }
    Vector3d vector(double most) {
        const double x = between(-most, most), y = between(-most, most);
        return {x, y, between(-most, most)};
    }
    bool happens(double share) { return between(0, 1) < share; }

private:
    std::mt19937 random_;
};

Scene looseParticles(Draw& draw, int count, double size, double speed) {
    Scene scene;
    scene.gravity = {0, 0, 0};
    for (int i = 0; i < count; ++i) {
        const Vector3d x = draw.vector(size), v = draw.vector(speed);
        scene.particles.push_back({.position = test::toFloats(x),
                                   .velocity = test::toFloats(v),
                                   .inverseMass = draw.happens(0.1) ? 0.0f : 1.0f,
                                   .contactOffset = static_cast<float>(draw.between(-0.02, 0.02))});
    }
    return scene;
}

HostCollider drawCollider(Draw& draw, double size) {
    HostCollider collider{.shape = static_cast<ColliderShape>(static_cast<int>(draw.between(0, 2.999))),
                          .radius = static_cast<float>(draw.between(0.01, 0.2)),
                          .halfLength = static_cast<float>(draw.between(0, 0.6)),
                          .friction = static_cast<float>(draw.between(0, 1)),
                          .maxSpeed = endless};
    const Vector3d extents = Vector3d(0.25, 0.25, 0.25) + draw.vector(0.24);
    collider.halfExtents = test::toFloats(extents);
    const Vector3d place = draw.vector(size), axis = draw.vector(1);
    collider.pose = {test::toFloats(place), test::turnedBy(draw.between(0, 180), axis)};
    return collider;
}

// Moves and turns it; sometimes so fast that its path passes over much of the scene.
void moveOn(HostCollider& collider, Draw& draw) {
    const double fast = draw.happens(0.2) ? 1 : 0.05;
    const Vector3d place = test::toVector(collider.pose.position) + draw.vector(fast), axis = draw.vector(1);
    const Eigen::AngleAxisd turned(test::toRotation(test::turnedBy(draw.between(0, 170 * fast), axis)) *
                                   test::toRotation(collider.pose.rotation));
    collider.pose = {test::toFloats(place), test::turnedBy(turned.angle() * 57.29577951, turned.axis())};
}

Step stepOf(const Scene& scene, std::span<const HostCollider> hostColliders) {
    return {.dt = scene.dt, .gravity = scene.gravity, .hostColliders = hostColliders};
}

// `acting` at scattered places of a list of `count`, in order; all others are far away or absent.
std::vector<HostCollider> amongOthers(std::span<const HostCollider> acting, std::size_t count) {
    std::vector<HostCollider> list;
    for (std::size_t c = 0; c < count; ++c) {
        const std::size_t next = c * acting.size() / count;
        if (c == 0 || (c - 1) * acting.size() / count != next)
            list.push_back(acting[next]);
        else if (c % 3 == 0)
            list.push_back({}); // absent
        else
            list.push_back(
                {.radius = 0.3f,
                 .pose = {.position = {50.0f + static_cast<float>(c), c % 2 == 0 ? 30.0f : -60.0f, 5}}});
    }
    return list;
}

// A wall of short capsules that do not overlap as they turn, and sweep through a block.
std::vector<HostCollider> comb(int step) {
    std::vector<HostCollider> list;
    for (std::uint32_t c = 0; c < many; ++c) {
        const auto column = static_cast<float>(c % 16), row = static_cast<float>(c / 16);
        list.push_back({.shape = ColliderShape::capsule,
                        .radius = 0.017f,
                        .halfLength = 0.001f,
                        .pose = {{-0.35f + 0.01f * static_cast<float>(step), 0.045f * (column - 7.5f),
                                  0.045f * (row - 7.5f)},
                                 test::turnedBy(7.0 * step, {1, 1, 0})}});
    }
    return list;
}

Scene floatingBlock() {
    Scene scene = test::block(6, 0.05f, 5e4f, -0.15f);
    for (Particle& particle : scene.particles) {
        particle.position.x -= 0.15f;
        particle.position.z -= 0.15f;
        particle.contactOffset = 0.004f; // more than half of the gaps of comb()
    }
    scene.gravity = {0, 0, 0};
    return scene;
}

double deepestIn(std::span<const HostColliderState> states, const std::vector<Vector3d>& x) {
    double deepest = 0;
    for (const HostColliderState& state : states)
        for (const Vector3d& one : x)
            deepest =
                std::max(deepest, -test::gapOf(colliderOf(state.hostCollider), state.hostCollider.pose, one));
    return deepest;
}

std::uint64_t hashOfComb(const Settings& settings) {
    const Scene scene = floatingBlock();
    test::Runner runner(scene, settings);
    for (int s = 0; s < 20; ++s) EXPECT_EQ(runner.step(stepOf(scene, comb(s))).nonFinite, 0u);
    return runner.stateHash();
}

} // namespace

// Random colliders of every shape that move at random among random particles, with a turn of up to 170
// degrees and a path of a meter in a step, give the same bits whether they are alone or among many.
TEST_P(ManyColliders, ActAsIfTheFarOnesWereNotThere) {
    int touched = 0;
    for (std::uint32_t seed = 1; seed <= 24; ++seed) {
        Draw draw(seed);
        const Scene scene = looseParticles(draw, 300, seed % 2 == 0 ? 0.4 : 3, seed % 3 == 0 ? 60 : 2);
        std::vector<HostCollider> few;
        for (int c = 0; c < 2; ++c) few.push_back(drawCollider(draw, 1));
        const std::uint32_t substeps = seed % 4 == 0 ? 1 : 4;
        test::Runner alone(scene, settings(2, substeps)), among(scene, settings(40, substeps));
        test::Runner without(scene, settings(2, substeps));
        for (int s = 0; s < 12; ++s) {
            alone.step(stepOf(scene, few));
            among.step(stepOf(scene, amongOthers(few, 40)));
            without.step(stepOf(scene, {}));
            for (HostCollider& collider : few) moveOn(collider, draw);
        }
        ASSERT_EQ(among.stateHash(), alone.stateHash()) << "seed " << seed;
        if (without.stateHash() != alone.stateHash()) ++touched;
    }
    EXPECT_GE(touched, 18) << "nothing was touched";
}

// A collider at 100 m/s takes a ball along, out of all that its work group has regarded, into another one.
TEST_P(ManyColliders, APushMayLeadIntoOnesThatWereFar) {
    const Scene scene = test::particleAt({0, 0, 0});
    for (const std::size_t count : {std::size_t{2}, std::size_t{200}}) {
        test::Runner runner(scene, settings(static_cast<std::uint32_t>(count), 1));
        const HostCollider wall{.radius = 0.5f, .pose = {.position = {1.8f, 0.1f, 0}}};
        HostCollider ram{.shape = ColliderShape::box,
                         .halfExtents = {0.1f, 1, 1},
                         .pose = {.position = {-0.2f, 0, 0}},
                         .maxSpeed = endless};
        runner.step({.gravity = {}, .hostColliders = amongOthers(std::array{ram, wall}, count)});
        ram.pose.position.x = 1.4f;
        runner.step({.gravity = {}, .hostColliders = amongOthers(std::array{ram, wall}, count)});
        const Vector3d x = runner.positions()[0];
        EXPECT_GE((x - Vector3d(1.8, 0.1, 0)).norm(), 0.5 - 1e-4) << count << " colliders";
        std::printf("%zu colliders: (%.7f %.7f %.7f)\n", count, x.x(), x.y(), x.z());
    }
}

// Each of 256 capsules strikes a particle of its own, which moves as it does with that capsule alone.
TEST_P(ManyColliders, EachStrikesAsByItself) {
    Draw draw(5);
    std::vector<HostCollider> capsules;
    Scene scene;
    scene.gravity = {0, 0, 0};
    for (std::uint32_t c = 0; c < many; ++c) {
        const Vector3d place(0.5 * (c % 16), 0.5 * (c / 16), 0);
        scene.particles.push_back({.position = test::toFloats(place + draw.vector(0.01))});
        capsules.push_back(
            {.shape = ColliderShape::capsule,
             .radius = 0.05f,
             .halfLength = 0.1f,
             .pose = {test::toFloats(place - Vector3d(0.1, 0, 0)), test::turnedBy(11.0 * c, {1, 2, 3})}});
    }
    const auto at = [&](std::uint32_t c, int step) {
        HostCollider capsule = capsules[c];
        capsule.pose.position.x += 0.01f * static_cast<float>(step);
        return capsule;
    };
    test::Runner together(scene, settings(many));
    constexpr int steps = 10;
    for (int s = 0; s < steps; ++s) {
        std::vector<HostCollider> list;
        for (std::uint32_t c = 0; c < many; ++c) list.push_back(at(c, s));
        together.step(stepOf(scene, list));
    }
    const std::vector<Vector3d> x = together.positions(), v = together.velocities();
    for (std::uint32_t c = 0; c < many; c += 37) {
        Scene one = scene;
        one.particles = {scene.particles[c]};
        test::Runner alone(one, settings(1));
        for (int s = 0; s < steps; ++s) alone.step(stepOf(one, std::array{at(c, s)}));
        EXPECT_EQ(alone.positions()[0], x[c]) << c;
        EXPECT_EQ(alone.velocities()[0], v[c]) << c;
        EXPECT_GT(v[c].x(), 0.1) << c << " was not struck";
    }
}

// Nothing is inside any of 256 capsules that sweep through a body, which they push along.
TEST_P(ManyColliders, PushABodyThatTheyDoNotEnter) {
    const Scene scene = floatingBlock();
    test::Runner runner(scene, settings(many, 8));
    double deepest = 0;
    for (int s = 0; s < 40; ++s) {
        ASSERT_EQ(runner.step(stepOf(scene, comb(s))).nonFinite, 0u);
        deepest = std::max(deepest, deepestIn(runner.simulation().hostColliders(), runner.positions()));
    }
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& x : runner.positions()) middle += x / static_cast<double>(scene.particles.size());
    std::printf("deepest %.2g m, moved %.3f m\n", deepest, middle.x());
    EXPECT_LE(deepest, 1e-4) << "[m]";
    EXPECT_GE(middle.x(), GetParam() == Solver::jacobi ? 0.01 : 0.05) << "[m]"; // jacobi: soft in one sweep
}

TEST_P(ManyColliders, HaveTheSameBitsInReversedOrder) {
    Settings reversed = settings(many);
    reversed.isReversed = true;
    const std::uint64_t hash = hashOfComb(settings(many));
    std::printf("state_hash %s %016" PRIx64 "\n", solverName(GetParam()), hash);
    EXPECT_EQ(hashOfComb(reversed), hash);
}

TEST_P(ManyColliders, GoOnWithTheSameBitsFromASavedState) {
    const Scene scene = floatingBlock();
    test::Runner runner(scene, settings(many));
    const auto push = [&](int from, int to) {
        for (int s = from; s < to; ++s) runner.step(stepOf(scene, comb(s)));
    };
    push(0, 12);
    const test::Runner::Saved saved = runner.save();
    push(12, 20);
    const std::uint64_t hash = runner.stateHash();
    runner.run(3);
    runner.load(saved);
    ASSERT_EQ(runner.simulation().hostColliders().size(), many);
    EXPECT_NEAR(double{runner.simulation().hostColliders()[255].hostCollider.pose.position.x}, -0.24, 1e-5);
    push(12, 20);
    EXPECT_EQ(runner.stateHash(), hash);
}

INSTANTIATE_TEST_SUITE_P(Of, ManyColliders,
                         testing::Values(Solver::jacobi, Solver::split, Solver::gaussSeidel),
                         [](const auto& parameter) { return solverName(parameter.param); });

// The impulses on each of many colliders, which are summed as whole numbers, equal those of few to rounding;
// the sums on a body are the opposite of those on the colliders.
TEST(ManyCollidersForces, EqualThoseOfFew) {
    const Scene scene = floatingBlock();
    std::vector<std::vector<Impulses>> runs;
    for (const std::size_t count : {std::size_t{8}, std::size_t{many}}) {
        test::Runner runner(
            scene, {.substeps = 8, .keepsForces = true, .hostColliders = static_cast<std::uint32_t>(count)});
        runs.emplace_back();
        for (int s = 0; s < 30; ++s) {
            std::vector<HostCollider> few;
            for (int c = 0; c < 8; ++c)
                few.push_back(
                    {.radius = 0.06f,
                     .pose = {.position = {-0.3f + 0.01f * static_cast<float>(s), c % 2 == 0 ? -0.1f : 0.1f,
                                           0.08f * static_cast<float>(c - 4)}}});
            const Status status = runner.step(stepOf(scene, amongOthers(few, count)));
            runs.back().push_back(runner.simulation().forces(status.frame));
        }
    }
    double largest = 0;
    for (std::size_t s = 0; s < runs[0].size(); ++s) {
        const Impulses &few = runs[0][s], &all = runs[1][s];
        ASSERT_EQ(all.hostColliders.size(), many);
        Vector3d sum = Vector3d::Zero();
        for (const Impulse& impulse : all.hostColliders) sum += test::toVector(impulse.linear);
        const Vector3d onBody = test::toVector(all.bodies[0].colliders.linear);
        EXPECT_LE((sum + onBody).norm(), 1e-5 * (1 + onBody.norm()));
        for (std::size_t c = 0; c < 8; ++c) {
            const Impulse &one = few.hostColliders[c], &same = all.hostColliders[c * many / 8];
            largest = std::max(largest, test::toVector(one.linear).norm());
            EXPECT_LE((test::toVector(one.linear) - test::toVector(same.linear)).norm(), 2e-6);
            EXPECT_LE((test::toVector(one.angular) - test::toVector(same.angular)).norm(), 2e-7);
        }
        EXPECT_LE((test::toVector(few.bodies[0].colliders.angular) -
                   test::toVector(all.bodies[0].colliders.angular))
                      .norm(),
                  1e-6);
    }
    EXPECT_GT(largest, 0.1) << "[N s]";
}

// They do not depend on the order in which particles add to them.
TEST(ManyCollidersForces, HaveTheSameBitsInReversedOrder) {
    const Scene scene = floatingBlock();
    std::vector<Impulses> last;
    for (const bool isReversed : {false, true}) {
        test::Runner runner(
            scene, {.substeps = 4, .keepsForces = true, .hostColliders = many, .isReversed = isReversed});
        for (int s = 0; s < 20; ++s) runner.step(stepOf(scene, comb(s)));
        last.push_back(runner.simulation().forces(19));
    }
    double sum = 0;
    for (std::uint32_t c = 0; c < many; ++c) {
        const Impulse &a = last[0].hostColliders[c], &b = last[1].hostColliders[c];
        sum += test::toVector(a.linear).norm();
        EXPECT_EQ(test::toVector(a.linear), test::toVector(b.linear)) << c;
        EXPECT_EQ(test::toVector(a.angular), test::toVector(b.angular)) << c;
    }
    EXPECT_GT(sum, 0.1) << "[N s]";
}

// Colliders of the scene and of the host together, a box as the floor among them.
TEST(ManyCollidersOfAScene, CarryWhatRestsOnThem) {
    Scene scene = test::block(3, 0.1f, 5e4f, 0.002f);
    scene.damping = 5; // takes 1 % of the weight
    scene.colliders.push_back({.shape = ColliderShape::box,
                               .halfExtents = {5, 0.5f, 5},
                               .friction = 0.5f,
                               .pose = {.position = {0, -0.5f, 0}}});
    for (std::uint32_t c = 1; c < ranges::mostColliders; ++c)
        scene.colliders.push_back({.radius = 0.1f, .pose = {.position = {static_cast<float>(c), 8, 0}}});
    test::Runner runner(scene,
                        {.substeps = 8, .keepsForces = true, .hostColliders = ranges::mostHostColliders});
    const Status status = runner.run(180);
    const Impulses impulses = runner.simulation().forces(status.frame);
    ASSERT_EQ(impulses.colliders.size(), ranges::mostColliders);
    const double weight = 9.81 * test::massOf(scene);
    EXPECT_NEAR(-double{impulses.colliders[0].linear.y} / double{scene.dt}, weight, 0.02 * weight);
    EXPECT_EQ(impulses.colliders[1].linear.y, 0);
    for (const Vector3d& x : runner.positions()) EXPECT_GE(x.y(), -1e-4);
}

TEST(ManyCollidersOfAScene, AreRefusedBeyondTheLimits) {
    Scene scene = floatingBlock();
    const auto sentences = validate(scene, {.hostColliders = ranges::mostHostColliders + 1});
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_NE(sentences[0].find("settings.hostColliders: is 1025"), std::string::npos) << sentences[0];
    scene.colliders.assign(ranges::mostColliders + 1, {.radius = 0.1f});
    EXPECT_EQ(validate(scene, {}).size(), 1u);
}

TEST(ManyCollidersOfAScene, MoreThanAskedForAreComplainedOf) {
    const Scene scene = floatingBlock();
    test::Runner runner(scene, {.substeps = 4, .hostColliders = many});
    runner.step(stepOf(scene, std::vector<HostCollider>(many + 1)));
    const auto sentences = runner.simulation().complaintsOfUse();
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_NE(sentences[0].find("257 host colliders are given, settings.hostColliders is 256"),
              std::string::npos)
        << sentences[0];
}

// Sleepers wake by what comes near them alone, whether the others are many or few.
TEST(ManyCollidersAndSleep, WakeWhatTheyComeNear) {
    Scene scene;
    scene.planes = {{.friction = 0.5f}};
    for (const float x : {0.0f, 3.0f}) scene.particles.push_back(test::ballAt({x, test::ballRadius, 0}));
    test::Runner runner(scene, {.substeps = 8, .sleeps = true, .hostColliders = many});
    const auto sleepers = [&](const std::vector<HostCollider>& list, int steps = 1) {
        Status status{};
        for (int s = 0; s < steps; ++s) status = runner.step(stepOf(scene, list));
        return status.sleeping;
    };
    std::vector<HostCollider> list(many, {.radius = 0.1f, .pose = {.position = {1.5f, 1, 0}}});
    ASSERT_EQ(sleepers(list, 60), 2u);
    for (HostCollider& collider : list) collider.pose.position.x += 0.01f;
    EXPECT_EQ(sleepers(list), 2u) << "all move between them";
    list[200].pose.position = {-0.15f, 0.05f, 0};
    list[200].maxSpeed = endless;
    EXPECT_EQ(sleepers(list), 1u) << "one comes beside one of them";
    EXPECT_EQ(sleepers(list, 60), 2u) << "and stands still";
    list[200].radius = 0.12f;
    EXPECT_EQ(sleepers(list), 1u) << "grows";
}

TEST(ManyCollidersAndEvents, AreToldByTheirIndex) {
    Scene scene = test::weightless();
    scene.bodies = {{"ball", 0, 1}};
    scene.particles = {{.velocity = {1, 0, 0}, .contactOffset = 0.1f, .radius = 0.1f}};
    test::Runner runner(scene, {.substeps = 4, .events = contactEvents, .hostColliders = many});
    std::vector<HostCollider> list(many);
    list[171] = {.radius = 0.1f, .pose = {.position = {0.4f, 0, 0}}};
    std::vector<Event> begins;
    for (int s = 0; s < 30; ++s) {
        const Status status = runner.step({.gravity = {}, .hostColliders = list});
        for (const Event& event : runner.simulation().events(status.frame).list)
            if (event.kind == EventKind::contactBegins) begins.push_back(event);
    }
    ASSERT_EQ(begins.size(), 1u);
    EXPECT_EQ(begins[0].partner, EventPartner::hostCollider);
    EXPECT_EQ(begins[0].other, 171u);
}
