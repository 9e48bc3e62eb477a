// Tests of opening scenes while the window continues: lists, dropped files, and files that are no scenes.
#include "viewer/jobs/scene_loader.hpp"

#include "mesh/import.hpp"
#include "viewer/capture/recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace sinew::viewer {
namespace {

namespace fs = std::filesystem;

class SceneLoaderTest : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder);
        write("b.toml",
              "[[box]]\nparticles = [3, 3, 3]\ncenter = [0, 1, 0]\nspacing = 0.1\nyoung_modulus = 1e4\n");
        write("a.toml", "[[chain]]\nparticles = 3\nlength = 0.1\nmass = 0.1\n");
        write("broken.toml", "[[box]]\nparticles = \n");
        write("drop_mesh.toml", "");
        write("noise.obj", "this is no mesh\n");
    }
    void TearDown() override { fs::remove_all(folder); }
    std::string write(const std::string& name, const std::string& text) {
        std::ofstream(folder / name) << text;
        return (folder / name).string();
    }
    static std::unique_ptr<OpenedScene> await(SceneLoader& sceneLoader) {
        while (sceneLoader.isOpening()) {
            if (auto opened = sceneLoader.take()) return opened;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return nullptr;
    }
    SceneLoader libraryOf(const std::string& scene) {
        return SceneLoader(Options{.scene = scene.empty() ? "" : (folder / scene).string()});
    }

    const fs::path folder = fs::temp_directory_path() / ("sinew-library-" + std::to_string(::getpid()));
};

TEST_F(SceneLoaderTest, OffersTheSceneFilesBesideTheOneOpened) {
    const SceneLoader sceneLoader = libraryOf("b.toml");
    EXPECT_EQ(sceneLoader.names(), (std::vector<std::string>{"a", "b", "broken"}));
    EXPECT_EQ(sceneLoader.current(), 1u);
}

TEST_F(SceneLoaderTest, ListsScenesForStudiesLast) {
    const std::string chain = "[[chain]]\nparticles = 3\nlength = 0.1\nmass = 0.1\n[gallery]\n";
    write("a.toml", chain + "study = true\n");
    write("c.toml", chain + "time = 2\nheavy = true\n");
    const SceneLoader sceneLoader = libraryOf("a.toml");
    EXPECT_EQ(sceneLoader.names(), (std::vector<std::string>{"b", "broken", "c", "a"}));
    EXPECT_EQ(sceneLoader.current(), 3u);
    EXPECT_EQ(sceneLoader.marks(),
              (std::vector<scenes::Gallery>{{}, {}, {2, false, true}, {0, true, false}}));
    const SceneLoader builtIn = libraryOf("");
    EXPECT_TRUE(std::ranges::is_sorted(builtIn.marks(), {}, &scenes::Gallery::isStudy));
    EXPECT_TRUE(builtIn.marks().back().isStudy);
}

TEST_F(SceneLoaderTest, ListsEightShippedScenesFirst) {
    const std::string chain = "[[chain]]\nparticles = 3\nlength = 0.1\nmass = 0.1\n[gallery]\n";
    write("a.toml", chain + "order = 2\n");
    write("c.toml", chain + "order = 1\n");
    EXPECT_EQ(libraryOf("a.toml").names(), (std::vector<std::string>{"c", "a", "b", "broken"}));
    const SceneLoader builtIn = libraryOf("");
    EXPECT_EQ(builtIn.names().front(), Options{}.builtIn) << "the scene that the viewer starts with";
    EXPECT_EQ(std::ranges::count_if(builtIn.marks(), &scenes::Gallery::isFirst), 8);
    EXPECT_TRUE(std::ranges::is_partitioned(builtIn.marks(), &scenes::Gallery::isFirst));
}

TEST_F(SceneLoaderTest, RemembersFilesThatTheListHasNot) {
    SceneLoader sceneLoader = libraryOf("b.toml");
    EXPECT_TRUE(sceneLoader.recent().empty()) << "the list has it";
    sceneLoader.addRecent({"/elsewhere/old.ply"});
    fs::create_directories(folder / "other");
    const std::string other = write("other/d.toml", "[[chain]]\nparticles = 3\nlength = 0.1\nmass = 0.1\n");
    sceneLoader.openFile(other, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    EXPECT_EQ(sceneLoader.recent(), (std::vector<std::string>{other, "/elsewhere/old.ply"}));
    sceneLoader.openFile((folder / "missing.stl").string(), 1.5f);
    EXPECT_THROW(await(sceneLoader), mesh::ImportError);
    EXPECT_EQ(sceneLoader.recent().size(), 2u) << "it was not opened";
}

TEST_F(SceneLoaderTest, SaysWhatHappensInAScene) {
    write("a.toml", "# A chain falls\r\n# and swings. It is short.\n# More.\n[[chain]]\nparticles = 3\n");
    const SceneLoader sceneLoader = libraryOf("b.toml");
    EXPECT_EQ(sceneLoader.sentences(), (std::vector<std::string>{"A chain falls and swings.", "", ""}));
    const SceneLoader builtIn = libraryOf("");
    ASSERT_EQ(builtIn.sentences().size(), builtIn.names().size());
    for (std::size_t i = 0; i < builtIn.names().size(); ++i)
        EXPECT_TRUE(builtIn.sentences()[i].ends_with(".")) << builtIn.names()[i];
    EXPECT_EQ(firstSentence("# Balls of 0.5 m fall"), "Balls of 0.5 m fall");
    EXPECT_EQ(firstSentence("name = 1 # A comment."), "");
    EXPECT_EQ(firstSentence("#"), "");
}

TEST_F(SceneLoaderTest, OffersTheBuiltInScenesWhereNoFileWasOpened) {
    const SceneLoader sceneLoader = libraryOf("");
    ASSERT_LT(sceneLoader.current(), sceneLoader.names().size());
    EXPECT_EQ(sceneLoader.names()[sceneLoader.current()], "organ_draped");
    EXPECT_EQ(std::ranges::count(sceneLoader.names(), "drop_mesh"), 0);
    EXPECT_EQ(std::ranges::count(sceneLoader.names(), "cloth"), 1);
}

TEST_F(SceneLoaderTest, FirstSceneCanBeCutAndItsPiecesTouch) {
    const scenes::LoadedScene first = scenes::loadBuiltIn(Options{}.builtIn);
    ASSERT_EQ(first.scene.grids.size(), 1u);
    EXPECT_TRUE(first.scene.grids[0].isCuttable);
    for (const sim::Particle& particle : first.scene.particles) EXPECT_GT(particle.radius, 0);
    EXPECT_EQ(first.scene.colliders.size(), 1u) << "the roll";
    EXPECT_EQ(first.bladeDepth, 0.05f) << "an incision that gapes, not a cut that severs";
    EXPECT_LE(first.settings.substeps, 24u) << "a software device plays it in the window";
    EXPECT_LE(first.scene.particles.size(), 2'500u);
}

TEST_F(SceneLoaderTest, OpensTheNextRoundTheEnd) {
    SceneLoader sceneLoader = libraryOf("b.toml");
    sceneLoader.openNext(-1, 1.5f);
    const auto a = await(sceneLoader);
    ASSERT_TRUE(a);
    EXPECT_EQ(a->loaded.scene.name, "a");
    EXPECT_EQ(sceneLoader.current(), 0u);
    sceneLoader.openNext(-1, 1.5f); // broken.toml
    EXPECT_THROW(await(sceneLoader), mesh::ImportError);
    EXPECT_EQ(sceneLoader.current(), 0u) << "what cannot be opened leaves the one on show";
    sceneLoader.openNext(1, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    EXPECT_EQ(sceneLoader.current(), 1u);
}

TEST_F(SceneLoaderTest, OpensWhatIsDroppedAndRefusesWhatIsNoMesh) {
    SceneLoader sceneLoader = libraryOf("b.toml");
    for (const char* bad : {"noise.obj", "missing.stl", "broken.toml"}) {
        sceneLoader.openFile((folder / bad).string(), 1.5f);
        EXPECT_THROW(await(sceneLoader), mesh::ImportError) << bad;
        EXPECT_EQ(sceneLoader.current(), 1u);
    }
    sceneLoader.openFile(folder.string(), 1.5f);
    EXPECT_THROW(await(sceneLoader), mesh::ImportError) << "a folder";
    sceneLoader.openFile((folder / "a.toml").string(), 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    sceneLoader.putBack();
    EXPECT_EQ(sceneLoader.current(), 1u);
}

TEST_F(SceneLoaderTest, OpensTheSameSceneAgainWithOtherSubsteps) {
    SceneLoader sceneLoader = libraryOf("b.toml");
    ReloadRequest reload;
    reload.material.stiffness = 7;
    sceneLoader.reopen({.substeps = 9}, reload, 1.5f);
    const auto opened = await(sceneLoader);
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->loaded.settings.substeps, 9u);
    ASSERT_TRUE(opened->reload);
    EXPECT_EQ(opened->reload->material.stiffness, 7);
    EXPECT_EQ(sceneLoader.current(), 1u);
}

// The shown scene has grown while its successor was opened, so the successor is opened again.
TEST_F(SceneLoaderTest, OpensWhatIsToTakeOverOnceMore) {
    SceneLoader sceneLoader = libraryOf("b.toml");
    sceneLoader.reopen({.substeps = 9}, {}, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    ReloadRequest roomier;
    roomier.settings.contactRoom = 48;
    sceneLoader.askAgain(roomier, 1.5f);
    EXPECT_FALSE(sceneLoader.shown().overrides.substeps) << "the one on show is still there";
    const auto opened = await(sceneLoader);
    ASSERT_TRUE(opened && opened->reload);
    EXPECT_EQ(opened->reload->settings.contactRoom, 48u);
    EXPECT_EQ(opened->loaded.settings.substeps, 9u) << "what was asked for stays";
    EXPECT_EQ(sceneLoader.shown().overrides.substeps, 9u);
}

TEST_F(SceneLoaderTest, OpensOneAtATime) {
    SceneLoader sceneLoader = libraryOf("b.toml");
    sceneLoader.open(0, 1.5f);
    sceneLoader.open(2, 1.5f); // a broken file, which is no longer wanted
    const auto opened = await(sceneLoader);
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->loaded.scene.name, "a");
    EXPECT_FALSE(sceneLoader.isOpening());
}

TEST(Recording, NeverWritesOverWhatIsThereAndLeavesNothingEmpty) {
    const fs::path was = fs::current_path();
    const fs::path folder = fs::temp_directory_path() / ("sinew-recording-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    fs::current_path(folder);
    EXPECT_EQ(freeName("a/b", ".png"), "a_b.png");
    std::ofstream("a_b.png") << "x";
    EXPECT_EQ(freeName("a/b", ".png"), "a_b-2.png");
    Recording("empty", 64, 64, 60).finish();
    EXPECT_FALSE(fs::exists("empty.mp4") || fs::exists("empty")) << "without a picture nothing is kept";
    fs::current_path(was);
    fs::remove_all(folder);
}

TEST_F(SceneLoaderTest, StaysOnTheDeviceThatWasChosen) {
    std::vector<std::string> devices; // devices on which scenes were prepared
    SceneLoader sceneLoader(Options{.scene = (folder / "b.toml").string()},
                            [&](OpenedScene&, const Options& options) { devices.push_back(options.device); });
    sceneLoader.openNext(-1, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    sceneLoader.reopenOn("other", {}, 1.5f);
    const auto reload = await(sceneLoader);
    ASSERT_TRUE(reload);
    EXPECT_EQ(reload->loaded.scene.name, "a");
    EXPECT_TRUE(reload->reload);
    sceneLoader.openNext(1, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    EXPECT_EQ(devices, (std::vector<std::string>{"", "other", "other"}));
    sceneLoader.reopenOn("third", {}, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    sceneLoader.putBack(); // the scene could not be shown
    EXPECT_EQ(sceneLoader.shown().device, "other");
    sceneLoader.openNext(-1, 1.5f);
    ASSERT_TRUE(await(sceneLoader));
    EXPECT_EQ(devices.back(), "other");
}

TEST_F(SceneLoaderTest, KeepsTheSceneOnShowWhereTheNextCannotBePrepared) {
    SceneLoader sceneLoader(Options{.scene = (folder / "b.toml").string()},
                            [](OpenedScene&, const Options& options) {
                                if (options.device == "bad") throw std::runtime_error("no such device");
                            });
    sceneLoader.reopenOn("bad", {}, 1.5f);
    EXPECT_THROW(await(sceneLoader), std::runtime_error);
    EXPECT_EQ(sceneLoader.current(), 1u);
    EXPECT_EQ(sceneLoader.shown().device, "");
    sceneLoader.openNext(-1, 1.5f);
    EXPECT_TRUE(await(sceneLoader)) << "on the device as before";
}

} // namespace
} // namespace sinew::viewer
