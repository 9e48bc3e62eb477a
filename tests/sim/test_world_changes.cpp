// The making of simulations of a world: sleep, new parts, room, failures, handles.
#include "sim/surface/split_skins.hpp"
#include "sim/world_play.hpp"
#include "sinew/substeps.hpp"

using namespace sinew;
using namespace sinew::sim;
using test::box, test::dampedGround, test::ground, test::Play, test::sleeping, test::slidingBoxes,
    test::stranger, test::Words;

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

TEST(World, KeepsBodiesInAndOutWhenOthersArrive) {
    for (const bool sleeps : {false, true}) {
        Play play(dampedGround(), {.substeps = 6, .sleeps = sleeps, .motions = 1});
        Scene guest = box({0, 0.5f, 0}, {2, 2, 2});
        guest.bodies[0].isAbsent = true;
        const PartId pool = play.add(guest);
        const auto isAway = [&] { return play.positions(pool)[0].x == Motion::absentPlace; };
        play.run(4);
        EXPECT_TRUE(isAway());
        const PartId other = play.add(stranger());
        play.run(4);
        EXPECT_TRUE(isAway());
        Motion motion{.kind = MotionKind::spawn, .body = play.at(pool).first.bodies};
        play.step({.motions = std::span(&motion, 1)});
        EXPECT_NEAR(double{play.positions(pool)[0].y}, 0.5, 0.01);
        play.remove(other);
        play.run(60);
        EXPECT_FALSE(isAway());
        EXPECT_LT(play.positions(pool)[0].y, 0.3f) << "it has fallen to the ground";
        EXPECT_GT(play.positions(pool)[0].y, -0.01f);
        motion = {.kind = MotionKind::despawn, .body = play.at(pool).first.bodies};
        play.step({.motions = std::span(&motion, 1)});
        EXPECT_TRUE(isAway());
        play.add(stranger());
        play.run(4);
        EXPECT_TRUE(isAway());
    }
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

TEST(World, TakesAsManySubstepsAsAPartNeedsThoughAnotherCannotArrive) {
    Play play(ground(), {});
    const PartId soft = play.add(stranger());
    Scene planes, stiff;
    for (int p = 0; p < 10; ++p) planes.planes.push_back({.offset = -10});
    for (int k = 0; k < 5; ++k) play.world().add(planes); // too many together
    const VkCommandBuffer commands = test::queue().begin();
    EXPECT_FALSE(play.world().recordChanges(commands)) << "it begins to make them";
    test::queue().wait(test::queue().submit(commands));
    addLattice(stiff, {.origin = {0, 0.1f, 0}, .cells = {2, 2, 2}, .spacing = 0.05f, .youngModulus = 5e6f});
    const PartId part = play.world().add(stiff);
    EXPECT_THROW(play.settle(), std::invalid_argument);
    EXPECT_TRUE(play.world().contains(part)) << "it was not among those that failed";
    const std::uint32_t before = play.world().settings().substeps;
    play.settle();
    stiff.planes = ground().planes;
    EXPECT_EQ(play.world().settings().substeps, withSubsteps(stiff, {}).substeps);
    EXPECT_GT(play.world().settings().substeps, before);
    play.remove(part);
    EXPECT_GT(play.world().settings().substeps, before) << "never less than before";
    EXPECT_TRUE(play.world().contains(soft));
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
