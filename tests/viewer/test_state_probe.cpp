// Tests of picking on a cuttable mesh as it is drawn. Before a cut some of its vertices are not updated, and
// after a cut its inside is open.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "support/device.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/state_probe.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sinew::viewer {
namespace {

constexpr float speed = 3; // of each half after the cut [m/s]

// A falling organ around the origin, whose halves separate along x once they are cut.
sim::Scene organ(float away, std::uint32_t resolution) {
    sim::Scene scene{.name = "organ", .gravity = {0, -9.81f, 0}};
    mesh::MeshBody body{.name = "organ", .youngModulus = 1e5f, .isCuttable = true};
    body.voxels.resolution = resolution;
    mesh::addMesh(scene, mesh::generate("organ", 49), body);
    for (sim::Particle& particle : scene.particles)
        particle.velocity.x = particle.position.x >= 0 ? away : -away;
    return scene;
}

class ProbedOrgan {
public:
    explicit ProbedOrgan(float away = 0, std::uint32_t resolution = 14) : scene_(organ(away, resolution)) {
        run([&](VkCommandBuffer commands) { stage.recordReset(commands); });
    }
    void step(int steps, bool isCut = false) {
        static constexpr std::array<sim::Vec3, 2> from{{{0, -3, -3}, {0, 3, -3}}},
            to{{{0, -3, 3}, {0, 3, 3}}};
        run([&](VkCommandBuffer commands) {
            for (int i = 0; i < steps; ++i)
                stage.recordStep(commands, nullptr, {},
                                 isCut && i == 0 ? sim::Blade{.from = from, .to = to} : sim::Blade{});
            stage.recordSkin(commands);
            probe.record(commands);
        });
    }
    // All parts of the skin at their current positions.
    SeenState parts() {
        run([&](VkCommandBuffer commands) {
            stage.simulation().recordSkin(commands, sim::SkinDetail::all);
            all_.record(commands);
        });
        SeenState seen = all_.seen();
        seen.isWhole = false;
        return seen;
    }
    std::optional<Pick> at(const Ray& ray, const SeenState& seen) const {
        return pick(scene_, balls_, ray, seen);
    }
    Vector3 placeOf(std::uint32_t particle) const {
        const sim::layout::vec4& at = probe.positions()[particle];
        return {at.x, at.y, at.z};
    }
    Vector3 middle() const { return probe.bounds().center(); }
    const sim::Scene& scene() const { return scene_; }
    const BallList& balls() const { return balls_; }
    float spacing() const { return scene_.grids[0].restLength[0]; }

private:
    template <typename Record> void run(const Record& record) {
        VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    sim::Scene scene_;
    BallList balls_ = ballsOf(scene_);

public:
    Stage stage{test::device(), scene_, {.substeps = 16}};
    StateProbe probe{test::device(), scene_, stage.settings(), stage.simulation()};

private:
    StateProbe all_{test::device(), scene_, stage.settings(), stage.simulation()};
};

// Rays from above over an area of this half width.
std::vector<Ray> raysDown(const ProbedOrgan& organ, float halfWidth) {
    std::vector<Ray> rays;
    for (float x = -halfWidth; x < halfWidth + 0.01f; x += 0.03f)
        for (float z = -0.2f; z < 0.21f; z += 0.03f)
            rays.push_back({organ.middle() + Vector3(x, 5, z), {0, -1, 0}});
    return rays;
}

std::vector<std::optional<Pick>> picks(const ProbedOrgan& organ, const std::vector<Ray>& rays,
                                       const SeenState& seen) {
    std::vector<std::optional<Pick>> met;
    for (const Ray& ray : rays) met.push_back(organ.at(ray, seen));
    return met;
}

// Expects hits at the positions of all parts, and that those in `wrong` are often elsewhere.
void expectMet(ProbedOrgan& organ, const std::vector<Ray>& rays, const std::vector<std::optional<Pick>>& met,
               const std::vector<std::optional<Pick>>& wrong, std::size_t leastWrong) {
    const auto expected = picks(organ, rays, organ.parts());
    std::size_t count = 0, others = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(met[i].has_value(), expected[i].has_value());
        if (!met[i]) continue;
        ++count;
        EXPECT_LT((met[i]->point - expected[i]->point).norm(), 1e-4f);
        others += !wrong[i] || std::abs(wrong[i]->distance - met[i]->distance) > 1e-3f ? 1 : 0;
    }
    EXPECT_GT(count, 20u);
    EXPECT_GT(others, leastWrong) << "all parts are where they are anyway: this shows nothing";
}

TEST(StateProbe, MeetsAMeshWhereItIsDrawnUntilItIsCut) {
    ProbedOrgan organ;
    organ.step(12);
    const SeenState seen = organ.probe.seen();
    ASSERT_TRUE(seen.isWhole);
    EXPECT_FALSE(seen.cuts);
    SeenState unmoved = seen;
    unmoved.isWhole = false;
    const std::vector<Ray> rays = raysDown(organ, 0.2f);
    expectMet(organ, rays, picks(organ, rays, seen), picks(organ, rays, unmoved), 20);
}

// Three steps later the halves are elsewhere.
TEST(StateProbe, MeetsAMeshWhereItIsDrawnOnceItIsCut) {
    ProbedOrgan organ(speed, 20);
    organ.step(1, true);
    const std::vector<Ray> rays = raysDown(organ, 0.5f);
    const auto early = picks(organ, rays, organ.probe.seen());
    organ.step(3);
    ASSERT_FALSE(organ.probe.seen().isWhole);
    expectMet(organ, rays, picks(organ, rays, organ.probe.seen()), early, 10);
}

// Rays across the gap, from between the halves.
TEST(StateProbe, MeetsTheInsideThatACutHasLaidOpen) {
    ProbedOrgan organ(speed);
    organ.step(1, true);
    for (int i = 0; i < 2; ++i) organ.step(4);
    ASSERT_TRUE(organ.probe.isComplete());
    const SeenState seen = organ.probe.seen();
    ASSERT_FALSE(seen.isWhole);
    ASSERT_TRUE(seen.cuts);
    const Vector3 middle = organ.middle();
    std::size_t inside = 0;
    for (float y = -0.2f; y < 0.21f; y += 0.02f)
        for (float z = -0.2f; z < 0.21f; z += 0.02f)
            for (const float side : {-1.0f, 1.0f}) {
                const auto met = organ.at({middle + Vector3(0, y, z), {side, 0, 0}}, seen);
                if (!met) continue;
                ++inside;
                EXPECT_NEAR(met->distance, 9 * speed / 60, 0.1f) << "what was cut, not the skin beyond";
                const Vector3 particle = organ.placeOf(met->particle);
                EXPECT_GT(side * (particle.x() - middle.x()), 0.5f * met->distance)
                    << "of the half that is met";
                EXPECT_LT((particle - met->point).norm(), 2 * organ.spacing());
            }
    EXPECT_GT(inside, 40u);
}

// Skin, pieces and inside form a closed surface. Behind a section through a half, every ray along its normal
// that hits the half meets its inside; in the gap there is none.
TEST(StateProbe, KnowsWhatASectionOpensOfACutBody) {
    ProbedOrgan organ(speed);
    organ.step(1, true);
    for (int i = 0; i < 2; ++i) organ.step(4);
    const SeenState seen = organ.probe.seen();
    const Vector3 middle = organ.middle();
    const std::vector<bool> isClosed{true};
    const auto opened = [&](float x, float y, float z) {
        const Section section{.normal = {1, 0, 0}, .offset = middle.x() + x};
        const Ray ray{middle + Vector3(5, y, z), {-1, 0, 0}};
        const auto met = pick(organ.scene(), organ.balls(), ray, seen, Among::all, Opened{section, isClosed});
        return met ? std::optional(5 - met->distance) : std::nullopt;
    };
    std::size_t cases = 0;
    for (float y = -0.1f; y < 0.11f; y += 0.02f)
        for (float z = -0.1f; z < 0.11f; z += 0.02f) {
            const auto left = organ.at({middle + Vector3(0, y, z), {-1, 0, 0}}, seen),
                       right = organ.at({middle + Vector3(0, y, z), {1, 0, 0}}, seen),
                       skin = organ.at({middle + Vector3(5, y, z), {-1, 0, 0}}, seen);
            if (!left || !right || 5 - skin->distance < right->distance + 0.05f) continue; // too thin
            const float solid = right->distance + 0.03f;
            const auto back = organ.at({middle + Vector3(solid, y, z), {-1, 0, 0}}, seen);
            if (!back || std::abs(back->distance - 0.03f) > 1e-4f) continue; // the skin folds there
            ++cases;
            EXPECT_NEAR(opened(solid, y, z).value(), solid, 1e-4f) << "in the half";
            EXPECT_NEAR(opened(0, y, z).value(), -left->distance, 1e-4f) << "in the gap";
        }
    EXPECT_GT(cases, 10u);
}

TEST(StateProbe, AsksAgainWhereMoreWasCutThanItHadRoomFor) {
    ProbedOrgan organ(0, 24);
    organ.step(1, true);
    EXPECT_FALSE(organ.probe.isComplete());
    EXPECT_FALSE(organ.probe.seen().cuts);
    organ.step(0);
    EXPECT_TRUE(organ.probe.isComplete());
    EXPECT_TRUE(organ.probe.seen().cuts);
}

} // namespace
} // namespace sinew::viewer
