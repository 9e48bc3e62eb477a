// Uses a pipeline once before a picture needs it: draws a degenerate triangle into an image that is drawn
// over anyway.
#include "viewer/render/renderer.hpp"

namespace sinew::viewer {

namespace {

constexpr std::uint32_t mostBindings = 5; // vertex bindings of any pipeline

} // namespace

// Drivers compile for the values that a shader branches on: this uses those of pictures.
void Renderer::recordRehearsal(VkCommandBuffer commands, std::uint32_t slot, Canvas& canvas,
                               const Camera& camera, const Layers& layers, const Additions& additions,
                               std::size_t which) const {
    const Additions::Made& made = additions.made_[which];
    const RenderPass* counts = additions.countsPass_ ? &*additions.countsPass_
                               : countsPass_         ? &*countsPass_
                                                     : nullptr;
    if (counts != nullptr) canvas.addCounts(device_, *counts, format_.samples);
    sets_.write(slot, frameParams(light_, camera, canvas.aspect(), layers.section));
    sets_.writeCounts(slot, canvas.hasCounts() ? canvas.counts() : maps_.floor.image.view(), maps_.nearest());
    sets_.writeBackdrop(slot, maps_.floor.image.view(), maps_.nearest());
    sets_.writeSurfaces(slot, maps_.floor.image.view(), maps_.floor.image.view(), maps_.nearest());
    sets_.writeEnlarged(slot, maps_.floor.image.view(), maps_.stretching());
    sets_.bind(commands, slot);
    constexpr std::array nothing{VkClearValue{}, VkClearValue{.depthStencil = {1, 0}}};
    constexpr std::array far{VkClearValue{.depthStencil = {1, 0}}};
    const auto isOf = [&](const RenderPass& pass) { return made.request.pass == pass.handle(); };
    const auto beginMap = [&](const LightMap& map) {
        begin(commands, map.pass, map.framebuffer.handle(), map.image.extent(), far);
    };
    if (isOf(maps_.shadow.pass))
        beginMap(maps_.shadow);
    else if (isOf(maps_.plan.pass))
        beginMap(maps_.plan);
    else if (counts != nullptr && isOf(*counts))
        begin(commands, *counts, canvas.countsFramebuffer(), canvas.extent(), nothing);
    else
        begin(commands, passOf(canvas), canvas.framebuffer(0), canvas.extent(), nothing);
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, made.pipeline.handle());
    bindNothing(commands);
    push(commands, {{layers.map() != ColorMap::none ? 1.0f : 0.0f}});
    functions.vkCmdDraw(commands, 3, 1, 0, 0);
    functions.vkCmdEndRenderPass(commands);
}

void Renderer::bindNothing(VkCommandBuffer commands) const noexcept {
    std::array<VkBuffer, mostBindings> buffers;
    std::array<VkDeviceSize, mostBindings> offsets;
    buffers.fill(nothing_.view().buffer);
    offsets.fill(nothing_.view().offset);
    device_.functions().vkCmdBindVertexBuffers(commands, 0, mostBindings, buffers.data(), offsets.data());
}

void Renderer::drawUnseen(VkCommandBuffer commands,
                          std::initializer_list<std::size_t> pipelines) const noexcept {
    bindNothing(commands);
    push(commands, layout::SkinPush{});
    for (const std::size_t pipeline : pipelines) {
        bind(commands, pipeline);
        device_.functions().vkCmdDraw(commands, 3, 1, 0, 0);
    }
}

} // namespace sinew::viewer
