// Tests of the number of submissions that a step takes.
#include "app/step_parts.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

using sinew::app::StepParts;

TEST(StepParts, AreAsManyAsKeepEachShort) {
    StepParts parts(false, nullptr);
    EXPECT_GT(parts.count(), 1u) << "nothing is known of the first step";
    for (int step = 0; step < 40; ++step) parts.measured(3);
    EXPECT_EQ(parts.count(), 1u);
    parts.measured(StepParts::longestMs);
    EXPECT_EQ(parts.count(), 1u);
    parts.measured(StepParts::longestMs * 3.5);
    EXPECT_EQ(parts.count(), 4u);
    parts.measured(3);
    EXPECT_EQ(parts.count(), 3u) << "one short step may be an exception";
    parts.measured(1e9);
    EXPECT_EQ(parts.count(), StepParts::most);
    parts.measured(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(parts.count(), StepParts::most);
}

TEST(StepParts, AreAsManyAsAreAskedFor) {
    for (const auto& [asked, count] : {std::pair{"3", 3u}, {"1", 1u}, {"1000", StepParts::most}}) {
        StepParts parts(false, asked);
        EXPECT_EQ(parts.count(), count);
        parts.measured(1e4);
        EXPECT_EQ(parts.count(), count);
        EXPECT_EQ(StepParts(true, asked).count(), count);
    }
    for (const char* none : {"0", "-1", "", "many"}) EXPECT_EQ(StepParts(true, none).count(), 1u) << none;
}

TEST(StepParts, AreOneOnASoftwareDevice) {
    StepParts parts(true, nullptr);
    EXPECT_EQ(parts.count(), 1u);
    parts.measured(1e9);
    EXPECT_EQ(parts.count(), 1u);
}
