#include "qt_window/drawing.hpp"

#include "qt_window_shaders.hpp"
#include "sinew/vk/spirv.hpp"

#include <array>
#include <cstring>
#include <stdexcept>

namespace {

struct Push {
    float clipFromWorld[16]; // by columns
    float color[4];
};

constexpr std::uint32_t vertexStride = 32, drawStride = 20; // [B]

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " failed");
}

} // namespace

Drawing::Drawing(const QVulkanWindow& window)
    : functions_(window.vulkanInstance()->deviceFunctions(window.device())), device_(window.device()) {
    const VkPushConstantRange range{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                    sizeof(Push)};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &range};
    check(functions_->vkCreatePipelineLayout(device_, &info, nullptr, &layout_), "vkCreatePipelineLayout");
    makePipeline(window);
}

Drawing::~Drawing() {
    functions_->vkDestroyPipeline(device_, pipeline_, nullptr);
    functions_->vkDestroyPipelineLayout(device_, layout_, nullptr);
}

VkShaderModule Drawing::makeModule(std::span<const std::uint32_t> code) const {
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = code.size_bytes(),
                                        .pCode = code.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    check(functions_->vkCreateShaderModule(device_, &info, nullptr, &module), "vkCreateShaderModule");
    return module;
}

void Drawing::makePipeline(const QVulkanWindow& window) {
    const VkShaderModule vertex = makeModule(sinew::vk::wordsOf(example::organVert)),
                         fragment = makeModule(sinew::vk::wordsOf(example::organFrag));
    const std::array<VkPipelineShaderStageCreateInfo, 2> stages{
        {{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = VK_SHADER_STAGE_VERTEX_BIT,
          .module = vertex,
          .pName = "main"},
         {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
          .module = fragment,
          .pName = "main"}}};
    const VkVertexInputBindingDescription binding{0, vertexStride, VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array<VkVertexInputAttributeDescription, 2> attributes{
        {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16}}};
    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 1,
        .pVertexBindingDescriptions = &binding,
        .vertexAttributeDescriptionCount = attributes.size(),
        .pVertexAttributeDescriptions = attributes.data()};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = window.sampleCountFlagBits()};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE,
        .depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL};
    const VkPipelineColorBlendAttachmentState blend{.colorWriteMask = 0xf};
    const VkPipelineColorBlendStateCreateInfo blending{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &blend};
    constexpr std::array<VkDynamicState, 2> dynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo changing{.sType =
                                                        VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                    .dynamicStateCount = dynamic.size(),
                                                    .pDynamicStates = dynamic.data()};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .stageCount = stages.size(),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blending,
                                            .pDynamicState = &changing,
                                            .layout = layout_,
                                            .renderPass = window.defaultRenderPass()};
    const VkResult result =
        functions_->vkCreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    functions_->vkDestroyShaderModule(device_, vertex, nullptr);
    functions_->vkDestroyShaderModule(device_, fragment, nullptr);
    check(result, "vkCreateGraphicsPipelines");
}

void Drawing::record(const QVulkanWindow& window, const sinew::sim::Simulation& simulation,
                     const QMatrix4x4& clipFromWorld) const {
    const VkCommandBuffer commands = window.currentCommandBuffer();
    const QSize size = window.swapChainImageSize();
    const VkExtent2D extent{static_cast<std::uint32_t>(size.width()),
                            static_cast<std::uint32_t>(size.height())};
    const std::array<VkClearValue, 3> clears{
        {{.color = {{0.86f, 0.88f, 0.91f, 1}}},
         {.depthStencil = {1, 0}},
         {.color = {{0.86f, 0.88f, 0.91f, 1}}}}}; // the last one with samples
    const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                      .renderPass = window.defaultRenderPass(),
                                      .framebuffer = window.currentFramebuffer(),
                                      .renderArea = {.extent = extent},
                                      .clearValueCount =
                                          window.sampleCountFlagBits() > VK_SAMPLE_COUNT_1_BIT ? 3u : 2u,
                                      .pClearValues = clears.data()};
    functions_->vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(size.width()), static_cast<float>(size.height()),
                              0, 1};
    const VkRect2D scissor{.extent = extent};
    functions_->vkCmdSetViewport(commands, 0, 1, &viewport);
    functions_->vkCmdSetScissor(commands, 0, 1, &scissor);
    functions_->vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    Push push{};
    std::memcpy(push.clipFromWorld, clipFromWorld.constData(), sizeof push.clipFromWorld);
    const auto paint = [&](const sinew::sim::Vec3& color) {
        const std::array<float, 4> value{color.x, color.y, color.z, 1};
        std::memcpy(push.color, value.data(), sizeof push.color);
        functions_->vkCmdPushConstants(commands, layout_,
                                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                       sizeof push, &push);
    };
    const auto bind = [&](const sinew::vk::BufferView& vertices, const sinew::vk::BufferView& indices) {
        functions_->vkCmdBindVertexBuffers(commands, 0, 1, &vertices.buffer, &vertices.offset);
        functions_->vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
    };
    const sinew::sim::Simulation::DrawnSkins skins = simulation.drawnSkins();
    if (skins.indices.size > 0) {
        bind(simulation.skinVertices(), skins.indices);
        for (const sinew::sim::SkinRange& range : skins.ranges) {
            paint(range.color);
            functions_->vkCmdDrawIndexed(commands, range.indexCount, 1, range.firstIndex, 0, 0);
        }
    }
    if (const sinew::sim::CutSurface cut = simulation.cutSurface();
        cut.draws.size > 0 && !skins.ranges.empty()) {
        bind(cut.vertices, cut.indices);
        paint({0.55f, 0.12f, 0.12f}); // inside
        functions_->vkCmdDrawIndexedIndirect(commands, cut.draws.buffer, cut.draws.offset, 1, drawStride);
        paint(skins.ranges.front().color); // pieces of skins, which have one color here
        functions_->vkCmdDrawIndexedIndirect(commands, cut.draws.buffer, cut.draws.offset + drawStride, 1,
                                             drawStride);
    }
    functions_->vkCmdEndRenderPass(commands);
}
