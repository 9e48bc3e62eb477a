// Parts come and go while a simulation runs. The others have the bits that they have in a world without them.
#include "common/layout.h"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim/surface/split_skins.hpp"
#include "sinew/bodies.hpp"
#include "sinew/holds.hpp"
#include "sinew/world.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <thread>

using namespace sinew;
using namespace sinew::sim;

namespace {

using Words = std::vector<std::uint32_t>;

Words wordsOf(const vk::BufferView& view, vk::Queue& queue = test::queue()) {
    if (view.size == 0) return {};
    vk::BufferView words = view;
    words.stride = sizeof(std::uint32_t);
    return queue.download<std::uint32_t>(words);
}

// A world that is stepped and read back one step at a time; `isValidated`: with the validation layer.
class Play {
public:
    explicit Play(const Scene& base, const Settings& settings, bool isValidated = false)
        : queue_(isValidated ? test::validatedQueue() : test::queue()),
          world_(isValidated ? test::validatedDevice() : test::device(), base, settings) {
        submit([&](VkCommandBuffer commands) { world_.simulation().recordReset(commands); });
    }

    World& world() { return world_; }

    // Waits until all changes have arrived.
    void settle() {
        while (world_.isChanging()) {
            bool isTaken = false;
            submit([&](VkCommandBuffer commands) { isTaken = world_.recordChanges(commands); });
            if (isTaken) world_.release(); // submit() waits
            if (!isTaken) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    PartId add(const Scene& part) {
        const PartId id = world_.add(part);
        settle();
        return id;
    }
    void remove(PartId part) {
        world_.remove(part);
        settle();
    }

    Status step(Step step = {}) {
        step.dt = world_.scene().dt;
        step.gravity = world_.scene().gravity;
        const Status status = tryStep(step);
        EXPECT_FALSE(status.isUndone) << "step " << status.frame;
        return status;
    }
    // The step may be undone.
    Status tryStep(Step step) {
        step.frame = frame_++;
        submit([&](VkCommandBuffer commands) { world_.simulation().record(commands, step); });
        return world_.simulation().status(step.frame);
    }
    Status run(int steps, const Step& given = {}) {
        Status status;
        for (int s = 0; s < steps; ++s) status = step(given);
        return status;
    }

    std::uint64_t steps() const { return frame_; }
    // False if something is awake after 10 s.
    bool fallsAsleep() {
        for (int s = 0; s < 600; ++s)
            if (step().sleeping == world_.scene().particles.size()) return true;
        return false;
    }

    PartRange at(PartId part) const { return world_.find(part).value(); }
    std::uint32_t particle(PartId part, std::uint32_t index) const {
        return at(part).first.particles + index;
    }
    // Bits of the public positions, velocities and pieces of a part.
    Words bits(PartId part) const {
        const PartRange range = at(part);
        Words result;
        for (const vk::BufferView& view :
             {world_.simulation().positions(), world_.simulation().velocities()}) {
            const Words words = wordsOf(view, queue_);
            const auto first = words.begin() + std::ptrdiff_t{4} * range.first.particles;
            result.insert(result.end(), first, first + std::ptrdiff_t{4} * range.count.particles);
        }
        const Words pieces = wordsOf(world_.simulation().pieces(), queue_);
        for (std::uint32_t i = 0; i < range.count.particles && !pieces.empty(); ++i) {
            const std::uint32_t piece = pieces[range.first.particles + i];
            result.push_back(piece < REMOVED_PIECE ? piece - range.first.particles : piece);
        }
        return result;
    }
    std::vector<Vec3> positions(PartId part) const {
        const PartRange range = at(part);
        const Words words = wordsOf(world_.simulation().positions(), queue_);
        std::vector<Vec3> result(range.count.particles);
        for (std::size_t i = 0; i < result.size(); ++i)
            std::memcpy(static_cast<void*>(&result[i]), &words[4 * (range.first.particles + i)],
                        sizeof(Vec3));
        return result;
    }
    // Positions and normals of what is drawn of cuts, and the numbers of triangles.
    Words surface() {
        submit([&](VkCommandBuffer commands) { world_.simulation().recordSkin(commands); });
        const CutSurface surface = world_.simulation().cutSurface();
        const Words counts = wordsOf(surface.counts, queue_);
        if (counts.empty()) return {};
        Words result(counts.begin(), counts.begin() + 4);
        const Words vertices = wordsOf(surface.vertices, queue_), indices = wordsOf(surface.indices, queue_);
        result.insert(result.end(), vertices.begin(), vertices.begin() + std::ptrdiff_t{8} * counts[0]);
        result.insert(result.end(), indices.begin(),
                      indices.begin() + std::ptrdiff_t{3} * (counts[1] + counts[2]));
        return result;
    }

private:
    template <typename Record> void submit(const Record& record) {
        const VkCommandBuffer commands = queue_.begin();
        record(commands);
        queue_.wait(queue_.submit(commands));
    }
    vk::Queue& queue_;
    World world_;
    std::uint64_t frame_ = 0;
};

Scene ground() {
    Scene scene{.name = "ground"};
    scene.planes.push_back({.friction = 0.4f});
    scene.contacts.friction = 0.4f;
    return scene;
}

Scene dampedGround() {
    Scene scene = ground();
    scene.damping = 4;
    return scene;
}

const Settings sleeping{.substeps = 8, .contactRoom = 64, .sleeps = true};

Scene box(const Vec3& origin, std::array<std::uint32_t, 3> cells, float radius = 0.02f) {
    Scene scene;
    const Lattice lattice{
        .origin = origin, .cells = cells, .spacing = 0.05f, .youngModulus = 5e4f, .radius = radius};
    const LatticeCorners corners = addLattice(scene, lattice);
    addLatticeSkin(scene, lattice, corners, {0.5f, 0.5f, 0.5f});
    return scene;
}

// Far from everything else.
Scene stranger(float x = 40) {
    return box({x, 0.3f, 0}, {3, 2, 4});
}

// Two boxes that slide down upon each other, with particles and faces as surfaces.
Scene slidingBoxes() {
    Scene scene = box({0, 0.03f, 0}, {4, 2, 4});
    append(scene, box({0.06f, 0.17f, 0.04f}, {3, 3, 3}));
    for (std::uint32_t g = 0; g < 2; ++g) addSurfaceFaces(scene, scene.grids[g]);
    for (Particle& particle : scene.particles) particle.velocity = {0.3f, 0, 0.1f};
    return scene;
}

// A sheet that falls on a box.
Scene drapedSheet() {
    Scene scene = box({0, 0.02f, 0}, {4, 2, 4});
    addSurfaceFaces(scene, scene.grids[0]);
    addCloth(scene, {.origin = {-0.1f, 0.16f, -0.1f},
                     .size = {12, 12},
                     .spacing = 0.035f,
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-4f,
                     .thickness = 0.01f});
    return scene;
}

Scene chain() {
    Scene scene;
    addChain(scene, {.origin = {0, 0.5f, 0}, .direction = {1, 0, 0}, .particles = 20, .pinned = {0}});
    scene.attachments.push_back({.particle = 19, .anchor = {1, 0.5f, 0}, .compliance = 1e-3f});
    return scene;
}

struct Kind {
    const char* name;
    Scene part;
    Settings settings;
};

std::vector<Kind> kinds() {
    const Settings settings{.substeps = 6, .contactRoom = 64};
    Settings forces = settings;
    forces.keepsForces = true;
    return {{"boxes", slidingBoxes(), settings},
            {"sheet", drapedSheet(), settings},
            {"chain", chain(), settings},
            {"forces", slidingBoxes(), forces},
            {"jacobi", chain(), {.solver = Solver::jacobi, .substeps = 4, .iterations = 3}}};
}

} // namespace

// Sums over a scene, such as the unit of integer sums, depend on all of its bodies: both worlds always have
// the same ones. In one of them a stranger is exchanged for another, so that all that comes after it moves to
// other indices.
TEST(World, GoesOnWithTheSameBitsWhenOthersComeAndGo) {
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        const bool touches = kind.settings.solver == Solver::split;
        Scene base = touches ? ground() : Scene{};
        const Scene other = box({40, 0.3f, 0}, {3, 2, 4}, touches ? 0.02f : 0);
        Play alone(base, kind.settings), busy(base, kind.settings);
        const PartId stays = alone.world().add(other);
        const PartId expected = alone.world().add(kind.part);
        PartId stranger = busy.world().add(other);
        const PartId kept = busy.world().add(kind.part);
        alone.settle();
        busy.settle();
        for (int round = 0; round < 4; ++round) {
            alone.run(12);
            busy.run(12);
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "round " << round;
            if (round == 0) {
                EXPECT_TRUE(busy.bits(stranger) == alone.bits(stays));
            }
            busy.world().remove(stranger);
            stranger = busy.add(other);
        }
        EXPECT_NE(busy.at(kept).first.particles, alone.at(expected).first.particles);
    }
}

TEST(World, GoesOnWithTheSameBitsInASmallerAndALargerScene) {
    const Settings settings{.substeps = 6, .contactRoom = 64};
    Play alone(ground(), settings), busy(ground(), settings);
    const PartId constant = alone.world().add(stranger(-30)), same = busy.world().add(stranger(-30));
    const PartId first = busy.world().add(stranger(50));
    const PartId kept = busy.world().add(slidingBoxes()), expected = alone.world().add(slidingBoxes());
    alone.settle();
    busy.settle();
    for (int round = 0; round < 3; ++round) {
        alone.run(12);
        busy.run(12);
        EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "round " << round;
        EXPECT_TRUE(busy.bits(same) == alone.bits(constant)) << "round " << round;
        if (round == 0) busy.remove(first);
        if (round == 1) busy.add(stranger());
    }
    EXPECT_EQ(busy.at(kept).first.particles, alone.at(expected).first.particles);
}

TEST(World, KeepsGrabsOfParticlesThatMoveToOtherIndices) {
    const Settings settings{.substeps = 5, .contactRoom = 64, .grabs = 2};
    Play alone(ground(), settings), busy(ground(), settings);
    alone.world().add(stranger());
    PartId first = busy.world().add(stranger());
    const PartId kept = busy.world().add(slidingBoxes()), expected = alone.world().add(slidingBoxes());
    alone.settle();
    busy.settle();
    const auto pull = [](Play& play, PartId part, int steps) {
        for (int s = 0; s < steps; ++s) {
            const float height = 0.1f + 0.01f * static_cast<float>(play.steps());
            const std::array<Grab, 2> grabs{
                {{.particle = play.particle(part, 70), .radius = 0.1f, .target = {0.3f, height, 0.2f}},
                 {.particle = play.particle(part, 5), .radius = 0.05f, .target = {-0.3f, 0.3f, 0}}}};
            play.step({.grabs = grabs});
        }
    };
    for (int round = 0; round < 4; ++round) {
        pull(alone, expected, 10);
        pull(busy, kept, 10);
        EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "round " << round;
        busy.world().remove(first);
        first = busy.add(stranger());
    }
    EXPECT_GT(busy.positions(kept)[70].y, 0.3f) << "it was lifted";
}

TEST(World, KeepsCutsWithTheirSurfaces) {
    Scene sheet, block, organ = test::organScene();
    addCloth(sheet, {.origin = {-0.5f, 0.4f, -0.5f},
                     .size = {16, 16},
                     .spacing = 0.06f,
                     .pinned = {0, 15},
                     .isCuttable = true});
    const Lattice lattice{.origin = {-0.2f, 0.1f, -0.2f},
                          .cells = {8, 5, 8},
                          .spacing = 0.05f,
                          .youngModulus = 4e4f,
                          .poissonRatio = 0.4f,
                          .radius = 0.02f,
                          .isCuttable = true};
    addLatticeSkin(block, lattice, addLattice(block, lattice), {0.8f, 0.2f, 0.2f});
    addSurfaceFaces(block, block.grids[0]);
    Scene cuttable; // another body that may be cut
    Lattice other = lattice;
    other.origin = {40, 0.1f, 0};
    other.cells = {4, 3, 5};
    addLatticeSkin(cuttable, other, addLattice(cuttable, other), {0.8f, 0.2f, 0.2f});
    for (const auto& [name, part] : {std::pair{"sheet", sheet}, {"block", block}, {"organ", organ}}) {
        SCOPED_TRACE(name);
        Scene base = ground();
        base.debris = 30;
        const Settings settings{.substeps = 4, .contactRoom = 64};
        Play alone(base, settings), busy(base, settings);
        alone.world().add(cuttable);
        PartId first = busy.world().add(cuttable);
        const PartId kept = busy.world().add(part), expected = alone.world().add(part);
        alone.settle();
        busy.settle();
        const std::array<test::Sweep, 3> strokes{
            test::sweepOf({.point = {0.013, 0.2, 0}, .normal = Eigen::Vector3d(1, 0.1, 0.2).normalized()}, 3),
            test::sweepOf({.point = {0, 0.27, 0.031}, .normal = Eigen::Vector3d(0.1, 1, 1).normalized()}, 3),
            test::sweepOf({.point = {0, 0.2, -0.07}, .normal = Eigen::Vector3d(0.1, 0.2, 1).normalized()},
                          3)};
        for (std::size_t round = 0; round < strokes.size(); ++round) {
            SCOPED_TRACE(round);
            Status before = alone.step({.blade = strokes[round].blade()}),
                   after = busy.step({.blade = strokes[round].blade()});
            EXPECT_EQ(after.linksCut, before.linksCut);
            if (round == 0) {
                EXPECT_GT(after.linksCut, 0u);
            }
            before = alone.run(5);
            after = busy.run(5);
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected));
            busy.world().remove(first);
            first = busy.add(cuttable); // behind what is kept
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "before the next step";
            before = alone.run(5);
            after = busy.run(5);
            EXPECT_TRUE(busy.bits(kept) == alone.bits(expected)) << "after steps";
            EXPECT_TRUE(busy.surface() == alone.surface());
            EXPECT_EQ(after.linksCutInAll, before.linksCutInAll);
            EXPECT_EQ(after.pieces, before.pieces);
            EXPECT_EQ(after.debris, before.debris);
            EXPECT_EQ(after.debrisParticles, before.debrisParticles);
            EXPECT_EQ(after.debrisMass, before.debrisMass);
            EXPECT_GT(after.pieces, 1u);
        }
    }
}

TEST(World, LetsSleepersSleepUntilSomethingIsRemoved) {
    Play play(dampedGround(), sleeping);
    const PartId lower = play.world().add(box({0, 0.02f, 0}, {2, 1, 2})),
                 upper = play.world().add(box({0, 0.12f, 0}, {2, 1, 2}));
    play.settle();
    ASSERT_TRUE(play.fallsAsleep());
    const std::uint32_t all = play.at(lower).count.particles + play.at(upper).count.particles;
    const Words before = play.bits(upper);
    const PartId far = play.add(stranger());
    EXPECT_EQ(play.step().sleeping, all) << "what arrives elsewhere wakes nothing";
    EXPECT_TRUE(play.bits(upper) == before);
    ASSERT_TRUE(play.fallsAsleep()) << "it falls asleep in turn";
    EXPECT_TRUE(play.bits(upper) == before);
    play.remove(far);
    EXPECT_EQ(play.step().sleeping, 0u);
    ASSERT_TRUE(play.fallsAsleep());
    const float height = play.positions(upper)[0].y;
    play.remove(lower);
    play.run(60);
    EXPECT_LT(play.positions(upper)[0].y, height - 0.05f) << "it falls when its support is gone";
}

TEST(World, WakesWhatSomethingNewFallsOn) {
    Play play(dampedGround(), sleeping);
    const PartId lower = play.add(box({0, 0.02f, 0}, {2, 1, 2}));
    ASSERT_TRUE(play.fallsAsleep());
    const Words before = play.bits(lower);
    const PartId upper = play.add(box({0.03f, 0.2f, 0.03f}, {1, 1, 1}));
    play.run(60);
    EXPECT_FALSE(play.bits(lower) == before);
    for (const Vec3& x : play.positions(upper)) EXPECT_GT(x.y, 0.06f) << "it lies on the lower one";
}

TEST(World, StartsPartsAsASceneStartsThem) {
    // free flight: x = x0 + v t - g t^2 / 2 with the rounding of the solver, whenever a part comes
    Scene base;
    const Settings settings{.substeps = 8};
    Play play(base, settings);
    Scene ball;
    addParticles(ball, {.count = {1, 1, 1}, .radius = 0.05f, .velocity = {1, 2, 0}});
    const PartId first = play.add(ball);
    play.run(20);
    const PartId second = play.add(ball); // where the first one was: they do not overlap now
    const std::vector<Vec3> start = play.positions(second);
    EXPECT_EQ(start[0].x, 0);
    play.run(20);
    const double t = 20.0 / 60;
    const std::vector<Vec3> now = play.positions(second), before = play.positions(first);
    EXPECT_NEAR(double{now[0].x}, t, 1e-5);
    EXPECT_NEAR(double{now[0].y}, 2 * t - 0.5 * 9.81 * t * t, 1e-5);
    EXPECT_NEAR(double{before[0].y}, 2 * 2 * t - 0.5 * 9.81 * 4 * t * t, 2e-5);
}

TEST(World, AddsAndRemovesCollidersAndWhatTheyCarry) {
    Play play(Scene{.name = "air"}, {.substeps = 6});
    Scene floor;
    floor.colliders.push_back({.shape = ColliderShape::box,
                               .halfExtents = {1, 0.1f, 1},
                               .friction = 0.5f,
                               .pose = {.position = {0, -0.1f, 0}}});
    const PartId collider = play.world().add(floor);
    const PartId body = play.world().add(box({0, 0.02f, 0}, {3, 3, 3}));
    play.settle();
    play.run(40);
    EXPECT_GT(play.positions(body)[0].y, -0.01f);
    play.remove(collider);
    play.run(30);
    EXPECT_LT(play.positions(body)[0].y, -0.5f) << "the collider is gone";
}

TEST(World, MakesRoomForMoreContacts) {
    Play play(ground(), {.substeps = 6, .contactRoom = 1}),
        roomy(ground(), {.substeps = 6, .contactRoom = 64});
    const PartId part = play.add(slidingBoxes()), expected = roomy.add(slidingBoxes());
    int undone = 0;
    for (int s = 0; s < 20; ++s) {
        const Step step{.dt = play.world().scene().dt, .gravity = play.world().scene().gravity};
        Status status = play.tryStep(step);
        for (; status.isUndone; status = play.tryStep(step)) {
            ASSERT_LT(++undone, 10);
            EXPECT_GT(status.contactRoom, play.world().settings().contactRoom);
            EXPECT_TRUE(play.world().observe(status));
            EXPECT_TRUE(play.world().isChanging());
            play.settle();
        }
    }
    EXPECT_GT(undone, 0);
    roomy.run(20);
    EXPECT_TRUE(play.bits(part) == roomy.bits(expected)) << "no step is lost";
    EXPECT_FALSE(play.world().observe({.isFinished = true, .contactRoom = 100000}))
        << "there is no such room";
}

// Contacts, faces, grabs, sleep and cuts at once, under the validation layer.
TEST(World, RecordsValidCommands) {
    Scene base = dampedGround();
    base.debris = 30;
    Settings settings{.substeps = 3, .contactRoom = 64, .sleeps = true, .grabs = 1};
    Play play(base, settings, true);
    PartId first = play.world().add(stranger());
    const PartId boxes = play.world().add(slidingBoxes()), organ = play.world().add(test::organScene());
    play.settle();
    const test::Sweep sweep =
        test::sweepOf({.point = {0.013, 0.2, 0}, .normal = Eigen::Vector3d(1, 0.1, 0.2).normalized()}, 0.5);
    for (int round = 0; round < 3; ++round) {
        const Grab grab{.particle = play.particle(boxes, 70), .radius = 0.1f, .target = {0.3f, 0.4f, 0.2f}};
        Step step{.grabs = std::span(&grab, 1)};
        if (round < 2) step.blade = sweep.blade();
        play.step(step);
        play.run(2);
        play.surface();
        play.world().remove(first);
        first = play.add(stranger());
        play.surface();
    }
    EXPECT_GT(play.run(1).pieces, 1u);
    play.remove(organ);
    play.run(1);
}

// The first step with contacts is undone: a ball that touched nothing before has no saved state but the one
// that it arrived with.
TEST(World, KeepsTheStateWhereTheFirstStepAfterATakeOverIsUndone) {
    Scene ball, heap;
    addParticles(ball, {.count = {1, 1, 1}, .radius = 0.05f, .velocity = {1, 2, 0}});
    addParticles(heap, {.center = {5, 0, 0}, .count = {4, 4, 4}, .spacing = 0.101f, .radius = 0.05f});
    Play play(Scene{}, {.substeps = 4, .contactRoom = 1}), roomy(Scene{}, {.substeps = 4, .contactRoom = 64});
    const PartId first = play.add(ball), expected = roomy.add(ball);
    play.run(10);
    roomy.run(10);
    play.add(heap);
    roomy.add(heap);
    const Step step{.dt = play.world().scene().dt, .gravity = play.world().scene().gravity};
    const Status status = play.tryStep(step);
    ASSERT_TRUE(status.isUndone);
    ASSERT_TRUE(play.world().observe(status));
    play.settle();
    play.run(3);
    roomy.run(3);
    EXPECT_TRUE(play.bits(first) == roomy.bits(expected));
    EXPECT_GT(play.positions(first)[0].x, 0.2f) << "it has flown";
}

TEST(World, KnowsTheStatusOfStepsBeforeATakeOver) {
    vk::Queue& queue = test::queue();
    World world(test::device(), ground(), {.substeps = 2});
    const auto record = [&](std::uint64_t frame) {
        const VkCommandBuffer commands = queue.begin();
        if (frame == 0) world.simulation().recordReset(commands);
        const bool isTaken = world.recordChanges(commands);
        world.simulation().record(commands, {.frame = frame});
        queue.wait(queue.submit(commands));
        return isTaken;
    };
    EXPECT_FALSE(record(0));
    const PartId part = world.add(stranger());
    std::uint64_t frame = 1;
    while (!record(frame)) ASSERT_LT(++frame, 100000u);
    EXPECT_TRUE(world.find(part));
    EXPECT_TRUE(world.status(frame).isFinished);
    EXPECT_TRUE(world.status(frame - 1).isFinished) << "of the simulation that was replaced";
    EXPECT_FALSE(world.simulation().status(frame - 1).isFinished);
    world.release();
    EXPECT_FALSE(world.status(frame - 1).isFinished);
    EXPECT_FALSE(world.status(frame + 1).isFinished);
}

TEST(World, RefusesAChangeOfMaterialThatWasPreparedBeforeATakeOver) {
    Play play(ground(), {.substeps = 2});
    play.add(stranger());
    Scene smoother = play.world().scene();
    smoother.contacts.friction = 0.3f;
    std::optional<SceneChange> change = play.world().simulation().prepareChange(smoother);
    ASSERT_TRUE(change);
    play.add(stranger(20));
    const VkCommandBuffer commands = test::queue().begin();
    EXPECT_FALSE(play.world().simulation().recordChange(commands, *change));
    test::queue().wait(test::queue().submit(commands));
}

TEST(World, RefusesStaleHandlesAndInvalidParts) {
    Play play(ground(), {.substeps = 2});
    World& world = play.world();
    EXPECT_THROW(world.remove({}), std::invalid_argument);
    const PartId part = world.add(stranger());
    EXPECT_TRUE(world.contains(part));
    EXPECT_FALSE(world.find(part)) << "it has not arrived";
    play.settle();
    EXPECT_TRUE(world.find(part));
    world.remove(part);
    EXPECT_FALSE(world.contains(part));
    EXPECT_TRUE(world.find(part)) << "it has not left";
    EXPECT_THROW(world.remove(part), std::invalid_argument);
    const PartId next = world.add(stranger());
    EXPECT_EQ(next.index, part.index);
    EXPECT_NE(next.generation, part.generation);
    play.settle();
    EXPECT_FALSE(world.find(part));
    EXPECT_TRUE(world.find(next));
    Scene bad = stranger();
    bad.distances[3].b = 5000;
    EXPECT_THROW(world.add(bad), std::invalid_argument);
    EXPECT_FALSE(world.isChanging());
    Scene homeless = stranger();
    homeless.bodies.clear();
    EXPECT_THROW(world.add(homeless), std::invalid_argument);
    const PartId passing = world.add(stranger());
    world.remove(passing); // never arrives
    play.settle();
    EXPECT_FALSE(world.contains(passing));
    EXPECT_EQ(world.scene().bodies.size(), 1u);
}

TEST(World, GoesOnWithoutPartsThatCannotArrive) {
    Play play(ground(), {.substeps = 2});
    const PartId kept = play.add(stranger());
    Scene planes;
    for (int p = 0; p < 10; ++p) planes.planes.push_back({.offset = -10});
    std::vector<PartId> many;
    for (int k = 0; k < 5; ++k) many.push_back(play.world().add(planes));
    bool hasFailed = false;
    try {
        play.settle();
    } catch (const std::invalid_argument& error) {
        hasFailed = true;
        EXPECT_NE(std::string(error.what()).find("plane"), std::string::npos) << error.what();
    }
    if (hasFailed) {
        for (const PartId part : many) EXPECT_FALSE(play.world().contains(part));
    }
    EXPECT_TRUE(hasFailed);
    play.settle();
    play.run(2);
    EXPECT_TRUE(play.world().find(kept));
}
