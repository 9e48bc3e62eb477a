// Tests of input logs that start from a saved state: a replay from this state alone gives the same bits.
#include "played.hpp"

#include "app/guard.hpp"

namespace sinew::viewer {
namespace {

const std::string text = block;

std::filesystem::path temporary(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("sinew-from-" + std::to_string(::getpid()) + "-" + name);
}

struct ReplayOfState : testing::Test {
    void write(const std::string& scene_) { std::ofstream(scene) << scene_; }
    ~ReplayOfState() override {
        std::filesystem::remove(scene);
        std::filesystem::remove(state);
    }
    void save(Played& played) {
        app::SavedRun run = played.document.save(test::device(), test::queue());
        run.scene = scene.string();
        app::writeRun(state, run);
    }
    // The log as ScenePlayer::inputFile makes it, from the text that F8 writes.
    InputFile log(Played& played) {
        InputFile file = played.file();
        file.scene = scene.string();
        file.from = SavedOrigin{state.string(), played.opening.run->fileHash};
        file.room = played.document.contactRoom().room;
        file.surface = played.document.surfaceRoom().needed;
        return parseInput(toText(file), "test");
    }
    void expectTheSameBitsOf(Played& played) {
        const InputFile file = log(played);
        Scene again(state, file);
        again.document.widen(roomOf(file), test::queue());
        Replay replay(file);
        replayAll(again, replay);
        EXPECT_EQ(again.document.steps(), played.document.steps());
        EXPECT_EQ(again.hash(), *file.hash);
        hasTheSameLog = again.tools.log().events() == file.events;
    }

    bool hasTheSameLog = false; // whether the replayed log equals its source, and can be saved again
    std::filesystem::path scene = temporary("block.toml"), state = temporary("block.state");
};

// Before the state, the block is softened, released from its pins and cut; after it, cut again and thrown.
TEST_F(ReplayOfState, LeadsToTheSameBits) {
    write(text);
    Played played(scene);
    played.turn({}, 5);
    played.tools.turn(played.document, {.stiffness = 0.5f});
    played.tools.pull(played.document, 5);
    played.turn({.actions = {actionOf(tool::blade)}});
    played.dragFrom({0.1f, -0.45f}, {0.05f, 0.9f}, 5);
    played.pressAt({0.15f, 0.45f}, false);
    played.turn({}, 5);
    save(played);
    Played on(state);
    EXPECT_EQ(on.hash(), played.hash());
    EXPECT_EQ(on.document.material().stiffness, 0.5f);
    on.turn({}, 3);
    const std::uint64_t untouched = on.hash();
    on.turn({.actions = {actionOf(tool::blade)}});
    on.dragFrom({-0.45f, 0.05f}, {0.9f, 0}, 6);
    on.pressAt({0.45f, 0.05f}, false);
    on.turn({.actions = {actionOf(tool::blade)}}, 4);
    on.dragFrom({0, 0.1f}, {0.1f, -0.2f}, 4);
    on.tools.turn(on.document, {.stiffness = 2});
    on.turn({}, 5);
    on.turn({.actions = {Action::undo}}, 3);
    on.turn({.actions = {Action::redo}}, 3);
    EXPECT_NE(on.hash(), untouched);
    expectTheSameBitsOf(on);
    EXPECT_TRUE(hasTheSameLog);
}

// The replay has the pins of the reset before it, and all material changes since.
TEST_F(ReplayOfState, OfOneThatWasResetBeginsWithItsScene) {
    write(text);
    Played played(scene);
    played.tools.turn(played.document, {.stiffness = 0.5f});
    played.turn({}, 5);
    save(played);
    Played on(state);
    on.turn({}, 3);
    on.tools.reset();
    on.run([&](VkCommandBuffer commands) { on.document.recordReset(commands); });
    on.turn({}, 10);
    Scene again(scene);
    Replay replay(parseInput(toText(on.file()), "test"));
    replayAll(again, replay);
    EXPECT_EQ(again.hash(), on.hash());
    EXPECT_EQ(again.document.material().stiffness, 0.5f);
}

// Balls fall into a heap with capacity for one neighbour; steps that lack capacity are repeated with more.
TEST_F(ReplayOfState, HasTheRoomThatThereWasInTheEnd) {
    write("[solver]\nsubsteps = 8\n[[particles]]\nradius = 0.05\ncount = [4, 4, 4]\njitter = 0.005\n"
          "center = [0, 0.3, 0]\n[[plane]]\n[contacts]\nroom = 1\n");
    Played played(scene);
    const auto take = [](Played& on, int steps) {
        for (int i = 0; i < steps; ++i) {
            on.run([&](VkCommandBuffer commands) { on.step(commands); });
            const std::uint64_t step = on.document.steps();
            if (on.document.neededRoom(step) == 0) continue;
            ASSERT_TRUE(on.document.makeRoom(step, test::queue(), on.tools.bring()));
            on.tools.restart(on.document, {}, 1);
            --i;
        }
    };
    save(played);
    Played on(state);
    take(on, 40);
    EXPECT_GT(on.document.contactRoom().grown, 0u) << "nobody needed more room";
    expectTheSameBitsOf(on);
}

// The scene has no friction; the changed material has, which needs more passes.
TEST_F(ReplayOfState, OfAMaterialThatNeedsOtherPasses) {
    std::string jacobi = text;
    jacobi.replace(jacobi.find("substeps = 4"), 12, "name = \"jacobi\"\nsubsteps = 12");
    jacobi.replace(jacobi.find("cuttable = true\n"), 16, "");
    jacobi.replace(jacobi.find("[[plane]]\n"), 10, "");
    write(jacobi);
    Played played(openFile(scene), sim::Material{.damping = 1.5f});
    played.turn({}, 5);
    save(played);
    Played on(state);
    EXPECT_EQ(on.hash(), played.hash());
    on.dragFrom({0, 0}, {0.1f, -0.2f}, 4);
    expectTheSameBitsOf(on);
}

TEST_F(ReplayOfState, FromAnotherStateIsRefused) {
    write(text);
    Played played(scene);
    save(played);
    Played on(state);
    on.turn({}, 2);
    const InputFile file = log(on);
    const auto refusal = [&](const std::filesystem::path& opened) -> std::string {
        try {
            const Scene again(opened, file);
        } catch (const app::Failure& failure) {
            EXPECT_EQ(failure.code(), app::badInput);
            return failure.what();
        }
        return "accepted";
    };
    EXPECT_EQ(refusal(state), "accepted");
    EXPECT_NE(refusal(scene).find(state.string()), std::string::npos) << "the scene itself is no state";
    played.turn({}, 1);
    save(played);
    EXPECT_NE(refusal(state).find(state.string()), std::string::npos) << "it was written over";
}

TEST_F(ReplayOfState, OpensItWhereItIsOrBesideTheLog) {
    write(text);
    Played played(scene);
    save(played);
    InputFile file{.scene = scene.string(), .from = SavedOrigin{state.string(), 1}};
    EXPECT_EQ(withReplay({}, file).scene, state.string());
    file.from->file = "/no/such/folder/" + state.filename().string();
    EXPECT_EQ(withReplay({.replay = state.parent_path() / "a.input"}, file).scene, state.string());
    EXPECT_EQ(withReplay({.replay = "elsewhere/a.input"}, file).scene, file.from->file);
    EXPECT_EQ(withReplay({.scene = "mine.state"}, file).scene, "mine.state");
}

} // namespace
} // namespace sinew::viewer
