// Tests of step programs without a device: errors of the builder, the passes of scenes, and the printed form.
#include "kernels.hpp"
#include "sim/compile/compile.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

using namespace sinew;
using namespace sinew::sim;

namespace {

using Vec4 = std::array<float, 4>;
using Words = std::array<std::uint32_t, 20>; // the size of the step parameters

// The arguments of predict.comp: two lists of vec4, the step parameters, and a count as push constant.
struct Predict {
    ProgramBuilder builder{false};
    BufferId positions = builder.scratch<Vec4>("positions", 8),
             velocities = builder.scratch<Vec4>("velocities", 8);
    BufferId step = builder.scratch<Words>("step", 1);
    std::uint32_t count = 8;
};

void expectNames(const std::string& message, std::initializer_list<const char*> words) {
    for (const char* word : words)
        EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
}

bool hasBuffer(const StepProgram& program, const std::string& part) {
    return std::any_of(program.buffers.begin(), program.buffers.end(), [&](const BufferSpec& buffer) {
        return buffer.label.find(part) != std::string::npos;
    });
}

std::size_t countPasses(const StepProgram& program, const std::string& label) {
    return static_cast<std::size_t>(std::count_if(program[List::step].begin(), program[List::step].end(),
                                                  [&](const Pass& pass) { return pass.label == label; }));
}

std::set<std::string> labels(const StepProgram& program) {
    std::set<std::string> result;
    for (const Pass& pass : program[List::step]) result.insert(pass.label);
    return result;
}

Scene inRoom(Scene scene) {
    test::addRoom(scene);
    return scene;
}

} // namespace

TEST(ProgramBuilder, TakesWhatAgreesWithTheKernel) {
    Predict p;
    p.builder.beginPhase("solve");
    p.builder.dispatch(kernels::predict, 8, {p.positions, p.velocities, p.step}, p.count);
    const StepProgram program = p.builder.finish();
    ASSERT_EQ(program[List::step].size(), 1u);
    EXPECT_EQ(program[List::step][0].label, "predict");
    EXPECT_EQ(program[List::step][0].uses[0].access, vk::Access::readWrite);
    EXPECT_EQ(program[List::step][0].uses[2].access, vk::Access::read);
}

TEST(ProgramBuilder, RefusesABufferTwiceWhereTheKernelDoesNotSayThatItMayBeOne) {
    Predict p;
    p.builder.beginPhase("solve");
    expectNames(test::refusal([&] {
                    p.builder.dispatch(kernels::predict, 8, {p.positions, p.positions, p.step}, p.count);
                }),
                {"predict", "positions", "decorate both Aliased"});
    for (const vk::ShaderCode* twice : {&kernels::solveDistanceColor, &kernels::skinNormals}) {
        const vk::KernelInterface interface = vk::readInterface(*twice);
        EXPECT_GE(std::ranges::count(interface.bindings, true, &vk::KernelBinding::isAliased), 2)
            << twice->name;
    }
    EXPECT_EQ(
        std::ranges::count(vk::readInterface(kernels::predict).bindings, true, &vk::KernelBinding::isAliased),
        0);
}

TEST(ProgramBuilder, RefusesAWrongNumberOfBuffers) {
    Predict p;
    p.builder.beginPhase("solve");
    const auto message = test::refusal([&] {
        p.builder.dispatch(kernels::predict, 8, {p.positions, p.step}, p.count);
    });
    expectNames(message, {"predict", "3 buffers", "got 2"});
}

TEST(ProgramBuilder, RefusesAWrongStrideNamingKernelBindingAndBuffer) {
    Predict p;
    p.builder.beginPhase("solve");
    const BufferId slim = p.builder.scratch<float>("slim", 8);
    const auto message = test::refusal([&] {
        p.builder.dispatch(kernels::predict, 8, {p.positions, slim, p.step}, p.count);
    });
    expectNames(message, {"predict", "Velocities", "16", "slim", "4"});
}

TEST(ProgramBuilder, RefusesAParameterBlockOfAnotherSize) {
    Predict p;
    p.builder.beginPhase("solve");
    const auto message = test::refusal([&] {
        p.builder.dispatch(kernels::predict, 8, {p.positions, p.velocities, p.positions}, p.count);
    });
    expectNames(message, {"predict", "Step", "80", "positions", "16"});
}

TEST(ProgramBuilder, RefusesAWrongPushConstantSize) {
    Predict p;
    p.builder.beginPhase("solve");
    const std::array<std::uint32_t, 2> two{8, 0};
    const auto message = test::refusal([&] {
        p.builder.dispatch(kernels::predict, 8, {p.positions, p.velocities, p.step}, two);
    });
    expectNames(message, {"predict", "takes 4 bytes", "got 8"});
}

TEST(ProgramBuilder, RefusesABufferThatIsNone) {
    Predict p;
    p.builder.beginPhase("solve");
    const auto message = test::refusal([&] {
        p.builder.dispatch(kernels::predict, 8, {p.positions, BufferId{}, p.step}, p.count);
    });
    expectNames(message, {"predict", "Velocities"});
}

TEST(ProgramBuilder, LeavesUnboundBindingsOutOfUsesAndBarriers) {
    Predict p;
    p.builder.beginPhase("solve");
    const auto dispatch = [&] {
        p.builder.dispatch(kernels::updateVelocity, 8,
                           {p.velocities, p.step, unbound, unbound, unbound, unbound}, p.count);
    };
    dispatch();
    const BufferId others = p.builder.scratch<Vec4>("others", 8);
    p.builder.dispatch(kernels::updateVelocity, 8, {others, p.step, unbound, unbound, unbound, unbound},
                       p.count);
    const StepProgram program = p.builder.finish();
    ASSERT_EQ(program[List::step][0].uses.size(), 2u);
    EXPECT_FALSE(program[List::step][1].barriers[0]) << "the two share no buffer";
    const std::vector<BufferId> buffers = boundBuffers(program, program[List::step][0]);
    ASSERT_EQ(buffers.size(), 6u);
    EXPECT_EQ(buffers[0], p.velocities);
    EXPECT_EQ(std::count(buffers.begin(), buffers.end(), unbound), 4);
}

TEST(ProgramBuilder, BindsTexelTwinsOnlyWhereTheProgramFetchesTexels) {
    for (const bool usesTexels : {true, false}) {
        const StepProgram program =
            compile(test::sheet(8), {.substeps = 2, .forms = {.usesTexels = usesTexels}});
        std::size_t twins = 0;
        for (const Pass& pass : program[List::step]) {
            if (pass.kind != PassKind::dispatch) continue;
            const auto& bindings = program.kernels[pass.kernel].interface.bindings;
            const std::vector<BufferId> buffers = boundBuffers(program, pass);
            for (std::size_t b = 0; b < bindings.size(); ++b) {
                if (!bindings[b].isTwin()) continue;
                ++twins;
                EXPECT_EQ(buffers[b], usesTexels ? buffers[bindings[b].binding - vk::texelTwins] : unbound)
                    << pass.label << ", " << bindings[b].name;
            }
        }
        EXPECT_GT(twins, 0u);
    }
}

TEST(ProgramBuilder, TakesAListOfGroupsForKernelsThatMayRunOverOne) {
    Predict p;
    const BufferId before = p.builder.scratch<Vec4>("before", 16);
    const BufferId listed = p.builder.scratch<std::uint32_t>("listed", 1);
    const BufferId arguments = p.builder.scratch<Vec4>("arguments", 1);
    p.builder.beginPhase("solve");
    const std::array<BufferId, 4> buffers{p.positions, p.velocities, before, p.step};
    const std::array<std::uint32_t, 2> push{8, 1};           // count, whether it is the first substep
    constexpr std::uint32_t lastBinding = 31, runsOver = 30; // bindings.h
    p.builder.dispatch(kernels::saveSubstepStart, 8, buffers, push);
    p.builder.dispatchListed(kernels::saveSubstepStart, {arguments, 0, 8}, buffers, listed, push);
    const StepProgram program = p.builder.finish();
    EXPECT_EQ(boundUses(program[List::step][0]).size(), 4u);
    ASSERT_EQ(boundUses(program[List::step][1]).size(), 5u);
    EXPECT_EQ(boundUses(program[List::step][1]).back().buffer, listed);
    EXPECT_EQ(boundUses(program[List::step][1]).back().binding, lastBinding);
    EXPECT_EQ(boundBuffers(program, program[List::step][0]).back(), unbound);
    EXPECT_EQ(program.kernels[program[List::step][1].kernel].constants.at(runsOver), 1u);
}

TEST(ProgramBuilder, RefusesAnEmptyDispatchAndAPassWithoutPhase) {
    Predict p;
    expectNames(test::refusal([&] { p.builder.fill(p.positions, 0); }), {"fill", "phase"});
    p.builder.beginPhase("solve");
    const auto nothing = [&] {
        p.builder.dispatch(kernels::predict, 0, {p.positions, p.velocities, p.step}, p.count);
    };
    expectNames(test::refusal(nothing), {"predict", "nothing to do"});
}

TEST(ProgramBuilder, RefusesACopyBetweenUnequalBuffers) {
    Predict p;
    p.builder.beginPhase("solve");
    expectNames(test::refusal([&] { p.builder.copy(p.positions, p.step); }),
                {"copy", "positions", "128", "step", "80"});
}

TEST(Program, OfASceneWithoutPlanesKnowsNoPlane) {
    for (const Solver solver : {Solver::jacobi, Solver::split, Solver::gaussSeidel}) {
        const StepProgram program = compile(test::chain(5, {1e-4f}), {.solver = solver, .substeps = 2});
        EXPECT_FALSE(hasBuffer(program, "plane") || hasBuffer(program, "contact"));
        for (const std::string& label : labels(program))
            EXPECT_EQ(label.find("plane"), std::string::npos) << label;
        EXPECT_EQ(std::count(program.skipped.begin(), program.skipped.end(), "boundary planes"), 1);
    }
}

TEST(Program, OfFreeParticlesKnowsNoConstraint) {
    for (const Solver solver : {Solver::jacobi, Solver::split, Solver::gaussSeidel}) {
        const StepProgram program =
            compile(inRoom(test::particleAt({0, 1, 0})), {.solver = solver, .substeps = 2, .iterations = 7});
        for (const char* part : {"distance", "corrections", "incidences", "slots", "multipliers"}) {
            EXPECT_FALSE(hasBuffer(program, part)) << part;
        }
        EXPECT_EQ(countPasses(program, "solve_distance") + countPasses(program, "apply_corrections"), 0u);
        EXPECT_EQ(countPasses(program, "solve_planes"), solver == Solver::jacobi ? 2u : 0u)
            << "planes alone converge at once";
        EXPECT_EQ(program.sweeps, 0u);
    }
}

TEST(Program, KeepsMultipliersOnlyForCompliantConstraints) {
    const Settings settings{.solver = Solver::jacobi, .substeps = 1};
    EXPECT_FALSE(hasBuffer(compile(test::chain(5), settings), "multipliers"));
    EXPECT_TRUE(hasBuffer(compile(test::chain(5, {1e-4f}), settings), "multipliers"));
    EXPECT_TRUE(hasBuffer(compile(test::chain(5, {1e-4f, true}), settings), "multipliers"));
}

TEST(Program, LeavesOutConstraintsBetweenFixedParticles) {
    Scene scene = test::chain(4);
    scene.fixed = {{0}, {1}};
    const StepProgram program = compile(scene, {.solver = Solver::jacobi, .substeps = 1});
    const auto edges =
        std::find_if(program.buffers.begin(), program.buffers.end(),
                     [](const BufferSpec& buffer) { return buffer.label == "distance.edges"; });
    ASSERT_NE(edges, program.buffers.end());
    EXPECT_EQ(edges->count, 2u);
    scene.fixed = {{0}, {1}, {2}, {3}};
    EXPECT_FALSE(hasBuffer(compile(scene, {.solver = Solver::jacobi}), "distance"));
    EXPECT_FALSE(hasBuffer(compile(scene, {.solver = Solver::split}), "distance"));
    EXPECT_FALSE(hasBuffer(compile(scene, {.solver = Solver::gaussSeidel}), "distance"));
}

TEST(Program, OfSplitIsOneDispatchASubstepAndOneCopyWhereSubstepsAreOdd) {
    const auto isInSubstep = [](const Pass& pass) {
        return pass.kind == PassKind::dispatch && pass.substep > 0;
    };
    for (const std::uint32_t substeps : {1u, 2u, 7u, 32u}) {
        const StepProgram program = compile(inRoom(test::block(2, 0.1f, 1e5f)), {.substeps = substeps});
        EXPECT_EQ(std::count_if(program[List::step].begin(), program[List::step].end(), isInSubstep),
                  substeps);
        EXPECT_EQ(countPasses(program, "copy"), substeps % 2);
        EXPECT_EQ(program[List::step].size(),
                  2 + substeps + substeps % 2 + 2); // update, fill ... measure, publish
        EXPECT_EQ(program.sweeps, substeps);
    }
}

TEST(Program, OfJacobiIsTwoPassesAnIteration) {
    const StepProgram program =
        compile(test::block(2, 0.1f, 1e5f), {.solver = Solver::jacobi, .substeps = 3, .iterations = 5});
    EXPECT_EQ(countPasses(program, "solve_distance"), 15u);
    EXPECT_EQ(countPasses(program, "apply_corrections"), 15u);
    EXPECT_EQ(countPasses(program, "predict"), 3u);
    EXPECT_EQ(program.sweeps, 15u);
}

TEST(Program, OfGaussSeidelIsOneDispatchAColorAndOneMoreASubstep) {
    Settings settings{.solver = Solver::gaussSeidel, .substeps = 5};
    const StepProgram sheet = compile(test::sheet(8), settings);
    // update, fill, 5 x (open or advance, 8 colors), close, measure, publish, publish the multipliers
    EXPECT_EQ(sheet[List::step].size(), 2u + 5 * 9 + 4);
    EXPECT_EQ(countPasses(sheet, "solve_distance_color[7]"), 5u);
    EXPECT_EQ(sheet.sweeps, 5u);
    settings.warmStart = 0;
    EXPECT_EQ(countPasses(compile(test::block(4, 0.1f, 1e5f), settings), "solve_distance_color[17]"), 5u);
    settings.iterations = 3;
    const StepProgram room = compile(inRoom(test::sheet(8)), settings);
    EXPECT_EQ(countPasses(room, "solve_distance_color[0]"), 15u);
    EXPECT_EQ(countPasses(room, "project_onto_planes"), 10u);
    EXPECT_EQ(room.sweeps, 15u);
}

TEST(Program, OfGaussSeidelKeepsMultipliersOnlyWhereSomethingNeedsThem) {
    const auto hasMultipliers = [](const Scene& scene, std::uint32_t iterations, float warmStart) {
        const Settings settings{
            .solver = Solver::gaussSeidel, .iterations = iterations, .warmStart = warmStart};
        return hasBuffer(compile(scene, settings), "multipliers");
    };
    EXPECT_FALSE(hasMultipliers(test::chain(5), 4, 0)) << "rigid";
    EXPECT_FALSE(hasMultipliers(test::chain(5, {1e-4f}), 1, 0)) << "one iteration";
    EXPECT_TRUE(hasMultipliers(test::chain(5, {1e-4f}), 2, 0));
    EXPECT_TRUE(hasMultipliers(test::chain(5), 1, 0.5f)) << "warm";
    EXPECT_FALSE(hasBuffer(compile(test::chain(5), {.solver = Solver::gaussSeidel, .warmStart = 0}), "warm"));
}

TEST(Program, OfAnEmptySceneHasNoPass) {
    for (const Solver solver : {Solver::jacobi, Solver::split, Solver::gaussSeidel}) {
        const StepProgram program = compile({}, {.solver = solver});
        EXPECT_TRUE(program[List::step].empty() && program[List::skin].empty());
        EXPECT_EQ(declaredBytes(program), 0u);
    }
}

TEST(Program, RunsEveryKernelReversedWhereAsked) {
    const StepProgram program = compile(inRoom(test::block(2, 0.1f, 1e5f)), {.isReversed = true});
    for (const KernelUse& kernel : program.kernels)
        EXPECT_EQ(kernel.constants.at(0), 1u) << kernel.code->name;
}

TEST(Program, DeclaresTheBytesItsKernelsTouch) {
    // A vec4 for each of 128 particles is 2048 bytes. Parameters are 80 bytes, the status 32; reads and
    // writes count separately. update 80, fill 16; drift 4 x 2048 + 80; copy 2 x 2048; measure 2 x 2048 + 32
    // + 80; publish 8 x 2048 + 16 + 80, because it may undo the step.
    Scene scene = test::chain(128);
    scene.distances.clear();
    for (Particle& particle : scene.particles)
        particle.position.x *= 0.01f; // near the origin, where remainders are not needed
    EXPECT_EQ(declaredBytes(compile(scene, {.substeps = 1})), 16u * 2048 + 448);
}

namespace {

struct Golden {
    const char* file;
    Scene scene;
    Settings settings;
};

// Two bodies of 2^3 cells, one above the other over a floor; both have skins.
Scene twoBlocks(bool isCuttable) {
    Scene scene{.name = "two blocks"};
    Lattice lattice{.cells = {2, 2, 2}, .spacing = 0.05f, .radius = 0.025f, .isCuttable = isCuttable};
    for (const float height : {0.1f, 0.3f}) {
        lattice.origin.y = height;
        addLatticeSkin(scene, lattice, addLattice(scene, lattice), {1, 1, 1});
    }
    test::addRoom(scene);
    return scene;
}

// A sheet that may be cut and touches itself.
Scene thickSheet() {
    Scene scene{.name = "sheet"};
    addCloth(scene, {.size = {4, 4}, .spacing = 0.1f, .thickness = 0.02f, .isCuttable = true});
    return scene;
}

// A block of 6^3 cells that may be cut, with two levels of blocks.
Scene stiffBlock() {
    Scene scene{.name = "block"};
    addLattice(scene, {.cells = {6, 6, 6}, .spacing = 0.05f, .youngModulus = 1e7f, .isCuttable = true});
    return scene;
}

std::vector<Golden> goldens() {
    return {{"jacobi_chain.txt", test::chain(5), {.solver = Solver::jacobi, .substeps = 2, .iterations = 2}},
            {"jacobi_sheet_in_a_room.txt",
             inRoom(test::sheet(4, 1e-5f)),
             {.solver = Solver::jacobi, .substeps = 10, .iterations = 1}},
            {"gauss_seidel_chain.txt",
             test::chain(5),
             {.solver = Solver::gaussSeidel, .substeps = 2, .warmStart = 0}},
            {"gauss_seidel_sheet_in_a_room.txt",
             inRoom(test::sheet(4, 1e-5f)),
             {.solver = Solver::gaussSeidel, .substeps = 10, .iterations = 2}},
            {"split_particle.txt", test::particleAt({0, 1, 0}), {.substeps = 1}},
            {"split_block.txt", test::block(2, 0.1f, 1e5f), {.substeps = 32}},
            {"split_sheet_in_a_room.txt", inRoom(test::sheet(4, 1e-5f)), {.substeps = 7}},
            {"split_blocks_that_touch_and_sleep.txt", twoBlocks(false), {.substeps = 2, .sleeps = true}},
            {"split_blocks_that_are_cut.txt", twoBlocks(true), {.substeps = 2}},
            {"split_block_with_levels.txt", stiffBlock(), {.substeps = 2, .levels = 2}},
            {"split_sheet_that_touches_itself.txt", thickSheet(), {.substeps = 2}}};
}

std::string contents(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

} // namespace

TEST(Program, SearchesForLinksOnlyWhereABodyMayBeCut) {
    constexpr std::uint32_t hasLinks = 1; // constant_id in face_search.glsl
    const StepProgram program = compile(thickSheet(), {.substeps = 2});
    std::size_t searches = 0;
    for (const KernelUse& use : program.kernels) {
        if (use.code != &kernels::findFaces) continue;
        ++searches;
        EXPECT_EQ(use.constants.at(hasLinks), 0u);
    }
    EXPECT_EQ(searches, 1u);
}

// Particles of bodies start no zone: zones of a sheet that folds tangled it.
TEST(Program, HasImpactZonesOnlyWithALooseBall) {
    const auto hasZones = [](const Scene& scene) {
        const StepProgram program = compile(scene, {.substeps = 2});
        return std::ranges::any_of(program.kernels,
                                   [](const KernelUse& use) { return use.code == &kernels::solveZones; });
    };
    Scene scene = thickSheet();
    EXPECT_FALSE(hasZones(scene));
    scene.particles.push_back(test::particleAt({0, 1, 0}).particles.front());
    scene.particles.back().radius = 0.03f;
    EXPECT_TRUE(hasZones(scene));
    scene.particles.back().inverseMass = 0;
    EXPECT_FALSE(hasZones(scene)) << "a ball that never moves";
}

// SINEW_UPDATE_GOLDEN=1 rewrites the files. A commit that does so must justify the new program.
TEST(Describe, PrintsTheGoldenText) {
    for (const Golden& golden : goldens()) {
        const std::string path = std::string(SINEW_GOLDEN_FOLDER) + "/" + golden.file;
        const std::string text = describe(compile(golden.scene, golden.settings));
        if (std::getenv("SINEW_UPDATE_GOLDEN")) std::ofstream(path) << text;
        EXPECT_EQ(text, contents(path)) << golden.file;
    }
}
