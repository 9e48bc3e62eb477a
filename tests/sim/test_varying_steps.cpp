// Steps whose lengths change, of bodies whose links a substep clamps: they gain no energy
// (sim/simulation/pace.hpp).
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sim/simulation/pace.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace sinew::sim {
namespace {

// Held at one end; 31 substeps would be exact.
Scene beam() {
    Scene scene;
    const LatticeCorners corners =
        addLattice(scene, {.cells = {11, 3, 3}, .spacing = 0.02f, .youngModulus = 2e5f});
    for (std::uint32_t y = 0; y <= 3; ++y)
        for (std::uint32_t z = 0; z <= 3; ++z) scene.fixed.push_back({corners.at(0, y, z)});
    return scene;
}

// Hung by two corners; 54 substeps would be exact.
Scene cloth() {
    Scene scene;
    addCloth(scene, {.size = {17, 17},
                     .spacing = 1 / 16.0f,
                     .stretchCompliance = 1e-3f,
                     .shearCompliance = 1e-2f,
                     .pinned = {0, 16}});
    return scene;
}

using LengthOf = std::function<float(int step)>; // of a step, by the scene's dt

const std::pair<const char*, LengthOf> patterns[] = {
    {"6:1", [](int s) { return s % 2 == 0 ? 1.0f : 1 / 6.0f; }},
    {"3:1", [](int s) { return s % 2 == 0 ? 1.0f : 1 / 3.0f; }},
    {"2:1", [](int s) { return s % 2 == 0 ? 1.0f : 1 / 2.0f; }},
    {"random", [random = std::mt19937(1)](
                   int) mutable { return std::uniform_real_distribution<float>(1 / 6.0f, 1)(random); }},
    {"one long in 10", [](int s) { return s % 10 == 0 ? 1.0f : 1 / 6.0f; }},
    {"one long in 60", [](int s) { return s % 60 == 0 ? 1.0f : 1 / 6.0f; }},
};

// The largest kinetic energy in each quarter of 2,000 steps [J].
std::vector<double> energies(const Scene& scene, const Settings& settings, const LengthOf& lengthOf) {
    test::Runner runner(scene, settings);
    std::vector<double> energies(4, 0);
    for (int s = 0; s < 2000; ++s) {
        const Status status = runner.step(scene.dt * lengthOf(s));
        EXPECT_TRUE(status.isFinished && status.nonFinite == 0) << "step " << s;
        if (testing::Test::HasFailure()) break;
        double& most = energies[static_cast<std::size_t>(s / 500)];
        most = std::max(most, test::kineticEnergy(scene, runner.velocities()));
    }
    return energies;
}

// The fall at the start has the most kinetic energy that the body can have from its weight.
TEST(VaryingSteps, FeedNoEnergyIntoClampedBodies) {
    const std::tuple<const char*, Scene, std::uint32_t> bodies[] = {{"beam", beam(), 5},
                                                                    {"cloth", cloth(), 6}};
    for (const auto& [body, scene, substeps] : bodies)
        for (const auto& [levels, isSharp] : {std::pair(0u, false), {2u, false}, {0u, true}})
            for (const auto& [pattern, lengthOf] : patterns) {
                const std::string clamp = isSharp ? ", sharp clamp" : "";
                SCOPED_TRACE(std::string(body) + ", levels " + std::to_string(levels) + clamp + ", " +
                             pattern);
                const std::vector<double> quarters = energies(
                    scene, {.substeps = substeps, .levels = levels, .hasSharpClamp = isSharp}, lengthOf);
                for (const double energy : quarters) EXPECT_LE(energy, 1.2 * quarters[0]);
                EXPECT_LE(quarters[3], quarters[0]);
                std::printf("%s, levels %u%s, %s: %.3g %.3g %.3g %.3g J\n", body, levels, clamp.c_str(),
                            pattern, quarters[0], quarters[1], quarters[2], quarters[3]);
            }
}

// A state that is saved while stiffness returns goes on to the same bits.
TEST(VaryingSteps, AreRememberedByASavedState) {
    const Scene scene = beam();
    test::Runner runner(scene, {.substeps = 5}), other(scene, {.substeps = 5});
    runner.run(3);
    for (int s = 0; s < 4; ++s) runner.step(scene.dt / 6);
    const auto saved = runner.save();
    other.load(saved);
    for (int s = 0; s < 4; ++s) {
        runner.step(scene.dt / 6);
        other.step(scene.dt / 6);
        ASSERT_EQ(runner.stateHash(), other.stateHash()) << s;
    }
}

TEST(Pace, IsTheSubstepWhereStepsAreEqualAndForgetsLongerOnes) {
    Pace pace;
    for (const float h : {1e-3f, 1e-3f, 1e-3f}) {
        ASSERT_EQ(pace.longestOf(8 * h, h), h);
        pace = pace.next(8 * h, h);
        ASSERT_EQ(pace.longest, h);
    }
    pace = pace.next(32e-3f, 4e-3f);
    EXPECT_EQ(pace.longest, 4e-3f) << "at once";
    EXPECT_EQ(pace.longestOf(8e-3f, 1e-3f), 4e-3f) << "the first kick spans half of the last substep";
    const int steps = 125; // 1 s
    for (int s = 0; s < steps; ++s) pace = pace.next(8e-3f, 1e-3f);
    EXPECT_NEAR(pace.longest, 4e-3 * std::exp(-0.5), 5e-5);
    for (int s = 0; s < 2 * steps; ++s) pace = pace.next(8e-3f, 1e-3f);
    EXPECT_EQ(pace.longest, 1e-3f) << "after 3 s";
}

TEST(Pace, CountsTheLongSubstepsOfAnotherProgramInTheFirstKickAlone) {
    Pace pace = Pace{8e-3f, 8e-3f}.inSubsteps(1, 8);
    EXPECT_EQ(pace.longestOf(8e-3f, 1e-3f), 8e-3f);
    pace = pace.next(8e-3f, 1e-3f);
    EXPECT_EQ(pace.longestOf(8e-3f, 1e-3f), 1e-3f);
    EXPECT_EQ((Pace{1e-3f, 1e-3f}.inSubsteps(7, 7).longest), 1e-3f) << "to the bit";
}

// A beam that was too soft for lack of substeps is as stiff as they make it within a second.
TEST(VaryingSteps, ATakeOverWithMoreSubstepsIsSoonStiff) {
    Scene scene = beam();
    scene.damping = 20;
    const auto meanSag = [](test::Runner& runner) { // over half a second
        double sum = 0;
        for (int s = 0; s < 30; ++s) {
            runner.run(1);
            double lowest = 0;
            for (const auto& x : runner.positions()) lowest = std::min(lowest, x[1]);
            sum += lowest / 30;
        }
        return sum;
    };
    test::Runner few(scene, {.substeps = 16}), more(scene, {.substeps = 32}), all(scene, {.substeps = 32});
    few.run(60);
    all.run(60);
    more.takeOver(few);
    more.run(60);
    const double sag = meanSag(all), softSag = meanSag(few);
    EXPECT_LT(softSag, 1.5 * sag) << "16 substeps are too few";
    EXPECT_NEAR(meanSag(more), sag, -0.1 * sag) << "from " << softSag;
}

} // namespace
} // namespace sinew::sim
