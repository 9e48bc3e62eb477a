// Tests the table of contact costs: counts and predicted times of a known program, and its row names.
#include "sinew/bench_contacts.hpp"
#include "sinew/predict/predict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace sinew;

namespace {

sim::Pass passOf(sim::PassKind kind, std::uint32_t substep, bool isIndirect = false, bool hasBarrier = true) {
    sim::Pass pass{.kind = kind, .isIndirect = isIndirect, .substep = substep};
    pass.barriers[sim::plainStep.index()] = hasBarrier;
    return pass;
}

// Two substeps with two direct dispatches, an indirect one and a copy; the second has one more indirect
// dispatch.
sim::StepProgram program() {
    using enum sim::PassKind;
    sim::StepProgram program;
    program[sim::List::step].push_back(passOf(update, 0));
    for (const std::uint32_t substep : {1u, 2u}) {
        program[sim::List::step].push_back(passOf(copy, substep, false, false));
        program[sim::List::step].push_back(passOf(dispatch, substep));
        program[sim::List::step].push_back(passOf(dispatch, substep));
        program[sim::List::step].push_back(passOf(dispatch, substep, true));
    }
    program[sim::List::step].push_back(passOf(dispatch, 2, true));
    program[sim::List::step].back().isOfLists = true;
    program[sim::List::step].back().barriers[sim::calmStep.index()] =
        true; // for a recording without this pass
    program[sim::List::step].push_back(passOf(dispatch, 0));
    sim::Pass ofCut = passOf(dispatch, 1);
    ofCut.when = sim::When::cut;
    program[sim::List::step].push_back(ofCut);
    return program;
}

} // namespace

TEST(BenchContacts, CountsTheMeanOfSubstepsWithoutABlade) {
    const tools::SubstepCounts counts = tools::countSubstep(program());
    EXPECT_EQ(counts.direct, 2);
    EXPECT_EQ(counts.indirect, 1.5);
    EXPECT_EQ(counts.passes, 4.5);
    EXPECT_EQ(counts.barriers, 3.5);
    EXPECT_EQ(tools::countSubstep({}).passes, 0) << "of nothing";
}

TEST(BenchContacts, PredictsTimeFromLaunchesThatWait) {
    const tools::Card card{.name = "a card", .dispatchUs = 5, .emptyUs = 4};
    EXPECT_EQ(tools::launchUs(program(), card, sim::plainStep), 6 * 5 + 3 * 4)
        << "the update waits, copies do not";
    EXPECT_EQ(tools::launchUs(program(), card, sim::calmStep), 0) << "no barrier was planned";
}

TEST(BenchContacts, LeavesPassesOfListsOutOfCalmSteps) {
    const tools::SubstepCounts counts = tools::countSubstep(program(), sim::calmStep);
    EXPECT_EQ(counts.direct, 2);
    EXPECT_EQ(counts.indirect, 1);
    EXPECT_EQ(counts.passes, 4);
    EXPECT_EQ(counts.barriers, 0) << "none was planned";
}

TEST(BenchContacts, NamesItsRowsApart) {
    const std::vector<std::string> rows = tools::contactRows();
    EXPECT_EQ(std::set(rows.begin(), rows.end()).size(), rows.size());
    for (const char* name : {"organ in free fall", "box 14^3", "on a plane", "cloth 60^2 swinging",
                             "cloth_links_on_sphere", "cloth_fold", "clutter_bodies", "stack",
                             "pile_8000, falling", "pile_8000, at rest", "1,000 balls", "8,000 balls"})
        EXPECT_TRUE(std::ranges::any_of(rows, [&](const std::string& row) {
            return row.find(name) != std::string::npos;
        })) << name;
}
