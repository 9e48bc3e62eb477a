// Tests of objects that are first needed while a scene plays. Other threads make them, so that this thread
// makes no pipeline, and the result has the same bits as with waiting.
#include "played.hpp"

#include "sinew/vk/kernel_store.hpp"
#include "viewer/jobs/layer_loader.hpp"
#include "viewer/render/shot.hpp"

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
        if (played.document.neededRoom(played.document.steps()) > 0) return played.document.steps();
    }
    return 0;
}

Document::Growth await(Document& document) {
    for (;;) {
        const Document::Growth growth = document.askGrowth();
        if (growth != Document::Growth::making) return growth;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

// Steps without the state probe, which belongs to the former simulation.
void step(Played& played, int steps) {
    for (int i = 0; i < steps; ++i) played.run([&](VkCommandBuffer commands) { played.step(commands); });
}

void take(Played& played) {
    played.document.bringGrowth(test::queue(), played.tools.bring());
    played.run([&](VkCommandBuffer commands) { played.document.recordGrowth(commands); });
    played.document.endGrowth();
}

TEST(DocumentGrowth, OfContactsIsMadeInAnotherThreadAndComesToTheSameBits) {
    Played waiting(crowd), going(crowd);
    const std::uint64_t crowded = playUntilCrowded(waiting);
    ASSERT_GT(crowded, 0u);
    ASSERT_EQ(playUntilCrowded(going), crowded);
    ASSERT_TRUE(waiting.document.makeRoom(crowded, test::queue()));
    const std::size_t made = pipelinesMadeHere();
    ASSERT_TRUE(going.document.beginRoom(crowded));
    EXPECT_TRUE(going.document.lacksContactRoom());
    EXPECT_EQ(going.document.steps(), crowded - 1);
    ASSERT_EQ(await(going.document), Document::Growth::made);
    take(going);
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_FALSE(going.document.isGrowing());
    EXPECT_EQ(going.document.contactRoom().room, waiting.document.contactRoom().room);
    EXPECT_EQ(going.document.contactRoom().grown, 1u);
    for (Played* one : {&waiting, &going}) {
        one->tools.restart(one->document, {}, 1);
        step(*one, 3);
        EXPECT_EQ(one->document.neededRoom(one->document.steps()), 0u);
    }
    EXPECT_EQ(going.hash(), waiting.hash());
}

TEST(DocumentGrowth, OfTheSurfaceGoesOnFromTheStepsTakenMeanwhile) {
    Played waiting, going;
    for (Played* one : {&waiting, &going}) one->turn({}, 2);
    ASSERT_TRUE(waiting.document.makeSurfaceRoom(200000, test::queue()));
    const std::size_t made = pipelinesMadeHere();
    ASSERT_TRUE(going.document.beginSurfaceRoom(200000));
    EXPECT_FALSE(going.document.lacksContactRoom());
    going.turn({}, 2); // whether it is ready or not
    step(waiting, 2);
    ASSERT_EQ(await(going.document), Document::Growth::made);
    take(going);
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_EQ(going.document.settings().cutSurfaceRoom, waiting.document.settings().cutSurfaceRoom);
    EXPECT_EQ(going.document.surfaceRoom().grown, 1u);
    EXPECT_EQ(going.document.steps(), 4u);
    for (Played* one : {&waiting, &going}) step(*one, 1);
    EXPECT_EQ(going.hash(), waiting.hash());
}

// A material change during the growth is not lost: the simulation is changed again.
TEST(DocumentGrowth, HasTheMaterialOfTheStepsTakenMeanwhile) {
    Played played;
    played.turn({}, 2);
    ASSERT_TRUE(played.document.beginSurfaceRoom(200000));
    played.document.turnNow({.stiffness = 0.5f});
    played.turn({}, 2);
    ASSERT_EQ(played.document.material(), sim::Material{.stiffness = 0.5f});
    ASSERT_EQ(await(played.document), Document::Growth::made);
    take(played);
    Played other(block, {.stiffness = 0.5f});
    other.document.takeOver(played.document);
    for (Played* one : {&played, &other}) step(*one, 1);
    EXPECT_EQ(played.hash(), other.hash());
}

// Steps that found too little room are taken again by the solver that took them.
TEST(DocumentGrowth, OfContactsComesBeforeAnotherShape) {
    Played played(crowd);
    const std::uint64_t crowded = playUntilCrowded(played);
    ASSERT_GT(crowded, 0u);
    ASSERT_TRUE(played.document.beginRoom(crowded));
    played.document.wantShape(sim::Solver::split, 9);
    EXPECT_FALSE(played.document.isShapeMade());
    EXPECT_TRUE(played.document.lacksContactRoom()) << "it goes on being made";
    ASSERT_EQ(await(played.document), Document::Growth::made);
    EXPECT_FALSE(played.document.isShapeMade());
    take(played);
    EXPECT_EQ(played.document.settings().substeps, 6u);
    played.tools.restart(played.document, {}, 1);
    ASSERT_EQ(played.document.undoneSteps(), 1u);
    EXPECT_FALSE(played.document.isShapeMade()) << "the undone step comes first";
    step(played, 1);
    while (!played.document.isShapeMade()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    played.document.reshape(test::queue(), played.tools.bring());
    EXPECT_EQ(played.document.settings().substeps, 9u);
}

// One simulation is made at a time: room for the surface makes way, and is asked for again by what lacks it.
TEST(DocumentGrowth, OfTheSurfaceMakesWayForAnotherShape) {
    Played played;
    played.turn({}, 2);
    ASSERT_TRUE(played.document.beginSurfaceRoom(200000));
    played.document.wantShape(sim::Solver::split, 9);
    while (!played.document.isShapeMade()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_FALSE(played.document.isGrowing());
    played.document.reshape(test::queue(), played.tools.bring());
    EXPECT_EQ(played.document.settings().substeps, 9u);
    EXPECT_LT(played.document.settings().cutSurfaceRoom, 200000u);
    EXPECT_EQ(played.document.askGrowth(), Document::Growth::none);
    ASSERT_TRUE(played.document.beginSurfaceRoom(200000));
    ASSERT_EQ(await(played.document), Document::Growth::made);
    take(played);
    EXPECT_GE(played.document.settings().cutSurfaceRoom, 200000u);
    EXPECT_EQ(played.document.settings().substeps, 9u);
}

// None after 20 s.
Document::Turn awaitTurn(Document& document) {
    Document::Turn turn = Document::Turn::none;
    for (int i = 0; i < 10000 && turn == Document::Turn::none; ++i) {
        turn = document.takeTurn(false);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return turn;
}

// Prepared for a simulation that makes way, a material that cannot be had is still refused aloud.
TEST(DocumentTurn, ThatFailsWhileASimulationIsReplacedIsTold) {
    Played played;
    played.turn({}, 2);
    played.document.turn({.friction = -1.0f});
    ASSERT_TRUE(played.document.makeSurfaceRoom(200000, test::queue()));
    EXPECT_THROW(awaitTurn(played.document), std::invalid_argument);
    EXPECT_EQ(played.document.takeTurn(false), Document::Turn::none) << "told once";
    played.document.turn({.stiffness = 0.5f});
    ASSERT_TRUE(played.document.makeSurfaceRoom(400000, test::queue()));
    EXPECT_EQ(awaitTurn(played.document), Document::Turn::ready) << "prepared again for the other one";
    step(played, 1);
    EXPECT_EQ(played.document.material().stiffness, 0.5f);
}

TEST(LayerLoader, MakesAndRehearsesLayersInOtherThreads) {
    const OpenedScene opening = openText(crowd);
    constexpr VkFormat format = VK_FORMAT_B8G8R8A8_UNORM;
    PreparedPlayer player(test::device(), opening, format);
    LayerLoader layerLoader(test::device(), player, opening.camera, 2);
    WantedLayers wanted{.layers = shown({"glass", "strain"}), .isCounting = true};
    for (const char* layer : {"wires", "particles", "links", "contacts"}) addLayer(layer, wanted.layers);
    wanted.layers.section = Section{};
    const std::size_t made = pipelinesMadeHere();
    EXPECT_EQ(layerLoader.ready({}).layers, Layers{});
    EXPECT_FALSE(layerLoader.isMaking()) << "nothing is wanted";
    EXPECT_EQ(layerLoader.ready(wanted).layers, Layers{}) << "what was there before goes on";
    EXPECT_TRUE(layerLoader.isMaking());
    int rehearsals = 0;
    for (bool isThere = false; !isThere; isThere = layerLoader.goOn()) {
        rehearsals += layerLoader.isBusy() ? 1 : 0;
        while (layerLoader.isBusy()) std::this_thread::yield();
    }
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_EQ(rehearsals > 20, isSoftware(test::device())) << rehearsals;
    EXPECT_EQ(layerLoader.ready(wanted).layers, wanted.layers);
    EXPECT_TRUE(layerLoader.ready(wanted).isCounting);
    EXPECT_FALSE(layerLoader.isMaking());

    Shot shot(test::device(), player.moving.renderer, {64, 48});
    const VkCommandBuffer commands = test::queue().begin();
    player.document.recordReset(commands);
    player.document.recordSkin(commands);
    layerLoader.inspection().record(commands, wanted.layers, 0);
    Overlay overlay{.layers = wanted.layers};
    overlay.buffers = layerLoader.inspection().buffers(wanted.layers, mapRange(1));
    shot.record(commands, 2, opening.camera, player.document.simulation(), overlay);
    test::queue().wait(test::queue().submit(commands));
    EXPECT_EQ(pipelinesMadeHere(), made);
    EXPECT_EQ(shot.read().pixels.size(), 64u * 48 * 4);
}

} // namespace
} // namespace sinew::viewer
