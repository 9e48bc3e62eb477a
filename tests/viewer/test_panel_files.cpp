// Tests of the list of files to open: what it holds, the choice by text and keys, and how it closes.
#include "panels_test.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace sinew::viewer {
namespace {

namespace fs = std::filesystem;

/// A folder with files of all kinds, removed at the end.
class FileBrowserTest : public testing::Test {
protected:
    FileBrowserTest() {
        fs::remove_all(folder);
        fs::create_directories(folder / "meshes" / "deep");
        for (const char* name : {"Zebra.toml", "apple.PLY", "later.state", "notes.txt", ".hidden.toml"})
            std::ofstream(folder / name) << "-";
        std::ofstream(folder / "meshes" / "bunny.obj") << "-";
    }
    ~FileBrowserTest() override { fs::remove_all(folder); }

    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const FileEntry& entry : browser.shown()) all.push_back(entry.name);
        return all;
    }
    using Names = std::vector<std::string>;

    const fs::path folder =
        fs::canonical(fs::temp_directory_path()) / ("sinew-file-browser-" + std::to_string(::getpid()));
    FileBrowser browser;
};

TEST_F(FileBrowserTest, ListsRecentFilesThenFoldersThenFilesThatOpen) {
    browser.open(folder, {"/elsewhere/ring.stl"});
    EXPECT_EQ(names(), (Names{"ring.stl", "../", "meshes/", "apple.PLY", "later.state", "Zebra.toml"}));
    EXPECT_TRUE(browser.shown()[0].isRecent);
    using Kind = FileEntry::Kind;
    const std::array kinds{Kind::mesh, Kind::folder, Kind::folder, Kind::mesh, Kind::state, Kind::scene};
    for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(browser.shown()[i].kind, kinds[i]) << i;
    EXPECT_FALSE(browser.chosen());
    EXPECT_FALSE(browser.takeTyped()) << "Enter without a choice";
}

TEST_F(FileBrowserTest, ChoosesByTextAndByArrows) {
    browser.open(folder, {});
    browser.filter("E");
    EXPECT_EQ(names(), (Names{"meshes/", "apple.PLY", "later.state", "Zebra.toml"}));
    EXPECT_EQ(browser.chosen(), 0u);
    browser.move(-1);
    EXPECT_EQ(browser.takeTyped(), (folder / "Zebra.toml").string());
    browser.move(1);
    EXPECT_FALSE(browser.takeTyped()) << "a folder";
    EXPECT_EQ(browser.folder(), folder / "meshes");
    EXPECT_EQ(names(), (Names{"../", "deep/", "bunny.obj"}));
    EXPECT_EQ(browser.take(2), (folder / "meshes" / "bunny.obj").string());
    EXPECT_FALSE(browser.take(0));
    EXPECT_EQ(browser.folder(), folder);
}

TEST_F(FileBrowserTest, FollowsAPathThatIsTyped) {
    browser.open(folder, {"/elsewhere/ring.stl"});
    browser.filter("meshes/bun");
    EXPECT_EQ(names(), (Names{"bunny.obj"}));
    EXPECT_EQ(browser.takeTyped(), (folder / "meshes/bunny.obj").string()) << "the only one with that part";
    browser.filter("meshes/cow");
    EXPECT_FALSE(browser.chosen());
    EXPECT_EQ(browser.takeTyped(), (folder / "meshes/cow").string()) << "as typed: the error names it";
    browser.filter((folder / "meshes").string());
    EXPECT_FALSE(browser.takeTyped());
    EXPECT_EQ(browser.folder(), folder / "meshes");
    browser.filter((folder / "none/").string());
    EXPECT_FALSE(browser.complaint().empty());
    browser.filter("");
    EXPECT_TRUE(browser.complaint().empty());
    EXPECT_EQ(names(), (Names{"ring.stl", "../", "deep/", "bunny.obj"}));
}

// A name that is complete is meant, though it is a part of others; so is a file that the list leaves out.
TEST_F(FileBrowserTest, TakesAWholeNameBeforeOthersThatContainIt) {
    for (const char* name : {"a_bunny.obj", "other.obj"}) std::ofstream(folder / "meshes" / name) << "-";
    browser.open(folder / "meshes", {});
    browser.filter("bunny");
    EXPECT_EQ(browser.takeTyped(), (folder / "meshes/a_bunny.obj").string()) << "a part: the first";
    for (const std::string& text : {std::string("bunny.obj"), (folder / "meshes/bunny.obj").string()}) {
        browser.filter(text);
        EXPECT_EQ(browser.takeTyped(), (folder / "meshes/bunny.obj").string()) << text;
    }
    browser.move(-1);
    EXPECT_EQ(browser.takeTyped(), (folder / "meshes/a_bunny.obj").string()) << "an arrow chooses another";
    browser.filter((folder / "notes.txt").string());
    EXPECT_EQ(browser.takeTyped(), (folder / "notes.txt").string());
}

TEST_F(PanelsTest, OpenAFileThatIsClickedInTheList) {
    facts.recent = {"/elsewhere/bunny.ply"};
    settle();
    panels.toggleFiles();
    settle();
    settle();
    const ImGuiWindow* files = shownWindow("files");
    const ImGuiWindow* side = shownWindow("side");
    ASSERT_TRUE(files != nullptr && side != nullptr);
    EXPECT_LE(files->Pos.x + files->Size.x, side->Pos.x);
    EXPECT_TRUE(panels.covers({files->Pos.x + 30, files->Pos.y + 100}));
    std::optional<std::string> opened;
    for (float y = files->Pos.y + 40; y < files->Pos.y + 120 && !opened; y += 8) {
        PanelInput press{.pointer = {files->Pos.x + 40, y}};
        picture(press);
        press.isDown[0] = true;
        press.presses[0] = 1;
        picture(press);
        opened = picture({.pointer = press.pointer}).file;
    }
    EXPECT_EQ(opened, "/elsewhere/bunny.ply");
    settle();
    EXPECT_FALSE(panels.takesKeys());
    EXPECT_EQ(shownWindow("files"), nullptr);
}

TEST_F(PanelsTest, OpenWhatArrowsChooseInTheList) {
    facts.recent = {"/elsewhere/bunny.ply", "/elsewhere/ring.ply"};
    settle();
    panels.toggleFiles();
    settle();
    settle();
    for (const int key : {GLFW_KEY_DOWN, GLFW_KEY_DOWN}) {
        picture({.keys = {{key, true}}});
        picture({.keys = {{key, false}}});
    }
    EXPECT_EQ(picture({.keys = {{GLFW_KEY_ENTER, true}}}).file, "/elsewhere/ring.ply");
}

TEST_F(PanelsTest, CloseWhatIsOpenAtAPressBeside) {
    facts.scenes = {"cloth", "cube"};
    settle();
    panels.toggleGallery();
    settle();
    EXPECT_TRUE(panels.isGalleryShown());
    panels.closeAll();
    settle();
    EXPECT_FALSE(panels.isGalleryShown());
    panels.toggleFiles();
    settle();
    settle();
    EXPECT_TRUE(panels.takesKeys());
    panels.closeAll();
    settle();
    EXPECT_FALSE(panels.takesKeys());
    panels.toggleHelp();
    settle();
    panels.closeAll();
    EXPECT_FALSE(panels.isHelpShown());
}

} // namespace
} // namespace sinew::viewer
