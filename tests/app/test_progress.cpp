// Tests of app/progress: a run writes lines to files and pipes, and a bar to a terminal.
#include "app/progress.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

using namespace sinew;

namespace {

std::string contents(std::FILE* stream) {
    std::string text(4096, '\0');
    std::rewind(stream);
    text.resize(std::fread(text.data(), 1, text.size(), stream));
    return text;
}

} // namespace

TEST(ProgressLine, SaysRateAndRemainingTime) {
    EXPECT_EQ(app::progressLine(0, 240, 0), "0 of 240 steps");
    EXPECT_EQ(app::progressLine(60, 240, 0.5), "60 of 240 steps, 120/s, 1.5 s left");
    EXPECT_EQ(app::progressLine(1, 10, 2), "1 of 10 steps, 0.50/s, 18.0 s left");
    EXPECT_EQ(app::progressLine(240, 240, 2), "240 of 240 steps, 120/s, 2.0 s");
    EXPECT_EQ(app::progressLine(60, 240, 0.5, "sweeps"), "60 of 240 sweeps, 120/s, 1.5 s left");
}

TEST(ProgressBar, FillsFromEmptyToFull) {
    EXPECT_EQ(app::progressBar(0, 240, 0), "[....................]   0 %  0 of 240 steps");
    EXPECT_EQ(app::progressBar(60, 240, 0.5),
              "[#####...............]  25 %  60 of 240 steps, 120/s, 1.5 s left");
    EXPECT_EQ(app::progressBar(240, 240, 2), "[####################] 100 %  240 of 240 steps, 120/s, 2.0 s");
    EXPECT_EQ(app::progressBar(0, 0, 0), "[####################] 100 %  0 of 0 steps");
}

TEST(Progress, WritesPlainLinesIntoAFile) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    {
        app::Progress progress(10, file);
        for (std::uint64_t step = 1; step <= 10; ++step) progress.update(step);
        progress.finish();
        progress.finish();
    }
    const std::string text = contents(file);
    std::fclose(file);
    EXPECT_EQ(text.find("10 of 10 steps"), 0u) << text;
    EXPECT_EQ(text.find('\n'), text.size() - 1);
    EXPECT_EQ(text.find('\r'), std::string::npos);
    EXPECT_EQ(text.find('\033'), std::string::npos);
}

TEST(Progress, DrawsABarOnATerminal) {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0)
        GTEST_SKIP() << "no pseudo-terminal here";
    std::FILE* terminal = std::fopen(::ptsname(master), "w");
    ASSERT_NE(terminal, nullptr);
    {
        app::Progress progress(4, terminal);
        progress.update(2);
        progress.finish();
    }
    std::string text; // the terminal may deliver the text in any number of parts
    char piece[4096];
    while (!text.ends_with('\n')) {
        const ssize_t size = ::read(master, piece, sizeof piece);
        if (size <= 0) break;
        text.append(piece, static_cast<std::size_t>(size));
    }
    std::fclose(terminal);
    ::close(master);
    EXPECT_EQ(text.find("\r[##########..........]  50 %  2 of 4 steps"), 0u) << text;
    EXPECT_EQ(text.substr(text.size() - 2), "\r\n") << "the cursor must not stay on the bar's line";
}
