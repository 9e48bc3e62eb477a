// Tests of lengths as text.
#include "viewer/render/length_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sinew::viewer {
namespace {

TEST(LengthText, HasTheUnitThatPeopleUse) {
    EXPECT_EQ(lengthText(0.0254f), "2.54 cm");
    EXPECT_EQ(lengthText(0.38f), "38 cm");
    EXPECT_EQ(lengthText(0.0125e-1f), "1.25 mm");
    EXPECT_EQ(lengthText(1.5f), "1.5 m");
    EXPECT_EQ(lengthText(2000), "2 km");
    EXPECT_EQ(lengthText(-0.1f), "-10 cm");
    EXPECT_EQ(lengthText(2.5e-5f), "25 \u00b5m");
}

TEST(LengthText, HasNoMinusZeroAndNoThousandOfTheSmallerUnit) {
    EXPECT_EQ(lengthText(-1e-9f), "0 cm");
    EXPECT_EQ(lengthText(0), "0 cm");
    EXPECT_EQ(lengthText(0.9999f), "1 m");
    EXPECT_EQ(lengthText(0.009999f), "1 cm");
}

TEST(RoundLength, IsTheLargestRoundOneThatFits) {
    EXPECT_FLOAT_EQ(roundLength(0.034f), 0.02f);
    EXPECT_FLOAT_EQ(roundLength(0.05f), 0.05f);
    EXPECT_FLOAT_EQ(roundLength(0.99f), 0.5f);
    EXPECT_FLOAT_EQ(roundLength(1), 1);
    EXPECT_FLOAT_EQ(roundLength(700), 500);
    for (const float most :
         {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(roundLength(most), 0) << most;
}

} // namespace
} // namespace sinew::viewer
