// Makes every kernel of the simulation, with the constants of shipped and random scenes, by the compilers of
// real GPUs that need not be present (support/null_hardware.hpp). All tests of this program run in one
// process, because they share the list of these kernels. SINEW_KERNEL_TABLE names a folder for a table of all
// kernels.
#include "all_kernels.hpp"
#include "scenes/drawn_scenes.hpp"
#include "scenes/load.hpp"
#include "scenes/specialised.hpp"
#include "sim/compile/compile.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sinew/bodies.hpp"
#include "sinew/validate.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "support/device.hpp"
#include "support/full.hpp"
#include "support/null_hardware.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <tuple>

using namespace sinew;
namespace fs = std::filesystem;
using test::NullHardware;
using test::PipelineFacts;

namespace {

constexpr std::uint32_t fewSubsteps = 3; // the first, the last and one between use all kernels of a step

constexpr std::uint32_t drawnScenes = 2000;

// The forms between which tune() chooses.
std::vector<sim::Forms> formsOf(const vk::Device& device, const sim::Settings& settings) {
    std::vector<sim::Forms> forms{settings.forms};
    if (settings.solver == sim::Solver::jacobi) return forms;
    forms.push_back({.usesTexels = false});
    if (settings.solver != sim::Solver::split) return forms;
    for (const std::uint32_t columns : {1u, 2u})
        for (const bool usesTexels : {false, true})
            forms.push_back({.usesTexels = usesTexels, .columns = columns, .chunk = 16});
    for (const std::uint32_t columns : {1u, 2u})
        forms.push_back({.columns = columns,
                         .chunk = columns == 1 ? 1u : 16u,
                         .residentBytes = device.limits().maxSharedMemory});
    return forms;
}

using Constants = std::map<std::uint32_t, std::uint32_t>;
using Uses = std::set<std::pair<const vk::ShaderCode*, Constants>>;

/// A kernel with its constants, and the bindings that a dispatch leaves empty.
struct Gaps {
    const vk::ShaderCode* code = nullptr;
    Constants constants;
    std::set<std::uint32_t> bindings;
    auto operator<=>(const Gaps&) const = default;
};

/// Collects the kernels of scenes, with their constants, as they are compiled for a device.
struct Collector {
    const vk::Device& device;
    Uses uses{};
    std::set<Gaps> gaps{};

    void record(const sim::StepProgram& program) {
        sim::forEachPass(program, [&](const sim::Pass& pass) {
            if (pass.kind != sim::PassKind::dispatch) return;
            const sim::KernelUse& use = program.kernels[pass.kernel];
            Gaps found{use.code, use.constants, {}};
            const std::vector<sim::BufferId> buffers = sim::boundBuffers(program, pass);
            for (std::size_t b = 0; b < buffers.size(); ++b)
                if (buffers[b] == sim::unbound) found.bindings.insert(use.interface.bindings[b].binding);
            if (!found.bindings.empty()) gaps.insert(std::move(found));
        });
    }

    void add(const sim::Scene& scene, const sim::Settings& settings) {
        const sim::StepProgram program = sim::compileFor(device, scene, settings);
        record(program);
        for (const sim::KernelUse& use : program.kernels) uses.emplace(use.code, use.constants);
    }
};

// The scene far from the origin, so that positions need rounding remainders (sim/model/rounding.hpp).
sim::Scene farAway(sim::Scene scene) {
    for (sim::Particle& particle : scene.particles) particle.position.x += 100;
    return scene;
}

// Adds the kernels that keep forces, if the scene supports them; for `jacobi`, without its links.
void addKept(Collector& collector, sim::Scene scene, sim::Settings settings) {
    settings.keepsForces = true;
    if (settings.solver == sim::Solver::jacobi) {
        scene.distances.clear();
        scene.bends.clear();
        scene.grids.clear();
    }
    if (sim::validate(scene, settings).empty()) collector.add(scene, settings);
}

// Adds a scene in all its forms, with and without grabs and host colliders, which exclude resident bodies,
// and far away.
void addForms(Collector& collector, const sim::Scene& scene, sim::Settings settings) {
    for (const sim::Forms& forms : formsOf(collector.device, settings)) {
        settings.forms = forms;
        collector.add(scene, settings);
    }
    settings.forms = {};
    collector.add(farAway(scene), settings);
    settings.grabs = settings.hostColliders = settings.solver == sim::Solver::split;
    collector.add(scene, settings);
    addKept(collector, scene, settings);
}

// The scene with removal of fragments, and with skins either as before mesh::addMesh split them, or
// stretching over cuts.
sim::Scene withDebris(sim::Scene scene, bool stretches) {
    scene.debris = 4;
    for (sim::Skin& skin : scene.skins) {
        skin.wholeTriangles.clear();
        skin.wholeOf.clear();
        if (stretches) skin.anchors.clear();
    }
    return scene;
}

// The scene with cells that recover from inversion, as the bodies of a user's mesh do.
sim::Scene recovering(sim::Scene scene) {
    for (sim::Grid& grid : scene.grids)
        if (grid.nodes[1] > 1) grid.recoveryPressure = std::max(grid.recoveryPressure, 100.0f);
    return scene;
}

// The scene with bodies that may be absent.
sim::Scene comingAndGoing(sim::Scene scene) {
    for (sim::Body& body : scene.bodies) body.isAbsent = true;
    return scene;
}

// Skins with texture coordinates.
sim::Scene textured(sim::Scene scene) {
    for (sim::Skin& skin : scene.skins) {
        skin.textureCoordinates.resize(skin.triangles.size());
        skin.wholeTextureCoordinates.resize(skin.wholeTriangles.size());
    }
    return scene;
}

// Loose balls that take recoils back.
sim::Scene takingRecoils(sim::Scene scene) {
    scene.contacts.takesRecoils = true;
    return scene;
}

std::vector<fs::path> sceneFiles() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& file : fs::directory_iterator(SINEW_SOURCE_FOLDER "/scenes"))
        if (file.path().extension() == ".toml" && file.path().stem() != "drop_mesh")
            files.push_back(file.path());
    std::ranges::sort(files);
    return files;
}

// Loads the scene for this solver; empty if the solver lacks a feature of the scene.
std::optional<scenes::LoadedScene> loadFor(const fs::path& file, const char* solver) {
    try {
        return scenes::load(file, {.solver = solver});
    } catch (const scenes::SceneError& error) {
        EXPECT_NE(std::string(error.what()).find("solver"), std::string::npos) << error.what();
        EXPECT_STRNE(solver, "split") << error.what();
        return std::nullopt;
    }
}

// Two thin sheets, whose edges may pass each other.
sim::Scene twoSheets() {
    sim::Scene scene;
    for (const float height : {0.0f, 0.1f})
        sim::addCloth(scene, {.origin = {0, height, 0}, .size = {5, 5}, .spacing = 0.1f, .thickness = 0.01f});
    return scene;
}

void addKernelsOfAllScenes(Collector& collector) {
    addForms(collector, twoSheets(), {.substeps = fewSubsteps});
    addKept(collector, twoSheets(), {.substeps = fewSubsteps, .hostColliders = 9}); // more share their sums
    collector.add(twoSheets(), {.substeps = fewSubsteps, .motions = 1, .keepsPrevious = true});
    for (const fs::path& file : sceneFiles())
        for (const char* solver : {"split", "jacobi", "gauss_seidel"}) {
            SCOPED_TRACE(file.stem().string() + ", " + solver);
            std::optional<scenes::LoadedScene> loaded = loadFor(file, solver);
            if (!loaded) continue;
            loaded->settings.substeps = std::min(loaded->settings.substeps, fewSubsteps);
            addForms(collector, loaded->scene, loaded->settings);
            sim::Settings coarse = loaded->settings;
            coarse.levels = 2;
            if (sim::validate(loaded->scene, coarse).empty()) collector.add(loaded->scene, coarse);
            sim::Settings sharp = loaded->settings;
            sharp.hasSharpClamp = sharp.solver == sim::Solver::split;
            const bool hasEveryForm =
                file.stem() == "beam" || file.stem() == "organ" || file.stem() == "cloth_study";
            if (sharp.hasSharpClamp && hasEveryForm) addForms(collector, loaded->scene, sharp);
            sim::Settings pool = loaded->settings;
            pool.motions = 1;
            if (file.stem() == "organ" && pool.solver == sim::Solver::split)
                collector.add(comingAndGoing(loaded->scene), pool);
            if (file.stem() == "clutter" && loaded->settings.solver == sim::Solver::split)
                addForms(collector, takingRecoils(loaded->scene), loaded->settings);
            const bool hasEverySkin =
                file.stem() == "organ" || file.stem() == "cube_quarters" || file.stem() == "cloth_cut";
            if (hasEverySkin && loaded->settings.solver == sim::Solver::split)
                collector.add(textured(loaded->scene), loaded->settings);
            if (file.stem() == "stirrer" && loaded->settings.solver == sim::Solver::split) // with faces
                collector.add(takingRecoils(loaded->scene), loaded->settings);
            if (loaded->settings.solver != sim::Solver::split || loaded->scene.grids.empty()) continue;
            addForms(collector, recovering(loaded->scene), loaded->settings);
            addForms(collector, withDebris(loaded->scene, false), loaded->settings);
            collector.add(withDebris(loaded->scene, true), loaded->settings);
        }
}

// The kernels that no program has: they carry states between simulations, or answer the host.
void addKernelsOfWorlds(Uses& uses) {
    for (const vk::ShaderCode* code :
         {&sim::kernels::carryElements, &sim::kernels::carryContacts, &sim::kernels::startArrivals,
          &sim::kernels::castRay, &sim::kernels::castRayBalls, &sim::kernels::castRayCuts,
          &sim::kernels::resolvePick, &sim::kernels::findWithin})
        uses.emplace(code, Constants{});
}

void addKernelsOfDrawnScenes(Collector& collector, std::uint32_t count) {
    std::size_t valid = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        SCOPED_TRACE(seed);
        auto [scene, settings] = test::drawScene(seed);
        if (!sim::validate(scene, settings).empty()) continue;
        collector.add(scene, settings);
        settings.forms.columns = settings.forms.chunk = 1; // one node for each invocation
        collector.add(scene, settings);
        addKept(collector, scene, settings);
        ++valid;
    }
    EXPECT_GT(valid, count / 2);
}

void writeTable(const std::vector<PipelineFacts>& pipelines, const std::string& family) {
    const char* folder = std::getenv("SINEW_KERNEL_TABLE");
    if (folder == nullptr) return;
    std::ofstream table(std::string(folder) + "/kernels_" + family + ".csv");
    table << "kernel,constants,VGPRs,SGPRs,spilled VGPRs,shared bytes,waves a SIMD,instructions,"
             "latency,inverse throughput\n";
    for (const PipelineFacts& facts : pipelines) {
        table << facts.kernel << ',';
        for (const std::uint32_t value : facts.constants) table << value << ' ';
        for (const char* statistic : {"VGPRs", "SGPRs", "Spilled VGPRs", "LDS size", "Subgroups per SIMD",
                                      "Instructions", "Latency", "Inverse Throughput"})
            table << ',' << facts[statistic];
        table << '\n';
    }
    EXPECT_TRUE(table.flush()) << "cannot write to " << folder;
}

/// All kernels with all their constants take two minutes a family. One family makes them all; each of the
/// others makes every kernel, but only every third of its constants, so that together they make all once more
/// (SINEW_FULL=1: all by all).
struct Family {
    const char* name;
    std::optional<std::size_t> third; // 0, 1 or 2; none = all
    /// Registers, of 256, above which the compiler of Mesa 22.3 spills; 0 = it never does.
    std::uint64_t mostRegisters = 0;
};

class GpuCompiler : public testing::TestWithParam<Family> {};

void expectNoSpill(const PipelineFacts& facts) {
    for (const char* statistic : {"Spilled VGPRs", "Spilled SGPRs", "Scratch size"}) {
        EXPECT_TRUE(facts.statistics.contains(statistic)) << statistic;
        EXPECT_EQ(facts[statistic], 0u) << facts.kernel << ": " << statistic;
    }
}

// The kernels of all scenes for a device. Devices that programs are compiled alike for share one list.
const Uses& usesOf(const vk::Device& device) {
    using Likeness = std::tuple<sim::DeviceKind, std::uint64_t, std::uint64_t, std::uint64_t>;
    static std::map<Likeness, Uses> lists;
    const auto& limits = device.limits();
    Uses& uses =
        lists[{sim::kindOf(device), limits.maxSharedMemory, limits.maxGroupInvocations, limits.maxTexels}];
    if (!uses.empty()) return uses;
    Collector collector{device};
    addKernelsOfAllScenes(collector);
    addKernelsOfDrawnScenes(collector, drawnScenes);
    addKernelsOfWorlds(collector.uses);
    return uses = std::move(collector.uses);
}

} // namespace

TEST_P(GpuCompiler, MakesEveryKernelWithoutSpilling) {
    const Family family = GetParam();
    const auto hardware = NullHardware::make(family.name);
    if (!hardware)
        GTEST_SKIP() << "no driver here compiles for " << family.name << ": install mesa-vulkan-drivers";
    const vk::KeptKernels kept(hardware->device());    // makes each kernel only once
    std::map<const vk::ShaderCode*, std::size_t> made; // how many of its constants were seen
    for (const auto& [code, values] : usesOf(hardware->device())) {
        const std::size_t place = made[code]++;
        if (family.third && !test::isFull() && place > 0 && place % 3 != *family.third) continue;
        std::vector<vk::SpecialisationConstant> constants;
        for (const auto& [id, value] : values) constants.push_back({id, value});
        EXPECT_NO_THROW(hardware->device().kernels().get(hardware->device(), *code, constants)) << code->name;
    }
    for (const vk::ShaderCode* code : sim::kernels::all)
        EXPECT_TRUE(made.contains(code)) << "no scene of this test has " << code->name;
    for (const PipelineFacts& facts : hardware->pipelines()) {
        EXPECT_GT(facts["Instructions"], 0u) << facts.kernel;
        if (family.mostRegisters == 0 || facts["VGPRs"] < family.mostRegisters) expectNoSpill(facts);
    }
    writeTable(hardware->pipelines(), family.name);
}

// A kernel may read anything from the buffer that the executor binds where a dispatch leaves a binding empty.
TEST(Kernels, AccessNoBindingThatADispatchLeavesEmpty) {
    constexpr std::uint32_t few = 200;
    Collector collector{test::device()};
    addKernelsOfAllScenes(collector);
    addKernelsOfDrawnScenes(collector, few);
    ASSERT_GT(collector.gaps.size(), 50u);
    std::optional<std::set<std::uint32_t>> accessed;
    const Gaps* last = nullptr;
    for (const Gaps& gaps : collector.gaps) {
        const bool isSame = last && last->code == gaps.code && last->constants == gaps.constants;
        if (!isSame) accessed = test::accessedBindings(*gaps.code, gaps.constants);
        last = &gaps;
        ASSERT_TRUE(accessed) << "spirv-opt is missing or refuses " << gaps.code->name;
        for (const std::uint32_t binding : gaps.bindings)
            EXPECT_FALSE(accessed->contains(binding))
                << gaps.code->name << ", binding " << binding << ", constants "
                << testing::PrintToString(gaps.constants);
    }
}

INSTANTIATE_TEST_SUITE_P(, GpuCompiler,
                         testing::Values(Family{"NAVI21", {}}, Family{"POLARIS10", 0}, Family{"VEGA10", 1},
                                         Family{"GFX1100", 2, 132}),
                         [](const auto& family) { return std::string(family.param.name); });
