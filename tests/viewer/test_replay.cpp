// Tests of input logs: they are read back as written, and their replay gives the same bits.
#include "played.hpp"

#include "app/guard.hpp"

#include <limits>

namespace sinew::viewer {
namespace {

// Grabs and throws the block, pins it, cuts it, and undoes and redoes the cut with a moving camera.
void play(Played& played) {
    played.turn({}, 5);
    played.dragFrom({0, 0}, {0.2f, -0.3f}, 8);
    played.turn({.notches = 1, .pointer = {0.2f, -0.3f}});
    EXPECT_TRUE(played.tools.isHolding());
    played.turn({.actions = {actionOf(tool::pins)}, .pointer = {0.2f, -0.2f}});
    EXPECT_EQ(played.tools.overlay().pins.size(), 1u);
    played.turn({.drags = {{Action::orbit, {0.05f, 0.02f}}}}, 6);
    played.tools.pull(played.document, 3);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.dragFrom({0.1f, -0.45f}, {0.05f, 0.9f}, 5);
    played.pressAt({0.15f, 0.45f}, false);
    played.turn({}, 5);
    EXPECT_TRUE(played.tools.hintFacts().canUndo) << "a cut";
    played.turn({.actions = {Action::undo}}, 0);
    played.turn({}, 3);
    played.turn({.actions = {Action::redo}}, 4);
    played.turn({.actions = {Action::undo}}, 0);
}

// Changes the material in the thread that prepares it, as a window does.
void turnMaterial(Played& played, const sim::Material& material) {
    played.document.turn(material);
    Document::Turn turn = Document::Turn::none;
    while (turn == Document::Turn::none) turn = played.document.takeTurn(false);
    EXPECT_EQ(turn, Document::Turn::ready);
}

// Softens the block, cuts it, undoes the cut, and stiffens it; the last request counts.
void soften(Played& played) {
    played.turn({}, 10);
    turnMaterial(played, {.stiffness = 0.2f, .damping = 1.5f});
    played.turn({}, 1);
    EXPECT_EQ(played.document.material().stiffness, 0.2f);
    played.turn({}, 9);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.dragFrom({0.1f, -0.45f}, {0.05f, 0.9f}, 5);
    played.pressAt({0.15f, 0.45f}, false);
    played.document.turn({.stiffness = 9});
    played.document.turn({.stiffness = 2});
    for (int i = 0; i < 1000 && played.document.material().stiffness != 2; ++i) {
        played.document.takeTurn(false);
        played.turn({}, 1);
    }
    played.turn({}, 5);
    played.turn({.actions = {Action::undo}}, 0); // to a softer state
    played.turn({}, 5);
}

// Pushes the block with a growing sphere from beside it and then on it, and removes the sphere each time.
void poke(Played& played) {
    played.turn({}, 20);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.turn({.actions = {actionOf(tool::poke)}});
    EXPECT_TRUE(played.tools.isOn(tool::poke) && !played.tools.isOn(tool::blade)) << "one tool at a time";
    played.dragFrom({-0.35f, -0.1f}, {0.4f, 0}, 12);
    EXPECT_TRUE(played.isPoking());
    played.turn({.growth = 2, .pointer = {0.05f, -0.1f}}, 2);
    played.pressAt({0.05f, -0.1f}, false);
    EXPECT_FALSE(played.isPoking());
    played.turn({}, 3);
    played.dragFrom({0.05f, 0.1f}, {-0.1f, -0.1f}, 5);
    played.turn({.actions = {Action::drop}, .pointer = {-0.05f, 0}}, 2);
    EXPECT_FALSE(played.isPoking()) << "Esc lifts it";
    EXPECT_FALSE(played.tools.isOn(tool::poke)) << "and puts it away";
    played.turn({.actions = {actionOf(tool::poke)}}, 2);
    played.turn({.actions = {actionOf(tool::blade)}}, 2);
    EXPECT_FALSE(played.tools.isOn(tool::poke));
    played.turn({.actions = {Action::drop}}, 2);
    EXPECT_FALSE(played.tools.isOn(tool::blade)) << "Esc puts any tool away";
}

void expectTheSameBitsOf(void (*hands)(Played&)) {
    Played played;
    hands(played);
    const InputFile file = played.file();
    const InputFile read = parseInput(toText(file), "test");
    EXPECT_EQ(read.events, file.events);
    EXPECT_EQ(read.hash, file.hash);
    EXPECT_EQ(read.scene, file.scene);
    EXPECT_EQ(read.steps(), played.document.steps());
    Scene again;
    Replay replay(read);
    replayAll(again, replay);
    EXPECT_EQ(again.document.steps(), played.document.steps());
    EXPECT_EQ(again.controller.camera, played.controller.camera);
    EXPECT_EQ(again.hash(), *file.hash);
    EXPECT_EQ(again.tools.log().events(), file.events) << "a replay can be saved as what it was made of";
}

TEST(Replay, LeadsToTheSameBits) {
    expectTheSameBitsOf(play);
}

TEST(Replay, TakesTheFormsOfItsLogAndLeadsToTheSameBits) {
    Played played;
    play(played);
    InputFile file = played.file();
    for (const sim::Forms& forms :
         {sim::Forms{.columns = 1, .chunk = 1}, sim::Forms{.usesTexels = false, .columns = 2, .chunk = 3}}) {
        file.forms = forms;
        const InputFile read = parseInput(toText(file), "test");
        OpenedScene opening = openText(block);
        prepareForReplay(opening, read);
        Scene again(std::move(opening));
        EXPECT_EQ(again.document.settings().forms, forms);
        Replay replay(read);
        replayAll(again, replay);
        EXPECT_EQ(again.hash(), *file.hash);
    }
}

TEST(Replay, TurnsTheSameMaterial) {
    expectTheSameBitsOf(soften);
}

TEST(Replay, OfAMaterialBeginsAtTheReset) {
    Played played;
    turnMaterial(played, {.stiffness = 0.2f, .bodies = {0.5f}});
    played.turn({}, 3);
    played.tools.reset();
    played.run([&](VkCommandBuffer commands) { played.document.recordReset(commands); });
    played.turn({}, 30);
    Scene again;
    Replay replay(parseInput(toText(played.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), played.hash());
    again.tools.putAway(again.document); // the replay starts again
    again.tools.reset();
    again.run([&](VkCommandBuffer commands) { again.document.recordReset(commands); });
    Scene untouched;
    for (Scene* scene : {&again, &untouched})
        scene->run([&](VkCommandBuffer commands) {
            scene->step(commands);
            scene->step(commands);
        });
    EXPECT_EQ(again.hash(), untouched.hash());
}

TEST(Replay, PushesWithTheSameSphere) {
    expectTheSameBitsOf(poke);
}

// The poke tool is active, with an enlarged sphere.
TEST(Replay, OfASphereBeginsAtTheReset) {
    Played played;
    played.turn({.actions = {actionOf(tool::poke)}});
    played.turn({.growth = 4});
    played.tools.reset();
    played.run([&](VkCommandBuffer commands) { played.document.recordReset(commands); });
    played.turn({}, 20);
    const std::uint64_t untouched = played.hash();
    played.dragFrom({-0.35f, -0.1f}, {0.4f, 0}, 8);
    EXPECT_NE(played.hash(), untouched);
    Scene again;
    Replay replay(parseInput(toText(played.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), played.hash());
}

// A stroke down the middle of the block from above to below it, as deep as the blade is set.
void stroke(Played& played) {
    played.dragFrom({0.02f, -0.4f}, {0, 0.8f}, 24);
    played.pressAt({0.02f, 0.4f}, false);
    played.turn({}, 10);
}

// A cut with a limited depth, enlarged by the wheel half way, and a cut that changes to a through cut.
void incise(Played& played) {
    played.turn({}, 5);
    played.tools.set(tool::blade, 0.12f);
    played.turn({.actions = {actionOf(tool::blade)}});
    stroke(played);
    EXPECT_GT(played.tools.history().undos(), 0u);
    played.dragFrom({-0.3f, 0.02f}, {0.3f, 0}, 8);
    played.turn({.growth = 2, .pointer = {0, 0.02f}});
    EXPECT_GT(played.tools.setting(tool::blade).value(), 0.12f);
    played.dragFrom({0, 0.02f}, {0.3f, 0}, 8);
    played.tools.set(tool::blade, std::nullopt);
    played.turn({.pointer = {0.32f, 0.1f}}, 3);
    played.pressAt({0.35f, 0.2f}, false);
    played.turn({}, 10);
}

TEST(Replay, CutsAsDeep) {
    expectTheSameBitsOf(incise);
}

TEST(Replay, OfADepthBeginsAtTheReset) {
    Played played;
    played.tools.set(tool::blade, 0.12f);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.tools.reset();
    played.run([&](VkCommandBuffer commands) { played.document.recordReset(commands); });
    stroke(played);
    Scene again;
    Replay replay(parseInput(toText(played.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), played.hash());
    EXPECT_EQ(again.tools.setting(tool::blade), 0.12f);
    again.tools.putAway(again.document);
    EXPECT_FALSE(again.tools.setting(tool::blade));
}

// Status of the block after a stroke without gravity.
sim::Status afterStroke(const std::optional<float>& depth) {
    Played played;
    played.tools.pull(played.document, 0);
    played.tools.set(tool::blade, depth);
    played.turn({.actions = {actionOf(tool::blade)}});
    stroke(played);
    EXPECT_FALSE(played.tools.question());
    return played.document.simulation().status(played.document.steps());
}

TEST(BladeDepth, LeavesWhatLiesDeeperInOnePiece) {
    const sim::Status shallow = afterStroke(0.08f), deep = afterStroke(0.2f), through = afterStroke({});
    EXPECT_EQ(through.pieces, 2u);
    EXPECT_EQ(shallow.pieces, 1u);
    EXPECT_EQ(deep.pieces, 1u);
    EXPECT_GT(shallow.linksCutInAll, 0u);
    EXPECT_GT(deep.linksCutInAll, shallow.linksCutInAll);
    EXPECT_GT(through.linksCutInAll, deep.linksCutInAll);
}

// Opens a text like a window, which plays no log.
OpenedScene openInWindow(const std::string& text, const std::optional<float>& asked = {}) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("sinew-blade-depth-" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << text;
    OpenedScene opening = open({.scene = file.string(), .bladeDepth = asked}, 1.6f);
    std::filesystem::remove(file);
    return opening;
}

TEST(BladeDepth, OfTheSceneFileIsTheFirstAndIsLogged) {
    const std::string text = std::string(block) + "[tools]\nblade_depth = 0.12\n";
    Played played{openInWindow(text)};
    EXPECT_EQ(played.tools.setting(tool::blade), 0.12f);
    played.turn({.actions = {actionOf(tool::blade)}});
    stroke(played);
    const sim::Status status = played.document.simulation().status(played.document.steps());
    EXPECT_GT(status.linksCutInAll, 0u);
    EXPECT_EQ(status.pieces, 1u);
    Scene again(text);
    Replay replay(parseInput(toText(played.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), played.hash());
    EXPECT_EQ(Played(openInWindow(text, 0.2f)).tools.setting(tool::blade), 0.2f) << "--blade-depth";
    played.tools.set(tool::blade, std::nullopt);
    played.tools.reset();
    EXPECT_FALSE(played.tools.setting(tool::blade)) << "the user's own change stays";
}

// Logs name each depth but that of a blade that goes through.
TEST(BladeDepth, OfTheSceneFileChangesNoLogThatDoesNotNameOne) {
    Played played;
    played.turn({.actions = {actionOf(tool::blade)}});
    stroke(played);
    Scene again(std::string(block) + "[tools]\nblade_depth = 0.12\n");
    Replay replay(parseInput(toText(played.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), played.hash());
}

TEST(Tools, LendTheBladeWhileAKeyIsHeldAndThePointerUsed) {
    Played scene;
    Tools& tools = scene.tools;
    EXPECT_FALSE(tools.lend(actionOf(tool::blade), false)) << "for Ctrl + S nobody needs a blade";
    EXPECT_FALSE(tools.isOn(tool::blade));
    EXPECT_TRUE(tools.lend(actionOf(tool::blade), true));
    EXPECT_FALSE(tools.lend(actionOf(tool::blade), true)) << "once";
    EXPECT_TRUE(tools.isOn(tool::blade));
    scene.pressAt({0, 0}, true);
    EXPECT_FALSE(tools.lend({}, true)) << "in the middle of a stroke";
    EXPECT_TRUE(tools.isOn(tool::blade));
    scene.pressAt({0, 0}, false);
    for (int i = 0; i < 5; ++i) scene.turn({});
    EXPECT_TRUE(tools.lend({}, false));
    EXPECT_FALSE(tools.isOn(tool::blade));

    tools.act(actionOf(tool::poke));
    EXPECT_TRUE(tools.lend(actionOf(tool::blade), true));
    EXPECT_TRUE(tools.isOn(tool::blade) && !tools.isOn(tool::poke));
    EXPECT_TRUE(tools.lend({}, false));
    EXPECT_TRUE(tools.isOn(tool::poke) && !tools.isOn(tool::blade)) << "back in hand";
    tools.act(actionOf(tool::blade)); // until the end
    EXPECT_FALSE(tools.lend(actionOf(tool::blade), true));
    EXPECT_FALSE(tools.lend({}, true));
    EXPECT_TRUE(tools.isOn(tool::blade));
    InputFile file = scene.file();
    Scene again;
    Replay replay(file);
    EXPECT_EQ(replayAll(again, replay), Replay::Due::nothing);
    EXPECT_EQ(again.hash(), file.hash);
    EXPECT_TRUE(again.tools.isOn(tool::blade));
}

// While time is paused, no step makes the cut.
TEST(Tools, TakeTheBladeBackWhileItsStrokeWaitsForAStep) {
    Played scene;
    const auto paused = [&](Input input) { scene.turn(input, 0); };
    ASSERT_TRUE(scene.tools.lend(actionOf(tool::blade), true));
    paused({.presses = {{Action::grab, true, {-0.6f, 0}}}, .pointer = {-0.6f, 0}});
    for (const float x : {-0.3f, 0.0f, 0.3f, 0.6f}) paused({.pointer = {x, 0}});
    EXPECT_FALSE(scene.tools.lend({}, true)) << "the button is down";
    paused({.presses = {{Action::grab, false, {0.6f, 0}}}, .pointer = {0.6f, 0}});
    EXPECT_TRUE(scene.tools.lend({}, true));
    EXPECT_FALSE(scene.tools.isOn(tool::blade));
    for (int i = 0; i < 6; ++i) scene.turn({});
    EXPECT_GT(scene.document.simulation().status(scene.document.steps() - 1).linksCutInAll, 0u);
    InputFile file = scene.file();
    Scene again;
    Replay replay(file);
    EXPECT_EQ(replayAll(again, replay), Replay::Due::nothing);
    EXPECT_EQ(again.hash(), file.hash);
}

TEST(Replay, BeginsAtTheReset) {
    Played played;
    played.tools.pull(played.document, 3);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.dragFrom({0.1f, -0.45f}, {0, 0.9f}, 2);
    played.tools.reset();
    played.run([&](VkCommandBuffer commands) { played.document.recordReset(commands); });
    EXPECT_FALSE(played.tools.hintFacts().canUndo) << "the cut is of another time";
    played.dragFrom({0.1f, -0.45f}, {0, 0.9f}, 3); // the blade is still active and gravity is still low
    Scene again;
    Replay replay(parseInput(toText(played.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), played.hash());
}

TEST(Replay, OfAnotherSceneIsRefused) {
    Scene scene;
    Replay replay(parseInput("sinew input 1\npress 0 0\nhand 100000 0 0 0 0 0 0 0.1\nsteps 1\n", "test"));
    try {
        replay.next(scene.tools, scene.controller.camera, scene.document);
        FAIL() << "accepted";
    } catch (const app::Failure& failure) {
        EXPECT_EQ(failure.code(), app::badInput);
        EXPECT_NE(std::string(failure.what()).find("100000"), std::string::npos);
    }
}

TEST(InputLog, TakesStepsBackAndKeepsWhatHandsDid) {
    InputLog log;
    log.step();
    log.step();
    log.press(true, {0, 0});
    log.step();
    log.takeBack(2);
    log.step();
    const std::vector<InputEvent> expected{Stepped{1}, Pressed{true, {0, 0}}, Stepped{1}};
    EXPECT_EQ(log.events(), expected);
}

TEST(InputFile, BringsEveryBitBack) {
    const float odd = 0.1f + std::numeric_limits<float>::epsilon();
    const Camera camera{.target = {odd, -odd, 1e-30f}};
    const InputFile file{.scene = "/a b/c.toml",
                         .from = SavedOrigin{"/a b/c d.state", 0xfedcba98u},
                         .solver = "jacobi",
                         .substeps = 7,
                         .levels = 2,
                         .hasSharpClamp = true,
                         .room = 64,
                         .surface = 5000,
                         .forms = sim::Forms{.usesTexels = false, .columns = 1, .chunk = 3},
                         .events = {camera, Pointed{{odd, 3e8f}}, Action::undo, Answered{},
                                    Answered{indexOf(tool::pins), Pick{3, {odd, 0, 0}, {0, odd, 0}}, odd},
                                    Pulled{odd}, Turned{{odd, {odd, 2}, {}, 0.0f}}, Turned{},
                                    ToolSet{indexOf(tool::blade), odd}, ToolSet{indexOf(tool::blade), {}},
                                    Answered{indexOf(tool::blade)}, Shaped{sim::Solver::gaussSeidel, 1000},
                                    Forgot{}, Stepped{3}},
                         .hash = 0xfedcba9876543210u};
    const InputFile read = parseInput(toText(file), "test");
    EXPECT_EQ(read.events, file.events);
    EXPECT_EQ(read.from, file.from);
    EXPECT_EQ(read.forms, file.forms);
    EXPECT_EQ(toText(read), toText(file));
}

TEST(InputFile, HasTheLinesThatToolsHadBefore) {
    const std::string text = "sinew input 2\nkey C\ndepth 0.25\nkey O\nradius 0.5\npress 0.5 0.25\n"
                             "poke 7 1 2 3 4 5 6 0.125\nrelease 0 0\nkey N\npin nothing\nhand nothing\n"
                             "blade 1 0 0 0 0 0 0 2\nkey Esc\ndepth -\nsteps 4\n";
    EXPECT_EQ(toText(parseInput(text, "test")), text);
}

std::string complaintAbout(const std::string& text) {
    try {
        parseInput(text, "a.input");
    } catch (const app::Failure& failure) {
        EXPECT_EQ(failure.code(), app::badInput);
        return failure.what();
    }
    return "accepted";
}

TEST(InputFile, IsRefusedWithItsLine) {
    EXPECT_EQ(complaintAbout("sinew input 1\n# by hand\n\nsteps 3\n"), "accepted");
    EXPECT_NE(complaintAbout("").find("a.input: it does not begin"), std::string::npos);
    for (const char* line : {"steps",
                             "steps -1",
                             "steps 1 2",
                             "steps 99999999999",
                             "pointer 0 nan",
                             "pointer 0",
                             "key F77",
                             "key",
                             "press 0 x",
                             "hand 3 0 0",
                             "hand -1 0 0 0 0 0 0 0",
                             "camera 0 0 0 -1 0 0 0.7 0",
                             "state xyz",
                             "wave",
                             "gravity inf",
                             "from",
                             "from 12",
                             "from x /a.state",
                             "depth",
                             "depth deep",
                             "blade 1 0 0",
                             "material",
                             "material 1",
                             "material 0 - -",
                             "material 1 - x",
                             "material 1 -1 -",
                             "material 1 - - 0",
                             "solve",
                             "solve split",
                             "solve magic 3",
                             "solve split 0",
                             "solve split 1001",
                             "solve split 3 4"})
        EXPECT_NE(complaintAbout(std::string("sinew input 1\n\n") + line + "\n").find("a.input:3: "),
                  std::string::npos)
            << line;
}

TEST(Replay, IsComparedWithTheStateAfterAsManySteps) {
    const InputFile recorded{.events = {Stepped{30}, Stepped{10}}, .hash = 0xabc};
    EXPECT_EQ(hashText(0xabc, 40), "state hash 0000000000000abc after 40 steps");
    EXPECT_EQ(hashText(0xabc, 40, recorded), "state hash 0000000000000abc after 40 steps, as recorded");
    EXPECT_NE(hashText(0xabd, 40, recorded).find(", not as recorded"), std::string::npos);
    EXPECT_EQ(hashText(0xabd, 50, recorded), "state hash 0000000000000abd after 50 steps, recorded was 40")
        << "of another state nothing is known";
    EXPECT_EQ(hashText(0xabd, 50, {}), "state hash 0000000000000abd after 50 steps") << "an old log has none";
}

// A run whose hash covers all of the state on the device that a step may read.
struct Walk : Played {
    std::uint64_t backAndHash(int steps) {
        for (int i = 0; i < steps; ++i) EXPECT_TRUE(tools.act(Action::stepBack));
        turn({}, 0);
        return hash();
    }
};

TEST(StepBack, LeadsToTheSameBitsBackAndForwards) {
    Walk walk;
    std::vector<std::uint64_t> hashes{walk.hash()};
    for (int step = 0; step < 30; ++step) {
        walk.turn({});
        hashes.push_back(walk.hash());
    }
    ASSERT_NE(hashes[30], hashes[29]);
    EXPECT_EQ(walk.backAndHash(1), hashes[29]);
    EXPECT_EQ(walk.backAndHash(1), hashes[28]);
    EXPECT_EQ(walk.backAndHash(7), hashes[21]);
    EXPECT_EQ(walk.document.played(), 21u);
    for (std::size_t step = 22; step <= 30; ++step) {
        walk.turn({});
        EXPECT_EQ(walk.hash(), hashes[step]) << step;
    }
    EXPECT_EQ(walk.backAndHash(1000), hashes[0]);
    EXPECT_EQ(walk.tools.stepsBack(), 0u);
    EXPECT_EQ(walk.backAndHash(1), hashes[0]) << "there is nothing before";
    EXPECT_FALSE(walk.tools.takeNote().empty());
}

TEST(StepBack, BringsBackWhatWasCutAndForgetsTheWayToIt) {
    Walk walk;
    walk.turn({}, 5);
    const std::uint64_t before = walk.hash();
    walk.tools.act(actionOf(tool::blade));
    walk.dragFrom({0, -0.4f}, {0, 0.8f}, 6);
    walk.pressAt({0, 0.4f}, false);
    ASSERT_EQ(walk.tools.history().undos(), 1u);
    ASSERT_GT(walk.document.simulation().status(walk.document.steps()).linksCutInAll, 0u);
    const auto steps = static_cast<int>(walk.document.played()) - 5;
    EXPECT_EQ(walk.backAndHash(steps), before);
    EXPECT_EQ(walk.tools.history().undos(), 0u) << "there is no cut yet";
    walk.tools.act(actionOf(tool::blade));
    walk.turn({});
    EXPECT_EQ(walk.document.simulation().status(walk.document.steps()).linksCutInAll, 0u);
}

TEST(StepBack, KeepsTheNewestAsFarAsThereIsRoom) {
    Walk walk;
    for (std::size_t turn = 0; turn < History::mostSteps / 10 + 3; ++turn) walk.turn({}, 10);
    EXPECT_EQ(walk.tools.stepsBack(), History::mostSteps);
    const std::uint64_t played = walk.document.played();
    walk.backAndHash(100000);
    EXPECT_EQ(walk.document.played(), played - History::mostSteps);
}

// The history keeps as many states as its capacity, and undone steps take none.
TEST(StepBack, KeepsAsManyAsThereIsRoomFor) {
    constexpr std::size_t room = 9, more = 4;
    Walk walk;
    History exact(test::device(), room), spare(test::device(), room);
    for (int turn = 0; turn < 20; ++turn)
        walk.run([&](VkCommandBuffer commands) {
            exact.recordBefore(commands, walk.document);
            spare.recordBefore(commands, walk.document, more);
            walk.step(commands);
        });
    EXPECT_EQ(exact.undos(), room);
    EXPECT_EQ(spare.undos(), room + more);
    spare.forgetFrom(walk.document.played() - more);
    EXPECT_EQ(spare.undos(), room);
}

// Undone steps that lacked contact lists must change neither step-back nor the log.
TEST(StepBack, KnowsNothingOfStepsThatWereTakenBack) {
    const std::string falling = R"([solver]
substeps = 12
[[box]]
particles = [4, 4, 4]
center = [0, 0.7, 0]
spacing = 0.1
collides = true
young_modulus = 2e4
[contacts]
room = 64
[[plane]]
)";
    constexpr std::uint64_t steps = 32;
    Played plain(falling), calm(falling);
    calm.document.setRepeats(true);
    while (plain.document.steps() < steps) plain.turn({}, 2);
    std::uint64_t takenBack = 0;
    while (calm.document.steps() < steps) {
        calm.turn({}, 2);
        const std::uint64_t newest = calm.document.steps();
        for (const std::uint64_t step : {newest - 1, newest}) {
            if (!calm.document.lacksLists(step)) continue;
            calm.document.goBackBefore(step);
            calm.tools.takeBack(calm.document, {}, newest - calm.document.steps());
            takenBack += newest - calm.document.steps();
            break;
        }
    }
    ASSERT_GT(takenBack, 0u);
    const auto extra = static_cast<int>(calm.document.steps() - steps); // one may still be undone
    plain.turn({}, extra);
    EXPECT_EQ(calm.document.played(), plain.document.played());
    EXPECT_EQ(calm.hash(), plain.hash());
    EXPECT_EQ(calm.file().steps(), plain.file().steps());
    EXPECT_EQ(calm.tools.stepsBack(), plain.tools.stepsBack());
    for (Played* one : {&plain, &calm}) {
        for (int i = 0; i < 20; ++i) one->tools.act(Action::stepBack);
        one->turn({}, 0);
    }
    EXPECT_EQ(calm.document.played(), plain.document.played());
    EXPECT_EQ(calm.hash(), plain.hash());
}

// Steps back and forth with a grab between, and once more often than there are steps.
void walk(Played& played) {
    played.turn({}, 12);
    for (int i = 0; i < 3; ++i) played.tools.act(Action::stepBack);
    played.turn({}, 0);
    played.dragFrom({0, 0}, {0.2f, -0.3f}, 4);
    played.turn({.actions = {Action::stepBack}}, 2);
    for (int i = 0; i < 100; ++i) played.tools.act(Action::stepBack);
    played.turn({}, 0);
    played.turn({.actions = {Action::stepBack}}, 0);
    played.turn({}, 7);
}

TEST(StepBack, IsDoneAgainByAReplay) {
    expectTheSameBitsOf(walk);
}

} // namespace
} // namespace sinew::viewer
