// Tests of motions: momentum and angular momentum, poses of bodies that touch, sleep or are cut, wrong input.
#include "sim/collision/contact_scenes.hpp"
#include "sim/program/program.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/ranges.hpp"
#include "sinew/start.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numeric>

namespace sinew::sim {
namespace {

using Eigen::Vector3d;

constexpr float spacing = 0.1f;

void addBox(Scene& scene, Vec3 origin, float radius = 0, bool isCuttable = false) {
    addLattice(scene, {.origin = origin,
                       .cells = {3, 2, 4},
                       .spacing = spacing,
                       .youngModulus = 1e5f,
                       .radius = radius,
                       .isCuttable = isCuttable});
    if (radius > 0) addSurfaceFaces(scene, scene.grids.back());
}

Vector3d toEigen(const Vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

Eigen::Quaterniond toEigen(const Quaternion& q) {
    return {double{q.w}, double{q.x}, double{q.y}, double{q.z}};
}

// Sums over the particles of a range.
struct Sums {
    double mass = 0;
    Vector3d center{0, 0, 0}, momentum{0, 0, 0}, angular{0, 0, 0}; // angular: about the centre of mass
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

Sums sumsOf(const Scene& scene, const std::vector<Vector3d>& x, const std::vector<Vector3d>& v,
            std::size_t first, std::size_t end) {
    Sums sums;
    const auto massOf = [&](std::size_t i) { return 1 / double{scene.particles[i].inverseMass}; };
    for (std::size_t i = first; i < end; ++i) {
        sums.mass += massOf(i);
        sums.center += massOf(i) * x[i];
        sums.momentum += massOf(i) * v[i];
    }
    sums.center /= sums.mass;
    for (std::size_t i = first; i < end; ++i) {
        const Vector3d r = x[i] - sums.center;
        sums.angular += massOf(i) * r.cross(v[i]);
        sums.inertia += massOf(i) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    }
    return sums;
}

std::vector<Vector3d> startOf(const Scene& scene) {
    std::vector<Vector3d> positions;
    for (const Particle& particle : scene.particles) positions.push_back(toEigen(particle.position));
    return positions;
}

struct After {
    std::vector<Vector3d> x, v;
};

// After one step without gravity.
After moved(const Scene& scene, const std::vector<Motion>& motions, Settings settings = {.substeps = 4}) {
    settings.motions = ranges::mostMotions;
    test::Runner runner(scene, settings);
    EXPECT_FALSE(runner.step(Step{.gravity = {}, .motions = motions}).isUndone);
    EXPECT_EQ(runner.simulation().complaintsOfUse(), std::vector<std::string>{});
    return {runner.positions(), runner.velocities()};
}

// The largest change of a distance between particles of a range.
double stretched(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b, std::size_t first,
                 std::size_t end) {
    double most = 0;
    for (std::size_t i = first; i < end; ++i)
        for (std::size_t j = first; j < i; ++j)
            most = std::max(most, std::abs((a[i] - a[j]).norm() - (b[i] - b[j]).norm()));
    return most;
}

const Quaternion quarter{0, 0, std::sqrt(0.5f), std::sqrt(0.5f)}; // about z
const Quaternion aslant{0.3f, -0.4f, 0.5f, std::sqrt(0.5f)};

constexpr Solver solvers[] = {Solver::split, Solver::jacobi, Solver::gaussSeidel};

// Two boxes.
Scene twoBoxes() {
    Scene scene;
    addBox(scene, {0, 0.3f, 0});
    addBox(scene, {5, 1, -2});
    return scene;
}

constexpr std::size_t ofBox = 4 * 3 * 5;

} // namespace

TEST(Motions, VelocitiesGiveTheirMomentum) {
    const Vec3 v{1, -2, 0.5f}, spin{0.3f, 0.2f, -0.4f};
    const Scene scene = twoBoxes();
    const auto before = startOf(scene);
    const Sums rest = sumsOf(scene, before, before, ofBox, 2 * ofBox);
    for (const Solver solver : solvers)
        for (const MotionKind kind : {MotionKind::addVelocity, MotionKind::setVelocity}) {
            const auto [x, after] = moved(scene, {{.kind = kind, .body = 1, .linear = v, .angular = spin}},
                                          {.solver = solver, .substeps = 4});
            const Sums sums = sumsOf(scene, x, after, ofBox, 2 * ofBox);
            const Vector3d momentum = sums.mass * toEigen(v), angular = rest.inertia * toEigen(spin);
            const double error = (sums.momentum - momentum).norm() / momentum.norm(),
                         turned = (sums.angular - angular).norm() / angular.norm();
            std::printf("solver %d: momentum %.1e, angular momentum %.1e\n", static_cast<int>(solver), error,
                        turned);
            EXPECT_LT(error, 1e-6);
            EXPECT_LT(turned, solver == Solver::split ? 2e-6 : 1e-3); // the others err in links that turn
            const After without = moved(scene, {}, {.solver = solver, .substeps = 4});
            for (std::size_t i = 0; i < ofBox; ++i) EXPECT_EQ(x[i], without.x[i]);
        }
}

TEST(Motions, ImpulsesGiveTheirMoments) {
    const Vec3 impulse{3, 1, -2}, moment{0.2f, -0.5f, 0.3f};
    const Scene scene = twoBoxes();
    const auto [x, v] =
        moved(scene, {{.kind = MotionKind::impulse, .body = 0, .linear = impulse, .angular = moment}});
    const Sums sums = sumsOf(scene, x, v, 0, ofBox);
    EXPECT_LT((sums.momentum - toEigen(impulse)).norm(), 2e-6 * toEigen(impulse).norm());
    EXPECT_LT((sums.angular - toEigen(moment)).norm(), 5e-6 * toEigen(moment).norm());
}

// A line of particles has no inertia about itself; what is across it counts.
TEST(Motions, MomentsTurnALineAcrossItself) {
    Scene scene;
    addChain(scene, {.direction = {1, 0, 0}, .particles = 20, .length = 1, .mass = 2});
    const auto [x, v] = moved(scene, {{.kind = MotionKind::impulse, .body = 0, .angular = {5, 0, 0.01f}}});
    const Sums sums = sumsOf(scene, x, v, 0, x.size());
    EXPECT_NEAR(sums.angular.z(), 0.01, 1e-6);
    EXPECT_LT(sums.momentum.norm(), 1e-6);
    EXPECT_NEAR(sums.angular.x(), 0, 1e-6);
}

TEST(Motions, SetVelocityEndsWhatWasThere) {
    Scene scene = twoBoxes();
    start(scene, 0, {.velocity = {7, 3, -2}, .spin = {1, 2, 3}, .rotation = {}});
    const Vec3 v{0.5f, 0, 0};
    for (const float h : {0.0f, 1.0f / 60}) { // as first step, and as a later one
        test::Runner runner(scene, {.substeps = 4, .motions = 1});
        if (h > 0) runner.step(h);
        const auto from = runner.positions();
        const std::vector<Motion> motions{{.kind = MotionKind::setVelocity, .body = 0, .linear = v}};
        runner.step(Step{.gravity = {}, .motions = motions});
        const auto x = runner.positions();
        const Sums sums = sumsOf(scene, x, runner.velocities(), 0, ofBox);
        EXPECT_LT((sums.momentum - sums.mass * toEigen(v)).norm(), 1e-5 * sums.mass);
        const Vector3d way = sums.center - sumsOf(scene, from, from, 0, ofBox).center;
        EXPECT_LT((way - toEigen(v) / 60).norm(), 2e-6);
    }
}

// A velocity that is set holds at the start of the step, under gravity too.
TEST(Motions, SetVelocityFallsAsAThrow) {
    const Scene scene = twoBoxes();
    test::Runner runner(scene, {.substeps = 8, .motions = 1});
    for (int s = 0; s < 10; ++s) runner.step(Step{});
    const auto from = runner.positions();
    const std::vector<Motion> motions{{.kind = MotionKind::setVelocity, .body = 0, .linear = {0, 4, 0}}};
    runner.step(Step{.motions = motions});
    for (int s = 0; s < 29; ++s) runner.step(Step{});
    const auto to = runner.positions();
    const double way =
        sumsOf(scene, to, to, 0, ofBox).center.y() - sumsOf(scene, from, from, 0, ofBox).center.y();
    EXPECT_NEAR(way, 4 * 0.5 - 0.5 * 9.81 * 0.25, 2e-5);
}

TEST(Motions, ActInARegion) {
    Scene scene;
    for (int i = 0; i < 200; ++i)
        scene.particles.push_back(
            {.position = {0.1f * static_cast<float>(i % 20), 0.1f * static_cast<float>(i / 20), 0}});
    const Vec3 center{1, 0.5f, 0};
    const float radius = 0.43f;
    const auto [x, v] = moved(scene, {{.kind = MotionKind::addVelocity,
                                       .center = center,
                                       .radius = radius,
                                       .linear = {0, 0, 2},
                                       .angular = {0, 0, 1}}});
    std::size_t met = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const bool isIn = (toEigen(scene.particles[i].position) - toEigen(center)).norm() < double{radius};
        met += isIn ? 1 : 0;
        EXPECT_EQ(v[i].z(), isIn ? 2 : 0) << i;
        EXPECT_TRUE(isIn || v[i].isZero());
    }
    EXPECT_GT(met, 30u);
}

TEST(Motions, VelocitiesFollowPosesInTheirOrder) {
    const Scene scene = twoBoxes();
    const auto [x, v] =
        moved(scene, {{.kind = MotionKind::setVelocity, .body = 0, .linear = {1, 0, 0}},
                      {.kind = MotionKind::pose, .body = 0, .linear = {0, 9, 0}, .rotation = quarter},
                      {.kind = MotionKind::addVelocity, .body = 0, .linear = {0, 0, 3}}});
    const Sums sums = sumsOf(scene, x, v, 0, ofBox);
    EXPECT_LT((sums.momentum / sums.mass - Vector3d(1, 0, 3)).norm(), 1e-6);
    EXPECT_NEAR(sums.center.y(), sumsOf(scene, startOf(scene), startOf(scene), 0, ofBox).center.y() + 9,
                1e-5);
}

TEST(Motions, APoseIsARigidMotion) {
    for (const Solver solver : solvers)
        for (const float far : {3.0f, 60.0f}) {
            Scene scene = twoBoxes();
            scene.distances.clear();
            scene.grids.clear();
            start(scene, 0, {.velocity = {1, 0, 0}, .spin = {0, 0, 2}, .rotation = {}});
            const Settings settings{.solver = solver, .substeps = 1, .motions = 2};
            test::Runner runner(scene, settings), other(scene, settings);
            for (test::Runner* one : {&runner, &other}) one->step(Step{.gravity = {}});
            const std::vector<Motion> motions{
                {.kind = MotionKind::pose, .body = 1, .linear = {far, -1, 2}, .rotation = aslant}};
            runner.step(Step{.gravity = {}, .motions = motions});
            other.step(Step{.gravity = {}});
            const auto x = runner.positions(), y = other.positions();
            const Sums here = sumsOf(scene, x, runner.velocities(), ofBox, 2 * ofBox),
                       there = sumsOf(scene, y, other.velocities(), ofBox, 2 * ofBox);
            const Eigen::Quaterniond q = toEigen(aslant).normalized();
            const Vector3d v = there.momentum / there.mass / 60;
            const double rounding = here.center.norm() / (1 << 23);
            std::printf("solver %d, %.0f m: distances %.1f roundings\n", static_cast<int>(solver),
                        double{far}, stretched(x, y, ofBox, 2 * ofBox) / rounding);
            EXPECT_LT(stretched(x, y, ofBox, 2 * ofBox), 2 * rounding);
            EXPECT_LT((here.center - there.center - Vector3d(double{far}, -1, 2) - (q * v - v)).norm(),
                      2 * rounding);
            EXPECT_LT((here.momentum - q * there.momentum).norm(), 1e-6 * here.momentum.norm());
            EXPECT_LT((here.angular - q * there.angular).norm(), 1e-5 * here.angular.norm());
            for (std::size_t i = 0; i < ofBox; ++i) EXPECT_EQ(x[i], y[i]) << i;
        }
}

namespace {

// A box, and a sheet 2.8 m above the floor that hangs by its corners.
Scene boxAndSheet(Vec3 box) {
    Scene scene;
    addBox(scene, box, 0.04f);
    addCloth(scene, {.origin = {-0.5f, 2.8f, -0.5f},
                     .right = {1, 0, 0},
                     .down = {0, 0, 1},
                     .size = {15, 15},
                     .spacing = 0.1f,
                     .areaDensity = 0.5f,
                     .membraneStiffness = 5000,
                     .thickness = 0.04f,
                     .pinned = {0, 14, 210, 224}});
    scene.planes.push_back({.normal = {0, 1, 0}});
    return scene;
}

constexpr Vec3 above{0.05f, 2.9f, 0}; // the sheet

} // namespace

// A body that lay on a sheet and is placed below it touches nothing on the way, and is not pulled back.
TEST(Motions, APlacedBodyIsNotSweptThroughASheet) {
    const Scene scene = boxAndSheet(above);
    test::Runner runner(scene, {.substeps = 16, .motions = 1});
    for (int s = 0; s < 60; ++s) runner.step(Step{});
    const auto on = runner.positions();
    const Sums lay = sumsOf(scene, on, runner.velocities(), 0, ofBox);
    const Vec3 way{0, -1, 0};
    const std::vector<Motion> motions{{.kind = MotionKind::pose, .body = 0, .linear = way}};
    EXPECT_FALSE(runner.step(Step{.motions = motions}).isUndone);
    const auto x = runner.positions();
    const Sums placed = sumsOf(scene, x, runner.velocities(), 0, ofBox);
    std::printf("lay at %.3f m, placed at %.3f m\n", lay.center.y(), placed.center.y());
    EXPECT_LT((placed.momentum - lay.momentum - lay.mass * Vector3d(0, -9.81 / 60, 0)).norm(),
              1e-2 * lay.mass);
    EXPECT_LT((placed.center - lay.center - toEigen(way)).norm(),
              lay.momentum.norm() / lay.mass / 60 + 0.003);
    for (int s = 0; s < 20; ++s) EXPECT_FALSE(runner.step(Step{}).isUndone);
    const auto to = runner.positions();
    const Sums fallen = sumsOf(scene, to, to, 0, ofBox);
    EXPECT_NEAR(fallen.center.y() - placed.center.y(), placed.momentum.y() / placed.mass / 3 - 9.81 / 18,
                5e-3); // free, below the sheet
}

namespace {

// The largest slip that contacts with faces remember [m].
double slipOf(test::Runner& runner) {
    double most = 0;
    for (const ContactMemory& memory : runner.simulation().program().contactMemory)
        for (const auto& m :
             test::queue().download<std::array<float, 4>>(runner.simulation().view(memory.memory)))
            most = std::max(most, std::hypot(double{m[0]}, double{m[1]}, double{m[2]}));
    return most;
}

} // namespace

// The slip of a contact is forgotten: a ball that friction holds on a slope and that is placed beside slips
// from there.
TEST(Motions, APlacedBallForgetsItsSlip) {
    Scene scene;
    std::vector<std::uint32_t> pinned(25);
    std::iota(pinned.begin(), pinned.end(), 0u);
    addCloth(scene, {.origin = {-0.2f, 0, -0.2f},
                     .size = {5, 5},
                     .spacing = spacing,
                     .thickness = 0.04f,
                     .pinned = pinned});
    scene.contacts.friction = 0.8f;
    scene.bodies.push_back({.name = "ball", .firstParticle = 25, .particleCount = 1});
    scene.particles.push_back({.position = {0.03f, 0.06f, 0.04f}, .radius = 0.04f});
    const Vec3 slope{3, -9.81f, 0};
    const Vec3 beside{0.002f, 0, 0}; // over the same face
    double slips[2]{};
    for (const bool isPlaced : {false, true}) {
        test::Runner runner(scene, {.substeps = 16, .motions = 1});
        for (int s = 0; s < 60; ++s) runner.step(Step{.gravity = slope});
        const std::vector<Motion> motions{{.kind = MotionKind::pose, .body = 1, .linear = beside}};
        runner.step(Step{.gravity = slope, .motions = std::span(motions).first(isPlaced ? 1 : 0)});
        slips[isPlaced ? 1 : 0] = slipOf(runner);
    }
    std::printf("slip %.2e m, after a pose %.2e m\n", slips[0], slips[1]);
    EXPECT_GT(slips[0], 0);
    EXPECT_LT(slips[1], 0.5 * slips[0]);
}

// Contacts begin anew where a body is placed: it falls onto a sheet as one that was made above it.
TEST(Motions, APlacedBodyTouchesWhatIsThere) {
    const auto fallFrom = [](Vec3 origin, const std::vector<Motion>& motions) {
        const Scene scene = boxAndSheet(origin);
        test::Runner runner(scene, {.substeps = 16, .motions = 2});
        EXPECT_FALSE(runner.step(Step{.motions = motions}).isUndone);
        for (int s = 0; s < 28; ++s) EXPECT_FALSE(runner.step(Step{}).isUndone);
        const auto x = runner.positions();
        return sumsOf(scene, x, runner.velocities(), 0, ofBox);
    };
    const std::vector<Motion> motions{
        {.kind = MotionKind::pose, .body = 0, .linear = {above.x - 4, above.y - 2, above.z}}};
    const Sums placed = fallFrom({4, 2, 0}, motions), made = fallFrom(above, {});
    std::printf("%.3f m/s, made there %.3f m/s\n", placed.momentum.y() / placed.mass,
                made.momentum.y() / made.mass);
    EXPECT_LT((placed.center - made.center).norm(), 1e-5);
    EXPECT_GT(made.momentum.y() / made.mass, -9.81 * 29 / 60 + 1); // the sheet slows it
}

TEST(Motions, ASleepingBodyWakesWithWhatItTouches) {
    constexpr float radius = test::ballRadius, pitch = 2.3f * radius;
    constexpr std::uint32_t side = 3, heap = side * side * side;
    Scene scene;
    for (const float x : {0.0f, 4.0f})
        test::addBalls(scene, side, pitch, 0.1f * radius, {x, 0.02f + 0.5f * side * pitch, 0});
    scene.bodies = {{.name = "heap", .firstParticle = 0, .particleCount = heap - 1},
                    {.name = "ball", .firstParticle = heap - 1, .particleCount = 1},
                    {.name = "other heap", .firstParticle = heap, .particleCount = heap}};
    scene.contacts.friction = 0.5f;
    scene.planes = {{.friction = 0.5f}};
    for (const MotionKind kind : {MotionKind::pose, MotionKind::addVelocity}) {
        test::Runner runner(scene, {.substeps = 16, .sleeps = true, .motions = 1});
        Status status;
        for (int s = 0; s < 400 && status.sleeping < 2 * heap; ++s) status = runner.run(1);
        ASSERT_EQ(status.sleeping, 2 * heap);
        const auto before = runner.positions();
        const std::vector<Motion> motions{{.kind = kind, .body = 1, .linear = {0, 1, -2}}};
        status = runner.step(Step{.motions = motions});
        EXPECT_GE(status.sleeping, heap);
        EXPECT_LT(status.sleeping, 2 * heap - 1) << "its neighbours sleep";
        const auto x = runner.positions();
        for (std::size_t i = heap; i < 2 * heap; ++i) EXPECT_EQ(x[i], before[i]);
        const Vector3d way = x[heap - 1] - before[heap - 1];
        if (kind == MotionKind::pose)
            EXPECT_LT((way - Vector3d(0, 1, -2)).norm(), 9.81 / 3600);
        else
            EXPECT_GT(way.norm(), 0.01); // against its neighbours
        for (int s = 0; s < 600 && status.sleeping < 2 * heap; ++s) status = runner.run(1);
        EXPECT_EQ(status.sleeping, 2 * heap);
    }
}

// A step that is undone takes its motions back; repeated, it has them once.
TEST(Motions, AreUndoneWithTheirStep) {
    const Scene scene = twoBoxes();
    test::Runner runner(scene, {.substeps = 4, .motions = 2});
    runner.step(Step{.gravity = {}});
    const std::vector<Motion> motions{{.kind = MotionKind::pose, .body = 0, .linear = {0, 0, 3}},
                                      {.kind = MotionKind::addVelocity, .body = 1, .linear = {0, 0, 3}}};
    const auto before = runner.positions();
    runner.writePosition(ofBox + 3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(runner.step(Step{.gravity = {}, .motions = motions}).isUndone);
    EXPECT_EQ(runner.positions(), before);
    EXPECT_FALSE(runner.step(Step{.gravity = {}, .motions = motions}).isUndone);
    EXPECT_LT((runner.positions()[0] - before[0] - Vector3d(0, 0, 3)).norm(), 1e-5);
    const Sums sums = sumsOf(scene, runner.positions(), runner.velocities(), ofBox, 2 * ofBox);
    EXPECT_LT((sums.momentum - sums.mass * Vector3d(0, 0, 3)).norm(), 1e-5 * sums.mass);
}

// Room for motions that are not given changes no bit, and no room adds no pass.
TEST(Motions, CostNothingWhereNoneIsGiven) {
    const Scene scene = boxAndSheet(above);
    const Settings with{.substeps = 8, .keepsPrevious = true};
    Settings without = with;
    without.motions = 8;
    EXPECT_EQ(test::hashOfRun(scene, with, 20), test::hashOfRun(scene, without, 20));
    EXPECT_TRUE(test::usesKernel(scene, "apply_motions", without));
    for (const char* kernel : {"measure_motions", "place_bodies", "apply_motions", "forget_contacts"})
        EXPECT_FALSE(test::usesKernel(scene, kernel, with)) << kernel;
}

TEST(Motions, PreviousPositionsArePlaced) {
    Scene scene = twoBoxes();
    start(scene, 0, {.velocity = {1, 0, 0}, .spin = {}, .rotation = {}});
    test::Runner runner(scene, {.substeps = 4, .motions = 1, .keepsPrevious = true});
    runner.step(Step{.gravity = {}});
    const std::vector<Motion> motions{
        {.kind = MotionKind::pose, .body = 0, .linear = {0, 0, 3}, .rotation = quarter}};
    runner.step(Step{.gravity = {}, .motions = motions});
    const auto now = runner.positions();
    const auto words = test::queue().download<std::array<float, 4>>(runner.simulation().previousPositions());
    for (std::size_t i = 0; i < 2 * ofBox; ++i) {
        const Vector3d before(double{words[i][0]}, double{words[i][1]}, double{words[i][2]});
        const Vector3d way = i < ofBox ? Vector3d(0, 1, 0) / 60 : Vector3d(1, 0, 0) / 60;
        EXPECT_LT((now[i] - before - way).norm(), 2e-6) << i;
    }
}

// A blade that stands still cuts nothing of a body that is placed behind it between two steps of a stroke.
TEST(Motions, APlacedBodyIsNotCutOnTheWay) {
    Scene scene;
    addBox(scene, {0, 0, 0}, 0, true);
    for (const bool isPlaced : {true, false}) {
        test::Runner runner(scene, {.substeps = 4, .motions = 1});
        const std::vector<Vec3> from{{0.15f, -1, 1}, {0.15f, 1, 1}};
        runner.step(Step{.gravity = {}, .blade = {.from = from, .to = from}});
        const std::vector<Motion> motions{
            {.kind = isPlaced ? MotionKind::pose : MotionKind::addVelocity, .body = 0, .linear = {0, 0, 2}}};
        Status status;
        for (int s = 0; s < 60; ++s)
            status = runner.step(Step{.gravity = {},
                                      .motions = s == 0 ? std::span(motions) : std::span<const Motion>{},
                                      .blade = {.from = from, .to = from, .isCarried = true}});
        if (isPlaced)
            EXPECT_EQ(status.linksCutInAll, 0u);
        else
            EXPECT_GT(status.linksCutInAll, 0u); // it flies through the edges of the blade
    }
}

TEST(Motions, FaultsHaveNoEffectAndASentence) {
    Scene scene = twoBoxes();
    addCloth(scene, {.origin = {0, 3, 0}, .size = {4, 4}, .spacing = spacing, .pinned = {0}});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Motion> faulty{
        {.kind = static_cast<MotionKind>(17), .body = 0},
        {.body = 0, .linear = {nan, 0, 0}},
        {.body = 0, .angular = {0, std::numeric_limits<float>::infinity(), 0}},
        {.body = 0, .linear = {2e9f, 0, 0}},
        {.body = 3, .linear = {1, 0, 0}},
        {.body = 0, .radius = -1, .linear = {1, 0, 0}},
        {.body = 0, .radius = 1e-9f, .linear = {1, 0, 0}},
        {.kind = MotionKind::pose, .linear = {1, 0, 0}},
        {.kind = MotionKind::pose, .body = 0, .radius = 1, .linear = {1, 0, 0}},
        {.kind = MotionKind::pose, .body = 0, .rotation = {0, 0, 0, 0}},
        {.kind = MotionKind::pose, .body = 0, .rotation = {0, 0, 0, 2}},
        {.kind = MotionKind::pose, .body = 2, .linear = {1, 0, 0}},
    };
    const Settings settings{.substeps = 4, .motions = 1};
    test::Runner plain(scene, settings);
    plain.step(Step{});
    for (const Motion& motion : faulty) {
        test::Runner runner(scene, settings);
        const char* fault = runner.simulation().faultOf(motion);
        ASSERT_NE(fault, nullptr);
        runner.step(Step{.motions = std::span(&motion, 1)});
        EXPECT_EQ(runner.stateHash(), plain.stateHash()) << fault;
        const auto sentences = runner.simulation().complaintsOfUse();
        ASSERT_EQ(sentences.size(), 1u) << fault;
        EXPECT_NE(sentences[0].find(fault), std::string::npos) << sentences[0];
    }
    test::Runner runner(scene, {.substeps = 4});
    const std::vector<Motion> motions{{.body = 0, .linear = {1, 0, 0}}};
    EXPECT_STREQ(runner.simulation().faultOf(motions[0]), "is given, but settings.motions is 0");
    runner.step(Step{.motions = motions});
    EXPECT_EQ(runner.simulation().complaintsOfUse().size(), 1u);
}

// Velocities of a held body change where it may move.
TEST(Motions, FixedParticlesStay) {
    Scene scene;
    addCloth(scene, {.origin = {0, 3, 0}, .size = {4, 4}, .spacing = spacing, .pinned = {0}});
    const auto [x, v] = moved(scene, {{.kind = MotionKind::addVelocity, .body = 0, .linear = {0, 1, 0}}});
    EXPECT_EQ(x[0], toEigen(scene.particles[0].position));
    EXPECT_GT(v[15].y(), 0.9);
}

TEST(Motions, HaveTheSameBitsInAnyOrder) {
    Scene scene = boxAndSheet(above);
    addBox(scene, {2, 1, 0}, 0.04f);
    const std::vector<Motion> motions{
        {.kind = MotionKind::pose, .body = 2, .linear = {-2, 2.3f, 0}, .rotation = aslant},
        {.kind = MotionKind::impulse, .body = 2, .linear = {0, -1, 0}, .angular = {0.01f, 0, 0.02f}},
        {.kind = MotionKind::addVelocity, .center = {0, 3, 0}, .radius = 0.4f, .linear = {0, 0, 1}},
    };
    std::uint64_t hashes[2];
    for (const bool isReversed : {false, true}) {
        test::Runner runner(scene, {.substeps = 8, .motions = 4, .isReversed = isReversed});
        for (int s = 0; s < 40; ++s)
            runner.step(Step{.motions = s == 20 ? std::span(motions) : std::span<const Motion>{}});
        hashes[isReversed ? 1 : 0] = runner.stateHash();
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

} // namespace sinew::sim
