// Tests of the conclusions that a study draws from its points, and of its plots.
#include "sinew/study/analysis.hpp"
#include "sinew/study/page.hpp"
#include "sinew/study/plan.hpp"
#include "sinew/study/plot_axes.hpp"
#include "sinew/study/plot_labels.hpp"
#include "sinew/study/rest_report.hpp"

#include "sim/compile/compile.hpp"
#include "sim/reference/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

using namespace sinew;
using namespace sinew::tools::study;

namespace {

using Indices = std::vector<std::size_t>;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

/// A trial that takes `ms` a frame with the error `error` in each of two frames; without an error it
/// diverged.
Trial trialOf(sim::Solver solver, double ms, std::optional<double> error) {
    Trial trial{
        .settings = {.solver = solver, .hasSharpClamp = true}, .sweeps = 8, .barriers = 9, .isRun = true};
    trial.isDiverged = !error;
    trial.frameRms.assign(2, error.value_or(0));
    trial.frameMax.assign(2, error.value_or(0));
    trial.add({ms});
    return trial;
}

SceneResult resultOf(std::vector<Trial> trials) {
    SceneResult result{.name = "scene", .frames = 2, .dt = 1.0 / 60};
    result.truth.growth = {0, 0};
    result.truth.motion = {0.1, 0.1}; // a body that does not move is off by a tenth of its size
    result.trials = std::move(trials);
    return result;
}

/// Samples of (time [s], kinetic energy [J]), with a depth of 0.1 m before 4 s and 0.04 m afterwards.
RestRun restOf(const std::vector<std::pair<double, double>>& samples) {
    RestRun run{.settings = {.substeps = 16}, .isRun = true};
    for (const auto& [time, energy] : samples)
        run.samples.push_back({.time = time,
                               .kineticEnergy = energy,
                               .penetrationMax = time < 4 ? 0.1 : 0.04,
                               .penetrationRms = 0.01});
    return run;
}

} // namespace

TEST(ParetoFront, KeepsWhatNobodyUndercuts) {
    const std::vector<Offer> offers{{4, 0.1}, {1, 0.5}, {2, 0.6},  {2, 0.2},
                                    {8, 0.1}, {16, {}}, {0.5, {}}, {3, 0.05}};
    EXPECT_EQ(paretoFront(offers), (Indices{1, 3, 7}));
    EXPECT_EQ(paretoFront(std::vector<Offer>{{1, {}}}), Indices{});
    EXPECT_EQ(paretoFront(std::vector<Offer>{{2, 0.1}, {2, 0.1}}).size(), 1u);
}

TEST(CostOfError, InterpolatesInLogarithms) {
    const std::vector<Offer> front{{1, 1.0}, {100, 1e-4}};
    EXPECT_NEAR(*costOfError(front, 1e-2), 10, 1e-9);
    EXPECT_NEAR(*costOfError(front, 1e-4), 100, 1e-9);
    EXPECT_NEAR(*costOfError(front, 1.5), 1, 1e-9) << "the cheapest point is good enough";
    EXPECT_FALSE(costOfError(front, 1e-5).has_value());
    EXPECT_FALSE(costOfError({}, 1).has_value());
}

TEST(ComparableFrames, AreAllWhereNothingGrows) {
    EXPECT_EQ(comparableFrames(std::vector{1e-9, 1e-9, 1e-9}, std::vector{1e-7, 2e-7, 5e-7}, 1e-7), 3u);
}

TEST(ComparableFrames, EndWhereADisturbanceReachesATenthOfTheError) {
    const std::vector<double> growth{1e-7, 1e-5, 2e-3, 0.5};
    // Over four frames the error is 0.1, and the growth of the last frame exceeds a tenth of it.
    EXPECT_EQ(comparableFrames(std::vector{0.1, 0.1, 0.1, 0.1}, growth, 1e-7), 3u);
    // Over three frames it is 1e-3, and the third frame's growth exceeds a tenth of it; over two it is still
    // 1e-3.
    EXPECT_EQ(comparableFrames(std::vector{1e-3, 1e-3, 1e-3, 5e-3}, growth, 1e-7), 2u);
    EXPECT_EQ(comparableFrames(std::vector{1e-6, 1e-6, 1e-6, 1e-6}, growth, 1e-7), 1u);
}

TEST(RmsOver, IsTheRootOfTheMeanSquare) {
    EXPECT_NEAR(rmsOver(std::vector{3.0, 4.0, 100.0}, 2), std::sqrt(12.5), 1e-12);
    EXPECT_EQ(rmsOver({}, 0), 0);
}

TEST(Plan, TriesEverySolverWithinTheAllowedSettings) {
    for (const std::string& name : sim::solverNames()) {
        sim::Solver solver{};
        ASSERT_TRUE(sim::parseSolver(name, solver));
        std::set<std::uint32_t> sweeps;
        for (const sim::Settings& settings : settingsToTry(solver, mostPoints)) {
            EXPECT_EQ(settings.solver, solver);
            EXPECT_GE(settings.substeps, 1u);
            EXPECT_LE(settings.substeps, 1000u);
            sweeps.insert(settings.substeps * settings.iterations);
        }
        for (const std::uint32_t rung : {8u, 16u, 32u, 64u, 128u, 256u, 512u, 1000u})
            EXPECT_TRUE(sweeps.contains(rung)) << name << ' ' << rung;
        for (const std::uint32_t between : {11u, 23u, 45u})
            EXPECT_EQ(sweeps.contains(between), solver != sim::Solver::jacobi) << name << ' ' << between;
        EXPECT_LT(settingsToTry(solver, 1).size(), settingsToTry(solver, 2).size());
    }
}

TEST(Plan, SearchesAllTuningsOfTheBaseline) {
    std::set<std::tuple<std::uint32_t, float, float>> tried;
    std::size_t runs = 0;
    for (const sim::Settings& settings : settingsToTry(sim::Solver::jacobi, 4))
        if (settings.substeps * settings.iterations == 64) {
            tried.insert({settings.iterations, settings.weight, settings.overRelaxation});
            ++runs;
        }
    for (const std::uint32_t iterations : {1u, 4u, 16u, 64u}) {
        for (const float omega : {1.0f, 1.3f, 1.6f})
            EXPECT_TRUE(tried.contains({iterations, 0.0f, omega})) << iterations << ' ' << omega;
        for (const float weight : {0.5f, 1.0f})
            EXPECT_TRUE(tried.contains({iterations, weight, 1.0f})) << iterations << ' ' << weight;
    }
    EXPECT_EQ(tried.size(), 4u * 5u);
    EXPECT_EQ(runs, tried.size()) << "none twice";
}

TEST(Plan, SearchesIterationsOfColoredSweepsWarmAndCold) {
    std::set<std::pair<std::uint32_t, float>> tried;
    for (const sim::Settings& settings : settingsToTry(sim::Solver::gaussSeidel, 4))
        if (settings.substeps * settings.iterations == 64)
            tried.insert({settings.iterations, settings.warmStart});
    const float warm = sim::Settings{}.warmStart;
    ASSERT_GT(warm, 0);
    for (const std::uint32_t iterations : {1u, 2u, 4u, 64u})
        for (const float start : {warm, 0.0f})
            EXPECT_TRUE(tried.contains({iterations, start})) << iterations << ' ' << start;
    EXPECT_EQ(tried.size(), 4u * 2u);
}

TEST(Plan, SplitsOneNumberOfSweepsWithoutTryingAnythingTwice) {
    for (const sim::Solver solver : {sim::Solver::jacobi, sim::Solver::split, sim::Solver::gaussSeidel})
        for (const std::uint32_t sweeps : {4u, 8u, 16u}) { // some of them take the whole frame
            using Key = std::tuple<std::uint32_t, float, std::uint32_t, bool, float, float, float>;
            std::set<Key> tried;
            const std::vector<sim::Settings> list = settingsAt(solver, sweeps);
            for (const sim::Settings& s : list) {
                EXPECT_EQ(s.substeps * s.iterations, sweeps);
                tried.insert(Key{s.iterations, s.theta, s.levels, s.hasSharpClamp, s.weight, s.overRelaxation,
                                 s.warmStart});
            }
            EXPECT_EQ(tried.size(), list.size()) << sim::solverName(solver) << ' ' << sweeps;
            EXPECT_GE(list.size(), 2u);
        }
}

TEST(Plan, HasFiveElasticScenesWhoseTruthCanBeComputedAndFourOfContacts) {
    const std::vector<StudyScene> scenes = studyScenes("all", {});
    ASSERT_EQ(scenes.size(), 9u);
    EXPECT_EQ(studySceneNames().size(), 9u);
    std::size_t touching = 0;
    for (const StudyScene& scene : scenes) {
        EXPECT_GE(scene.frames * double{scene.loaded.scene.dt}, 0.29);
        if (isOfContacts(scene.loaded.scene)) {
            ++touching;
            EXPECT_LT(scene.points, mostPoints) << scene.name << ": its runs end where 1 % is long reached";
            continue;
        }
        EXPECT_NO_THROW(sim::reference::trueTrajectory(scene.loaded.scene, {.frames = 1, .dt = 1e-5}))
            << scene.name;
        EXPECT_EQ(scene.points, mostPoints);
    }
    EXPECT_EQ(touching, 4u);
    EXPECT_EQ(studyScenes("chain", 7).at(0).frames, 7u);
}

TEST(Plan, LetsEverySolverThatCanDoAContactSceneComeToRest) {
    std::vector<StudyScene> loose = studyScenes("clutter", {}), cube = studyScenes("cube", {});
    std::set<std::pair<std::string, std::uint32_t>> tried;
    for (const sim::Settings& s : restSettings(loose.at(0)))
        tried.insert({sim::solverName(s.solver), s.substeps});
    EXPECT_EQ(tried,
              (std::set<std::pair<std::string, std::uint32_t>>{{"split", 8}, {"split", 16}, {"split", 32}}))
        << "no other has a form for particles that touch";
    tried.clear();
    for (const sim::Settings& s : restSettings(cube.at(0)))
        tried.insert({sim::solverName(s.solver), s.substeps});
    EXPECT_TRUE(tried.contains({"jacobi", 32}));
    EXPECT_TRUE(tried.contains({"gauss_seidel", 32}));
    EXPECT_TRUE(tried.contains({"split", 8}));
    loose.at(0).loaded.settings.contactRoom = 77;
    for (const sim::Settings& s : restSettings(loose.at(0))) EXPECT_EQ(s.contactRoom, 77u) << "of the file";
}

TEST(Truth, IsDoubtedWhereHalvingOrChaosSaysSo) {
    Truth truth;
    truth.growth = {1e-7, 1e-5, 2e-3, 0.5};
    EXPECT_EQ(truth.doubt(), truth.growth);
    EXPECT_EQ(framesAtTarget(truth), 2u) << "a tenth of 1 % is 1e-3";
    truth.halving = {1e-6, 2e-3, 1e-3, 1e-3};
    EXPECT_EQ(truth.doubt(), (std::vector{1e-6, 2e-3, 2e-3, 0.5}));
    EXPECT_EQ(framesAtTarget(truth), 1u);
}

TEST(Truth, OfContactsComparesAllRunsOverTheSameFrames) {
    Truth truth;
    truth.growth = {1e-7, 1e-5, 9e-4, 0.5};
    const std::vector good{1e-4, 1e-4, 1e-4, 1e-4}, bad{0.5, 0.5, 0.5, 0.5};
    EXPECT_LT(comparableFrames(good, truth), comparableFrames(bad, truth));
    truth.halving = {0, 1e-5, 0, 0};
    EXPECT_EQ(comparableFrames(good, truth), 3u);
    EXPECT_EQ(comparableFrames(bad, truth), 3u);
    truth.halving[0] = 1;
    EXPECT_EQ(comparableFrames(bad, truth), 1u) << "at least one";
    EXPECT_EQ(errorOf(trialOf(sim::Solver::split, 1, 0.01), truth)->frames, 1u);
}

TEST(Truth, OfContactsIsMeasuredByTheLargestBody) {
    sim::Scene scene;
    for (const float x : {0.0f, 3.0f, 4.0f, 100.0f})
        scene.particles.push_back({.position = {x, 0, 0}, .radius = 0.5f});
    EXPECT_NEAR(largestBody(scene), 1, 1e-6) << "balls";
    scene.distances = {{1, 2, 1, 0}};
    scene.particles[3].inverseMass = 0;
    scene.particles[1].radius = scene.particles[2].radius = 0;
    EXPECT_NEAR(largestBody(scene), 1, 1e-6);
    scene.particles[2].position.y = 5;
    EXPECT_NEAR(largestBody(scene), std::sqrt(26), 1e-6);
}

TEST(Rest, IsReachedWhereEnergyStaysLow) {
    const RestRun run = restOf({{1, 100}, {2, 0.05}, {3, 1}, {4, 0.05}, {5, 0.01}});
    EXPECT_EQ(timeToRest(run, 1e-3), 4);
    EXPECT_EQ(timeToRest(run, 1e-2), 2);
    EXPECT_FALSE(timeToRest(run, 1e-5).has_value());
    EXPECT_NEAR(*deepest(run), 0.1, 1e-12);
    EXPECT_NEAR(*deepest(run, 4), 0.04, 1e-12);
    EXPECT_FALSE(timeToRest(RestRun{}, 1).has_value());
}

TEST(Rest, IsWrittenDrawnAndTabulated) {
    SceneResult result = resultOf({trialOf(sim::Solver::split, 1, 0.01)});
    EXPECT_TRUE(restPlots(result).empty());
    EXPECT_EQ(restTable(result), "");
    result.isOfContacts = true;
    result.rest = {restOf({{1, 100}, {2, 1}, {3, 0}}), restOf({{1, 1}})};
    result.rest[1].isDiverged = true;
    const std::vector<Plot> plots = restPlots(result);
    ASSERT_EQ(plots.size(), 2u);
    for (const Plot& plot : plots) {
        ASSERT_EQ(plot.curves.size(), 1u) << "a diverged one has no line";
        EXPECT_EQ(plot.curves[0].points.size(), 3u);
        const std::string svg = draw(plot, Style::own);
        EXPECT_EQ(count(svg, "class=\"line\""), 1u);
        EXPECT_EQ(count(svg, "class=\"dot\"") + count(svg, "class=\"target\"") + count(svg, "class=\"best\""),
                  0u);
        EXPECT_EQ(count(svg, ">split 16</text>"), 2u) << "the name and the paper around it";
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
    }
    EXPECT_EQ(count(restTable(result), "<tr><td>"), 2u);
    EXPECT_NE(restTable(result).find("100 mm"), std::string::npos);
    EXPECT_NE(restText(result).find("diverged"), std::string::npos);
}

TEST(Headline, ComparesWithJacobiAtEqualError) {
    using enum sim::Solver;
    const SceneResult result = resultOf({trialOf(jacobi, 10, 0.1), trialOf(jacobi, 1000, 1e-3),
                                         trialOf(split, 1, 0.1), trialOf(split, 4, 1e-3)});
    const std::vector<Curve> curves = curvesOf(result);
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_NEAR(*curves[0].costOf(targetError, prices[0]), 100, 1e-9);
    EXPECT_NEAR(*curves[1].costOf(targetError, prices[0]), 2, 1e-9);
    const std::optional<Advantage> advantage = advantageOf(curves[1], curves);
    ASSERT_TRUE(advantage.has_value());
    EXPECT_NEAR(advantage->ratio, 50, 1e-9);
    EXPECT_FALSE(advantage->isBound);
}

TEST(Headline, ComparesWithAveragingAndShowsWeightsBesideIt) {
    using enum sim::Solver;
    Trial weighted = trialOf(jacobi, 20, 0.01);
    weighted.settings.weight = 1;
    const SceneResult result = resultOf({trialOf(jacobi, 80, 0.05), weighted, trialOf(split, 4, 0.01)});
    const std::vector<Curve> curves = curvesOf(result);
    ASSERT_EQ(curves.size(), 3u);
    EXPECT_EQ(curves[0].solver, "jacobi");
    EXPECT_FALSE(curves[0].costOf(targetError, prices[0]).has_value());
    EXPECT_EQ(curves[2].solver, "jacobi_weighted");
    EXPECT_NEAR(*curves[2].costOf(targetError, prices[0]), 20, 1e-9);
    EXPECT_TRUE(advantageOf(curves[1], curves)->isBound);
}

TEST(Headline, IsABoundWhereJacobiNeverGetsThere) {
    using enum sim::Solver;
    const SceneResult result = resultOf({trialOf(jacobi, 10, 0.1), trialOf(jacobi, 80, 0.05),
                                         trialOf(jacobi, 99, {}), trialOf(split, 4, 0.01)});
    const std::vector<Curve> curves = curvesOf(result);
    EXPECT_FALSE(curves[0].costOf(targetError, prices[0]).has_value());
    const std::optional<Advantage> advantage = advantageOf(curves[1], curves);
    ASSERT_TRUE(advantage.has_value());
    EXPECT_NEAR(advantage->ratio, 80.0 / 4, 1e-9);
    EXPECT_TRUE(advantage->isBound);
    EXPECT_FALSE(advantageOf(curves[0], curves).has_value());
}

TEST(Error, OfTheMotionIsThatOfABodyThatStandsStill) {
    Truth truth;
    truth.growth = {0, 0, 0};
    truth.motion = {3, 4, 100};
    EXPECT_NEAR(truth.standingStill(2), std::sqrt(12.5), 1e-12);
    EXPECT_NEAR(truth.standingStill(), std::sqrt((9 + 16 + 10000) / 3.0), 1e-12);
    Trial trial = trialOf(sim::Solver::split, 1, 0.5);
    EXPECT_NEAR(errorOf(trial, truth)->ofMotion.value(), 0.5 / std::sqrt(12.5), 1e-12) << "over two frames";
    truth.motion = {0, 0, 0};
    EXPECT_FALSE(errorOf(trial, truth)->ofMotion.has_value()) << "nothing moves";
    trial.isDiverged = true;
    EXPECT_FALSE(errorOf(trial, truth).has_value());
}

TEST(Headline, HasATimeToAShareOfTheMotionToo) {
    using enum sim::Solver;
    const SceneResult result = resultOf({trialOf(split, 1, 0.01), trialOf(split, 4, 1e-4)});
    const Curve curve = curvesOf(result).at(0);
    EXPECT_NEAR(*curve.costOf(0.01, prices[0]), 1, 1e-9);
    EXPECT_NEAR(*curve.costOf(0.01, prices[0], Scale::motion), 2, 1e-9) << "a tenth of the error is asked";
    EXPECT_NE(toHtml({.device = {}, .scenes = {result}}).find("to 1 % of the motion"), std::string::npos);
}

TEST(Repeats, HaveAMedianEachAndASpread) {
    Trial trial;
    trial.add({1, 9, 2});
    trial.add({4});
    ASSERT_EQ(trial.repeats.size(), 2u);
    EXPECT_GE(trial.repeats[0].load, 0);
    EXPECT_EQ(trial.repeatMs(), (std::vector<double>{2, 4}));
    EXPECT_EQ(trial.medianMs(), 2) << "of all frames";
}

TEST(Plot, DrawsWhiskersAndTheLineOfABodyThatStandsStill) {
    Plot plot{.title = "t",
              .xLabel = "ms",
              .standing = 0.13,
              .curves = {{.label = "split",
                          .slot = 1,
                          .points = {{1, 0.1, true, 0.5, 3}, {4, 1e-4, true}, {8, 0.2, false, 1, 9}},
                          .xAtTarget = {}}}};
    const std::string svg = draw(plot, Style::own);
    EXPECT_EQ(count(svg, "class=\"whisker\""), 1u) << "only of the front";
    EXPECT_EQ(count(svg, "class=\"standing\""), 1u);
    EXPECT_EQ(count(svg, ">standing still</text>"), 1u);
    EXPECT_LE(axesFor(plot).xLow, 0.5) << "the whisker is inside";
    plot.standing = 40; // of body sizes
    EXPECT_GE(axesFor(plot).yHigh, 40) << "the line is inside";
    plot.standing = 0;
    EXPECT_EQ(count(draw(plot, Style::own), "class=\"standing\""), 0u);
}

TEST(Labels, CoverNoMarkerOfTheirOwnCurveOrAnother) {
    const Box box{0, 0, 400, 300};
    LabelPlacer placer(box);
    // A straight front whose faint points lie around its end on all sides but far below.
    const std::vector<Spot> front{{200, 100}};
    placer.avoid(front, 0);
    for (const double x : {120.0, 160.0, 200.0, 240.0, 280.0})
        for (const double y : {70.0, 90.0, 110.0, 130.0}) placer.avoidMark({x, y}, 2.3);
    const Label label = placer.place("jacobi", front, 0);
    for (const double x : {120.0, 160.0, 200.0, 240.0, 280.0})
        for (const double y : {70.0, 90.0, 110.0, 130.0})
            EXPECT_FALSE(x > label.x && x < label.x + 50 && y > label.y - 11 && y < label.y + 3)
                << label.x << ' ' << label.y;
    EXPECT_NEAR(label.y, 100, 70) << "near its curve";
}

TEST(Plot, LeavesNoPointOutAndDrawsDivergedOnesAtTheTopEdge) {
    const Plot plot{
        .title = "a < b",
        .xLabel = "ms",
        .curves = {
            {.label = "jacobi",
             .slot = 0,
             .points = {{3, 0.5, false}, {5, {}, false}, {1, 0.4, true}, {9, 0.02, true}},
             .xAtTarget = {}},
            {.label = "split", .slot = 1, .points = {{1, 0.1, true}, {4, 1e-4, true}}, .xAtTarget = 2}}};
    const std::string svg = draw(plot, Style::own);
    EXPECT_EQ(count(svg, "class=\"dot\""), 4u);
    EXPECT_EQ(count(svg, "class=\"faint\""), 1u);
    EXPECT_EQ(count(svg, "class=\"hollow\""), 1u);
    EXPECT_EQ(count(svg, "class=\"ring\""), 1u);
    EXPECT_EQ(count(svg, "class=\"line\""), 2u);
    EXPECT_EQ(count(svg, "class=\"best\""), 1u);
    EXPECT_EQ(count(svg, ">jacobi</text>"), 2u) << "the name and the paper around it";
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    const std::string inPage = draw(plot, Style::fromPage);
    EXPECT_EQ(inPage.find("<style>"), std::string::npos);
}

TEST(Plot, DrawsWhatHasNoFinitePoint) {
    const std::string svg =
        draw({.title = "t",
              .xLabel = "x",
              .curves = {{.label = "s", .slot = 2, .points = {{1, {}, false}}, .xAtTarget = {}}}},
             Style::own);
    EXPECT_EQ(count(svg, "class=\"hollow\""), 1u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Axes, TickAtOneTwoFiveOrAtDecades) {
    EXPECT_EQ(ticks(1.5, 60), (std::vector<double>{2, 5, 10, 20, 50}));
    EXPECT_EQ(ticks(1, 10'000), (std::vector<double>{1, 10, 100, 1000, 10'000}));
}

TEST(Axes, TickTimesFromNought) {
    EXPECT_EQ(linearTicks(4), (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}));
    EXPECT_EQ(linearTicks(10), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
    for (const double high : {0.03, 0.07, 1.0, 13.0, 99.0, 100.0}) {
        EXPECT_GE(linearTicks(high).size(), 4u) << high;
        EXPECT_LE(linearTicks(high).size(), 12u) << high;
    }
}

TEST(Axes, WriteErrorsAsPercent) {
    EXPECT_EQ(percentText(1), "100 %");
    EXPECT_EQ(percentText(0.01), "1 %");
    EXPECT_EQ(percentText(1e-5), "0.001 %");
    EXPECT_EQ(percentText(1e-8), "10⁻⁶ %");
}
