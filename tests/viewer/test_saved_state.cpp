// Tests of states as files: a run continued from a file has the same bits as one without it, and invalid
// files are refused.
#include "app/guard.hpp"
#include "app/state_file.hpp"
#include "sim/core/hash.hpp"
#include "sim/device/gpu_compile.hpp"
#include "support/device.hpp"
#include "viewer/document/document.hpp"
#include "viewer/jobs/gauges.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/jobs/replay.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <unistd.h>

namespace sinew::viewer {
namespace {

// Bodies that fall onto each other while a blade cuts one.
constexpr const char* heap = R"([solver]
substeps = 12
[[box]]
name = "cut"
particles = [5, 5, 5]
center = [0, 0.3, 0]
spacing = 0.1
young_modulus = 1e5
cuttable = true
collides = true
[[box]]
name = "above"
particles = [3, 3, 3]
center = [0.1, 0.85, 0.05]
spacing = 0.1
young_modulus = 1e5
collides = true
[[plane]]
[[blade]]
times = [0.05, 0.45]
edges = [[[-0.5, 0.23, -0.5], [-0.5, 0.23, 0.5]], [[0.5, 0.23, -0.5], [0.5, 0.23, 0.5]]]
)";

std::filesystem::path temporary(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("sinew-" + std::to_string(::getpid()) + "-" + name);
}

// Adds grabs and pokes to the settings, as in the window.
OpenedScene withHands(OpenedScene opening) {
    app::addRoomForUser(opening.loaded.settings);
    return opening;
}

struct Played {
    explicit Played(const std::filesystem::path& file)
        : opening(withHands(open({.scene = file.string()}, 1.6f))),
          document(test::device(), opening.loaded.scene, opening.loaded.settings) {
        document.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
        if (opening.run)
            document.load(test::device(), *opening.run, test::queue());
        else
            run([&](VkCommandBuffer commands) { document.recordReset(commands); });
    }
    template <typename Record> void run(const Record& record) {
        VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    void take(int steps) {
        for (int i = 0; i < steps; ++i) run([&](VkCommandBuffer commands) { document.recordStep(commands); });
    }
    std::uint64_t hash() { return stateHash(test::device(), document, test::queue()); }
    sim::Status status() { return document.simulation().status(document.steps()); }

    OpenedScene opening;
    Document document;
};

struct SavedState : testing::Test {
    SavedState() { std::ofstream(scene) << heap; }
    ~SavedState() override {
        std::filesystem::remove(scene);
        std::filesystem::remove(file);
    }
    void save(const Played& played) {
        app::SavedRun run = played.document.save(test::device(), test::queue());
        run.scene = scene.string();
        app::writeRun(file, run);
    }
    std::string refusal() {
        try {
            const Played again{file};
        } catch (const app::Failure& failure) {
            EXPECT_EQ(failure.code(), app::badInput);
            return failure.what();
        }
        return "none";
    }

    std::filesystem::path scene = temporary("heap.toml"), file = temporary("heap.state");
};

TEST_F(SavedState, GoesOnWithTheSameBits) {
    Played played(scene);
    for (const int steps : {3, 9, 12, 20}) { // before the blade, during its motion, after it
        played.take(steps);
        save(played);
        Played again(file);
        EXPECT_EQ(again.hash(), played.hash());
        EXPECT_EQ(again.document.played(), played.document.played());
        const double dt = double{again.opening.loaded.scene.dt};
        const Facts facts = Gauges(again.document, dt).facts(again.document);
        EXPECT_NEAR(facts.time, static_cast<double>(facts.steps) * dt, 1e-9) << "they are shown in one line";
        const std::uint64_t before = played.hash();
        played.take(15);
        again.take(15);
        EXPECT_NE(played.hash(), before);
        EXPECT_EQ(again.hash(), played.hash()) << "after " << steps << " more steps";
        EXPECT_EQ(again.status().linksCutInAll, played.status().linksCutInAll);
        EXPECT_EQ(again.status().pieces, played.status().pieces);
    }
    EXPECT_GT(played.status().linksCutInAll, 0u) << "the blade met nothing";
}

// A device of another kind would complete open forms differently, and its simulation would not fit the state.
TEST_F(SavedState, SaysTheFormsThatTheDeviceHasChosen) {
    Played played(scene);
    ASSERT_EQ(played.document.settings().forms.columns, 0u) << "left open";
    save(played);
    const sim::Forms forms = app::readRun(file).settings.forms;
    const sim::Forms chosen = sim::completed(played.document.settings().forms, sim::kindOf(test::device()));
    EXPECT_EQ(forms, chosen);
    EXPECT_GT(forms.columns, 0u);
    EXPECT_GT(forms.chunk, 0u);
}

TEST_F(SavedState, KeepsWhatTheSceneWasTurnedTo) {
    Played played(scene);
    played.take(5);
    played.document.turnNow({.stiffness = 0.4f, .friction = 0.9f});
    played.document.setGravity(3.7f);
    played.take(20);
    save(played);
    Played again(file);
    EXPECT_EQ(again.document.material(), played.document.material());
    EXPECT_EQ(again.hash(), played.hash());
    played.take(25);
    again.take(25);
    EXPECT_EQ(again.hash(), played.hash());
}

TEST_F(SavedState, KeepsWhereItWasSeenFrom) {
    const Played played(scene);
    app::SavedRun run = played.document.save(test::device(), test::queue());
    run.scene = scene.string();
    run.view = {.target = {0.1f, -0.2f, 0.3f},
                .distance = 0.7f,
                .azimuth = -2,
                .elevation = 0.5f,
                .fieldOfView = 0.9f};
    app::writeRun(file, run);
    const Camera first = played.opening.camera;
    const OpenedScene opening = open({.scene = file.string()}, 1.6f);
    EXPECT_EQ(opening.camera, (Camera{.target = {0.1f, -0.2f, 0.3f},
                                      .distance = 0.7f,
                                      .azimuth = -2,
                                      .elevation = 0.5f,
                                      .fieldOfView = 0.9f,
                                      .lowestEye = first.lowestEye}));
    EXPECT_EQ(opening.light.toLight, played.opening.light.toLight) << "which follows from the first view";
    run.view->distance = std::numeric_limits<float>::quiet_NaN();
    app::writeRun(file, run);
    EXPECT_NE(refusal().find("its contents do not match its version"), std::string::npos) << refusal();
}

// Version 5 ended with the substep of clamps, version 4 with the levels, version 3 with the view, version 2
// before it.
TEST_F(SavedState, OfTheVersionsBeforeIsSeenAsItsScene) {
    Played played(scene);
    played.take(3);
    save(played);
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string title = "sinew state 6\n";
    ASSERT_TRUE(text.starts_with(title));
    text = text.substr(title.size(), text.size() - title.size() - sizeof(std::uint64_t));
    for (const char* before : {"sinew state 5\n", "sinew state 4\n", "sinew state 3\n", "sinew state 2\n"}) {
        text.resize(text.size() - sizeof(std::uint32_t));
        const std::uint64_t hash = sim::fnv1a(std::as_bytes(std::span(text)));
        std::string whole = before + text;
        whole.append(reinterpret_cast<const char*>(&hash), sizeof(hash));
        std::ofstream(file, std::ios::binary) << whole;
        Played again(file);
        EXPECT_EQ(again.hash(), played.hash());
        EXPECT_EQ(again.opening.camera, played.opening.camera);
    }
}

TEST_F(SavedState, IsRefusedWhereItIsOfAnotherSimulation) {
    save(Played(scene));
    std::string other = heap;
    other.replace(other.find("0.85"), 4, "0.86");
    std::ofstream(scene) << other;
    EXPECT_NE(refusal().find("it is of another simulation"), std::string::npos) << refusal();
    std::filesystem::remove(scene);
    EXPECT_ANY_THROW(Played{file});
}

// A file larger than any memory, if the file system supports sparse files.
TEST_F(SavedState, IsNotReadWhereItIsNone) {
    std::ofstream(file) << "something else";
    std::error_code error;
    std::filesystem::resize_file(file, std::uintmax_t{1} << 42, error);
    if (error) GTEST_SKIP() << error.message();
    EXPECT_NE(refusal().find("it does not begin like a state"), std::string::npos) << refusal();
    try {
        loadInput(file);
        FAIL() << "accepted";
    } catch (const app::Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("it does not begin with"), std::string::npos);
    }
}

TEST_F(SavedState, IsRefusedWhereItIsDamaged) {
    save(Played(scene));
    std::ifstream stream(file, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    const auto write = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{14}, std::size_t{30},
                                   whole.size() / 2, whole.size() - 1}) {
        write(whole.substr(0, size));
        EXPECT_NE(refusal().find("cannot read a state"), std::string::npos)
            << size << " bytes: " << refusal();
    }
    for (const std::size_t at : {std::size_t{20}, whole.size() / 3, whole.size() - 3}) {
        std::string changed = whole;
        changed[at] ^= 4;
        write(changed);
        EXPECT_NE(refusal().find("was changed"), std::string::npos) << refusal();
    }
    write(whole + "x");
    EXPECT_NE(refusal().find("was changed"), std::string::npos);
    std::filesystem::remove(file);
    EXPECT_NE(refusal().find("there is no such file"), std::string::npos);
}

} // namespace
} // namespace sinew::viewer
