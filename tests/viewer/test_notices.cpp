// Tests of the window's notices, which appear one after the other.
#include "viewer/ui/notices.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

using namespace std::chrono_literals;

TEST(Notices, ShowEveryNoteOfASceneInItsTurn) {
    Notices notices;
    Notices::Clock::time_point now{};
    notices.announce({"one", "two", "three"}, now);
    for (const char* text : {"one", "two", "three", ""}) {
        EXPECT_TRUE(notices.hasChanged()) << text;
        EXPECT_EQ(notices.shown().text, text);
        EXPECT_FALSE(notices.shown().isBad);
        notices.pass(now + Notices::notePasses - 1ms);
        EXPECT_FALSE(notices.hasChanged()) << text;
        EXPECT_EQ(notices.shown().text, text) << "it stays its time";
        notices.pass(now += Notices::notePasses);
    }
    EXPECT_FALSE(notices.hasChanged());
}

TEST(Notices, PutAWarningBeforeThoseThatWait) {
    Notices notices;
    Notices::Clock::time_point now{};
    notices.announce({"one", "two"}, now);
    notices.show({"no room", true}, now);
    EXPECT_EQ(notices.shown().text, "no room");
    notices.pass(now += Notices::notePasses);
    EXPECT_EQ(notices.shown().text, "no room") << "a warning stays longer";
    notices.show({"no memory", true}, now);
    EXPECT_EQ(notices.shown().text, "no room") << "as long as another one";
    notices.pass(now += Notices::warningStays);
    EXPECT_EQ(notices.shown().text, "no memory");
    for (const char* text : {"one", "two", ""}) {
        notices.pass(now += Notices::warningStays);
        EXPECT_EQ(notices.shown().text, text);
    }
}

TEST(Notices, ShowAWarningAgainAfterANote) {
    Notices notices;
    Notices::Clock::time_point now{};
    for (int time = 0; time < 3; ++time) notices.show({"soft", true}, now);
    notices.show({"plays jacobi"}, now);
    EXPECT_EQ(notices.shown().text, "plays jacobi");
    notices.pass(now += Notices::notePasses);
    EXPECT_EQ(notices.shown().text, "soft");
    EXPECT_TRUE(notices.shown().isBad);
    notices.pass(now += Notices::warningStays);
    EXPECT_EQ(notices.shown().text, "") << "once, however often it was said";
}

TEST(Notices, ForgetThoseOfTheSceneBefore) {
    Notices notices;
    Notices::Clock::time_point now{};
    notices.announce({"one", "two"}, now);
    notices.announce({}, now);
    EXPECT_EQ(notices.shown().text, "");
    notices.announce({"three"}, now);
    notices.show({"no room", true}, now);
    notices.announce({"four"}, now);
    EXPECT_EQ(notices.shown().text, "no room") << "a warning stays";
    notices.pass(now += Notices::warningStays);
    EXPECT_EQ(notices.shown().text, "four");
}

} // namespace
} // namespace sinew::viewer
