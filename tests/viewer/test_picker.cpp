// Tests of picking on the device against a reference on the host, on random rays: skins, balls, cut bodies
// and sheets, removed fragments, sections. Before a cut some vertices of a mesh are not updated, and after a
// cut its inside is open.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "picked.hpp"
#include "sinew/bodies.hpp"
#include "viewer/tools/grab_tool.hpp"

#include <cmath>
#include <random>

namespace sinew::viewer {
namespace {

// Rays from all around towards the surroundings of a box.
std::vector<Ray> randomRays(const Box& box, std::size_t count) {
    std::mt19937 random(11);
    std::normal_distribution<float> direction;
    std::uniform_real_distribution<float> share(0, 1);
    const Vector3 middle = box.center();
    const float radius = box.diagonal().norm();
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const Vector3 way = Vector3(direction(random), direction(random), direction(random)).normalized();
        const Vector3 to =
            box.min() + Vector3(share(random), share(random), share(random)).cwiseProduct(box.sizes());
        const Vector3 from = middle + radius * way;
        rays.push_back({from, (to - from).normalized()});
    }
    return rays;
}

// Starts inside the box: rays also meet backs and the walls of cuts.
std::vector<Ray> raysFromInside(const Box& box, std::size_t count) {
    std::vector<Ray> rays = randomRays(box, count);
    for (Ray& ray : rays) ray.origin += 0.5f * box.diagonal().norm() * ray.direction;
    return rays;
}

Box boundsOf(const Picked& picked) {
    Box box;
    for (const auto& x : test::queue().download<sim::layout::vec4>(picked.document.simulation().positions()))
        box.extend(Vector3(x.x, x.y, x.z));
    return box;
}

// Random rays from outside and inside, with all and with moving particles, without and with random sections.
void expectAsOnHost(Picked& picked, std::size_t leastMet, std::size_t count = 144) {
    const Box box = boundsOf(picked);
    const std::vector<Ray> rays = randomRays(box, count), inside = raysFromInside(box, count);
    std::size_t met = 0;
    for (const Among among : {Among::moving, Among::all})
        for (const auto& all : {rays, inside}) met += picked.expectAsOnHost(all, among);
    EXPECT_GT(met, leastMet);
    std::size_t opened = 0;
    for (const Vector3& normal : {Vector3(1, 0, 0), Vector3(-0.36f, 0.48f, 0.8f)}) {
        const Section section{normal, normal.dot(box.center()) + 0.01f};
        opened += picked.expectAsOnHost(rays, Among::all, section);
        opened += picked.expectAsOnHost(inside, Among::moving, section);
    }
    EXPECT_GT(opened, leastMet / 8);
}

constexpr std::array<sim::Vec3, 2> bladeFrom{{{0.01f, -3, -3}, {0.01f, 3, -3}}},
    bladeTo{{{0.02f, -3, 3}, {0.02f, 3, 3}}};
const sim::Blade blade{.from = bladeFrom, .to = bladeTo};

// Two blocks, one of them partly fixed, a chain, and loose balls among them.
sim::Scene mixed() {
    sim::Scene scene;
    for (const float z : {-0.2f, -0.9f}) {
        const sim::Lattice lattice{.origin = {-0.2f, -0.2f, z}, .cells = {4, 4, 4}, .spacing = 0.1f};
        sim::addLatticeSkin(scene, lattice, sim::addLattice(scene, lattice), {0.7f, 0.1f, 0.1f});
    }
    for (std::uint32_t i = 0; i < 60; ++i) scene.fixed.push_back({i});
    sim::addParticles(scene, {.center = {0.5f, 0, -0.3f}, .count = {3, 4, 5}, .radius = 0.04f});
    return scene;
}

TEST(Picker, MeetsSkinsAndBallsLikeTheHost) {
    Picked picked(mixed());
    expectAsOnHost(picked, 150, 240);
    picked.step(3);
    expectAsOnHost(picked, 150, 240);
}

// The document gets another simulation twice while the pointer is pressed: before the answer to the press has
// been read, and while the particle is held.
TEST(Picker, GoesOnInAnotherSimulationWhileThePointerIsPressed) {
    constexpr std::uint32_t slot = 5;
    Picked picked(mixed(), {.substeps = 8, .grabs = 1});
    picked.step(3);
    const Camera camera = lookingFrom({0.1f, 0, 3}, {0.1f, -0.05f, 0}, 40);
    GrabTool tool;
    tool.press(camera, {0, 0});
    ASSERT_TRUE(tool.question());
    const Ray ray = *tool.question();
    const auto ask = [&] {
        picked.run([&](VkCommandBuffer commands) {
            picked.document.recordSkin(commands);
            picked.picker.record(commands, slot, {Picker::Cast{ray, Among::moving}});
        });
    };
    ask();
    const std::optional<Pick> expected = picked.onHost(std::span(&ray, 1))[0];
    ASSERT_TRUE(expected);

    picked.document.wantShape(sim::Solver::split, 16);
    picked.document.reshape(test::queue());
    picked.picker.restart();
    const std::optional<Pick> found = picked.picker.answer(slot, 0);
    ASSERT_TRUE(found) << "the answer of before is kept";
    EXPECT_EQ(found->particle, expected->particle);
    EXPECT_LT((found->point - expected->point).norm(), 1e-4f);
    ask();
    ASSERT_TRUE(picked.picker.answer(slot, 0));
    EXPECT_EQ(picked.picker.answer(slot, 0)->particle, expected->particle)
        << "asked again, in the same state";

    tool.answer(found, holdRadius(picked.scene, found->particle));
    ASSERT_TRUE(tool.isHolding());
    const auto away = [&] { // from where the pointer holds it [m]
        const sim::layout::vec4 x = test::queue().download<sim::layout::vec4>(
            picked.document.simulation().positions())[found->particle];
        const sim::Vec3& to = tool.grabs()[0].target;
        return (Vector3(x.x, x.y, x.z) - Vector3(to.x, to.y, to.z)).norm();
    };
    const auto pull = [&](int steps) {
        picked.run([&](VkCommandBuffer commands) {
            for (int i = 0; i < steps; ++i) picked.document.recordStep(commands, nullptr, tool.grabs());
            picked.document.recordSkin(commands);
        });
    };
    const auto expectPulled = [&](const Vector2& pointer) {
        tool.move(camera, pointer);
        const float before = away();
        pull(10);
        EXPECT_LT(away(), 0.9f * before) << "it is pulled";
        picked.expectAsOnHost(randomRays(boundsOf(picked), 240));
    };
    pull(1); // begins at the point that was pressed
    expectPulled({0.2f, 0.2f});
    sim::Settings roomy = picked.document.settings();
    roomy.contactRoom *= 2;
    const sim::Simulation* replaced = &picked.document.simulation();
    picked.document.widen(roomy, test::queue());
    ASSERT_NE(&picked.document.simulation(), replaced);
    picked.picker.restart();
    expectPulled({-0.2f, 0.2f});
}

TEST(Picker, MeetsOneBallAndNothingBesideIt) {
    sim::Scene scene;
    sim::addParticles(scene, {.count = {1, 1, 1}, .radius = 0.1f});
    Picked picked(scene);
    EXPECT_TRUE(picked.at({{0, 0, 3}, {0, 0, -1}}));
    EXPECT_FALSE(picked.at({{0.2f, 0, 3}, {0, 0, -1}}));
    EXPECT_FALSE(picked.at({{0, 0, 3}, {0, 0, 1}})) << "behind the ray";
}

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

TEST(Picker, MeetsAMeshLikeTheHostBeforeAndAfterItIsCut) {
    Picked picked(organ(3, 14));
    picked.step(12);
    ASSERT_TRUE(picked.document.simulation().drawnSkins().areWhole);
    expectAsOnHost(picked, 100);
    picked.step(1, blade);
    ASSERT_FALSE(picked.document.simulation().drawnSkins().areWhole);
    expectAsOnHost(picked, 100);
    picked.step(8);
    expectAsOnHost(picked, 100);
}

// Rays from above over the body.
std::vector<Ray> raysDown(const Picked& picked, float halfWidth) {
    const Vector3 middle = boundsOf(picked).center();
    std::vector<Ray> rays;
    for (float x = -halfWidth; x < halfWidth + 0.01f; x += 0.03f)
        for (float z = -0.2f; z < 0.21f; z += 0.03f) rays.push_back({middle + Vector3(x, 5, z), {0, -1, 0}});
    return rays;
}

// Expects hits where all parts of the skin are at present, and that those in `wrong` are often elsewhere.
void expectWhereAllPartsAre(Picked& picked, const std::vector<Ray>& rays, const Picked::Found& wrong,
                            std::size_t leastWrong) {
    const Picked::Found met = picked.at(rays);
    picked.run([&](VkCommandBuffer commands) {
        picked.document.simulation().recordSkin(commands, sim::SkinDetail::all);
    });
    const StateCopy copy(picked.scene, picked.document.simulation());
    SeenState all = copy.seen();
    all.isWhole = false;
    std::size_t count = 0, others = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto expected = pickOnHost(picked.scene, picked.light.balls, rays[i], all);
        ASSERT_EQ(met[i].has_value(), expected.has_value()) << "ray " << i;
        if (!expected) continue;
        ++count;
        EXPECT_LT((met[i]->point - expected->point).norm(), 1e-4f) << "ray " << i;
        others += !wrong[i] || std::abs(wrong[i]->distance - met[i]->distance) > 1e-3f ? 1 : 0;
    }
    EXPECT_GT(count, 20u);
    EXPECT_GT(others, leastWrong) << "all parts are where they are anyway: this shows nothing";
}

TEST(Picker, MeetsAMeshWhereItIsDrawnUntilItIsCut) {
    Picked picked(organ(0, 14));
    picked.step(12);
    ASSERT_TRUE(picked.document.simulation().drawnSkins().areWhole);
    const std::vector<Ray> rays = raysDown(picked, 0.2f);
    const StateCopy copy(picked.scene, picked.document.simulation());
    SeenState unmoved = copy.seen(); // vertices that only a cut needs are where they were
    unmoved.isWhole = false;
    Picked::Found wrong;
    for (const Ray& ray : rays) wrong.push_back(pickOnHost(picked.scene, picked.light.balls, ray, unmoved));
    expectWhereAllPartsAre(picked, rays, wrong, 20);
}

// Three steps later the halves are elsewhere.
TEST(Picker, MeetsAMeshWhereItIsDrawnOnceItIsCut) {
    Picked picked(organ(3, 20), {.substeps = 16});
    picked.step(1, blade);
    const std::vector<Ray> rays = raysDown(picked, 0.5f);
    const Picked::Found early = picked.at(rays);
    picked.step(3);
    ASSERT_FALSE(picked.document.simulation().drawnSkins().areWhole);
    expectWhereAllPartsAre(picked, rays, early, 10);
}

// Rays towards a cut without a gap, beside which the nearest particle is often one of the other half.
TEST(Picker, KeepsToItsSideOfACutLikeTheHost) {
    Picked picked(organ(0, 14));
    picked.step(1, blade);
    Box near = boundsOf(picked);
    near.min().x() = -0.01f;
    near.max().x() = 0.04f;
    EXPECT_GT(picked.expectAsOnHost(randomRays(near, 600), Among::all), 200u);
}

// Rays across the gap, from between the halves.
TEST(Picker, MeetsTheInsideThatACutHasLaidOpen) {
    Picked picked(organ(3, 14));
    picked.step(1, blade);
    picked.step(8);
    const Vector3 middle = boundsOf(picked).center();
    const auto positions =
        test::queue().download<sim::layout::vec4>(picked.document.simulation().positions());
    std::vector<Ray> rays;
    for (float y = -0.2f; y < 0.21f; y += 0.02f)
        for (float z = -0.2f; z < 0.21f; z += 0.02f)
            for (const float side : {-1.0f, 1.0f})
                rays.push_back({Vector3(middle.x(), middle.y() + y, middle.z() + z), {side, 0, 0}});
    const Picked::Found found = picked.at(rays);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!found[i]) continue;
        ++inside;
        EXPECT_NEAR(found[i]->distance, 9 * 3.0f / 60, 0.1f) << "what was cut, not the skin beyond";
        const float x = positions[found[i]->particle].x - middle.x();
        EXPECT_GT(rays[i].direction.x() * x, 0.5f * found[i]->distance) << "of the half that is met";
        EXPECT_LT(found[i]->offset.norm(), 2 * picked.scene.grids[0].restLength[0]);
    }
    EXPECT_GT(inside, 40u);
}

// Skin, pieces and inside form a closed surface. Behind a section through a half, every ray along its normal
// that hits the half meets its inside; in the gap there is none.
TEST(Picker, MeetsWhatASectionOpensOfACutBody) {
    Picked picked(organ(3, 14));
    picked.step(1, blade);
    picked.step(8);
    const Vector3 middle = boundsOf(picked).center();
    const auto opened = [&](float x, float y, float z) {
        const Section section{.normal = {1, 0, 0}, .offset = middle.x() + x};
        const Ray ray{middle + Vector3(5, y, z), {-1, 0, 0}};
        const auto met = picked.at(ray, Among::all, section);
        return met ? std::optional(5 - met->distance) : std::nullopt;
    };
    std::size_t cases = 0;
    for (float y = -0.1f; y < 0.11f; y += 0.02f)
        for (float z = -0.1f; z < 0.11f; z += 0.02f) {
            const auto left = picked.at(Ray{middle + Vector3(0, y, z), {-1, 0, 0}}),
                       right = picked.at(Ray{middle + Vector3(0, y, z), {1, 0, 0}}),
                       skin = picked.at(Ray{middle + Vector3(5, y, z), {-1, 0, 0}});
            if (!left || !right || 5 - skin->distance < right->distance + 0.05f) continue; // too thin
            const float solid = right->distance + 0.03f;
            const auto back = picked.at(Ray{middle + Vector3(solid, y, z), {-1, 0, 0}});
            if (!back || std::abs(back->distance - 0.03f) > 1e-4f) continue; // the skin folds there
            ++cases;
            EXPECT_NEAR(opened(solid, y, z).value(), solid, 1e-4f) << "in the half";
            EXPECT_NEAR(opened(0, y, z).value(), -left->distance, 1e-4f) << "in the gap";
        }
    EXPECT_GT(cases, 10u);
}

// A cloth that is cut in two, and pinned at a corner.
TEST(Picker, MeetsACutSheetLikeTheHost) {
    sim::Scene scene;
    sim::addCloth(scene, {.origin = {-0.5f, 0, -0.5f},
                          .size = {17, 17},
                          .spacing = 1.0f / 16,
                          .membraneStiffness = 500,
                          .pinned = {0},
                          .isCuttable = true});
    Picked picked(scene);
    picked.step(2, blade);
    picked.step(6);
    EXPECT_GT(picked.document.simulation().status(picked.document.steps()).linksCutInAll, 10u);
    expectAsOnHost(picked, 60);
}

// A block of which a blade cuts a corner, or a half, off; it is kept, or removed as debris.
TEST(Picker, LeavesOutRemovedFragmentsLikeTheHost) {
    for (const bool hasSkin : {true, false})
        for (const std::uint32_t debris : {0u, 5u, 60u}) {
            sim::Scene scene{.gravity = {0, 0, 0}};
            const sim::Lattice lattice{
                .cells = {4, 4, 4}, .spacing = 0.1f, .radius = 0.04f, .isCuttable = true};
            const sim::LatticeCorners corners = sim::addLattice(scene, lattice);
            if (hasSkin) sim::addLatticeSkin(scene, lattice, corners, {1, 0, 0});
            scene.debris = debris;
            Picked picked(scene);
            constexpr std::array<sim::Vec3, 2> from{{{0.15f, -3, -3}, {0.15f, 3, -3}}},
                to{{{0.15f, -3, 3}, {0.15f, 3, 3}}};
            picked.step(3, {.from = from, .to = to});
            const sim::Status status = picked.document.simulation().status(picked.document.steps());
            EXPECT_EQ(status.debrisParticles, debris == 60 ? 50u : 0u);
            expectAsOnHost(picked, 60);
        }
}

} // namespace
} // namespace sinew::viewer
