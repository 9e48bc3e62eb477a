// Another solver, other substeps, another material or another device go on in the state that there is, with
// all that hands do; and a replay does so, too.
#include "played.hpp"

#include "app/guard.hpp"
#include "vk/loader.hpp"

#include <algorithm>

namespace sinew::viewer {
namespace {

std::string changed(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
}
std::string with(const std::string& solver, const std::string& text = block) {
    return changed(text, "substeps = 4", solver);
}
const std::string falling = changed(changed(block, "cuttable = true\n", ""), "[[plane]]\n", "");
const std::string jacobi = with("name = \"jacobi\"\nsubsteps = 12", falling);
const sim::Material damped{.damping = 1.5f}; // by a pass that `jacobi` has only then

// As Show::takeOver.
void takeOver(Played& next, const Played& before) {
    next.stage.takeOver(before.stage);
    next.tools.goOn(before.tools, next.stage);
    next.controller = before.controller;
    next.asked.reset();
}

std::vector<sim::layout::vec4> positions(Played& played) {
    played.run([&](VkCommandBuffer commands) { played.probe.record(commands); });
    const auto read = played.probe.positions();
    return {read.begin(), read.end()};
}
bool areInTheSamePlaces(Played& a, Played& b) {
    return std::ranges::equal(positions(a), positions(b), [](const auto& x, const auto& y) {
        return x.x == y.x && x.y == y.y && x.z == y.z;
    });
}

void expectTheSameBitsAgain(Played& played, const std::string& text) {
    const InputFile file = played.file();
    const InputFile read = parseInput(toText(file), "test");
    EXPECT_EQ(read.events, file.events);
    Scene again(text);
    Replay replay(read);
    replayAll(again, replay);
    EXPECT_EQ(again.stage.steps(), played.stage.steps());
    EXPECT_EQ(again.stage.settings().solver, played.stage.settings().solver);
    EXPECT_EQ(again.stage.settings().substeps, played.stage.settings().substeps);
    EXPECT_EQ(again.stage.material(), played.stage.material());
    EXPECT_EQ(again.hash(), *file.hash);
    EXPECT_EQ(again.tools.log().events(), file.events);
}

// Under a weaker gravity it is pinned, cut through, and its upper half held.
void pinCutAndHold(Played& played) {
    played.turn({}, 5);
    played.tools.pull(played.stage, 3);
    played.dragFrom({0, 0}, {0.1f, -0.1f}, 3);
    played.turn({.actions = {Action::pin}, .pointer = {0.1f, -0.1f}});
    ASSERT_EQ(played.tools.pins(), 1u);
    played.pressAt({0.1f, -0.1f}, false);
    played.turn({.actions = {Action::blade}});
    played.dragFrom({-0.5f, 0.1f}, {1, 0}, 6);
    played.pressAt({0.5f, 0.1f}, false);
    played.turn({.actions = {Action::blade}}, 4);
    played.dragFrom({-0.1f, 0}, {0, -0.1f}, 3);
}

TEST(StageTakeOver, KeepsPlacesCutsPinsGravityAndTime) {
    Played before;
    pinCutAndHold(before);
    const sim::Status cut = before.stage.simulation().status(before.stage.steps());
    ASSERT_EQ(cut.pieces, 2u);
    ASSERT_TRUE(before.tools.isHolding());
    const std::uint64_t hash = before.hash();
    Played next(with("substeps = 9"), {.stiffness = 0.5f, .damping = 1.5f});
    next.turn({}, 3); // of which nothing may be left
    takeOver(next, before);
    EXPECT_TRUE(areInTheSamePlaces(next, before));
    EXPECT_EQ(next.hash(), hash) << "the same solver keeps velocities as well";
    EXPECT_EQ(before.hash(), hash);
    EXPECT_EQ(next.stage.steps(), before.stage.steps());
    EXPECT_EQ(next.stage.played(), before.stage.played());
    EXPECT_EQ(next.stage.gravity().y, -3);
    EXPECT_EQ(next.tools.pins(), 1u);
    EXPECT_TRUE(next.tools.isHolding());
    EXPECT_EQ(next.tools.history().undos(), 0u) << "those states are of the other simulation";
    EXPECT_FALSE(next.tools.takeNote().empty());
    next.turn({}, 6);
    const sim::Status status = next.stage.simulation().status(next.stage.steps());
    EXPECT_EQ(status.nonFinite, 0u);
    EXPECT_EQ(status.pieces, cut.pieces);
    EXPECT_EQ(status.linksCutInAll, cut.linksCutInAll);
    next.turn({.actions = {Action::undo}}, 3);
    EXPECT_EQ(next.stage.simulation().status(next.stage.steps()).pieces, cut.pieces);
    expectTheSameBitsAgain(next, block);
}

TEST(StageTakeOver, ByAnotherSolverAndBackIsDoneAgainByAReplay) {
    Played first(falling), second(jacobi), third(falling);
    first.turn({}, 8);
    first.dragFrom({0, 0}, {0.1f, -0.2f}, 4);
    takeOver(second, first);
    EXPECT_TRUE(areInTheSamePlaces(second, first));
    second.turn({.pointer = {0.2f, -0.3f}}, 6);
    EXPECT_FALSE(areInTheSamePlaces(second, first));
    takeOver(third, second);
    EXPECT_TRUE(areInTheSamePlaces(third, second));
    third.pressAt({0.2f, -0.3f}, false);
    third.turn({}, 6);
    expectTheSameBitsAgain(third, falling);
}

TEST(StageTakeOver, HasAMaterialThatNeedsOtherPasses) {
    Played before(jacobi);
    before.turn({}, 6);
    before.stage.turn(damped);
    Stage::Turn turn = Stage::Turn::none;
    while (turn == Stage::Turn::none) turn = before.stage.takeTurn(false);
    ASSERT_EQ(turn, Stage::Turn::refused);
    before.turn({}, 2);
    EXPECT_EQ(before.stage.material(), sim::Material{});
    Played next(jacobi, damped);
    takeOver(next, before);
    EXPECT_TRUE(areInTheSamePlaces(next, before));
    next.turn({}, 20);
    before.turn({}, 20);
    EXPECT_NE(next.hash(), before.hash());
    expectTheSameBitsAgain(next, jacobi);
    next.tools.reset(); // with what it was turned to
    next.run([&](VkCommandBuffer commands) { next.stage.recordReset(commands); });
    next.turn({}, 20);
    expectTheSameBitsAgain(next, jacobi);
}

TEST(StageTakeOver, GoesToAnotherDevice) {
    std::vector<std::string> messages;
    const vk::Loader loader;
    const vk::Device device =
        vk::Device::create(loader.getInstanceProcAddr(),
                           {.hasValidation = true, .onValidationMessage = [&](const std::string& text) {
                                messages.push_back(text);
                            }});
    Played here;
    pinCutAndHold(here);
    {
        Stage there(device, here.opening.loaded.scene, here.opening.loaded.settings);
        there.takeOver(here.stage);
        vk::Queue queue(device);
        EXPECT_EQ(stateHash(device, there, queue), here.hash());
        const VkCommandBuffer commands = queue.begin();
        for (int i = 0; i < 2; ++i) there.recordStep(commands);
        queue.wait(queue.submit(commands));
        EXPECT_EQ(there.simulation().status(there.steps()).pieces, 2u);
        here.run([&](VkCommandBuffer here_) {
            for (int i = 0; i < 2; ++i) here.stage.recordStep(here_);
        });
        EXPECT_EQ(stateHash(device, there, queue), here.hash());
    }
    EXPECT_TRUE(messages.empty()) << messages.front();
}

TEST(StageTakeOver, HasAllRoomThatThereIs) {
    Played roomy, next;
    sim::Settings settings = roomy.opening.loaded.settings;
    settings.contactRoom = 64;
    settings.cutSurfaceRoom = 50000;
    Stage stage(test::device(), roomy.opening.loaded.scene, settings);
    roomy.run([&](VkCommandBuffer commands) {
        stage.recordReset(commands);
        stage.recordStep(commands);
    });
    next.stage.takeOver(stage);
    EXPECT_EQ(next.stage.settings().contactRoom, 64u);
    EXPECT_EQ(next.stage.settings().cutSurfaceRoom, 50000u);
    EXPECT_EQ(next.stage.contactRoom().room, 64u);
    EXPECT_EQ(next.hash(), stateHash(test::device(), stage, test::queue()));
    next.run([&](VkCommandBuffer commands) { next.stage.recordStep(commands); });
    const sim::Status status = next.stage.simulation().status(next.stage.steps());
    EXPECT_EQ(status.frame, stage.steps() + 1);
    EXPECT_EQ(status.nonFinite, 0u);
}

TEST(StageReshape, ThatCannotBeHadLeavesAllAsItIs) {
    Played played; // of a block that may be cut, which one solver alone can do
    played.turn({}, 5);
    const std::uint64_t hash = played.hash();
    played.stage.wantShape(sim::Solver::jacobi, 4);
    EXPECT_TRUE(played.stage.wantsShape());
    EXPECT_THROW(played.stage.reshape(test::queue()), std::invalid_argument);
    EXPECT_FALSE(played.stage.wantsShape());
    EXPECT_EQ(played.stage.settings().solver, sim::Solver::split);
    EXPECT_EQ(played.hash(), hash);
    played.turn({}, 2);
    EXPECT_NE(played.hash(), hash);
}

// The replay begins again with what its scene was opened with.
TEST(StageReshape, IsTakenBackAtTheBeginningOfAReplay) {
    Played first(jacobi), second(changed(jacobi, "12", "7"), damped);
    first.turn({}, 5);
    takeOver(second, first);
    second.turn({}, 5);
    Scene again(jacobi);
    Replay replay(second.file());
    replayAll(again, replay);
    again.tools.putAway(again.stage);
    again.tools.reset();
    again.run([&](VkCommandBuffer commands) { again.stage.recordReset(commands); });
    again.stage.reshape(test::queue());
    again.tools.forgetStates();
    EXPECT_EQ(again.stage.settings().solver, sim::Solver::jacobi);
    EXPECT_EQ(again.stage.settings().substeps, 12u);
    EXPECT_EQ(again.stage.material(), sim::Material{});
    replay.restart();
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), second.hash());
}

} // namespace
} // namespace sinew::viewer
