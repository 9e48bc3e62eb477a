// Tests the advice on threads of a software device, with times that are made up.
#include "app/thread_advice.hpp"

#include <gtest/gtest.h>

using namespace sinew;

TEST(ThreadAdvice, NamesTheVariableTheGainAndTheMeasurement) {
    const std::optional<std::string> advice = app::threadAdvice({.threaded = 0.84, .single = 0.4});
    ASSERT_TRUE(advice.has_value());
    EXPECT_NE(advice->find("2.1 times as fast with LP_NUM_THREADS=0"), std::string::npos) << *advice;
    EXPECT_NE(advice->find("0.84 ms with the driver's threads and 0.4 ms without"), std::string::npos)
        << *advice;
}

TEST(ThreadAdvice, SaysNothingWhereThreadsPayOrHardlyCost) {
    EXPECT_FALSE(app::threadAdvice({.threaded = 1, .single = 1.8}).has_value());
    EXPECT_FALSE(app::threadAdvice({.threaded = 1, .single = 0.95}).has_value());
    EXPECT_TRUE(app::threadAdvice({.threaded = 1, .single = 0.85}).has_value());
}

TEST(ThreadAdvice, ComparesTheShortestTimesTakenInTurns) {
    std::string order;
    double load = 9; // of the first rounds
    const app::ThreadTimes times = app::compareThreads(
        [&] {
            order += 't';
            return 2 + load;
        },
        [&] {
            order += 's';
            return 1 + (load = load > 3 ? load - 3 : 0);
        });
    EXPECT_EQ(order.substr(0, 4), "tsts");
    EXPECT_EQ(times.threaded, 2);
    EXPECT_EQ(times.single, 1);
}
