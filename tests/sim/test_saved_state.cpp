// Tests that loading a saved state restores every bit, whatever happened since.
#include "sim/collision/contact_scenes.hpp"
#include "sim/collision/face_scenes.hpp"
#include "sim/program/program_values.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <set>

using namespace sinew;
using namespace sinew::sim;

namespace {

// Continues from a saved state twice; expects equal bits, which are also those of a run without saving.
void expectTheSameBits(const Scene& scene, const Settings& settings, int before, int after) {
    test::Runner runner(scene, settings), other(scene, settings);
    runner.run(before);
    const test::Runner::Saved saved = runner.save();
    runner.run(after);
    const std::uint64_t first = runner.stateHash();
    runner.run(3);
    runner.load(saved);
    runner.run(after);
    EXPECT_EQ(runner.stateHash(), first);
    other.run(before + after);
    EXPECT_EQ(other.stateHash(), first) << "saving changed something";
}

} // namespace

TEST(SavedState, OfEverySolverGoesOnWithTheSameBits) {
    Scene scene = test::sheet(12, 1e-5f);
    test::addRoom(scene);
    for (const Solver solver : {Solver::split, Solver::jacobi, Solver::gaussSeidel}) {
        SCOPED_TRACE(::testing::PrintToString(solver));
        expectTheSameBits(
            scene, {.solver = solver, .substeps = 8, .iterations = solver == Solver::split ? 1u : 3u}, 7, 9);
        expectTheSameBits(scene, {.solver = solver, .substeps = 8}, 0, 4);
    }
}

TEST(SavedState, OfAGridAndOfWhatIsResident) {
    const Scene scene = test::block(5, 0.1f, 1e5f, 0.05f);
    expectTheSameBits(scene, {.substeps = 9}, 5, 6);
    expectTheSameBits(scene, {.substeps = 8, .forms = {.residentBytes = 32768}}, 5, 6);
}

TEST(SavedState, HasContactsWithTheirMemoryAndWhoSleeps) {
    Scene scene;
    test::addBalls(scene, 4, 2.3f * test::ballRadius, 0.2f * test::ballRadius, {0, 0.3f, 0});
    scene.contacts.friction = 0.5f;
    scene.planes = {{.friction = 0.5f}};
    expectTheSameBits(scene, {.substeps = 8, .sleeps = true}, 30, 10);
    expectTheSameBits(scene, {.substeps = 8, .sleeps = true}, 130, 5);
}

TEST(SavedState, LeavesOutWhatAStepMakesAnew) {
    Scene scene = test::fallingFold();
    for (int c = 0; c < 12; ++c) // more than eight: groups look for those near them
        scene.colliders.push_back(
            {.radius = 0.05f, .pose = {.position = {0.1f * static_cast<float>(c) - 0.5f, 0.02f, 0}}});
    const Settings settings{.substeps = 8, .keepsForces = true, .motions = 2};
    test::Runner runner(scene, settings);
    const StepProgram& program = runner.simulation().program();
    std::set<std::string> all, saved;
    std::uint64_t size = 0;
    for (const BufferSpec& buffer : program.buffers) all.insert(buffer.label);
    for (const BufferId buffer : writtenByStep(program)) {
        saved.insert(program.buffers[buffer.index].label);
        size += runner.simulation().view(buffer).size;
    }
    for (const char* label :
         {"forces.terms", "forces.colliders", "colliders.near", "faces.touched", "motions.placed"}) {
        EXPECT_TRUE(all.contains(label)) << label;
        EXPECT_FALSE(saved.contains(label)) << label;
    }
    EXPECT_EQ(runner.simulation().stateSize(), size);
    expectTheSameBits(scene, settings, 30, 10);
}

TEST(SavedState, KnowsWhereAnchorsAndCollidersAre) {
    Scene scene = test::block(3, 0.1f, 1e5f, 0.3f);
    scene.attachments = {{.particle = 0, .anchor = scene.particles[0].position, .compliance = 1e-4f}};
    scene.colliders = {{.radius = 0.1f}};
    scene.colliders[0].path = {{.time = 0, .pose = {.position = {-1, 0.2f, 0}}},
                               {.time = 1, .pose = {.position = {1, 0.2f, 0}}}};
    test::Runner runner(scene, {.substeps = 8});
    Vec3 anchor = scene.attachments[0].anchor;
    const auto step = [&](float way) {
        anchor.y += way;
        runner.step(1.0f / 60, std::array{anchor});
    };
    for (int s = 0; s < 20; ++s) step(0.01f);
    const test::Runner::Saved saved = runner.save();
    const Vec3 savedAnchor = anchor;
    for (int s = 0; s < 10; ++s) step(-0.02f);
    const std::uint64_t first = runner.stateHash();
    for (int s = 0; s < 7; ++s) step(0.03f);
    runner.load(saved);
    EXPECT_NEAR(runner.simulation().colliderPoses()[0].position.x, -1 + 2 * 20.0f / 60, 1e-5f);
    anchor = savedAnchor;
    for (int s = 0; s < 10; ++s) step(-0.02f);
    EXPECT_EQ(runner.stateHash(), first);
}
