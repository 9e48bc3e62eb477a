// Makes every pipeline of the viewer with the compiler of a real GPU that need not be present
// (support/null_hardware.hpp). GPU families as in the test of the simulation's pipelines, more with
// SINEW_FULL=1. SINEW_KERNEL_TABLE names a folder for a table of all shaders.
#include "all_viewer_shaders.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/spirv.hpp"
#include "support/full.hpp"
#include "support/null_hardware.hpp"
#include "viewer/render/renderer.hpp"
#include "viewer/render/walls.hpp"
#include "viewer/ui/panel_painter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace sinew::viewer {
namespace {

using test::NullHardware;
using test::PipelineFacts;

// By the execution model of the entry point in its SPIR-V.
bool isKernel(const vk::ShaderCode& code) {
    constexpr std::uint32_t header = 5, entryPoint = 15, compute = 5;
    const std::vector<std::uint32_t> words = vk::wordsOf(code);
    for (std::size_t at = header; at < words.size(); at += words[at] >> 16)
        if ((words[at] & 0xffff) == entryPoint) return words[at + 1] == compute;
    return false;
}

// A light with balls, marks, a wall and a cloth, which need pipelines.
SceneLight light() {
    SceneLight light;
    light.bounds = Box(Vector3(-1, -1, -1), Vector3(1, 1, 1));
    sim::Scene scene;
    scene.planes.push_back({.normal = {1, 0, 0}, .offset = -1});
    light.walls = wallsOf(scene, light.bounds);
    light.balls = {.ranges = {{.first = 0, .count = 2, .color = {1, 0, 0}}}, .radii = {0.1f, 0.1f}};
    light.marks = light.balls;
    light.isSheet = {true};
    light.sheets.resize(1);
    return light;
}

void makeDrawing(const vk::Device& device, const Quality& quality) {
    for (const VkFormat format : {VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_B8G8R8A8_UNORM}) {
        const PanelPainter panels(device, format, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, 1);
        Renderer renderer(device, {.color = format, .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}, quality,
                          light());
        for (const bool isGlass : {false, true})
            for (const bool isOpened : {false, true}) {
                Layers layers;
                for (const std::string& name : layerNames()) addLayer(name, layers);
                layers.looks[indexOf(layer::skin)] = isGlass ? 1 : 0;
                if (isOpened) layers.section.emplace();
                renderer.add(renderer.make(layers));
            }
    }
}

std::vector<std::string> families() {
    std::vector<std::string> result{"NAVI21", "POLARIS10"};
    if (test::isFull()) result.insert(result.end(), {"VEGA10", "GFX1100"});
    return result;
}

void writeTable(const std::vector<PipelineFacts>& pipelines, const std::string& family) {
    const char* folder = std::getenv("SINEW_KERNEL_TABLE");
    if (folder == nullptr) return;
    std::ofstream table(std::string(folder) + "/viewer_" + family + ".csv");
    table << "pipeline,shader,VGPRs,SGPRs,waves a SIMD,instructions,latency\n";
    for (const PipelineFacts& facts : pipelines) {
        table << facts.kernel << ',' << facts.shader;
        for (const char* statistic : {"VGPRs", "SGPRs", "Subgroups per SIMD", "Instructions", "Latency"})
            table << ',' << facts[statistic];
        table << '\n';
    }
    EXPECT_TRUE(table.flush()) << "cannot write to " << folder;
}

class ViewerGpuCompiler : public testing::TestWithParam<std::string> {};

TEST_P(ViewerGpuCompiler, MakesEveryPipelineWithoutSpilling) {
    const std::string& family = GetParam();
    const auto hardware = NullHardware::make(family);
    if (!hardware)
        GTEST_SKIP() << "no driver here compiles for " << family << ": install mesa-vulkan-drivers";
    const vk::KeptKernels kept(hardware->device());
    for (const vk::ShaderCode* code : shaders::all)
        if (isKernel(*code)) {
            EXPECT_NO_THROW(hardware->device().kernels().get(hardware->device(), *code, {})) << code->name;
        }
    makeDrawing(hardware->device(), {});
    makeDrawing(hardware->device(), reducedQuality());
    for (const vk::ShaderCode* code : shaders::all)
        EXPECT_TRUE(isKernel(*code) || hardware->hasModuleOf(*code))
            << "no pipeline of this test has " << code->name;
    for (const PipelineFacts& facts : hardware->pipelines()) {
        const std::string name = facts.kernel + ", " + facts.shader;
        EXPECT_GT(facts["Instructions"], 0u) << name;
        for (const char* statistic : {"Spilled VGPRs", "Spilled SGPRs", "Scratch size"})
            EXPECT_EQ(facts[statistic], 0u) << name << ": " << statistic;
    }
    writeTable(hardware->pipelines(), family);
}

INSTANTIATE_TEST_SUITE_P(, ViewerGpuCompiler, testing::ValuesIn(families()),
                         [](const auto& family) { return family.param; });

} // namespace
} // namespace sinew::viewer
