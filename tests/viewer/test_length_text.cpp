// Tests of lengths as text.
#include "viewer/render/legend.hpp"
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

TEST(PointText, HasOneUnitForAllNumbers) {
    EXPECT_EQ(pointText({0.1234f, -0.02f, 0}), "12.3, -2, 0 cm");
    EXPECT_EQ(pointText({1.5f, 0.04f, -0.002f}), "1.5, 0.04, 0 m");
    EXPECT_EQ(pointText({-12.34f, 100, 0}), "-12, 100, 0 m");
    EXPECT_EQ(pointText({0.3f, -1e-5f, -0.0f}), "30, 0, 0 cm") << "no minus before a zero";
    EXPECT_EQ(pointText({0, -1e-9f, 0}), "0, 0, 0 cm");
}

TEST(CountText, HasTheNounInTheRightNumber) {
    EXPECT_EQ(countText(0, "link"), "0 links");
    EXPECT_EQ(countText(1, "link"), "1 link");
    EXPECT_EQ(countText(4211, "link"), "4,211 links");
    EXPECT_EQ(countText(1, "class", "classes"), "1 class");
    EXPECT_EQ(countText(18, "class", "classes"), "18 classes");
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
