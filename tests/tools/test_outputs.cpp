// Tests of output paths: which ones are refused before a run, and the file names of bodies.
#include "sinew/outputs.hpp"

#include "app/guard.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include <stdlib.h>

using namespace sinew;
namespace fs = std::filesystem;

namespace {

class Outputs : public testing::Test {
protected:
    Outputs() {
        std::string name = (fs::temp_directory_path() / "sinew-outputs-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~Outputs() override { fs::remove_all(folder_); }

    template <typename Action> int codeOf(const Action& action) const {
        try {
            action();
        } catch (const app::Failure& failure) {
            return failure.code();
        }
        return 0;
    }

    fs::path folder_;
};

} // namespace

TEST_F(Outputs, MakeMissingFoldersAndLeaveNoLockBehind) {
    {
        const tools::OutputFolder folder(folder_ / "a/b");
        EXPECT_TRUE(fs::is_directory(folder.path()));
        EXPECT_TRUE(fs::exists(folder.path() / ".sinew-lock"));
    }
    EXPECT_TRUE(fs::is_empty(folder_ / "a/b"));
}

TEST_F(Outputs, LockAFolderForOneRun) {
    const tools::OutputFolder first(folder_);
    EXPECT_EQ(codeOf([&] { const tools::OutputFolder second(folder_); }), app::outputFailed);
}

TEST_F(Outputs, TakeOverTheLockOfARunThatDied) {
    std::ofstream(folder_ / ".sinew-lock") << "";
    EXPECT_EQ(codeOf([&] { const tools::OutputFolder folder(folder_); }), 0);
}

TEST_F(Outputs, DoNotFollowALinkInThePlaceOfTheLock) {
    fs::create_symlink(folder_ / "elsewhere", folder_ / ".sinew-lock");
    EXPECT_EQ(codeOf([&] { const tools::OutputFolder folder(folder_); }), app::outputFailed);
    EXPECT_FALSE(fs::exists(folder_ / "elsewhere"));
}

TEST_F(Outputs, WriteTextsWholeAndReplaceOldOnes) {
    const std::string file = (folder_ / "report.json").string();
    for (const std::string text : {"a long first text\n", "short\n"}) {
        tools::TextOutput(file).write(text);
        std::ifstream stream(file);
        EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), text);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Outputs, RefuseFoldersAndMissingFoldersBeforeARun) {
    EXPECT_EQ(codeOf([&] { tools::TextOutput output(folder_.string()); }), app::outputFailed);
    EXPECT_EQ(codeOf([&] { tools::TextOutput output((folder_ / "none/report.json").string()); }),
              app::outputFailed);
    EXPECT_EQ(codeOf([&] { tools::TextOutput output("-"); }), 0);
}

TEST_F(Outputs, NoticeAFullDisk) {
    const tools::TextOutput full("/dev/full");
    EXPECT_EQ(codeOf([&] { full.write("text"); }), app::outputFailed);
}

TEST(FileName, KeepsNoPathsAndNoSpecialCharacters) {
    EXPECT_EQ(tools::fileName("organ-2"), "organ-2");
    EXPECT_EQ(tools::fileName("../etc/passwd"), "___etc_passwd");
    EXPECT_EQ(tools::fileName("Herz \xc3\xa4\n"), "Herz_\xc3\xa4_");
    EXPECT_EQ(tools::fileName(""), "body");
    EXPECT_EQ(tools::fileName(std::string(1000, 'x')).size(), 64u);
}

TEST(FileName, KeepsLettersOfEveryScript) {
    for (const char* name : {"\xd0\xbf\xd0\xb5\xd1\x87\xd0\xb5\xd0\xbd\xd1\x8c", "\xe8\x82\x9d\xe8\x87\x93",
                             "\xce\xb1-\xce\xb2", "\xf0\x9f\xab\x80"})
        EXPECT_EQ(tools::fileName(name), name);
}

TEST(FileName, ReplacesWhatIsNoUtf8AndWhatTurnsTextAround) {
    EXPECT_EQ(tools::fileName("a\xff\xc3z"), "a__z");      // no start byte, and no continuation byte
    EXPECT_EQ(tools::fileName("a\xc0\xafz"), "a__z");      // "/" in two bytes
    EXPECT_EQ(tools::fileName("a\xed\xa0\x80z"), "a___z"); // half of a surrogate pair
    EXPECT_EQ(tools::fileName("a\xe2\x80\xaez"), "a___z"); // right-to-left override
    EXPECT_EQ(tools::fileName("a\xc2\x85z"), "a__z");      // a control character
    EXPECT_EQ(tools::fileName("a\xe8\x82"), "a__");        // truncated
}

TEST(FileName, EndsBetweenLetters) {
    std::string name;
    for (int i = 0; i < 40; ++i) name += "\xe8\x82\x9d"; // 3 bytes each: 21 fit into 64
    EXPECT_EQ(tools::fileName(name), name.substr(0, 63));
}
