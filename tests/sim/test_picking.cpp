// Rays and regions of a host, against positions that are known. The viewer's tests compare rays with a
// reference on the host, also at cuts (tests/viewer/test_picker.cpp).
#include "sinew/bodies.hpp"
#include "sinew/picking.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace sinew;
using namespace sinew::sim;

namespace {

// Body 0: a ball of radius 0.05 at the origin. Body 1: a box with a skin, from x = 1 to 1.2. Body 2: a ball
// that never moves, at z = 1.
Scene ballsAndBox() {
    Scene scene;
    scene.gravity = {};
    addParticles(scene, {.count = {1, 1, 1}, .radius = 0.05f});
    const Lattice lattice{
        .origin = {1, -0.1f, -0.1f}, .cells = {4, 4, 4}, .spacing = 0.05f, .youngModulus = 5e4f};
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {0.5f, 0.5f, 0.5f});
    addParticles(scene, {.center = {0, 0, 1}, .count = {1, 1, 1}, .radius = 0.05f});
    scene.particles.back().inverseMass = 0;
    return scene;
}

class Asked {
public:
    explicit Asked(const Scene& scene, std::uint32_t room = 1000)
        : simulation(test::device(), scene, {.substeps = 4}),
          caster(test::device(), scene, rayTargets(scene), 2, 2), finder(test::device(), scene, room, 2) {
        caster.watch(simulation);
        finder.watch(simulation);
        run([&](VkCommandBuffer commands) {
            simulation.recordReset(commands);
            simulation.recordSkin(commands);
        });
    }
    template <typename Record> void run(const Record& record) {
        const VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    std::optional<RayHit> cast(const RayQuery& ray) {
        const std::array<std::optional<RayQuery>, 2> rays{std::nullopt, ray};
        run([&](VkCommandBuffer commands) { caster.record(commands, 1, rays); });
        return caster.hit(1, 1);
    }
    RegionFinder::Found find(const RegionQuery& region) {
        run([&](VkCommandBuffer commands) { finder.record(commands, 1, region); });
        return finder.found(1);
    }

    Simulation simulation;
    RayCaster caster;
    RegionFinder finder;
};

} // namespace

TEST(RayCaster, FindsParticleBodyPointAndDistance) {
    const Scene scene = ballsAndBox();
    Asked asked(scene);
    const auto ball = asked.cast({.origin = {0, 0, -3}, .direction = {0, 0, 1}});
    ASSERT_TRUE(ball);
    EXPECT_EQ(ball->particle, 0u);
    EXPECT_EQ(ball->body, 0u);
    EXPECT_NEAR(ball->distance, 2.95f, 1e-6f);
    EXPECT_NEAR(ball->point.z, -0.05f, 1e-6f);
    EXPECT_EQ(ball->place.z, 0);
    const auto box = asked.cast({.origin = {1.03f, 2, 0.04f}, .direction = {0, -1, 0}});
    ASSERT_TRUE(box);
    EXPECT_EQ(box->body, 1u);
    EXPECT_NEAR(box->distance, 1.9f, 1e-5f) << "the skin is the upper side of the box";
    const Vec3 at = scene.particles[box->particle].position;
    EXPECT_NEAR(at.x, 1.05f, 1e-6f) << "the nearest node";
    EXPECT_NEAR(at.y, 0.1f, 1e-6f);
    EXPECT_NEAR(at.z, 0.05f, 1e-6f);
    EXPECT_FALSE(asked.cast({.origin = {0, 0.2f, -3}, .direction = {0, 0, 1}})) << "beside the balls";
    EXPECT_FALSE(asked.cast({.origin = {0, 0, -3}, .direction = {0, 0, -1}})) << "behind it";
}

TEST(RayCaster, EndsAtItsLengthAndPassesNoFixedBody) {
    Asked asked(ballsAndBox());
    const RayQuery towards{.origin = {0, 0, 3}, .direction = {0, 0, -1}};
    RayQuery ray = towards;
    ASSERT_TRUE(asked.cast(ray));
    EXPECT_EQ(asked.cast(ray)->body, 2u) << "the fixed ball is nearer";
    ray.meetsFixed = false;
    EXPECT_FALSE(asked.cast(ray)) << "a fixed body hides what is behind it";
    ray = towards;
    ray.length = 1.9f;
    EXPECT_FALSE(asked.cast(ray));
    ray.length = 2;
    EXPECT_TRUE(asked.cast(ray));
}

TEST(RayCaster, AnswersWhenAStepBehindItHasFinished) {
    Scene scene = ballsAndBox();
    scene.particles[0].velocity = {0, 0, 6};
    Asked asked(scene);
    const std::array<std::optional<RayQuery>, 1> ray{RayQuery{.origin = {0, 0, -3}, .direction = {0, 0, 1}}};
    const VkCommandBuffer commands = test::queue().begin();
    for (std::uint64_t frame = 0; frame < 2; ++frame) {
        asked.caster.record(commands, static_cast<std::uint32_t>(frame), ray);
        asked.simulation.record(commands, {.dt = scene.dt, .gravity = {}, .frame = frame});
    }
    const std::uint64_t submitted = test::queue().submit(commands);
    while (!asked.simulation.status(1).isFinished) {
    }
    ASSERT_TRUE(asked.caster.hit(0, 0));
    ASSERT_TRUE(asked.caster.hit(1, 0));
    EXPECT_NEAR(asked.caster.hit(0, 0)->distance, 2.95f, 1e-5f);
    EXPECT_NEAR(asked.caster.hit(1, 0)->distance, 2.95f + 6 * scene.dt, 1e-4f);
    test::queue().wait(submitted);
}

TEST(RegionFinder, FindsWhatLiesInSpheresAndBoxes) {
    const Scene scene = ballsAndBox();
    Asked asked(scene);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-0.2f, 1.3f), size(0, 0.4f);
    std::size_t found = 0;
    for (int turn = 0; turn < 60; ++turn) {
        RegionQuery region{.center = {place(random), place(random) - 0.5f, place(random) - 0.2f},
                           .radius = size(random),
                           .findsFixed = turn % 2 == 0};
        if (turn % 3 > 0) region.halfExtents = {size(random), size(random), size(random)};
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
            const Particle& particle = scene.particles[i];
            const auto beyond = [](float x, float center, float half) {
                return std::max(std::abs(double{x} - double{center}) - double{half}, 0.0);
            };
            const double x = beyond(particle.position.x, region.center.x, region.halfExtents.x),
                         y = beyond(particle.position.y, region.center.y, region.halfExtents.y),
                         z = beyond(particle.position.z, region.center.z, region.halfExtents.z);
            const bool counts = region.findsFixed || particle.inverseMass > 0;
            if (counts && x * x + y * y + z * z <= double{region.radius} * double{region.radius})
                expected.push_back(i);
        }
        const RegionFinder::Found result = asked.find(region);
        EXPECT_EQ(result.particles, expected) << "turn " << turn;
        EXPECT_EQ(result.count, expected.size());
        found += expected.size();
    }
    EXPECT_GT(found, 500u);
}

TEST(RegionFinder, CountsAllThoughFewerFit) {
    Asked asked(ballsAndBox(), 7);
    const RegionFinder::Found result = asked.find({.center = {1.1f, 0, 0}, .radius = 0.5f});
    EXPECT_EQ(result.count, 125u);
    ASSERT_EQ(result.particles.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_GT(result.particles[i], i == 0 ? 0u : result.particles[i - 1]);
        EXPECT_LE(result.particles[i], 125u);
    }
}
