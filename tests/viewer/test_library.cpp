// Tests of opening scenes while the window continues: lists, dropped files, and files that are no scenes.
#include "viewer/library.hpp"

#include "mesh/import.hpp"
#include "viewer/pictures/recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <unistd.h>

namespace sinew::viewer {
namespace {

namespace fs = std::filesystem;

class LibraryTest : public testing::Test {
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
    static std::unique_ptr<Opening> await(Library& library) {
        while (library.isOpening()) {
            if (auto opened = library.take()) return opened;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return nullptr;
    }
    Library libraryOf(const std::string& scene) {
        return Library(Options{.scene = scene.empty() ? "" : (folder / scene).string()});
    }

    const fs::path folder = fs::temp_directory_path() / ("sinew-library-" + std::to_string(::getpid()));
};

TEST_F(LibraryTest, OffersTheSceneFilesBesideTheOneOpened) {
    const Library library = libraryOf("b.toml");
    EXPECT_EQ(library.names(), (std::vector<std::string>{"a", "b", "broken"}));
    EXPECT_EQ(library.current(), 1u);
}

TEST_F(LibraryTest, OffersTheBuiltInScenesWhereNoFileWasOpened) {
    const Library library = libraryOf("");
    ASSERT_LT(library.current(), library.names().size());
    EXPECT_EQ(library.names()[library.current()], "organ");
    EXPECT_EQ(std::ranges::count(library.names(), "drop_mesh"), 0);
    EXPECT_EQ(std::ranges::count(library.names(), "cloth"), 1);
}

TEST_F(LibraryTest, OpensTheNextRoundTheEnd) {
    Library library = libraryOf("b.toml");
    library.openNext(-1, 1.5f);
    const auto a = await(library);
    ASSERT_TRUE(a);
    EXPECT_EQ(a->loaded.scene.name, "a");
    EXPECT_EQ(library.current(), 0u);
    library.openNext(-1, 1.5f); // broken.toml
    EXPECT_THROW(await(library), mesh::ImportError);
    EXPECT_EQ(library.current(), 0u) << "what cannot be opened leaves the one on show";
    library.openNext(1, 1.5f);
    ASSERT_TRUE(await(library));
    EXPECT_EQ(library.current(), 1u);
}

TEST_F(LibraryTest, OpensWhatIsDroppedAndRefusesWhatIsNoMesh) {
    Library library = libraryOf("b.toml");
    for (const char* bad : {"noise.obj", "missing.stl", "broken.toml"}) {
        library.openFile((folder / bad).string(), 1.5f);
        EXPECT_THROW(await(library), mesh::ImportError) << bad;
        EXPECT_EQ(library.current(), 1u);
    }
    library.openFile(folder.string(), 1.5f);
    EXPECT_THROW(await(library), mesh::ImportError) << "a folder";
    library.openFile((folder / "a.toml").string(), 1.5f);
    ASSERT_TRUE(await(library));
    library.putBack();
    EXPECT_EQ(library.current(), 1u);
}

TEST_F(LibraryTest, OpensTheSameSceneAgainWithOtherSubsteps) {
    Library library = libraryOf("b.toml");
    Again again;
    again.material.stiffness = 7;
    library.reopen({.substeps = 9}, again, 1.5f);
    const auto opened = await(library);
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->loaded.settings.substeps, 9u);
    ASSERT_TRUE(opened->again);
    EXPECT_EQ(opened->again->material.stiffness, 7);
    EXPECT_EQ(library.current(), 1u);
}

// The shown scene has grown while its successor was opened, so the successor is opened again.
TEST_F(LibraryTest, OpensWhatIsToTakeOverOnceMore) {
    Library library = libraryOf("b.toml");
    library.reopen({.substeps = 9}, {}, 1.5f);
    ASSERT_TRUE(await(library));
    Again roomier;
    roomier.settings.contactRoom = 48;
    library.askAgain(roomier, 1.5f);
    EXPECT_FALSE(library.shown().overrides.substeps) << "the one on show is still there";
    const auto opened = await(library);
    ASSERT_TRUE(opened && opened->again);
    EXPECT_EQ(opened->again->settings.contactRoom, 48u);
    EXPECT_EQ(opened->loaded.settings.substeps, 9u) << "what was asked for stays";
    EXPECT_EQ(library.shown().overrides.substeps, 9u);
}

TEST_F(LibraryTest, OpensOneAtATime) {
    Library library = libraryOf("b.toml");
    library.open(0, 1.5f);
    library.open(2, 1.5f); // a broken file, which is no longer wanted
    const auto opened = await(library);
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->loaded.scene.name, "a");
    EXPECT_FALSE(library.isOpening());
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

TEST_F(LibraryTest, StaysOnTheDeviceThatWasChosen) {
    std::vector<std::string> devices; // devices on which scenes were prepared
    Library library(Options{.scene = (folder / "b.toml").string()},
                    [&](Opening&, const Options& options) { devices.push_back(options.device); });
    library.openNext(-1, 1.5f);
    ASSERT_TRUE(await(library));
    library.reopenOn("other", {}, 1.5f);
    const auto again = await(library);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->loaded.scene.name, "a");
    EXPECT_TRUE(again->again);
    library.openNext(1, 1.5f);
    ASSERT_TRUE(await(library));
    EXPECT_EQ(devices, (std::vector<std::string>{"", "other", "other"}));
    library.reopenOn("third", {}, 1.5f);
    ASSERT_TRUE(await(library));
    library.putBack(); // the scene could not be shown
    EXPECT_EQ(library.shown().device, "other");
    library.openNext(-1, 1.5f);
    ASSERT_TRUE(await(library));
    EXPECT_EQ(devices.back(), "other");
}

TEST_F(LibraryTest, KeepsTheSceneOnShowWhereTheNextCannotBePrepared) {
    Library library(Options{.scene = (folder / "b.toml").string()}, [](Opening&, const Options& options) {
        if (options.device == "bad") throw std::runtime_error("no such device");
    });
    library.reopenOn("bad", {}, 1.5f);
    EXPECT_THROW(await(library), std::runtime_error);
    EXPECT_EQ(library.current(), 1u);
    EXPECT_EQ(library.shown().device, "");
    library.openNext(-1, 1.5f);
    EXPECT_TRUE(await(library)) << "on the device as before";
}

} // namespace
} // namespace sinew::viewer
