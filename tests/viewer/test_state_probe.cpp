// What the pointer meets on a mesh that may be cut, as it is drawn: before a cut some of its vertices have
// not moved with it.
#include "support/device.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/state_probe.hpp"
#include "viewer/opening.hpp"

#include <gtest/gtest.h>

#include <array>

namespace sinew::viewer {
namespace {

class ProbedOrgan : public testing::Test {
protected:
    template <typename Record> void run(const Record& record) {
        VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    // Down to where it has fallen, with what is drawn then.
    void step(int steps, const sim::Blade& blade = {}) {
        run([&](VkCommandBuffer commands) {
            for (int i = 0; i < steps; ++i)
                stage.recordStep(commands, nullptr, {}, i == 0 ? blade : sim::Blade{}, {});
            stage.recordSkin(commands);
            probe.record(commands);
        });
    }
    std::optional<Pick> at(const Ray& ray, const SeenState& seen) const {
        return pick(stage.scene(), opening.light.balls, ray, seen);
    }
    // The same with all parts of the skin where they are.
    std::optional<Pick> expected(const Ray& ray) {
        run([&](VkCommandBuffer commands) {
            stage.simulation().recordSkin(commands, sim::SkinDetail::all);
            all.record(commands);
        });
        SeenState seen = all.seen();
        seen.isWhole = false;
        return at(ray, seen);
    }
    std::vector<Ray> rays() const {
        std::vector<Ray> rays;
        for (float x = -0.06f; x < 0.07f; x += 0.03f)
            for (float y = -0.06f; y < 0.07f; y += 0.03f) rays.push_back(rayThrough(opening.camera, {x, y}));
        return rays;
    }

    Opening opening = open({.scene = "", .builtIn = "organ"}, 1.6f);
    Stage stage{test::device(), opening.loaded.scene, opening.loaded.settings};
    StateProbe probe{test::device(), stage.simulation()}, all{test::device(), stage.simulation()};
};

TEST_F(ProbedOrgan, IsMetWhereItIsDrawnBeforeACutAndAfter) {
    run([&](VkCommandBuffer commands) { stage.recordReset(commands); });
    step(12);
    ASSERT_TRUE(probe.seen().isWhole);
    std::size_t met = 0, stale = 0;
    for (const Ray& ray : rays()) {
        const auto seen = at(ray, probe.seen());
        SeenState parts = probe.seen(); // which nobody has moved yet
        parts.isWhole = false;
        const auto wrong = at(ray, parts);
        stale += wrong.has_value() != seen.has_value() ||
                 (seen && std::abs(wrong->distance - seen->distance) > 1e-3f);
        const auto right = expected(ray);
        ASSERT_EQ(seen.has_value(), right.has_value());
        if (!seen) continue;
        ++met;
        EXPECT_LT((seen->point - right->point).norm(), 1e-4f);
    }
    EXPECT_GT(met, 5u);
    EXPECT_GT(stale, 0u) << "all parts are where they are anyway: this shows nothing";

    const Box box = probe.bounds();
    const Vector3 low = box.min() - box.sizes(), high = box.max() + box.sizes(), middle = box.center();
    const std::array from{sim::Vec3{middle.x(), low.y(), low.z()}, sim::Vec3{middle.x(), high.y(), low.z()}};
    const std::array to{sim::Vec3{middle.x(), low.y(), high.z()}, sim::Vec3{middle.x(), high.y(), high.z()}};
    step(6, {.from = from, .to = to});
    ASSERT_GT(stage.simulation().status(stage.steps() - 1).linksCutInAll, 0u);
    EXPECT_FALSE(probe.seen().isWhole);
    for (const Ray& ray : rays()) {
        const auto seen = at(ray, probe.seen()), right = expected(ray);
        ASSERT_EQ(seen.has_value(), right.has_value());
        EXPECT_TRUE(!seen || (seen->point - right->point).norm() < 1e-4f);
    }
}

} // namespace
} // namespace sinew::viewer
