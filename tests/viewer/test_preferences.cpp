// Tests of settings kept between runs: they are read back as written, and unknown lines are harmless.
#include "viewer/ui/preferences.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <unistd.h>

namespace sinew::viewer {
namespace {

namespace fs = std::filesystem;

Preferences parse(const std::string& text) {
    std::vector<std::string> complaints;
    const Preferences preferences = parsePreferences(text, complaints);
    EXPECT_TRUE(complaints.empty()) << complaints.front();
    return preferences;
}

std::string complaintAbout(const std::string& text) {
    std::vector<std::string> complaints;
    EXPECT_EQ(parsePreferences(text, complaints), Preferences{}) << text;
    return complaints.size() == 1 ? complaints.front() : "accepted";
}

class PreferencesTest : public testing::Test {
protected:
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }
    void put(const std::string& text) const {
        fs::create_directories(file.parent_path());
        std::ofstream(file) << text;
    }
    const fs::path folder = fs::temp_directory_path() / ("sinew-settings-" + std::to_string(::getpid()));
    const fs::path file = folder / "sinew" / "viewer.conf";
};

const Preferences chosen{.width = 1600,
                         .height = 900,
                         .arePanelsShown = false,
                         .folded = Folds().set(indexOf(Fold::view)).set(indexOf(Fold::record)),
                         .scale = 1.265625f,
                         .isVsync = false,
                         .scene = "/home/some body/a = b # c.toml",
                         .recent = {"/home/a = b.ply", "/home/c.state"}};

TEST(Preferences, AreReadAsTheyWereWritten) {
    EXPECT_EQ(parse(toText(chosen)), chosen);
    EXPECT_EQ(parse(toText(Preferences{})), Preferences{});
    EXPECT_EQ(parse(""), Preferences{});
}

TEST(Preferences, KeepSixRecentFiles) {
    Preferences many;
    for (char name = 'a'; name < 'k'; ++name) many.recent.push_back(std::string("/") + name);
    EXPECT_EQ(parse(toText(many)).recent, (std::vector<std::string>{"/a", "/b", "/c", "/d", "/e", "/f"}));
}

TEST(Preferences, KeepThatNoSectionIsFolded) {
    EXPECT_EQ(parse("").folded, foldedAtFirst);
    EXPECT_EQ(parse(toText(Preferences{.folded = {}})).folded, Folds());
    EXPECT_EQ(parse("folded = none").folded, Folds());
}

TEST(Preferences, TakeCommentsAndBlanks) {
    const Preferences read = parse("# by hand\n\n  scale=2   \r\n\tpanels = true\n");
    EXPECT_EQ(read.scale, 2);
    EXPECT_EQ(read.arePanelsShown, true);
    EXPECT_EQ(read.width, 0u);
}

TEST(Preferences, IgnoreLinesThatMakeNoSenseAndSayWhich) {
    EXPECT_NE(complaintAbout("\nheight = -3\n").find("line 2: -3"), std::string::npos);
    EXPECT_NE(complaintAbout("width = 1e9").find("line 1"), std::string::npos);
    EXPECT_NE(complaintAbout("width = 99999999999999999999").find("not a number"), std::string::npos);
    EXPECT_NE(complaintAbout("scale = nan").find("nan"), std::string::npos);
    EXPECT_NE(complaintAbout("scale = 0").find("0.5"), std::string::npos);
    EXPECT_NE(complaintAbout("panels = maybe").find("maybe"), std::string::npos);
    EXPECT_NE(complaintAbout("folded = view attic").find("attic"), std::string::npos);
    EXPECT_NE(complaintAbout("colour = red").find("no setting"), std::string::npos);
    EXPECT_NE(complaintAbout("[window]").find("key = value"), std::string::npos);
    std::vector<std::string> complaints;
    EXPECT_EQ(parsePreferences("vsync = 0\nscale = 2\n", complaints).scale, 2) << "the others count";
}

TEST(Preferences, LieWhereTheEnvironmentSays) {
    EXPECT_EQ(preferencesFile("/configs", "/home/somebody"), "/configs/sinew/viewer.conf");
    EXPECT_EQ(preferencesFile(nullptr, "/home/somebody"), "/home/somebody/.config/sinew/viewer.conf");
    EXPECT_EQ(preferencesFile("", "/home/somebody"), "/home/somebody/.config/sinew/viewer.conf");
    EXPECT_EQ(preferencesFile("relative", "/home/somebody"), "/home/somebody/.config/sinew/viewer.conf");
    EXPECT_EQ(preferencesFile(nullptr, nullptr), "");
}

TEST(Preferences, NameScenesFromWhereverTheProgramIsStarted) {
    EXPECT_EQ(rememberedScene("", "organ"), "organ");
    EXPECT_EQ(rememberedScene("a/../b.toml", "organ"), (fs::current_path() / "b.toml").string());
    EXPECT_EQ(rememberedScene("/a\nscale = 4", "organ"), "");
}

TEST_F(PreferencesTest, AreKeptInAFileThatNeedNotBeThere) {
    EXPECT_EQ(loadPreferences(file), Preferences{});
    savePreferences(file, chosen);
    EXPECT_EQ(loadPreferences(file), chosen);
    EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator()), 1)
        << "nothing is left beside it";
    savePreferences("", chosen);
    EXPECT_EQ(loadPreferences(""), Preferences{});
}

TEST_F(PreferencesTest, ThatAreDamagedCostALineAndNothingElse) {
    for (const std::string& text : {std::string("scale = large\nscale\n"), std::string(100'000, 'x'),
                                    std::string(3, '\0'), std::string("\033[2J = 1")}) {
        put(text);
        testing::internal::CaptureStderr();
        EXPECT_EQ(loadPreferences(file), Preferences{});
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
        EXPECT_EQ(std::ranges::count(said, '\033'), 0) << said;
        EXPECT_NE(said.find("viewer.conf"), std::string::npos);
    }
}

TEST_F(PreferencesTest, ThatCannotBeWrittenCostALine) {
    fs::create_directories(folder);
    std::ofstream(folder / "sinew") << "a file where the folder should be";
    testing::internal::CaptureStderr();
    savePreferences(file, chosen);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
}

} // namespace
} // namespace sinew::viewer
