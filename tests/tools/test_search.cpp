// Tests the search for settings at equal error on programs whose errors are formulas.
#include "sinew/peers/search.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace sinew::tools::peers;
using sinew::sim::Settings;

namespace {

/// Two families: an error of 1 / substeps whatever the iterations.
Search bySubsteps(std::vector<double> targets) {
    return {.variants = {{{}, 1}, {{}, 4}},
            .targets = std::move(targets),
            .errorOf = [](const Settings& s, double) { return std::optional(1.0 / s.substeps); },
            .isOver = [] { return false; }};
}

std::vector<Candidate> candidatesOf(const SearchResult& result, std::size_t target) {
    std::vector<Candidate> list;
    for (const Candidate& candidate : result.candidates)
        if (candidate.target == target) list.push_back(candidate);
    return list;
}

} // namespace

TEST(Search, FindsTheFewestSubstepsThatReachATarget) {
    const SearchResult result = findCheapest(bySubsteps({0.1, 0.01}));
    EXPECT_TRUE(result.isComplete);
    const std::vector<Candidate> coarse = candidatesOf(result, 0), fine = candidatesOf(result, 1);
    ASSERT_FALSE(coarse.empty());
    EXPECT_EQ(coarse[0].settings.substeps, 10u) << "not 16, the next power of two";
    EXPECT_EQ(coarse[0].settings.iterations, 1u);
    ASSERT_FALSE(fine.empty());
    EXPECT_GE(fine[0].settings.substeps, 100u);
    EXPECT_LE(fine[0].settings.substeps, 104u) << "within a part in 24";
    for (const Candidate& candidate : result.candidates)
        EXPECT_NEAR(candidate.error, 1.0 / candidate.settings.substeps, 1e-12);
}

TEST(Search, FindsTheCliffOfAProgramThatDivergesBelowIt) {
    Search search = bySubsteps({0.1, 0.01, 0.001});
    search.variants = {{}};
    search.errorOf = [](const Settings& s, double) {
        return s.substeps < 111 ? std::nullopt : std::optional(1e-7);
    };
    const SearchResult result = findCheapest(search);
    ASSERT_EQ(result.candidates.size(), 3u);
    for (const Candidate& candidate : result.candidates) {
        EXPECT_GE(candidate.settings.substeps, 111u);
        EXPECT_LE(candidate.settings.substeps, 115u);
    }
}

TEST(Search, CountsIterationsOfAWholeFrame) {
    Search search = bySubsteps({0.1});
    search.variants = {{{}, 1, true}};
    search.errorOf = [](const Settings& s, double) {
        EXPECT_EQ(s.substeps, 1u);
        return std::optional(1.0 / s.iterations);
    };
    const SearchResult result = findCheapest(search);
    ASSERT_EQ(result.candidates.size(), 1u);
    EXPECT_EQ(result.candidates[0].settings.iterations, 10u);
}

TEST(Search, DropsVariantsThatFallBehindButKeepsFour) {
    Search search = bySubsteps({5e-3});
    search.variants.clear();
    for (int i = 0; i < 12; ++i) search.variants.push_back({{.omega = static_cast<float>(i)}, 1});
    int last = 0;
    search.errorOf = [&](const Settings& s, double) {
        last += s.substeps == 256;
        return std::optional((1 + double{s.omega} / 10) / s.substeps);
    };
    const SearchResult result = findCheapest(search);
    EXPECT_EQ(last, 4);
    ASSERT_EQ(candidatesOf(result, 0).size(), 2u) << "two are timed, in case one costs less a sweep";
    EXPECT_EQ(result.candidates[0].settings.omega, 0);
    EXPECT_EQ(result.candidates[1].settings.omega, 1);
}

TEST(Search, SaysThatItIsNeverReachedOrThatTimeWasOver) {
    Search search = bySubsteps({1e-9});
    EXPECT_TRUE(findCheapest(search).isComplete);
    EXPECT_TRUE(findCheapest(search).candidates.empty());
    int left = 5;
    search.isOver = [&] { return --left < 0; };
    const SearchResult result = findCheapest(search);
    EXPECT_FALSE(result.isComplete);
    EXPECT_EQ(result.probes.size(), 5u);
    // Targets that were reached before the time was over stay.
    search = bySubsteps({0.6, 1e-9});
    left = 6;
    search.isOver = [&] { return --left < 0; };
    EXPECT_FALSE(findCheapest(search).candidates.empty());
}
