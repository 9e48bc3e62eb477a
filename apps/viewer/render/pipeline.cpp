// Fills in Vulkan's structs for a graphics pipeline.
#include "viewer/render/pipeline.hpp"

#include "common/layout.h"
#include "sinew/vk/check.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <array>
#include <utility>

namespace sinew::viewer {

namespace {

// A shader module that lives as long as pipeline creation.
class Module {
public:
    Module(const vk::Device& device, const vk::ShaderCode& code) : device_(device) {
        const std::vector<std::uint32_t> words = vk::wordsOf(code);
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .codeSize = words.size() * sizeof(std::uint32_t),
                                            .pCode = words.data()};
        vk::check(device.functions().vkCreateShaderModule(device.handle(), &info, nullptr, &module_),
                  "vkCreateShaderModule", code.name);
    }
    ~Module() { device_.functions().vkDestroyShaderModule(device_.handle(), module_, nullptr); }
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;

    VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage,
                                          const VkSpecializationInfo& constants) const {
        return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = stage,
                .module = module_,
                .pName = "main",
                .pSpecializationInfo = &constants};
    }

private:
    const vk::Device& device_;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

constexpr VkVertexInputBindingDescription skinBinding{0, sizeof(sim::layout::SkinVertex),
                                                      VK_VERTEX_INPUT_RATE_VERTEX};
constexpr std::array skinAttributes{
    VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT,
                                      offsetof(sim::layout::SkinVertex, position)},
    VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32B32A32_SFLOAT,
                                      offsetof(sim::layout::SkinVertex, normal)}};

constexpr std::array ballBindings{
    VkVertexInputBindingDescription{0, sizeof(sim::layout::vec4), VK_VERTEX_INPUT_RATE_VERTEX},
    VkVertexInputBindingDescription{1, sizeof(sim::layout::vec4), VK_VERTEX_INPUT_RATE_INSTANCE},
    VkVertexInputBindingDescription{2, sizeof(std::uint32_t), VK_VERTEX_INPUT_RATE_INSTANCE},
    VkVertexInputBindingDescription{3, sizeof(float), VK_VERTEX_INPUT_RATE_INSTANCE}};
constexpr std::array ballAttributes{VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
                                    VkVertexInputAttributeDescription{1, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
                                    VkVertexInputAttributeDescription{4, 2, VK_FORMAT_R32_UINT, 0},
                                    VkVertexInputAttributeDescription{2, 3, VK_FORMAT_R32_SFLOAT, 0}};

constexpr std::array cutBindings{
    skinBinding,
    VkVertexInputBindingDescription{1, sizeof(sim::layout::CutVertex), VK_VERTEX_INPUT_RATE_VERTEX}};
constexpr std::array cutAttributes{
    skinAttributes[0], skinAttributes[1],
    VkVertexInputAttributeDescription{2, 1, VK_FORMAT_R32G32B32A32_SFLOAT,
                                      offsetof(sim::layout::CutVertex, rest)},
    VkVertexInputAttributeDescription{4, 1, VK_FORMAT_R32_UINT, offsetof(sim::layout::CutVertex, point)}};

// Bindings with a value for each vertex or instance.
constexpr VkVertexInputBindingDescription valueBinding(std::uint32_t binding, VkVertexInputRate rate) {
    return {binding, sizeof(float), rate};
}
constexpr VkVertexInputAttributeDescription valueAttribute(std::uint32_t binding) {
    return {3, binding, VK_FORMAT_R32_SFLOAT, 0};
}
constexpr std::array skinValueBindings{skinBinding, valueBinding(1, VK_VERTEX_INPUT_RATE_VERTEX)};
constexpr std::array skinValueAttributes{skinAttributes[0], skinAttributes[1], valueAttribute(1)};
constexpr std::array ballValueBindings{ballBindings[0], ballBindings[1], ballBindings[2], ballBindings[3],
                                       valueBinding(4, VK_VERTEX_INPUT_RATE_INSTANCE)};
constexpr std::array ballValueAttributes{ballAttributes[0], ballAttributes[1], ballAttributes[2],
                                         ballAttributes[3], valueAttribute(4)};
constexpr std::array cutValueBindings{cutBindings[0], cutBindings[1],
                                      valueBinding(2, VK_VERTEX_INPUT_RATE_VERTEX)};
constexpr std::array cutValueAttributes{cutAttributes[0], cutAttributes[1], valueAttribute(2)};

constexpr std::array sheetBindings{
    skinBinding, VkVertexInputBindingDescription{1, sizeof(sim::layout::vec4), VK_VERTEX_INPUT_RATE_VERTEX}};
constexpr std::array sheetAttributes{
    skinAttributes[0], skinAttributes[1],
    VkVertexInputAttributeDescription{4, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 0}};

constexpr std::array panelBindings{
    VkVertexInputBindingDescription{0, sizeof(PanelVertex), VK_VERTEX_INPUT_RATE_VERTEX}};
constexpr std::array panelAttributes{
    VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, place)},
    VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, atlas)},
    VkVertexInputAttributeDescription{2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(PanelVertex, color)}};

// In the order of PipelineRequest::Input.
constexpr std::array vertexForms{VertexForm{},
                                 VertexForm{{&skinBinding, 1}, {skinAttributes.data(), 1}},
                                 VertexForm{{&skinBinding, 1}, skinAttributes},
                                 VertexForm{ballBindings, ballAttributes},
                                 VertexForm{{ballBindings.data(), 3}, {ballAttributes.data(), 3}},
                                 VertexForm{cutBindings, cutAttributes},
                                 VertexForm{panelBindings, panelAttributes},
                                 VertexForm{skinValueBindings, skinValueAttributes},
                                 VertexForm{ballValueBindings, ballValueAttributes},
                                 VertexForm{cutValueBindings, cutValueAttributes},
                                 VertexForm{sheetBindings, sheetAttributes}};

VkPipelineVertexInputStateCreateInfo vertexInput(const PipelineRequest& request) {
    const VertexForm& form = request.input == PipelineRequest::Input::own
                                 ? request.vertices
                                 : vertexForms[static_cast<std::size_t>(request.input)];
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
            .vertexBindingDescriptionCount = static_cast<std::uint32_t>(form.bindings.size()),
            .pVertexBindingDescriptions = form.bindings.data(),
            .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(form.attributes.size()),
            .pVertexAttributeDescriptions = form.attributes.data()};
}

VkPipelineDepthStencilStateCreateInfo depthState(PipelineRequest::Depth depth) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
            .depthTestEnable = depth != PipelineRequest::Depth::none,
            .depthWriteEnable = depth == PipelineRequest::Depth::testAndWrite,
            .depthCompareOp = depth == PipelineRequest::Depth::testBehind ? VK_COMPARE_OP_GREATER
                                                                          : VK_COMPARE_OP_LESS_OR_EQUAL};
}

constexpr std::array dynamicStates{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
constexpr VkPipelineDynamicStateCreateInfo dynamicState{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
    .dynamicStateCount = dynamicStates.size(),
    .pDynamicStates = dynamicStates.data()};
constexpr VkPipelineViewportStateCreateInfo viewportState{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
constexpr std::array<VkCullModeFlags, 3> culls{
    VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT,
    VK_CULL_MODE_FRONT_BIT}; // in the order of PipelineRequest::Faces

VkPipelineRasterizationStateCreateInfo rasterState(const PipelineRequest& request) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
            .polygonMode = request.hasEdgesAlone ? VK_POLYGON_MODE_LINE : VK_POLYGON_MODE_FILL,
            .cullMode = culls[static_cast<std::size_t>(request.faces)],
            .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
            .lineWidth = 1};
}
constexpr VkColorComponentFlags allComponents =
    VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
constexpr VkPipelineColorBlendAttachmentState opaque{.colorWriteMask = allComponents};
constexpr VkPipelineColorBlendAttachmentState blended{.blendEnable = VK_TRUE,
                                                      .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
                                                      .dstColorBlendFactor =
                                                          VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                                      .srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO,
                                                      .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                      .colorWriteMask = allComponents};

constexpr VkPipelineColorBlendAttachmentState summed{.blendEnable = VK_TRUE,
                                                     .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                     .dstColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                     .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                     .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                     .colorWriteMask = allComponents};
constexpr VkPipelineColorBlendAttachmentState ofAlpha(VkBlendFactor source, VkBlendFactor sourceAlpha,
                                                      VkBlendFactor alpha) {
    VkPipelineColorBlendAttachmentState state = blended;
    state.srcColorBlendFactor = source;
    state.srcAlphaBlendFactor = sourceAlpha;
    state.dstAlphaBlendFactor = alpha;
    return state;
}
constexpr VkPipelineColorBlendAttachmentState laid =
    ofAlpha(VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA);
constexpr VkPipelineColorBlendAttachmentState overTimesAlpha =
    ofAlpha(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ZERO, VK_BLEND_FACTOR_ONE);
constexpr std::array blends{&opaque, &blended, &summed, &laid,
                            &overTimesAlpha}; // in the order of PipelineRequest::Blend

VkPipeline create(const vk::Device& device, const PipelineRequest& request,
                  std::span<const VkPipelineShaderStageCreateInfo> stages) {
    const VkPipelineVertexInputStateCreateInfo input = vertexInput(request);
    const VkPipelineDepthStencilStateCreateInfo depth = depthState(request.depth);
    const VkPipelineRasterizationStateCreateInfo raster = rasterState(request);
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, .topology = request.topology};
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = request.samples};
    std::array<VkPipelineColorBlendAttachmentState, 2> colors;
    colors.fill(*blends[static_cast<std::size_t>(request.blend)]);
    const VkPipelineColorBlendStateCreateInfo blend{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = request.fragment && !request.isDepthOnly ? request.colors : 0u,
        .pAttachments = colors.data()};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .stageCount = static_cast<std::uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewportState,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &multisample,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamicState,
                                            .layout = request.layout,
                                            .renderPass = request.pass};
    VkPipeline pipeline = VK_NULL_HANDLE;
    vk::check(device.functions().vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info,
                                                           nullptr, &pipeline),
              "vkCreateGraphicsPipelines", request.name);
    return pipeline;
}

} // namespace

Pipeline::Pipeline(const vk::Device& device, const PipelineRequest& request) : device_(&device) {
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    for (const vk::SpecialisationConstant& constant : request.constants) {
        entries.push_back({constant.id, static_cast<std::uint32_t>(values.size() * sizeof(std::uint32_t)),
                           sizeof(std::uint32_t)});
        values.push_back(constant.value);
    }
    const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                         values.size() * sizeof(std::uint32_t), values.data()};
    const Module vertex(device, *request.vertex);
    std::vector stages{vertex.stage(VK_SHADER_STAGE_VERTEX_BIT, constants)};
    std::optional<Module> fragment;
    if (request.fragment) {
        fragment.emplace(device, *request.fragment);
        stages.push_back(fragment->stage(VK_SHADER_STAGE_FRAGMENT_BIT, constants));
    }
    pipeline_ = create(device, request, stages);
    device.kernels().countPipeline();
    device.name(VK_OBJECT_TYPE_PIPELINE, vk::handleValue(pipeline_), request.name);
}

Pipeline::Pipeline(Pipeline&& other) noexcept
    : device_(other.device_), pipeline_(std::exchange(other.pipeline_, VK_NULL_HANDLE)) {}

Pipeline::~Pipeline() {
    device_->functions().vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
}

} // namespace sinew::viewer
