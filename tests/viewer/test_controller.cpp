// Tests of the table of bindings and of actions, without a window.
#include "viewer/input/controller.hpp"
#include "viewer/render/picture_budget.hpp"
#include "viewer/tools/cut_tool.hpp"
#include "viewer/tools/grab_tool.hpp"
#include "viewer/tools/pins.hpp"
#include "viewer/tools/poke_tool.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace sinew::viewer {
namespace {

constexpr double dt = 1.0 / 60;

TEST(Bindings, AreUnambiguous) {
    for (const Binding& a : bindings())
        for (const Binding& b : bindings())
            EXPECT_TRUE(&a == &b || !(a.trigger == b.trigger)) << a.shown << " and " << b.shown;
}

TEST(Bindings, CoverEveryAction) {
    std::set<Action> bound;
    for (const Binding& binding : bindings()) bound.insert(binding.action);
    for (int action = static_cast<int>(Action::orbit); action <= static_cast<int>(Action::quit); ++action)
        EXPECT_EQ(bound.count(static_cast<Action>(action)), 1u) << "action " << action;
}

TEST(Bindings, AreAllInTheHelpText) {
    const std::string text = helpText();
    for (const Binding& binding : bindings()) {
        EXPECT_NE(text.find(binding.shown), std::string::npos) << binding.shown;
        EXPECT_NE(text.find(binding.help), std::string::npos) << binding.help;
    }
}

// The triggers in the first column of the table in docs/viewer.md, split at `;`, `,` and "or".
std::set<std::string> triggersInDocs() {
    std::set<std::string> found;
    std::ifstream file(SINEW_VIEWER_PAGE);
    std::string line;
    while (std::getline(file, line) && line != "| input | does |") {
    }
    std::getline(file, line); // the rule below the header
    while (std::getline(file, line) && line.starts_with("| ")) {
        std::string cell = line.substr(2, line.find(" |") - 2);
        for (const std::string_view apart : {" or ", ", "})
            for (std::size_t at = cell.find(apart); at != std::string::npos; at = cell.find(apart))
                cell.replace(at, apart.size(), "; ");
        std::erase(cell, '`');
        for (std::size_t at = 0; at != std::string::npos;) {
            const std::size_t end = cell.find("; ", at);
            found.insert(cell.substr(at, end == std::string::npos ? end : end - at));
            at = end == std::string::npos ? end : end + 2;
        }
    }
    return found;
}

// Nobody reads a flat list of fifty keys.
TEST(Bindings, StandInGroupsInTheHelp) {
    std::vector<std::string_view> headings;
    std::size_t inGroup = 0, largest = 0;
    for (const HelpLine& line : helpLines()) {
        if (!line.heading.empty()) {
            headings.push_back(line.heading);
            inGroup = 0;
        }
        EXPECT_FALSE(headings.empty()) << line.triggers << " stands before all groups";
        largest = std::max(largest, ++inGroup);
    }
    EXPECT_EQ(headings,
              (std::vector<std::string_view>{"Pointer and camera", "Time", "Tools", "Material and gravity",
                                             "View and compare", "Scenes, files, recording", "Window"}));
    EXPECT_LE(largest, 14u);
    EXPECT_NE(helpText().find("Time:\n  Space, P"), std::string::npos);
}

TEST(Bindings, AreFoundByKeyByWordAndByGroup) {
    const auto triggers = [](std::string_view search) {
        std::vector<std::string> all;
        for (const HelpLine& line : helpLines(search)) all.push_back(line.triggers);
        return all;
    };
    EXPECT_EQ(triggers("UNDO the last"), (std::vector<std::string>{"Ctrl + Z"}));
    EXPECT_EQ(triggers("page up"), (std::vector<std::string>{"Page Up"}));
    EXPECT_EQ(triggers("material and"), triggers("material and gravity"));
    EXPECT_EQ(triggers("material and").size(), 8u) << "a group by its heading";
    EXPECT_TRUE(triggers("nothing of the kind").empty());
    EXPECT_EQ(triggers("").size(), helpLines().size());
    const std::vector<HelpLine> plane = helpLines("section plane");
    ASSERT_GE(plane.size(), 3u);
    EXPECT_EQ(plane[0].heading, "Pointer and camera");
    EXPECT_EQ(plane[1].heading, "View and compare") << "its first line is not the first of the group";
    EXPECT_EQ(plane[2].heading, "");
}

TEST(Bindings, AreThoseOfTheDocs) {
    std::set<std::string> shown;
    for (const Binding& binding : bindings())
        if (!binding.shown.empty()) shown.emplace(binding.shown);
    EXPECT_EQ(triggersInDocs(), shown);
}

TEST(Bindings, HintAtWhatHandsCanDoNow) {
    const auto hintWith = [](const Tool& tool, const std::optional<float>& setting = {}) {
        return hintText({.inUse = indexOf(tool), .canUse = {true, true, true, true}, .setting = setting});
    };
    const std::string empty = hintText({.canUse = {true, true, true, true}}), blade = hintWith(tool::blade);
    EXPECT_EQ(hintText({.canUse = {false, true, true, true}}).find("cut"), std::string::npos);
    EXPECT_LT(blade.find("Ctrl + Z undoes the cut"), blade.find("depth")) << "narrow windows drop the rest";
    EXPECT_NE(blade.find("cuts through"), std::string::npos);
    EXPECT_NE(hintWith(tool::blade, 0.012f).find("cuts 1.2 cm deep"), std::string::npos);
    const std::string poke = hintWith(tool::poke);
    EXPECT_NE(poke.find("Shift + wheel"), std::string::npos);
    for (const std::string& hint : {empty, blade, poke, hintWith(tool::hand)})
        EXPECT_NE(hint.find("H help"), std::string::npos) << hint;
}

// The first minute needs no more; the help has the rest.
TEST(Bindings, HintsOfIdleHandsHaveThreeParts) {
    constexpr std::array<bool, mostTools> canUse{true, true, true, true};
    const std::string dot = "   \u00b7   ", first = "drag to pull" + dot + "hold Ctrl and drag to cut" + dot;
    EXPECT_EQ(hintText({.canUse = canUse}), first + "H help");
    EXPECT_EQ(hintText({.canUse = canUse, .canUndo = true}), first + "Ctrl + Z undoes" + dot + "H help");
}

// A window that is too narrow for all hints shows the first ones.
TEST(Bindings, HintsAreDroppedFromTheRightUntilTheyFit) {
    const HintFacts facts{.inUse = indexOf(tool::blade), .canUse = {true, true, true, true}};
    const std::string all = hintText(facts);
    const auto fitting = [&](std::size_t most) {
        return hintText(facts, [most](const std::string& text) { return text.size() <= most; });
    };
    EXPECT_EQ(fitting(all.size()), all);
    const std::string less = fitting(all.size() - 1);
    EXPECT_TRUE(less.starts_with("left drag cuts through")) << less;
    EXPECT_NE(less.find("Esc puts the blade away"), std::string::npos) << less;
    EXPECT_EQ(less.find("Tab panels"), std::string::npos) << less;
    EXPECT_TRUE(less.ends_with("H help")) << less;
    EXPECT_EQ(fitting(3), "H help");
}

TEST(Bindings, HintsSayWhatAButtonWaitsFor) {
    const std::string hint = hintText({.inUse = indexOf(tool::blade), .awaited = tool::pins.awaited});
    EXPECT_TRUE(hint.starts_with("click a body to pin it")) << hint;
    EXPECT_NE(hint.find("Esc cancels"), std::string::npos) << hint;
    EXPECT_EQ(hint.find("cuts"), std::string::npos) << hint;
    for (const Tool* tool : toolTable()) EXPECT_EQ(tool->isMomentary, !tool->awaited.empty()) << tool->name;
}

TEST(Tools, HaveKeysAndNamesOfTheirOwn) {
    std::set<std::string_view> names;
    std::size_t count = 0, withoutKey = 0, lent = 0;
    for (const Tool* tool : toolTable()) {
        for (const std::string_view name : {tool->name, tool->setting}) {
            names.insert(name);
            count += name.empty() ? 0 : 1;
        }
        lent += tool->isLent ? 1 : 0;
        if (tool->key == 0)
            ++withoutKey;
        else
            EXPECT_EQ(actionFor({Trigger::Kind::key, tool->key, 0}), actionOf(*tool)) << tool->name;
    }
    names.erase("");
    EXPECT_EQ(names.size(), count) << "lines of logs begin with them";
    EXPECT_EQ(withoutKey, 1u) << "the one in hand while no other is";
    EXPECT_EQ(lent, 1u);
    EXPECT_EQ(toolOf(actionOf(tool::poke)), indexOf(tool::poke));
    EXPECT_FALSE(toolOf(Action::drop));
    EXPECT_FALSE(toolOf(actionOfLayer(0)));
}

TEST(Bindings, EscapeDropsWhatIsHeldAndControlQQuits) {
    EXPECT_EQ(actionFor({Trigger::Kind::key, GLFW_KEY_ESCAPE, 0}), Action::drop);
    EXPECT_FALSE(actionFor({Trigger::Kind::key, GLFW_KEY_Q, 0}));
    EXPECT_EQ(actionFor({Trigger::Kind::key, GLFW_KEY_Q, GLFW_MOD_CONTROL}), Action::quit);
}

TEST(Bindings, IgnoreLocksOfTheKeyboard) {
    EXPECT_EQ(actionFor({Trigger::Kind::key, GLFW_KEY_P, GLFW_MOD_CAPS_LOCK | GLFW_MOD_NUM_LOCK}),
              Action::pause);
}

TEST(Playback, FollowsRealTime) {
    Playback playback(dt);
    std::uint32_t steps = 0;
    for (int frame = 0; frame < 144; ++frame) // one second with 144 pictures a second
        steps += playback.plan(1.0 / 144).steps;
    EXPECT_GE(steps, 59u);
    EXPECT_LE(steps, 60u);
}

TEST(Playback, DropsTimeItCannotKeepUpWith) {
    Playback playback(dt);
    EXPECT_EQ(playback.plan(10).steps, Playback::maxSteps);
    EXPECT_LE(playback.plan(0).steps, 1u) << "ten seconds are not made up for";
    EXPECT_EQ(playback.plan(0).steps, 0u);
}

TEST(Playback, TakesItsTimeInSlowMotion) {
    Playback playback(dt);
    playback.slowDown();
    playback.slowDown();
    EXPECT_EQ(playback.pace(), 0.25);
    std::uint32_t steps = 0;
    for (int frame = 0; frame < 240; ++frame) steps += playback.plan(1.0 / 60).steps;
    EXPECT_NEAR(steps, 60, 1);
    playback.slowDown();
    playback.slowDown();
    EXPECT_EQ(playback.pace(), 1) << "and round again";
}

// Number of steps in a plan; records them all.
std::uint32_t take(Playback& playback, double elapsed, std::uint32_t most = Playback::maxSteps) {
    const std::uint32_t steps = playback.plan(elapsed, most).steps;
    playback.taken(steps);
    return steps;
}

TEST(Playback, TakesNoMoreStepsThanAskedFor) {
    Playback playback(dt);
    EXPECT_EQ(take(playback, 1, 1), 1u);
    playback.step();
    playback.step();
    EXPECT_EQ(take(playback, 0, 1), 1u);
    EXPECT_EQ(take(playback, 0, 1), 1u);
    EXPECT_EQ(take(playback, 0, 1), 0u);
}

TEST(Playback, StandsStillWhilePausedAndDoesNotJumpAfterwards) {
    Playback playback(dt);
    playback.toggle();
    EXPECT_TRUE(playback.isPaused());
    for (int frame = 0; frame < 10; ++frame) EXPECT_EQ(playback.plan(1).steps, 0u);
    playback.toggle();
    EXPECT_EQ(playback.plan(0.5 * dt).steps, 0u);
}

TEST(Playback, StepPausesAndTakesExactlyOne) {
    Playback playback(dt);
    playback.step();
    EXPECT_TRUE(playback.isPaused());
    EXPECT_EQ(take(playback, 1), 1u);
    EXPECT_EQ(take(playback, 1), 0u);
}

TEST(Playback, TakesStepsAgainThatWereUndoneWhilePaused) {
    Playback playback(dt);
    playback.pause();
    EXPECT_EQ(playback.plan(1, 2, 3).steps, 2u);
    EXPECT_EQ(playback.plan(1, 2, 1).steps, 1u);
    playback.step();
    EXPECT_EQ(playback.plan(1, 2, 1).steps, 2u) << "and the one that was asked for";
    playback.taken(0);
    EXPECT_EQ(playback.plan(1, 2, 0).steps, 1u) << "which is still to come";
    playback.toggle();
    EXPECT_EQ(playback.plan(dt, 2, 3).steps, 1u) << "time goes on by itself";
    playback.toggle();
    EXPECT_EQ(playback.plan(1, 2, 0).steps, 0u);
}

TEST(Playback, KeepsSingleStepsUntilTheyAreTaken) {
    Playback playback(dt);
    playback.step();
    EXPECT_EQ(playback.plan(1).steps, 1u);
    EXPECT_EQ(playback.plan(1, 0).steps, 0u) << "no step may be taken now";
    EXPECT_EQ(playback.plan(1).steps, 1u) << "the plans before came to nothing";
    playback.taken(1);
    EXPECT_EQ(playback.plan(1).steps, 0u);
    playback.step();
    playback.dropSingleSteps();
    EXPECT_EQ(playback.plan(1).steps, 0u);
}

TEST(Playback, DropsStepsThatWereUndoneAtAReset) {
    Playback playback(dt);
    playback.pause();
    playback.reset();
    const Plan plan = playback.plan(1, 2, 2);
    EXPECT_TRUE(plan.isReset);
    EXPECT_EQ(plan.steps, 0u);
    playback.reset();
    playback.step();
    EXPECT_EQ(playback.plan(1, 2, 2).steps, 1u) << "asked for after the reset";
}

TEST(Playback, ResetComesOnceAndAlsoWhilePaused) {
    Playback playback(dt);
    playback.pause();
    playback.reset();
    EXPECT_TRUE(playback.plan(0).isReset);
    EXPECT_FALSE(playback.plan(0).isReset);
    EXPECT_TRUE(playback.isPaused());
}

TEST(Controller, DoesWhatConcernsTimeAndLeavesTheRest) {
    Controller controller(Camera{}, dt);
    EXPECT_TRUE(controller.act(Action::pause));
    EXPECT_TRUE(controller.playback.isPaused());
    EXPECT_TRUE(controller.act(Action::step));
    EXPECT_TRUE(controller.act(Action::reset));
    for (const Action action : {Action::screenshot, Action::fullScreen, Action::quit, Action::frame})
        EXPECT_FALSE(controller.act(action));
}

TEST(Controller, DragsMoveTheCameraByTheirKind) {
    Controller orbiting(Camera{}, dt), panning(Camera{}, dt);
    orbiting.drag(Action::orbit, {0.1f, 0});
    panning.drag(Action::pan, {0.1f, 0});
    EXPECT_EQ(orbiting.camera.target, Camera{}.target);
    EXPECT_NE(orbiting.camera.azimuth, Camera{}.azimuth);
    EXPECT_NE(panning.camera.target, Camera{}.target);
    EXPECT_EQ(panning.camera.azimuth, Camera{}.azimuth);
}

TEST(Controller, WheelForwardsComesNearer) {
    Controller controller(Camera{}, dt);
    controller.wheel(1, Vector2::Zero());
    EXPECT_LT(controller.camera.distance, Camera{}.distance);
    controller.wheel(-1, Vector2::Zero());
    EXPECT_NEAR(controller.camera.distance, Camera{}.distance, 1e-5f);
}

TEST(PictureBudget, IsAsAskedUntilAStepHasBeenTimed) {
    PictureBudget budget;
    EXPECT_EQ(budget.steps(2), 2u);
    budget.pictureTaken(0.2, 2);
    EXPECT_EQ(budget.steps(2), 2u);
}

TEST(PictureBudget, TakesASecondStepOnlyWherePicturesStayWithinTheGoal) {
    const auto steps = [](double step, double rest) {
        PictureBudget budget;
        for (int picture = 0; picture < 20; ++picture) {
            budget.stepTimed(step);
            const std::uint32_t taken = budget.steps(2);
            budget.pictureTaken(taken * step + rest, taken);
        }
        return budget.steps(2);
    };
    EXPECT_EQ(steps(0.002, 0.014), 2u);
    EXPECT_EQ(steps(0.016, 0.017), 2u);
    EXPECT_EQ(steps(0.020, 0.015), 1u);
    EXPECT_EQ(steps(0.060, 0.080), 1u); // time advances even on a slow device
    EXPECT_EQ(steps(0.001, 0.300), 1u);
}

// Scales chosen for a device on which a step takes `step`, the rest of a picture `fixed`, and its pixels
// `pixels` at full size.
std::vector<std::size_t> scalesOf(double step, double fixed, double pixels, int pictures) {
    PictureBudget budget;
    std::vector<std::size_t> scales;
    for (int picture = 0; picture < pictures; ++picture) {
        budget.stepTimed(step);
        const std::uint32_t taken = budget.steps(2);
        const float scale = PictureBudget::scales[budget.scale()];
        budget.pictureTaken(taken * step + fixed + pixels * double{scale * scale}, taken);
        scales.push_back(budget.scale());
    }
    return scales;
}

TEST(PictureBudget, DrawsFewerPixelsWhereThatBringsPicturesNearerTheGoal) {
    EXPECT_EQ(scalesOf(0.004, 0.004, 0.006, 60).back(), 0u);
    EXPECT_EQ(scalesOf(0.025, 0.010, 0.070, 60).back(), 1u);
    EXPECT_EQ(scalesOf(0.300, 0.004, 0.010, 60).back(), 0u) << "the step alone is slow";
}

TEST(PictureBudget, ComesToRestAtAScale) {
    for (const double pixels : {0.02, 0.03, 0.04, 0.05, 0.06, 0.08, 0.12})
        for (const double step : {0.002, 0.01, 0.02, 0.03}) {
            const auto scales = scalesOf(step, 0.006, pixels, 200);
            EXPECT_EQ(std::set(scales.begin() + 60, scales.end()).size(), 1u) << pixels << ' ' << step;
        }
}

TEST(PictureBudget, GivesPixelsBackWhenThereIsTime) {
    PictureBudget budget;
    const auto play = [&](double seconds) {
        for (int picture = 0; picture < 60; ++picture) {
            budget.stepTimed(0.005);
            budget.pictureTaken(0.005 + seconds, 1);
        }
    };
    play(0.09);
    EXPECT_EQ(budget.scale(), 1u);
    play(0.004);
    EXPECT_EQ(budget.scale(), 0u);
}

} // namespace
} // namespace sinew::viewer
