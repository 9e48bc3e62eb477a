// Tests of the table of frame times: its numbers are those of the input and consistent.
#include "viewer/ui/frame_times.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

using Kind = FrameTimes::Kind;

TEST(FrameTimes, AreQuantilesOfWhatCame) {
    FrameTimes times;
    for (int ms = 100; ms >= 1; --ms) times.addFrame(ms, false);
    EXPECT_EQ(times.quantile(Kind::frame, 0.5), 50);
    EXPECT_EQ(times.quantile(Kind::frame, 0.95), 95);
    EXPECT_EQ(times.quantile(Kind::frame, 1), 100);
    EXPECT_EQ(times.quantile(Kind::step, 0.5), 0) << "there was none";
    EXPECT_NEAR(times.framesPerSecond(), 1000 / 50.5, 1e-9);
}

TEST(FrameTimes, CountWhatTookTooLongAndWhatOfItWasACut) {
    FrameTimes times;
    times.addFrame(100, true);
    EXPECT_EQ(times.slowFrames(), 0u) << "just not";
    times.addFrame(101, false);
    times.addFrame(250, true);
    EXPECT_EQ(times.slowFrames(), 2u);
    EXPECT_EQ(times.slowFramesOfCut(), 1u);
    EXPECT_EQ(times.count(Kind::frame), 3u);
    EXPECT_EQ(times.count(Kind::frameOfCut), 2u);
}

TEST(FrameTimes, HaveALineOfWhatThereIsAlone) {
    FrameTimes times;
    times.addFrame(40, false);
    times.addFrame(120, true);
    times.add(Kind::picturesBefore, 1);
    const std::string table = times.table();
    EXPECT_NE(table.find("12.5 pictures a second"), std::string::npos) << table;
    EXPECT_NE(table.find("frame [ms]"), std::string::npos);
    EXPECT_NE(table.find("input to picture [pictures without it]"), std::string::npos);
    EXPECT_EQ(table.find("panels"), std::string::npos);
    EXPECT_NE(table.find("frames over 100 ms: 1, in a cut: 1"), std::string::npos);
    times.clear();
    EXPECT_EQ(times.table().find("frame [ms]"), std::string::npos);
}

TEST(FrameTimes, KeepTheNewest) {
    FrameTimes times;
    for (std::size_t i = 0; i < FrameTimes::most; ++i) times.add(Kind::step, 7);
    for (std::size_t i = 0; i < FrameTimes::most; ++i) times.add(Kind::step, 3);
    EXPECT_EQ(times.quantile(Kind::step, 1), 3);
    EXPECT_EQ(times.count(Kind::step), 2 * FrameTimes::most);
    EXPECT_NE(times.table().find("7.00"), std::string::npos) << "the largest of all stays";
}

} // namespace
} // namespace sinew::viewer
