// Records a picture: shadow map, plan map and floor map, then skins, colliders, ground and sky in one pass,
// which is multisampled if the quality asks for it.
#include "viewer/render/renderer.hpp"

#include "sinew/vk/commands.hpp"
#include "viewer/render/mesh_buffer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::array empty{VkClearValue{.color = {{0, 0, 0, 1}}}, VkClearValue{.depthStencil = {1, 0}}};

constexpr std::uint64_t picturesBeforeUnseen = 3; // the first picture should come soon

bool isSrgb(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB;
}

std::array<vk::SpecialisationConstant, 3> lookOf(const Renderer::Target& target, const Quality& quality) {
    return {vk::SpecialisationConstant{0, isSrgb(target.color) ? 0u : 1u},
            vk::SpecialisationConstant{1, quality.shadowTaps},
            vk::SpecialisationConstant{2, quality.skyTaps}};
}

// Marks of held particles are many, small and without penumbras: a few taps are enough.
std::array<vk::SpecialisationConstant, 3> heldLookOf(const Renderer::Target& target, Quality quality) {
    quality.shadowTaps = std::max(quality.shadowTaps / 8, 1u);
    return lookOf(target, quality);
}

VkFormat canvasDepthFormat(const vk::Device& device) {
    // Vulkan guarantees one of these two.
    constexpr std::array formats{VK_FORMAT_D32_SFLOAT, VK_FORMAT_X8_D24_UNORM_PACK32};
    return findFormat(device, formats, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT);
}

// Insides of inside.glsl: a head for each skin, then the depths of all.
vk::Buffer insidesBuffer(const vk::Device& device, const SkinDepths& of) {
    std::vector<float> all(sizeof(of.skins) / sizeof(float) + std::max<std::size_t>(of.depths.size(), 1));
    std::memcpy(all.data(), of.skins.data(), sizeof(of.skins));
    std::ranges::copy(of.depths, all.begin() + sizeof(of.skins) / sizeof(float));
    return filledBuffer(device, "picture.insides", all, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

} // namespace

Quality reducedQuality() {
    return {.shadowSize = 1024,
            .floorSize = 160,
            .shadowTaps = 8,
            .skyTaps = 20,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .keepsBackdrop = true,
            .mayEnlarge = true,
            .leavesBacks = true,
            .floorEvery = 2,
            .shadesOnce = true};
}

bool isSoftware(const vk::Device& device) {
    return device.description().type == "software";
}

Renderer::Renderer(const vk::Device& device, const Target& target, const Quality& quality,
                   const SceneLight& light)
    : device_(device), light_(light), colliders_(device, light.colliders),
      sphere_(device, {{.radius = 1, .color = handColor}}), format_{target.color, canvasDepthFormat(device),
                                                                    quality.samples},
      finalLayout_(target.finalLayout), quality_(quality), drawsEdges_(viewer::drawsEdges(device)),
      maps_(device, quality.shadowSize, quality.floorSize),
      pass_(RenderPass::picture(device, {.color = format_.color,
                                         .depth = format_.depth,
                                         .samples = format_.samples,
                                         .finalLayout = target.finalLayout})),
      insidesOfSkins_(insidesBuffer(device, light.depths)),
      sets_(device, maps_, insidesOfSkins_.view(), slots), balls_(device, light.balls),
      insides_(device, light.insides, 0), marks_(device, light.marks, 0), walls_(device, light.walls),
      hand_(device), strokes_(device, {.name = "strokes",
                                       .count = slots * pointsASlot,
                                       .stride = sizeof(sim::layout::vec4),
                                       .kind = vk::MemoryKind::upload,
                                       .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}),
      sheets_(filledBuffer(device, "picture.sheets",
                           light.sheets.empty() ? std::vector<layout::vec4>(1) : light.sheets,
                           VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)),
      nothing_(filledBuffer(device, "picture.nothing", std::vector<sim::layout::vec4>(64),
                            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)),
      look_(lookOf(target, quality)), heldLook_(heldLookOf(target, quality)),
      copiedPass_(RenderPass::picture(device, {.color = format_.color,
                                               .depth = format_.depth,
                                               .samples = format_.samples,
                                               .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL})) {
    Additions to;
    makeMaps(to);
    makeBodies(to);
    makeCuts(to);
    if (quality.shadesOnce) {
        surfacesPass_.emplace(RenderPass::surfaces(device_, surfaceFormats, format_.depth));
        for (const VkImageLayout layout : {target.finalLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL})
            keepingPasses_.push_back(RenderPass::picture(device_, {.color = format_.color,
                                                                   .depth = format_.depth,
                                                                   .samples = format_.samples,
                                                                   .finalLayout = layout,
                                                                   .keepsDepth = true}));
        makeSurfaces(to);
    }
    if (!light_.sheets.empty()) makeSheets(to);
    if (!balls_.ranges().empty()) makeBalls(to);
    if (!marks_.ranges().empty()) makeHeld(to);
    if (!walls_.isEmpty()) makeWalls(to);
    readablePass_.emplace(
        RenderPass::picture(device_, {.color = format_.color,
                                      .depth = format_.depth,
                                      .samples = format_.samples,
                                      .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));
    if (quality.keepsBackdrop) makeBackdrop(to);
    wholePass_.emplace(RenderPass::whole(device_, format_.color, finalLayout_));
    makeEnlarging(to);
    add(std::move(to));
}

Canvas Renderer::makeCanvas(VkExtent2D extent, std::span<const VkImageView> pictures, float scale) const {
    Canvas canvas = scale < 1 && quality_.mayEnlarge
                        ? Canvas(device_, *readablePass_, format_,
                                 Enlarging(device_, *wholePass_, format_.color, extent, scale, pictures))
                        : Canvas(device_, pass_, format_, extent, pictures);
    if (has(backdropPipeline)) canvas.addBackdrop(device_, *readablePass_, format_.color);
    addSurfaces(canvas);
    return canvas;
}

Canvas Renderer::makeCopiedCanvas(VkExtent2D extent, std::span<const VkImageView> pictures,
                                  float scale) const {
    if (finalLayout_ == VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL) return makeCanvas(extent, pictures, scale);
    Canvas canvas(device_, copiedPass_, format_, extent, pictures);
    canvas.setCopied();
    addSurfaces(canvas);
    return canvas;
}

void Renderer::addSurfaces(Canvas& canvas) const {
    if (surfacesPass_) canvas.addSurfaces(device_, *surfacesPass_);
}

// The passes differ only in the picture's final layout, which pipelines do not depend on.
const RenderPass& Renderer::passOf(const Canvas& canvas, bool keepsDepth) const noexcept {
    if (keepsDepth) return keepingPasses_[canvas.enlarging() ? 1 : canvas.isCopied() ? 2 : 0];
    return canvas.enlarging() ? *readablePass_ : canvas.isCopied() ? copiedPass_ : pass_;
}

// A section discards fragments sample by sample, glass is blended, and maps of values are hardly shaded.
bool Renderer::shadesOnce(const Canvas& canvas, const Layers& layers) const noexcept {
    return canvas.hasSurfaces() && !layers.section && layers.map() == ColorMap::none &&
           layers.skin() == SkinLook::solid;
}

void Renderer::record(VkCommandBuffer commands, std::uint32_t slot, Canvas& canvas, std::size_t picture,
                      const Camera& camera, const sim::Simulation& simulation,
                      const Overlay& overlay) noexcept {
    layout::FrameParams params = frameParams(light_, camera, canvas.aspect(), overlay.layers.section);
    params.look.x = overlay.layers.map() != ColorMap::none ? 1 : 0;
    sets_.write(slot, params);
    leavesBacks_ = quality_.leavesBacks && !overlay.layers.section && !light_.bounds.contains(eye(camera));
    const bool isOpened = overlay.layers.section && canvas.hasCounts() && has(capPipeline);
    // Without counts another image is bound: drivers validate a set as a whole.
    sets_.writeCounts(slot, isOpened ? canvas.counts() : maps_.floor.image.view(), maps_.nearest());
    const Sheet sheet{canvas, picture, slot};
    const Backdrop::Use backdrop = prepareBackdrop(sheet, params);
    const std::optional<Enlarging>& enlarging = canvas.enlarging();
    sets_.writeEnlarged(slot, enlarging ? enlarging->view() : maps_.floor.image.view(), maps_.stretching());
    const VkImageView unused = maps_.floor.image.view();
    const bool isOnce = shadesOnce(canvas, overlay.layers);
    sets_.writeSurfaces(slot, isOnce ? canvas.normals() : unused, isOnce ? canvas.materials() : unused,
                        maps_.nearest());
    sets_.bind(commands, slot);
    vk::Commands labels(device_, commands);
    labels.beginLabel("light maps");
    const bool isPart = enlarging && !enlarging->isWhole(); // other halves show other bodies
    recordMaps(commands, simulation, overlay, isPart || pictures_++ % quality_.floorEvery == 0);
    labels.endLabel();
    if (isOpened) {
        labels.beginLabel("section");
        recordCounts(commands, canvas, simulation, overlay);
        labels.endLabel();
    }
    if (backdrop == Backdrop::Use::made) {
        labels.beginLabel("backdrop");
        recordBackdrop(commands, canvas, params);
        labels.endLabel();
    }
    labels.beginLabel("picture");
    if (isOnce) recordSurfaces(commands, canvas, simulation, overlay.layers);
    recordPicture(commands, sheet, simulation, overlay, params, backdrop != Backdrop::Use::direct);
    if (enlarging && enlarging->isWhole()) recordEnlarging(commands, *enlarging, picture);
    labels.endLabel();
}

// If a translucent skin shows balls, only the balls cast shadows. Light enters a closed body through a face
// towards the light, so the other half of its faces is not drawn.
void Renderer::drawShades(VkCommandBuffer commands, const Shades& shades, const sim::Simulation& simulation,
                          const Overlay& overlay) const noexcept {
    const Layers& layers = overlay.layers;
    const bool hasSkins = layers.skin() == SkinLook::solid ||
                          (layers.skin() == SkinLook::glass && !layers.has(layer::particles));
    const std::size_t ofAll = opened(shades.all, layers);
    const std::size_t ofSolids = quality_.leavesBacks && !layers.section ? shades.facing : ofAll;
    const std::size_t ofCuts = light_.areSolidsOutward() ? ofSolids : ofAll;
    if (hasSkins) drawSkins(commands, {ofAll, ofSolids}, simulation);
    if (hasSkins) drawCuts(commands, ofCuts, ofCuts, simulation);
    drawColliders(commands, shades.all, simulation);
    drawHostColliders(commands, shades.all, simulation);
    drawBalls(commands, opened(shades.balls, layers), simulation, overlay);
}

void Renderer::recordMaps(VkCommandBuffer commands, const sim::Simulation& simulation, const Overlay& overlay,
                          bool isFloorDue) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    const std::array far{VkClearValue{.depthStencil = {1, 0}}};
    const std::array open{VkClearValue{.color = {{1, 1, 1, 1}}}};
    const auto beginMap = [&](const LightMap& map, std::span<const VkClearValue> clear) {
        begin(commands, map.pass, map.framebuffer.handle(), map.image.extent(), clear);
    };
    beginMap(maps_.shadow, far);
    drawShades(commands, {shadowPipeline, shadowFacingPipeline, ballShadowPipeline}, simulation, overlay);
    functions.vkCmdEndRenderPass(commands);
    if (!isFloorDue) return;
    // Without a ground the other two maps are only cleared: the shaders' bindings must be readable.
    beginMap(maps_.plan, far);
    if (light_.ground)
        drawShades(commands, {planPipeline, planFacingPipeline, ballPlanPipeline}, simulation, overlay);
    functions.vkCmdEndRenderPass(commands);
    beginMap(maps_.floor, open);
    if (light_.ground) {
        bind(commands, floorPipeline);
        functions.vkCmdDraw(commands, 3, 1, 0, 0);
    }
    functions.vkCmdEndRenderPass(commands);
}

Backdrop::Use Renderer::prepareBackdrop(const Sheet& sheet,
                                        const layout::FrameParams& params) const noexcept {
    Canvas& canvas = sheet.canvas;
    const Backdrop::Use use = canvas.hasBackdrop() ? canvas.backdrop().next(params) : Backdrop::Use::direct;
    const bool isRead = use != Backdrop::Use::direct;
    sets_.writeBackdrop(sheet.slot, isRead ? canvas.backdrop().view() : maps_.floor.image.view(),
                        maps_.nearest());
    return use;
}

void Renderer::recordBackdrop(VkCommandBuffer commands, const Canvas& canvas,
                              const layout::FrameParams& params) const noexcept {
    begin(commands, *readablePass_, canvas.backdrop().framebuffer(), canvas.extent(), empty);
    if (light_.ground) drawGround(commands, params, false);
    drawScreen(commands, skyPipeline);
    device_.functions().vkCmdEndRenderPass(commands);
}

void Renderer::recordPicture(VkCommandBuffer commands, const Sheet& sheet, const sim::Simulation& simulation,
                             const Overlay& overlay, const layout::FrameParams& params,
                             bool hasBackdrop) const noexcept {
    const Canvas& canvas = sheet.canvas;
    const Layers& layers = overlay.layers;
    const bool isOnce = shadesOnce(canvas, layers);
    begin(commands, passOf(canvas, isOnce), canvas.framebuffer(sheet.picture), canvas.extent(), empty);
    if (isOnce) {
        drawScreen(commands, surfacesPipeline);
    } else {
        drawThings(commands, simulation, layers, skinPipeline);
        drawThings(commands, simulation, layers, skinBacksPipeline);
    }
    if (layers.map() != ColorMap::none) {
        drawValues(commands, simulation, overlay);
    } else {
        drawBalls(commands, opened(ballPipeline, layers), simulation, overlay);
        if (layers.skin() == SkinLook::solid) drawSheets(commands, layers, simulation);
        if (layers.skin() == SkinLook::solid && !isOnce)
            drawCuts(commands, opened(insidePipeline, layers), opened(clippedPipeline, layers), simulation);
    }
    drawMarks(commands, simulation, layers);
    drawWalls(commands, skinPipeline, walls_.bars(), barColor);
    drawCap(commands, canvas, layers);
    if (overlay.hand) drawHand(commands, simulation, *overlay.hand, handColor, 1);
    for (const Hand& pin : overlay.pins) drawHand(commands, simulation, pin, pinColor, -1);
    if (pictures_ == picturesBeforeUnseen) drawUnseen(commands, {handPipeline});
    drawStroke(commands, overlay.stroke, strokeColor, sheet.slot * pointsASlot);
    drawStroke(commands, overlay.gauge.first(std::min<std::size_t>(overlay.gauge.size(), 2)), gaugeColor,
               sheet.slot * pointsASlot + mostStrokePoints);
    if (light_.ground) drawGround(commands, params, hasBackdrop);
    drawScreen(commands, hasBackdrop ? backdropPipeline : skyPipeline);
    drawWalls(commands, wallPipeline, walls_.sides(), sideColor);
    recordLayers(commands, simulation, overlay);
    device_.functions().vkCmdEndRenderPass(commands);
}

void Renderer::recordSurfaces(VkCommandBuffer commands, const Canvas& canvas,
                              const sim::Simulation& simulation, const Layers& layers) const noexcept {
    constexpr std::array nothing{VkClearValue{}, VkClearValue{}, VkClearValue{.depthStencil = {1, 0}}};
    begin(commands, *surfacesPass_, canvas.surfacesFramebuffer(), canvas.extent(), nothing);
    drawThings(commands, simulation, layers, skinSurfacePipeline);
    drawThings(commands, simulation, layers, skinBacksSurfacePipeline);
    drawCuts(commands, insideSurfacePipeline, clippedSurfacePipeline, simulation);
    if (pictures_ == picturesBeforeUnseen && simulation.cutSurface().draws.size > 0)
        drawUnseen(commands, {insideSurfacePipeline, clippedSurfacePipeline});
    device_.functions().vkCmdEndRenderPass(commands);
}

void Renderer::recordEnlarging(VkCommandBuffer commands, const Enlarging& enlarging,
                               std::size_t picture) const noexcept {
    begin(commands, *wholePass_, enlarging.framebuffer(picture), enlarging.extent(), {});
    drawScreen(commands, enlargePipeline);
    device_.functions().vkCmdEndRenderPass(commands);
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

} // namespace sinew::viewer
