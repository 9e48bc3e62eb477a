// Recording of a picture: shadow map, plan map, floor map, then skins, ground and sky in one multisampled
// pass.
#include "viewer/renderer.hpp"

#include "viewer_shaders.hpp"
#include "vk/check.hpp"
#include "vk/commands.hpp"

#include <cstring>

namespace sinew::viewer {

namespace {

enum PipelineIndex : std::size_t {
    shadowPipeline,
    planPipeline,
    floorPipeline,
    skinPipeline,
    groundPipeline,
    skyPipeline
};
constexpr std::uint32_t bindingCount = 5; // frame.glsl, light.glsl, floor.frag
constexpr VkShaderStageFlags drawingStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

bool isSrgb(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB;
}

VkFormat canvasDepthFormat(const vk::Device& device) {
    // The specification promises one of the first two.
    constexpr std::array formats{VK_FORMAT_D32_SFLOAT, VK_FORMAT_X8_D24_UNORM_PACK32};
    return findFormat(device, formats, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT);
}

std::vector<vk::Buffer> makeParams(const vk::Device& device) {
    std::vector<vk::Buffer> params;
    for (std::uint32_t slot = 0; slot < Renderer::slots; ++slot)
        params.emplace_back(device, vk::BufferRequest{.name = "picture.params",
                                                      .count = 1,
                                                      .stride = sizeof(layout::FrameParams),
                                                      .kind = vk::MemoryKind::upload,
                                                      .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT});
    return params;
}

} // namespace

Quality reducedQuality() {
    return {.shadowSize = 1024, .floorSize = 256, .shadowTaps = 12, .skyTaps = 20};
}

bool isSoftware(const vk::Device& device) {
    return device.description().type == "software";
}

Renderer::Renderer(const vk::Device& device, const Target& target, const Quality& quality,
                   const StageLight& light)
    : device_(device), light_(light), format_{target.color, canvasDepthFormat(device), quality.samples},
      maps_(device, quality.shadowSize, quality.floorSize),
      pass_(RenderPass::picture(device, {.color = format_.color,
                                         .depth = format_.depth,
                                         .samples = format_.samples,
                                         .finalLayout = target.finalLayout})),
      params_(makeParams(device)) {
    try {
        createLayouts();
        createSets();
        createPipelines(target, quality);
    } catch (...) {
        release();
        throw;
    }
}

Renderer::~Renderer() {
    release();
}

void Renderer::release() noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    functions.vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    functions.vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void Renderer::createLayouts() {
    std::array<VkDescriptorSetLayoutBinding, bindingCount> bindings{};
    for (std::uint32_t binding = 0; binding < bindingCount; ++binding)
        bindings[binding] = {.binding = binding,
                             .descriptorType = binding == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                            : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                             .descriptorCount = 1,
                             .stageFlags = drawingStages};
    const VkDescriptorSetLayoutCreateInfo setInfo{.sType =
                                                      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .bindingCount = bindingCount,
                                                  .pBindings = bindings.data()};
    vk::check(
        device_.functions().vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_),
        "vkCreateDescriptorSetLayout", "picture");
    const VkPushConstantRange push{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(layout::SkinPush)};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &setLayout_,
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &push};
    vk::check(device_.functions().vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout_),
              "vkCreatePipelineLayout", "picture");
}

void Renderer::createSets() {
    const std::array sizes{
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, slots},
        VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, (bindingCount - 1) * slots}};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = slots,
                                          .poolSizeCount = sizes.size(),
                                          .pPoolSizes = sizes.data()};
    vk::check(device_.functions().vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool_),
              "vkCreateDescriptorPool", "picture");
    std::array<VkDescriptorSetLayout, slots> layouts;
    layouts.fill(setLayout_);
    const VkDescriptorSetAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                 .descriptorPool = pool_,
                                                 .descriptorSetCount = slots,
                                                 .pSetLayouts = layouts.data()};
    vk::check(device_.functions().vkAllocateDescriptorSets(device_.handle(), &allocation, sets_.data()),
              "vkAllocateDescriptorSets", "picture");
    for (std::uint32_t slot = 0; slot < slots; ++slot) writeSet(slot);
}

void Renderer::writeSet(std::uint32_t slot) const {
    constexpr VkImageLayout readable = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkDescriptorBufferInfo params{params_[slot].view().buffer, params_[slot].view().offset,
                                        sizeof(layout::FrameParams)};
    const std::array<VkDescriptorImageInfo, bindingCount - 1> images{
        VkDescriptorImageInfo{maps_.comparing(), maps_.shadow.image.view(), readable},
        VkDescriptorImageInfo{maps_.nearest(), maps_.shadow.image.view(), readable},
        VkDescriptorImageInfo{maps_.nearest(), maps_.plan.image.view(), readable},
        VkDescriptorImageInfo{maps_.smooth(), maps_.floor.image.view(), readable}};
    std::array<VkWriteDescriptorSet, bindingCount> writes{};
    for (std::uint32_t binding = 0; binding < bindingCount; ++binding)
        writes[binding] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                           .dstSet = sets_[slot],
                           .dstBinding = binding,
                           .descriptorCount = 1,
                           .descriptorType = binding == 0 ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                          : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           .pImageInfo = binding == 0 ? nullptr : &images[binding - 1],
                           .pBufferInfo = binding == 0 ? &params : nullptr};
    device_.functions().vkUpdateDescriptorSets(device_.handle(), bindingCount, writes.data(), 0, nullptr);
}

void Renderer::createPipelines(const Target& target, const Quality& quality) {
    using Input = PipelineRequest::Input;
    using Depth = PipelineRequest::Depth;
    const std::array look{vk::SpecialisationConstant{0, isSrgb(target.color) ? 0u : 1u},
                          vk::SpecialisationConstant{1, quality.shadowTaps},
                          vk::SpecialisationConstant{2, quality.skyTaps}};
    const std::array plan{vk::SpecialisationConstant{3, 1}};
    const auto add = [&](PipelineRequest request) {
        request.layout = layout_;
        pipelines_.emplace_back(device_, request);
    };
    add({.name = "picture.shadow",
         .vertex = &shaders::depthVert,
         .pass = maps_.shadow.pass.handle(),
         .input = Input::positions,
         .depth = Depth::testAndWrite});
    add({.name = "picture.plan",
         .vertex = &shaders::depthVert,
         .pass = maps_.plan.pass.handle(),
         .input = Input::positions,
         .depth = Depth::testAndWrite,
         .constants = plan});
    add({.name = "picture.floor",
         .vertex = &shaders::screenVert,
         .fragment = &shaders::floorFrag,
         .pass = maps_.floor.pass.handle(),
         .constants = look});
    add({.name = "picture.skin",
         .vertex = &shaders::skinVert,
         .fragment = &shaders::skinFrag,
         .pass = pass_.handle(),
         .samples = quality.samples,
         .input = Input::positionsAndNormals,
         .depth = Depth::testAndWrite,
         .constants = look});
    add({.name = "picture.ground",
         .vertex = &shaders::groundVert,
         .fragment = &shaders::groundFrag,
         .pass = pass_.handle(),
         .samples = quality.samples,
         .depth = Depth::testAndWrite,
         .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
         .constants = look});
    add({.name = "picture.sky",
         .vertex = &shaders::screenVert,
         .fragment = &shaders::skyFrag,
         .pass = pass_.handle(),
         .samples = quality.samples,
         .depth = Depth::test,
         .constants = look});
}

Canvas Renderer::makeCanvas(VkExtent2D extent, std::span<const VkImageView> pictures) const {
    return Canvas(device_, pass_, format_, extent, pictures);
}

void Renderer::record(VkCommandBuffer commands, std::uint32_t slot, const Canvas& canvas, std::size_t picture,
                      const Camera& camera, const sim::Simulation& simulation) const noexcept {
    const layout::FrameParams params = frameParams(light_, camera, canvas.aspect());
    std::memcpy(params_[slot].mapped(), &params, sizeof(params));
    device_.functions().vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1,
                                                &sets_[slot], 0, nullptr);
    vk::Commands labels(device_, commands);
    labels.beginLabel("light maps");
    recordMaps(commands, simulation);
    labels.endLabel();
    labels.beginLabel("picture");
    recordPicture(commands, canvas, picture, simulation);
    labels.endLabel();
}

void Renderer::recordMaps(VkCommandBuffer commands, const sim::Simulation& simulation) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    const std::array far{VkClearValue{.depthStencil = {1, 0}}};
    const std::array open{VkClearValue{.color = {{1, 1, 1, 1}}}};
    const auto beginMap = [&](const LightMap& map, std::span<const VkClearValue> clear) {
        begin(commands, map.pass, map.framebuffer.handle(), map.image.extent(), clear);
    };
    beginMap(maps_.shadow, far);
    bind(commands, shadowPipeline);
    drawSkins(commands, simulation);
    functions.vkCmdEndRenderPass(commands);
    // Without a ground the other two are only cleared: the shaders' bindings stay readable.
    beginMap(maps_.plan, far);
    if (light_.ground) {
        bind(commands, planPipeline);
        drawSkins(commands, simulation);
    }
    functions.vkCmdEndRenderPass(commands);
    beginMap(maps_.floor, open);
    if (light_.ground) {
        bind(commands, floorPipeline);
        functions.vkCmdDraw(commands, 3, 1, 0, 0);
    }
    functions.vkCmdEndRenderPass(commands);
}

void Renderer::recordPicture(VkCommandBuffer commands, const Canvas& canvas, std::size_t picture,
                             const sim::Simulation& simulation) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    const std::array clear{VkClearValue{.color = {{0, 0, 0, 1}}}, VkClearValue{.depthStencil = {1, 0}}};
    begin(commands, pass_, canvas.framebuffer(picture), canvas.extent(), clear);
    bind(commands, skinPipeline);
    drawSkins(commands, simulation);
    if (light_.ground) {
        bind(commands, groundPipeline);
        functions.vkCmdDraw(commands, 4, 1, 0, 0);
    }
    bind(commands, skyPipeline);
    functions.vkCmdDraw(commands, 3, 1, 0, 0);
    functions.vkCmdEndRenderPass(commands);
}

void Renderer::begin(VkCommandBuffer commands, const RenderPass& pass, VkFramebuffer framebuffer,
                     VkExtent2D extent, std::span<const VkClearValue> clear) const noexcept {
    const VkRenderPassBeginInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                     .renderPass = pass.handle(),
                                     .framebuffer = framebuffer,
                                     .renderArea = {{0, 0}, extent},
                                     .clearValueCount = static_cast<std::uint32_t>(clear.size()),
                                     .pClearValues = clear.data()};
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    device_.functions().vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    device_.functions().vkCmdSetViewport(commands, 0, 1, &viewport);
    device_.functions().vkCmdSetScissor(commands, 0, 1, &scissor);
}

void Renderer::bind(VkCommandBuffer commands, std::size_t pipeline) const noexcept {
    device_.functions().vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                          pipelines_[pipeline].handle());
}

void Renderer::drawSkins(VkCommandBuffer commands, const sim::Simulation& simulation) const noexcept {
    const vk::BufferView vertices = simulation.skinVertices(), indices = simulation.skinIndices();
    if (simulation.skins().empty()) return;
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindVertexBuffers(commands, 0, 1, &vertices.buffer, &vertices.offset);
    functions.vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
    for (std::size_t i = 0; i < simulation.skins().size(); ++i) {
        const sim::SkinRange& skin = simulation.skins()[i];
        const layout::SkinPush push{{skin.color.x, skin.color.y, skin.color.z, light_.gloss[i]}};
        functions.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(push), &push);
        functions.vkCmdDrawIndexed(commands, skin.indexCount, 1, skin.firstIndex, 0, 0);
    }
}

} // namespace sinew::viewer
