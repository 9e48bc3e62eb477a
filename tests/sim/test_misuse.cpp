// Tests that each mistake of a host gives one sentence, once, and that correct use gives none.
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>

using namespace sinew;
using namespace sinew::sim;
using test::queue;
using Sentences = std::vector<std::string>;

namespace {

constexpr Settings fewSubsteps{.substeps = 2};

// Records into a command buffer, submits it and waits for it.
void submit(const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBuffer commands = queue().begin();
    record(commands);
    queue().wait(queue().submit(commands));
}

void step(Simulation& simulation, const Step& step) {
    submit([&](VkCommandBuffer commands) { simulation.record(commands, step); });
}

Simulation& reset(Simulation& simulation) {
    submit([&](VkCommandBuffer commands) { simulation.recordReset(commands); });
    return simulation;
}

// Expects exactly one sentence that has all these parts.
void expectOne(const Sentences& said, std::initializer_list<const char*> parts) {
    ASSERT_EQ(said.size(), 1u) << ::testing::PrintToString(said);
    for (const char* part : parts) EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
}

// A row of balls that nearly touch: with a wide margin, each is near ten others.
Scene crowd(int count) {
    Scene scene{.name = "crowd", .gravity = {}};
    for (int i = 0; i < count; ++i)
        scene.particles.push_back({.position = {0.205f * static_cast<float>(i), 0, 0}, .radius = 0.1f});
    return scene;
}

} // namespace

TEST(Misuse, OfNothingIsNotSaid) {
    Scene scene = test::cuttableSheet();
    Settings settings = fewSubsteps;
    settings.grabs = settings.hostColliders = 2;
    Simulation simulation(test::device(), scene, settings);
    reset(simulation);
    const std::vector<Grab> grabs(2);
    const std::vector<HostCollider> hostColliders(2, {.radius = 0.01f, .pose = {{9, 9, 9}, {}}});
    for (std::uint64_t frame = 0; frame < 9; ++frame)
        step(simulation, {.frame = frame,
                          .grabs = grabs,
                          .hostColliders = hostColliders,
                          .blade = test::bladeAcrossSheet()});
    EXPECT_EQ(simulation.complaints(), Sentences{});
    EXPECT_EQ(simulation.oldestInFlight(), std::nullopt);
}

TEST(Misuse, OfPlacesFarFromTheOriginIsSaidOnce) {
    Scene scene = test::chain(6);
    EXPECT_EQ(warnings(scene), Sentences{});
    for (Particle& particle : scene.particles) particle.position.x += 4000;
    const Sentences said = warnings(scene);
    expectOne(said, {"positions are rounded to 0.24 mm at 4001 m from the origin", "place all within "});
    Simulation simulation(test::device(), scene, fewSubsteps);
    EXPECT_EQ(simulation.complaints(), said);
    EXPECT_EQ(simulation.complaints(), Sentences{});
}

TEST(Misuse, OfMoreGrabsOrPokesThanThereIsRoomForIsSaidOnce) {
    for (const std::uint32_t allowed : {0u, 1u}) {
        Settings settings = fewSubsteps;
        settings.grabs = settings.hostColliders = allowed;
        Simulation simulation(test::device(), test::chain(6), settings);
        reset(simulation);
        const std::vector<Grab> grabs(20);
        const std::vector<HostCollider> hostColliders(3, {.radius = 0.1f, .pose = {{9, 9, 9}, {}}});
        step(simulation, {.frame = 0});
        EXPECT_EQ(simulation.complaints(), Sentences{});
        step(simulation, {.frame = 1, .grabs = grabs});
        const std::string is = " is " + std::to_string(allowed);
        expectOne(simulation.complaints(), {"step 1", "20 grabs", ("settings.grabs" + is).c_str()});
        step(simulation, {.frame = 2, .grabs = grabs, .hostColliders = hostColliders});
        expectOne(simulation.complaints(),
                  {"step 2", "3 host colliders", ("settings.hostColliders" + is).c_str()});
        step(simulation, {.frame = 3, .grabs = grabs, .hostColliders = hostColliders});
        EXPECT_EQ(simulation.complaints(), Sentences{}) << "it was said";
    }
}

TEST(Misuse, OfMoreAnchorsThanAttachmentsIsSaid) {
    Scene scene = test::chain(6);
    scene.attachments = {{.particle = 5, .anchor = scene.particles[5].position, .compliance = 1e-3f}};
    Simulation simulation(test::device(), scene, fewSubsteps);
    reset(simulation);
    const std::vector<Vec3> anchors(4, scene.particles[5].position);
    step(simulation, {.frame = 0, .anchors = std::span(anchors).first(1)});
    EXPECT_EQ(simulation.complaints(), Sentences{});
    step(simulation, {.frame = 1, .anchors = anchors});
    expectOne(simulation.complaints(), {"step 1", "4 anchors", "has 1 attachment"});
}

TEST(Misuse, OfABladeWhereNothingMayBeCutIsSaid) {
    const RayCut ray{.from = {0, 1, 0}, .to = {0, -1, 0}, .radius = 0.1f};
    for (const Step& cutting : {Step{.blade = test::bladeAcrossSheet()}, Step{.ray = ray}}) {
        Simulation simulation(test::device(), test::sheet(4, 1e-5f), fewSubsteps);
        reset(simulation);
        step(simulation, cutting);
        expectOne(simulation.complaints(), {"step 0", "no body may be cut", "Grid::isCuttable"});
    }
}

TEST(Misuse, OfABladeThatIsNoneIsSaid) {
    const std::vector<Vec3> points(3, Vec3{0, 0, 0});
    const Vec3 nan{std::numeric_limits<float>::quiet_NaN(), 0, 0};
    const std::vector<Vec3> notFinite(3, nan), many(300, Vec3{});
    const Blade blades[] = {{.from = points, .to = std::span(points).first(2)},
                            {.from = std::span(points).first(1), .to = std::span(points).first(1)},
                            {.from = points, .to = notFinite},
                            {.from = {}, .to = points},
                            {.from = many, .to = many}};
    for (const Blade& blade : blades) {
        Simulation simulation(test::device(), test::cuttableSheet(), fewSubsteps);
        reset(simulation);
        step(simulation, {.blade = blade});
        expectOne(simulation.complaints(), {"step 0", "cuts nothing",
                                            ("from " + std::to_string(blade.from.size()) + " to " +
                                             std::to_string(blade.to.size()) + " points")
                                                .c_str()});
    }
}

TEST(Misuse, OfStepsBeforeTheFirstResetIsSaid) {
    Simulation simulation(test::device(), test::chain(6), fewSubsteps);
    step(simulation, {.frame = 7});
    expectOne(simulation.complaints(), {"step 7", "recordReset()"});
    reset(simulation);
    step(simulation, {.frame = 8});
    EXPECT_EQ(simulation.complaints(), Sentences{});
    Simulation next(test::device(), test::chain(6), fewSubsteps);
    submit([&](VkCommandBuffer commands) { next.recordTakeOver(commands, simulation); });
    step(next, {.frame = 9});
    EXPECT_EQ(next.complaints(), Sentences{}) << "a state that was taken over is one";
}

// Three frames in flight with three steps each.
TEST(Misuse, OfMoreStepsInFlightThanTheSettingSaysIsSaid) {
    for (const std::uint32_t allowed : {1u, 4u, 9u}) {
        Settings settings = fewSubsteps;
        settings.framesInFlight = allowed;
        Simulation simulation(test::device(), test::chain(6), settings);
        reset(simulation);
        const VkCommandBuffer commands = queue().begin(); // no step can finish before the submission
        for (std::uint64_t frame = 18; frame < 27; ++frame) simulation.record(commands, {.frame = frame});
        EXPECT_EQ(simulation.oldestInFlight(), 27 - allowed);
        queue().wait(queue().submit(commands));
        EXPECT_EQ(simulation.oldestInFlight(), std::nullopt);
        if (allowed < 9)
            expectOne(simulation.complaints(),
                      {("step " + std::to_string(18 + allowed)).c_str(), "step 18 has not finished",
                       ("framesInFlight is " + std::to_string(allowed)).c_str()});
        else
            EXPECT_EQ(simulation.complaints(), Sentences{});
        for (std::uint64_t frame = 18; frame < 27; ++frame) {
            const Status status = simulation.status(frame);
            EXPECT_EQ(status.isFinished, frame + allowed >= 27) << frame;
            EXPECT_EQ(status.frame, frame);
        }
    }
}

TEST(Misuse, OfTheNumberOfStepsInFlightIsRefused) {
    for (const std::uint32_t wrong : {0u, 65u})
        EXPECT_NE(test::refusal([&] {
                      Simulation(test::device(), test::chain(3), {.framesInFlight = wrong});
                  }).find("settings.framesInFlight: is " + std::to_string(wrong)),
                  std::string::npos);
}

TEST(Misuse, IsToldWithoutTheWarningsOfTheScene) {
    Scene scene = test::chain(6);
    for (Particle& particle : scene.particles) particle.position.x += 4000;
    ASSERT_EQ(warnings(scene).size(), 1u);
    Simulation told(test::device(), scene, fewSubsteps), ofUse(test::device(), scene, fewSubsteps);
    for (Simulation* simulation : {&told, &ofUse}) step(*simulation, {.frame = 0}); // without a reset
    EXPECT_EQ(told.complaints().size(), 2u);
    expectOne(ofUse.complaintsOfUse(), {"step 0", "recordReset"});
    EXPECT_EQ(ofUse.complaints(), Sentences{}) << "they are not told later";
}

// The lines of docs/embedding.md.
TEST(Misuse, OfRoomForContactsIsLoudAndHasACure) {
    const Scene scene = crowd(128);
    Settings settings = fewSubsteps;
    settings.contactRoom = 4;
    settings.contactMargin = 9;
    auto simulation = std::make_unique<Simulation>(test::device(), scene, settings);
    reset(*simulation);
    for (std::uint64_t frame = 0; frame < 6; ++frame) {
        step(*simulation, {.frame = frame});
        const Status status = simulation->status(frame);
        EXPECT_TRUE(status.isUndone);
        EXPECT_EQ(status.stepsUndone, frame + 1);
        EXPECT_EQ(status.contactRoom, 10u);
    }
    expectOne(simulation->complaints(), {"undone", "10 candidates for a particle on average",
                                         "settings.contactRoom is 4", "recordTakeOver"});
    step(*simulation, {.frame = 6});
    EXPECT_EQ(simulation->complaints(), Sentences{});

    settings.contactRoom = simulation->status(6).contactRoom;
    auto roomy = std::make_unique<Simulation>(test::device(), scene, settings);
    submit([&](VkCommandBuffer commands) { roomy->recordTakeOver(commands, *simulation); });
    simulation = std::move(roomy);
    step(*simulation, {.frame = 0});
    const Status status = simulation->status(0);
    EXPECT_FALSE(status.isUndone);
    EXPECT_EQ(status.stepsUndone, 0u);
    EXPECT_EQ(status.contactRoom, 0u);
    EXPECT_EQ(simulation->complaints(), Sentences{});
}
