// Every compute pipeline of every shipped scene, made by the compiler of a real GPU, on a machine that has
// none (support/null_hardware.hpp). Families are the newest and the oldest that a driver of 2022 knows well,
// more with SINEW_FULL=1. The variable SINEW_KERNEL_TABLE names a folder for a table of all kernels.
#include "scenes/load.hpp"
#include "sim/compile.hpp"
#include "sim/gpu_compile.hpp"
#include "support/full.hpp"
#include "support/null_hardware.hpp"
#include "vk/kernel_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace sinew;
namespace fs = std::filesystem;
using test::NullHardware;
using test::PipelineFacts;

namespace {

constexpr std::uint32_t fewSubsteps = 3; // the first, the last and one between: all kernels of a step

// The forms between which tune() chooses.
std::vector<sim::Forms> formsOf(const vk::Device& device, const sim::Settings& settings) {
    std::vector<sim::Forms> forms{settings.forms};
    if (settings.solver == sim::Solver::jacobi) return forms;
    forms.push_back({.usesTexels = false});
    if (settings.solver != sim::Solver::split) return forms;
    forms.push_back({.columns = 1});
    forms.push_back({.usesTexels = false, .columns = 1});
    forms.push_back({.residentBytes = device.limits().maxSharedMemory});
    return forms;
}

void makeKernels(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings) {
    for (const sim::KernelUse& use : sim::compileFor(device, scene, settings).kernels) {
        std::vector<vk::SpecialisationConstant> constants;
        for (const auto& [id, value] : use.constants) constants.push_back({id, value});
        EXPECT_NO_THROW(device.kernels().get(device, *use.code, constants)) << use.code->name;
    }
}

// A scene in all its forms, without and with hands and pokes, which a resident body has not.
void makeForms(const vk::Device& device, const sim::Scene& scene, sim::Settings settings) {
    for (const sim::Forms& forms : formsOf(device, settings)) {
        settings.forms = forms;
        makeKernels(device, scene, settings);
    }
    settings.forms = {};
    settings.grabs = settings.pokes = settings.solver == sim::Solver::split;
    makeKernels(device, scene, settings);
}

// The scene with cells that come back from being turned inside out, as bodies of a user's mesh do.
sim::Scene recovering(sim::Scene scene) {
    for (sim::Grid& grid : scene.grids)
        if (grid.nodes[1] > 1) grid.recoveryPressure = std::max(grid.recoveryPressure, 100.0f);
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

// None where the scene has something that the solver has no form for.
std::optional<scenes::LoadedScene> loadFor(const fs::path& file, const char* solver) {
    try {
        return scenes::load(file, {.solver = solver});
    } catch (const scenes::SceneError& error) {
        EXPECT_NE(std::string(error.what()).find("solver"), std::string::npos) << error.what();
        EXPECT_STRNE(solver, "split") << error.what();
        return std::nullopt;
    }
}

void makeKernelsOfAllScenes(const vk::Device& device) {
    for (const fs::path& file : sceneFiles())
        for (const char* solver : {"split", "jacobi", "gauss_seidel"}) {
            SCOPED_TRACE(file.stem().string() + ", " + solver);
            std::optional<scenes::LoadedScene> loaded = loadFor(file, solver);
            if (!loaded) continue;
            loaded->settings.substeps = std::min(loaded->settings.substeps, fewSubsteps);
            makeForms(device, loaded->scene, loaded->settings);
            if (loaded->settings.solver == sim::Solver::split && !loaded->scene.grids.empty())
                makeForms(device, recovering(loaded->scene), loaded->settings);
        }
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

struct Family {
    const char* name;
    /// False: its compiler in Mesa 22.3 stops at 132 of the 256 registers that there are, and spills the
    /// rest.
    bool usesAllRegisters = true;
};

class GpuCompiler : public testing::TestWithParam<Family> {};

std::vector<Family> families() {
    std::vector<Family> result{{"NAVI21"}, {"POLARIS10"}};
    if (test::isFull()) result.insert(result.end(), {{"VEGA10"}, {"GFX1100", false}});
    return result;
}

void expectNoSpill(const PipelineFacts& facts) {
    for (const char* statistic : {"Spilled VGPRs", "Spilled SGPRs", "Scratch size"}) {
        EXPECT_TRUE(facts.statistics.contains(statistic)) << statistic;
        EXPECT_EQ(facts[statistic], 0u) << facts.kernel << ": " << statistic;
    }
}

} // namespace

TEST_P(GpuCompiler, MakesEveryPipelineOfEveryShippedSceneWithoutSpilling) {
    const Family family = GetParam();
    const auto hardware = NullHardware::make(family.name);
    if (!hardware)
        GTEST_SKIP() << "no driver here compiles for " << family.name << ": install mesa-vulkan-drivers";
    const vk::KeptKernels kept(hardware->device()); // each is made once
    makeKernelsOfAllScenes(hardware->device());
    EXPECT_GT(hardware->pipelines().size(), 250u);
    for (const PipelineFacts& facts : hardware->pipelines()) {
        EXPECT_GT(facts["Instructions"], 0u) << facts.kernel;
        if (family.usesAllRegisters) expectNoSpill(facts);
    }
    writeTable(hardware->pipelines(), family.name);
}

INSTANTIATE_TEST_SUITE_P(, GpuCompiler, testing::ValuesIn(families()),
                         [](const auto& family) { return std::string(family.param.name); });
