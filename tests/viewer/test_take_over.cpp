// Tests of changes of solver, substeps, material or device: the simulation continues from the current state
// with all input, and a replay does the same.
#include "played.hpp"

#include "app/guard.hpp"
#include "sinew/vk/loader.hpp"
#include "vk/allocator.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

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
const sim::Material damped{.damping = 1.5f}; // `jacobi` has this pass only then

// Takes over like ScenePlayer::takeOver.
void takeOver(Played& next, const Played& before) {
    next.document.takeOver(before.document, next.tools.bringOf(before.tools));
    next.tools.goOn(before.tools, next.document);
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
    EXPECT_EQ(again.document.steps(), played.document.steps());
    EXPECT_EQ(again.document.settings().solver, played.document.settings().solver);
    EXPECT_EQ(again.document.settings().substeps, played.document.settings().substeps);
    EXPECT_EQ(again.document.material(), played.document.material());
    EXPECT_EQ(again.hash(), *file.hash);
    EXPECT_EQ(again.tools.log().events(), file.events);
}

// Pins the block under a weaker gravity, cuts it through and grabs its upper half.
void pinCutAndHold(Played& played) {
    played.turn({}, 5);
    played.tools.pull(played.document, 3);
    played.dragFrom({0, 0}, {0.1f, -0.1f}, 3);
    played.turn({.actions = {actionOf(tool::pins)}, .pointer = {0.1f, -0.1f}});
    ASSERT_EQ(played.tools.overlay().pins.size(), 1u);
    played.pressAt({0.1f, -0.1f}, false);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.dragFrom({-0.5f, 0.1f}, {1, 0}, 6);
    played.pressAt({0.5f, 0.1f}, false);
    played.turn({.actions = {actionOf(tool::blade)}}, 4);
    played.dragFrom({-0.1f, 0}, {0, -0.1f}, 3);
}

TEST(DocumentTakeOver, KeepsPlacesCutsPinsGravityAndTime) {
    Played before;
    pinCutAndHold(before);
    const sim::Status cut = before.document.simulation().status(before.document.steps());
    ASSERT_EQ(cut.pieces, 2u);
    ASSERT_TRUE(before.tools.isHolding());
    const std::uint64_t hash = before.hash();
    Played next(with("substeps = 9"), {.stiffness = 0.5f, .damping = 1.5f});
    next.turn({}, 3); // must leave no trace
    takeOver(next, before);
    EXPECT_TRUE(areInTheSamePlaces(next, before));
    EXPECT_EQ(next.hash(), hash) << "the same solver keeps velocities as well";
    EXPECT_EQ(before.hash(), hash);
    EXPECT_EQ(next.document.steps(), before.document.steps());
    EXPECT_EQ(next.document.played(), before.document.played());
    EXPECT_EQ(next.document.gravity().y, -3);
    EXPECT_EQ(next.tools.overlay().pins.size(), 1u);
    EXPECT_TRUE(next.tools.isHolding());
    EXPECT_EQ(next.tools.history().times(), before.tools.history().times());
    EXPECT_EQ(next.tools.stepsBack(), 0u) << "of single steps there is no way back";
    EXPECT_TRUE(next.tools.takeNote().empty());
    next.turn({}, 6);
    const sim::Status status = next.document.simulation().status(next.document.steps());
    EXPECT_EQ(status.nonFinite, 0u);
    EXPECT_EQ(status.pieces, cut.pieces);
    EXPECT_EQ(status.linksCutInAll, cut.linksCutInAll);
    next.turn({.actions = {Action::undo}}, 3);
    EXPECT_EQ(next.document.simulation().status(next.document.steps()).pieces, 1u);
    next.turn({.actions = {Action::redo}}, 3);
    EXPECT_EQ(next.document.simulation().status(next.document.steps()).pieces, cut.pieces);
    expectTheSameBitsAgain(next, block);
}

// A cut across the block at this height.
void cutAt(Played& played, float height) {
    played.turn({.actions = {actionOf(tool::blade)}});
    played.dragFrom({-0.5f, height}, {1, 0}, 6);
    played.pressAt({0.5f, height}, false);
    played.turn({.actions = {actionOf(tool::blade)}}, 4);
}

// Two cuts, the second of which is undone, and the hashes of all states: before both, after the first, after
// the second.
struct Cuts {
    explicit Cuts(Played& played) {
        played.tools.pull(played.document, 3);
        played.turn({}, 4);
        cutAt(played, 0.1f);
        cutAt(played, -0.05f);
        hashes[2] = played.hash();
        played.turn({.actions = {Action::undo}}, 0);
        hashes[1] = played.hash();
        played.turn({.actions = {Action::undo}}, 0);
        hashes[0] = played.hash();
        played.turn({.actions = {Action::redo}}, 0);
        EXPECT_EQ(played.hash(), hashes[1]);
        EXPECT_NE(hashes[0], hashes[1]);
        EXPECT_NE(hashes[1], hashes[2]);
    }
    void expectAllIn(Played& played) const {
        const auto go = [&](Action way, std::uint64_t hash) {
            played.turn({.actions = {way}}, 0);
            EXPECT_EQ(played.hash(), hash);
        };
        EXPECT_EQ(played.tools.history().undos(), 1u);
        EXPECT_EQ(played.tools.history().redos(), 1u);
        go(Action::undo, hashes[0]);
        go(Action::redo, hashes[1]);
        go(Action::redo, hashes[2]);
        go(Action::undo, hashes[1]);
        go(Action::undo, hashes[0]);
    }
    std::array<std::uint64_t, 3> hashes{};
};

TEST(Undo, GoesOnWithOtherSubstepsAndAnotherMaterial) {
    Played before;
    const Cuts cuts(before);
    Played next(with("substeps = 9"), {.stiffness = 0.5f, .damping = 1.5f});
    next.turn({}, 3);
    takeOver(next, before);
    cuts.expectAllIn(next);
    next.turn({}, 5);
    cutAt(next, 0.1f);
    EXPECT_EQ(next.tools.history().undos(), 1u);
    next.turn({.actions = {Action::undo}}, 2);
    EXPECT_EQ(next.document.simulation().status(next.document.steps()).linksCutInAll, 0u);
    cuts.expectAllIn(before); // it has kept its own history
    expectTheSameBitsAgain(next, block);
}

TEST(Undo, LeadsWithMoreRoomToTheStepsThatItLedToWithout) {
    Played little, roomy, growing; // the last one grows in another thread
    const Cuts cuts(little), same(roomy), likewise(growing);
    const std::uint32_t more = 4 * roomy.document.settings().cutSurfaceRoom + 10000;
    ASSERT_TRUE(roomy.document.makeSurfaceRoom(more, test::queue(), roomy.tools.bring()));
    EXPECT_GT(roomy.document.simulation().stateSize(), little.document.simulation().stateSize());
    ASSERT_TRUE(growing.document.beginSurfaceRoom(more));
    while (growing.document.askGrowth() == Document::Growth::making)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    growing.document.bringGrowth(test::queue(), growing.tools.bring());
    growing.run([&](VkCommandBuffer commands) { growing.document.recordGrowth(commands); });
    growing.document.endGrowth();
    for (Played* played : {&roomy, &growing}) played->tools.moveOn();
    for (Played* played : {&little, &roomy, &growing})
        for (const Action way : {Action::undo, Action::redo, Action::redo}) {
            played->tools.act(way); // turn() would use the probe of the former simulation
            played->run([&](VkCommandBuffer commands) {
                EXPECT_TRUE(played->tools.recordHistory(commands, played->document));
                for (int i = 0; i < 7; ++i) played->step(commands);
            });
        }
    EXPECT_EQ(roomy.hash(), little.hash());
    EXPECT_EQ(growing.hash(), little.hash());
    EXPECT_EQ(roomy.document.simulation().status(roomy.document.steps()).linksCutInAll,
              little.document.simulation().status(little.document.steps()).linksCutInAll);
}

TEST(Undo, GoesOnOnAnotherDevice) {
    std::vector<std::string> messages;
    const vk::Loader loader;
    const vk::Device device =
        vk::Device::create(loader.getInstanceProcAddr(),
                           {.hasValidation = true, .onValidationMessage = [&](const std::string& text) {
                                messages.push_back(text);
                            }});
    Played here;
    const Cuts cuts(here);
    {
        Document there(device, here.opening.loaded.scene, here.opening.loaded.settings);
        Tools tools(device, toolContext(here.opening));
        there.takeOver(here.document, tools.bringOf(here.tools));
        tools.goOn(here.tools, there);
        vk::Queue queue(device);
        EXPECT_EQ(stateHash(device, there, queue), cuts.hashes[1]);
        const auto go = [&](Action way, int steps) {
            tools.act(way);
            const VkCommandBuffer commands = queue.begin();
            EXPECT_TRUE(tools.recordHistory(commands, there));
            for (int i = 0; i < steps; ++i) there.recordStep(commands);
            queue.wait(queue.submit(commands));
        };
        go(Action::undo, 0);
        EXPECT_EQ(stateHash(device, there, queue), cuts.hashes[0]);
        go(Action::redo, 0);
        go(Action::redo, 3);
        here.turn({.actions = {Action::redo}}, 3);
        EXPECT_EQ(stateHash(device, there, queue), here.hash());
    }
    EXPECT_TRUE(messages.empty()) << messages.front();
}

// A stroke whose steps lacked capacity is stored once in the history, from before the repeated step.
TEST(Undo, OfAStrokeThatIsCutAgainIsThereOnce) {
    Played played;
    const Cuts cuts(played);
    const std::array begun{Sweep{}};
    played.run([&](VkCommandBuffer commands) { played.tools.remember(commands, played.document); });
    EXPECT_EQ(played.tools.history().undos(), 2u);
    played.tools.forgetUndone(played.document, begun);
    EXPECT_EQ(played.tools.history().undos(), 1u);
    played.tools.forgetUndone(played.document, begun);
    EXPECT_EQ(played.tools.history().undos(), 1u) << "that one was done";
}

TEST(InputFile, OfTheVersionBeforeLosesStatesWithTheSolver) {
    const InputFile before = parseInput("sinew input 1\nsolve split 9\nsteps 1\n", "test"),
                    now = parseInput("sinew input 2\nsolve split 9\nforget steps\nforget\nsteps 1\n", "test");
    const Shaped shaped{sim::Solver::split, 9};
    EXPECT_EQ(before.events, (std::vector<InputEvent>{shaped, Forgot{}, Stepped{1}}));
    EXPECT_EQ(now.events,
              (std::vector<InputEvent>{shaped, Forgot{.areOfSteps = true}, Forgot{}, Stepped{1}}));
    EXPECT_EQ(parseInput(toText(now), "test").events, now.events);
    EXPECT_THROW(parseInput("sinew input 2\nforget me\n", "test"), app::Failure);
}

TEST(DocumentTakeOver, ByAnotherSolverAndBackIsDoneAgainByAReplay) {
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

// A cuttable body has contacts by default. Another solver leaves both out as long as nothing was cut.
TEST(DocumentTakeOver, ByAnotherSolverDoesWithoutDefaultContactsAndCuts) {
    const auto byJacobi = [] { return openText(block, {.solver = "jacobi", .substeps = 12}); };
    Played first, second(byJacobi()), third;
    ASSERT_GT(first.document.scene().particles[0].radius, 0);
    ASSERT_EQ(second.document.scene().particles[0].radius, 0);
    first.turn({}, 8);
    takeOver(second, first);
    EXPECT_TRUE(areInTheSamePlaces(second, first));
    second.turn({}, 6);
    EXPECT_EQ(second.document.simulation().status(second.document.steps()).nonFinite, 0u);
    takeOver(third, second);
    EXPECT_TRUE(areInTheSamePlaces(third, second));
    third.tools.pull(third.document, 3);
    cutAt(third, 0.1f);
    EXPECT_GT(third.document.simulation().status(third.document.steps()).linksCutInAll, 0u);
    expectTheSameBitsAgain(third, block);

    Played fourth(byJacobi());
    EXPECT_THROW(fourth.document.takeOver(third.document), std::invalid_argument)
        << "which would heal the cut";
    third.turn({.actions = {Action::undo}}, 1);
    takeOver(fourth, third);
    EXPECT_TRUE(areInTheSamePlaces(fourth, third));
    EXPECT_EQ(fourth.tools.history().redos(), 0u) << "the state with the cut stays behind";
}

TEST(DocumentTakeOver, HasAMaterialThatNeedsOtherPasses) {
    Played before(jacobi);
    before.turn({}, 6);
    before.document.turn(damped);
    Document::Turn turn = Document::Turn::none;
    while (turn == Document::Turn::none) turn = before.document.takeTurn(false);
    ASSERT_EQ(turn, Document::Turn::refused);
    before.turn({}, 2);
    EXPECT_EQ(before.document.material(), sim::Material{});
    Played next(jacobi, damped);
    takeOver(next, before);
    EXPECT_TRUE(areInTheSamePlaces(next, before));
    next.turn({}, 20);
    before.turn({}, 20);
    EXPECT_NE(next.hash(), before.hash());
    expectTheSameBitsAgain(next, jacobi);
    next.tools.reset(); // with the changed material
    next.run([&](VkCommandBuffer commands) { next.document.recordReset(commands); });
    next.turn({}, 20);
    expectTheSameBitsAgain(next, jacobi);
}

TEST(DocumentTakeOver, GoesToAnotherDevice) {
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
        Document there(device, here.opening.loaded.scene, here.opening.loaded.settings);
        there.takeOver(here.document);
        vk::Queue queue(device);
        EXPECT_EQ(stateHash(device, there, queue), here.hash());
        const VkCommandBuffer commands = queue.begin();
        for (int i = 0; i < 2; ++i) there.recordStep(commands);
        queue.wait(queue.submit(commands));
        EXPECT_EQ(there.simulation().status(there.steps()).pieces, 2u);
        here.run([&](VkCommandBuffer here_) {
            for (int i = 0; i < 2; ++i) here.document.recordStep(here_);
        });
        EXPECT_EQ(stateHash(device, there, queue), here.hash());
    }
    EXPECT_TRUE(messages.empty()) << messages.front();
}

TEST(DocumentTakeOver, HasAllRoomThatThereIs) {
    Played roomy, next;
    sim::Settings settings = roomy.opening.loaded.settings;
    settings.contactRoom = 64;
    settings.cutSurfaceRoom = 50000;
    Document document(test::device(), roomy.opening.loaded.scene, settings);
    roomy.run([&](VkCommandBuffer commands) {
        document.recordReset(commands);
        document.recordStep(commands);
    });
    next.document.takeOver(document);
    EXPECT_EQ(next.document.settings().contactRoom, 64u);
    EXPECT_EQ(next.document.settings().cutSurfaceRoom, 50000u);
    EXPECT_EQ(next.document.contactRoom().room, 64u);
    EXPECT_EQ(next.hash(), stateHash(test::device(), document, test::queue()));
    next.run([&](VkCommandBuffer commands) { next.document.recordStep(commands); });
    const sim::Status status = next.document.simulation().status(next.document.steps());
    EXPECT_EQ(status.frame, document.steps() + 1);
    EXPECT_EQ(status.nonFinite, 0u);
}

TEST(DocumentReshape, ThatCannotBeHadLeavesAllAsItIs) {
    Played played;
    played.tools.pull(played.document, 3);
    cutAt(played, 0.1f); // only one solver supports cuts
    const std::uint64_t hash = played.hash();
    const std::uint32_t buffers = test::device().allocator().statistics().buffers;
    played.document.wantShape(sim::Solver::jacobi, 4);
    EXPECT_TRUE(played.document.wantsShape());
    EXPECT_THROW(played.document.reshape(test::queue(), played.tools.bring()), std::invalid_argument);
    EXPECT_FALSE(played.document.wantsShape());
    EXPECT_EQ(played.document.settings().solver, sim::Solver::split);
    EXPECT_EQ(played.hash(), hash);
    EXPECT_EQ(test::device().allocator().statistics().buffers, buffers) << "what was refused is gone";
    EXPECT_EQ(played.tools.history().undos(), 1u) << "states stay with the simulation that they are of";
    played.turn({}, 2);
    EXPECT_NE(played.hash(), hash);
    played.turn({.actions = {Action::undo}}, 1);
    EXPECT_EQ(played.document.simulation().status(played.document.steps()).linksCutInAll, 0u);
}

// Another thread makes the new simulation. Meanwhile pictures continue, and another change may be requested.
TEST(DocumentReshape, IsMadeBesideWhatPlays) {
    const auto isMade = [](Document& document) {
        for (int n = 0; n < 3000 && !document.isShapeMade(); ++n)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return document.isShapeMade();
    };
    Played waiting, polling;
    EXPECT_FALSE(polling.document.isShapeMade()) << "nobody has asked for one";
    for (Played* played : {&waiting, &polling}) {
        played->turn({}, 5);
        played->document.wantShape(sim::Solver::split, 8);
    }
    waiting.document.reshape(test::queue());
    ASSERT_TRUE(isMade(polling.document));
    EXPECT_EQ(polling.document.settings().substeps, 4u) << "it is not taken by itself";
    polling.document.reshape(test::queue());
    EXPECT_EQ(polling.document.settings().substeps, 8u);
    EXPECT_FALSE(polling.document.wantsShape());
    EXPECT_EQ(polling.hash(), waiting.hash());
    polling.document.wantShape(sim::Solver::split, 12);
    EXPECT_TRUE(isMade(polling.document));
    polling.document.keepShape();
    EXPECT_FALSE(polling.document.wantsShape());
    polling.document.reshape(test::queue());
    EXPECT_EQ(polling.document.settings().substeps, 8u);
    polling.document.wantShape(sim::Solver::split, 12);
    EXPECT_TRUE(isMade(polling.document));
    polling.document.wantShape(sim::Solver::split, 6);
    polling.document.reshape(test::queue());
    EXPECT_EQ(polling.document.settings().substeps, 6u) << "the one that was wanted last";
    polling.run([&](VkCommandBuffer commands) { polling.document.recordStep(commands); });
    EXPECT_EQ(polling.document.simulation().status(polling.document.steps()).nonFinite, 0u);
}

// A replay starts with the settings with which its scene was opened.
TEST(DocumentReshape, IsTakenBackAtTheBeginningOfAReplay) {
    Played first(jacobi), second(changed(jacobi, "12", "7"), damped);
    first.turn({}, 5);
    takeOver(second, first);
    second.turn({}, 5);
    Scene again(jacobi);
    Replay replay(second.file());
    replayAll(again, replay);
    again.tools.putAway(again.document);
    again.tools.reset();
    again.run([&](VkCommandBuffer commands) { again.document.recordReset(commands); });
    again.document.reshape(test::queue(), again.tools.bring());
    again.tools.reshaped();
    EXPECT_EQ(again.document.settings().solver, sim::Solver::jacobi);
    EXPECT_EQ(again.document.settings().substeps, 12u);
    EXPECT_EQ(again.document.material(), sim::Material{});
    replay.restart();
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), second.hash());
}

} // namespace
} // namespace sinew::viewer
