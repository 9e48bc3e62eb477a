// Tests of objects that are first needed while a scene plays. Other threads make them, so that this thread
// makes no pipeline, and the result has the same bits as with waiting.
#include "played.hpp"

#include "sinew/vk/kernel_store.hpp"
#include "viewer/backstage.hpp"
#include "viewer/draw/shot.hpp"

#include <chrono>
#include <thread>

namespace sinew::viewer {
namespace {

const std::string crowd = R"([solver]
substeps = 6
[contacts]
room = 1
[[box]]
particles = [6, 6, 6]
center = [0, 0.3, 0]
spacing = 0.1
collides = true
young_modulus = 2e4
cuttable = true
[[box]]
particles = [3, 3, 3]
center = [0, 0.9, 0]
spacing = 0.1
collides = true
young_modulus = 2e4
[[plane]]
)";

std::size_t pipelinesMadeHere() {
    return test::device().kernels().pipelinesMade();
}

// Number of the step that lacked contact capacity on the device; 0 = none did.
std::uint64_t playUntilCrowded(Played& played) {
    for (int i = 0; i < 120; ++i) {
        played.turn({});
        if (played.stage.neededRoom(played.stage.steps()) > 0) return played.stage.steps();
    }
    return 0;
}

Stage::Growth await(Stage& stage) {
    for (;;) {
        const Stage::Growth growth = stage.askGrowth();
        if (growth != Stage::Growth::making) return growth;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

// Steps without the state probe, which belongs to the former simulation.
void step(Played& played, int steps) {
    for (int i = 0; i < steps; ++i) played.run([&](VkCommandBuffer commands) { played.step(commands); });
}

void take(Played& played) {
    played.stage.bringGrowth(test::queue(), played.tools.bring());
    played.run([&](VkCommandBuffer commands) { played.stage.recordGrowth(commands); });
    played.stage.endGrowth();
}

TEST(StageGrowth, OfContactsIsMadeInAnotherThreadAndComesToTheSameBits) {
    Played waiting(crowd), going(crowd);
    const std::uint64_t crowded = playUntilCrowded(waiting);
    ASSERT_GT(crowded, 0u);
    ASSERT_EQ(playUntilCrowded(going), crowded);
    ASSERT_TRUE(waiting.stage.makeRoom(crowded, test::queue()));
    const std::size_t made = pipelinesMadeHere();
    ASSERT_TRUE(going.stage.beginRoom(crowded));
    EXPECT_TRUE(going.stage.lacksContactRoom());
    EXPECT_EQ(going.stage.steps(), crowded - 1);
    ASSERT_EQ(await(going.stage), Stage::Growth::made);
    take(going);
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_FALSE(going.stage.isGrowing());
    EXPECT_EQ(going.stage.contactRoom().room, waiting.stage.contactRoom().room);
    EXPECT_EQ(going.stage.contactRoom().grown, 1u);
    for (Played* one : {&waiting, &going}) {
        one->tools.restart(one->stage, {}, 1);
        step(*one, 3);
        EXPECT_EQ(one->stage.neededRoom(one->stage.steps()), 0u);
    }
    EXPECT_EQ(going.hash(), waiting.hash());
}

TEST(StageGrowth, OfTheSurfaceGoesOnFromTheStepsTakenMeanwhile) {
    Played waiting, going;
    for (Played* one : {&waiting, &going}) one->turn({}, 2);
    ASSERT_TRUE(waiting.stage.makeSurfaceRoom(200000, test::queue()));
    const std::size_t made = pipelinesMadeHere();
    ASSERT_TRUE(going.stage.beginSurfaceRoom(200000));
    EXPECT_FALSE(going.stage.lacksContactRoom());
    going.turn({}, 2); // whether it is ready or not
    step(waiting, 2);
    ASSERT_EQ(await(going.stage), Stage::Growth::made);
    take(going);
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_EQ(going.stage.settings().cutSurfaceRoom, waiting.stage.settings().cutSurfaceRoom);
    EXPECT_EQ(going.stage.surfaceRoom().grown, 1u);
    EXPECT_EQ(going.stage.steps(), 4u);
    for (Played* one : {&waiting, &going}) step(*one, 1);
    EXPECT_EQ(going.hash(), waiting.hash());
}

// A material change during the growth is not lost: the simulation is changed again.
TEST(StageGrowth, HasTheMaterialOfTheStepsTakenMeanwhile) {
    Played played;
    played.turn({}, 2);
    ASSERT_TRUE(played.stage.beginSurfaceRoom(200000));
    played.stage.turnNow({.stiffness = 0.5f});
    played.turn({}, 2);
    ASSERT_EQ(played.stage.material(), sim::Material{.stiffness = 0.5f});
    ASSERT_EQ(await(played.stage), Stage::Growth::made);
    take(played);
    Played other(block, {.stiffness = 0.5f});
    other.stage.takeOver(played.stage);
    for (Played* one : {&played, &other}) step(*one, 1);
    EXPECT_EQ(played.hash(), other.hash());
}

// Steps that found too little room are taken again by the solver that took them.
TEST(StageGrowth, OfContactsComesBeforeAnotherShape) {
    Played played(crowd);
    const std::uint64_t crowded = playUntilCrowded(played);
    ASSERT_GT(crowded, 0u);
    ASSERT_TRUE(played.stage.beginRoom(crowded));
    played.stage.wantShape(sim::Solver::split, 9);
    EXPECT_FALSE(played.stage.isShapeMade());
    EXPECT_TRUE(played.stage.lacksContactRoom()) << "it goes on being made";
    ASSERT_EQ(await(played.stage), Stage::Growth::made);
    EXPECT_FALSE(played.stage.isShapeMade());
    take(played);
    EXPECT_EQ(played.stage.settings().substeps, 6u);
    played.tools.restart(played.stage, {}, 1);
    ASSERT_EQ(played.stage.undoneSteps(), 1u);
    EXPECT_FALSE(played.stage.isShapeMade()) << "the undone step comes first";
    step(played, 1);
    while (!played.stage.isShapeMade()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    played.stage.reshape(test::queue(), played.tools.bring());
    EXPECT_EQ(played.stage.settings().substeps, 9u);
}

// One simulation is made at a time: room for the surface makes way, and is asked for again by what lacks it.
TEST(StageGrowth, OfTheSurfaceMakesWayForAnotherShape) {
    Played played;
    played.turn({}, 2);
    ASSERT_TRUE(played.stage.beginSurfaceRoom(200000));
    played.stage.wantShape(sim::Solver::split, 9);
    while (!played.stage.isShapeMade()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_FALSE(played.stage.isGrowing());
    played.stage.reshape(test::queue(), played.tools.bring());
    EXPECT_EQ(played.stage.settings().substeps, 9u);
    EXPECT_LT(played.stage.settings().cutSurfaceRoom, 200000u);
    EXPECT_EQ(played.stage.askGrowth(), Stage::Growth::none);
    ASSERT_TRUE(played.stage.beginSurfaceRoom(200000));
    ASSERT_EQ(await(played.stage), Stage::Growth::made);
    take(played);
    EXPECT_GE(played.stage.settings().cutSurfaceRoom, 200000u);
    EXPECT_EQ(played.stage.settings().substeps, 9u);
}

// None after 20 s.
Stage::Turn awaitTurn(Stage& stage) {
    Stage::Turn turn = Stage::Turn::none;
    for (int i = 0; i < 10000 && turn == Stage::Turn::none; ++i) {
        turn = stage.takeTurn(false);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return turn;
}

// Prepared for a simulation that makes way, a material that cannot be had is still refused aloud.
TEST(StageTurn, ThatFailsWhileASimulationIsReplacedIsTold) {
    Played played;
    played.turn({}, 2);
    played.stage.turn({.friction = -1.0f});
    ASSERT_TRUE(played.stage.makeSurfaceRoom(200000, test::queue()));
    EXPECT_THROW(awaitTurn(played.stage), std::invalid_argument);
    EXPECT_EQ(played.stage.takeTurn(false), Stage::Turn::none) << "told once";
    played.stage.turn({.stiffness = 0.5f});
    ASSERT_TRUE(played.stage.makeSurfaceRoom(400000, test::queue()));
    EXPECT_EQ(awaitTurn(played.stage), Stage::Turn::ready) << "prepared again for the other one";
    step(played, 1);
    EXPECT_EQ(played.stage.material().stiffness, 0.5f);
}

TEST(Backstage, MakesAndRehearsesLayersInOtherThreads) {
    const Opening opening = openText(crowd);
    constexpr VkFormat format = VK_FORMAT_B8G8R8A8_UNORM;
    PreparedShow show(test::device(), opening, format);
    Backstage backstage(test::device(), show, opening.camera, 2);
    Watched wanted{.layers = shown({"glass", "strain"}), .isCounting = true};
    for (const char* layer : {"wires", "particles", "links", "contacts"}) addLayer(layer, wanted.layers);
    wanted.layers.section = Section{};
    const std::size_t made = pipelinesMadeHere();
    EXPECT_EQ(backstage.ready({}).layers, Layers{});
    EXPECT_FALSE(backstage.isMaking()) << "nothing is wanted";
    EXPECT_EQ(backstage.ready(wanted).layers, Layers{}) << "what was there before goes on";
    EXPECT_TRUE(backstage.isMaking());
    int rehearsals = 0;
    for (bool isThere = false; !isThere; isThere = backstage.goOn()) {
        rehearsals += backstage.isBusy() ? 1 : 0;
        while (backstage.isBusy()) std::this_thread::yield();
    }
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_EQ(rehearsals > 20, isSoftware(test::device())) << rehearsals;
    EXPECT_EQ(backstage.ready(wanted).layers, wanted.layers);
    EXPECT_TRUE(backstage.ready(wanted).isCounting);
    EXPECT_FALSE(backstage.isMaking());

    Shot shot(test::device(), show.moving.renderer, {64, 48});
    const VkCommandBuffer commands = test::queue().begin();
    show.stage.recordReset(commands);
    show.stage.recordSkin(commands);
    backstage.inspection().record(commands, wanted.layers, 0);
    Overlay overlay{.layers = wanted.layers};
    overlay.buffers = backstage.inspection().buffers(wanted.layers, mapRange(1));
    shot.record(commands, 2, opening.camera, show.stage.simulation(), overlay);
    test::queue().wait(test::queue().submit(commands));
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_EQ(shot.read().pixels.size(), 64u * 48 * 4);
}

} // namespace
} // namespace sinew::viewer
