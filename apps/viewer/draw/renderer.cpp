// Recording of a picture: shadow map, plan map, floor map, then skins and colliders, ground and sky in one
// multisampled pass.
#include "viewer/draw/renderer.hpp"

#include "viewer_shaders.hpp"
#include "vk/check.hpp"
#include "vk/commands.hpp"

#include <algorithm>

namespace sinew::viewer {

namespace {

constexpr float ballGloss = 0.6f;      // of a skin's: balls are hard and dry
constexpr float colliderGloss = 0.15f; // dull beside tissue

constexpr sim::Vec3 handColor{0.95f, 0.62f, 0.10f}, strokeColor{0.10f, 0.55f, 0.95f},
    pinColor{0.02f, 0.30f, 0.72f};

constexpr std::array plan{vk::SpecialisationConstant{3, 1}};

constexpr std::array empty{VkClearValue{.color = {{0, 0, 0, 1}}}, VkClearValue{.depthStencil = {1, 0}}};

bool isSrgb(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB;
}

std::array<vk::SpecialisationConstant, 3> lookOf(const Renderer::Target& target, const Quality& quality) {
    return {vk::SpecialisationConstant{0, isSrgb(target.color) ? 0u : 1u},
            vk::SpecialisationConstant{1, quality.shadowTaps},
            vk::SpecialisationConstant{2, quality.skyTaps}};
}

VkFormat canvasDepthFormat(const vk::Device& device) {
    // The specification promises one of the first two.
    constexpr std::array formats{VK_FORMAT_D32_SFLOAT, VK_FORMAT_X8_D24_UNORM_PACK32};
    return findFormat(device, formats, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT);
}

} // namespace

Quality reducedQuality() {
    return {.shadowSize = 1024,
            .floorSize = 160,
            .shadowTaps = 8,
            .skyTaps = 20,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .keepsBackdrop = true};
}

bool isSoftware(const vk::Device& device) {
    return device.description().type == "software";
}

Renderer::Renderer(const vk::Device& device, const Target& target, const Quality& quality,
                   const StageLight& light)
    : device_(device), light_(light), colliders_(device, light.colliders),
      poke_(device, {{.radius = 1, .color = handColor}}), format_{target.color, canvasDepthFormat(device),
                                                                  quality.samples},
      maps_(device, quality.shadowSize, quality.floorSize),
      pass_(RenderPass::picture(device, {.color = format_.color,
                                         .depth = format_.depth,
                                         .samples = format_.samples,
                                         .finalLayout = target.finalLayout})),
      sets_(device, maps_, slots), balls_(device, light.balls), hand_(device),
      strokes_(device, {.name = "strokes",
                        .count = slots * mostStrokePoints,
                        .stride = sizeof(sim::layout::vec4),
                        .kind = vk::MemoryKind::upload,
                        .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}),
      look_(lookOf(target, quality)) {
    createMapPipelines();
    createPipelines();
    createCutPipelines();
    if (!balls_.ranges().empty()) createBallPipelines();
    if (quality.keepsBackdrop) createBackdrop();
}

void Renderer::addPipeline(std::size_t index, PipelineRequest request) {
    request.layout = sets_.layout();
    pipelines_[index].emplace(device_, request);
    if (index < pipelineCount) requests_[index] = request;
}

PipelineRequest Renderer::litRequest(const std::string& name) const {
    return {.name = "picture." + name,
            .pass = pass_.handle(),
            .samples = format_.samples,
            .depth = PipelineRequest::Depth::testAndWrite,
            .constants = look_};
}

void Renderer::createMapPipelines() {
    using Input = PipelineRequest::Input;
    using Depth = PipelineRequest::Depth;
    addPipeline(shadowPipeline, {.name = "picture.shadow",
                                 .vertex = &shaders::depthVert,
                                 .pass = maps_.shadow.pass.handle(),
                                 .input = Input::positions,
                                 .depth = Depth::testAndWrite});
    addPipeline(planPipeline, {.name = "picture.plan",
                               .vertex = &shaders::depthVert,
                               .pass = maps_.plan.pass.handle(),
                               .input = Input::positions,
                               .depth = Depth::testAndWrite,
                               .constants = plan});
    addPipeline(floorPipeline, {.name = "picture.floor",
                                .vertex = &shaders::screenVert,
                                .fragment = &shaders::floorFrag,
                                .pass = maps_.floor.pass.handle(),
                                .constants = look_});
}

void Renderer::createPipelines() {
    using Input = PipelineRequest::Input;
    PipelineRequest request = litRequest("skin");
    request.vertex = &shaders::skinVert;
    request.fragment = &shaders::skinFrag;
    request.input = Input::positionsAndNormals;
    request.faces = PipelineRequest::Faces::fronts;
    addPipeline(skinPipeline, request);
    request.name = "picture.skin_backs";
    request.faces = PipelineRequest::Faces::backs;
    addPipeline(skinBacksPipeline, request);
    request = litRequest("hand");
    request.vertex = &shaders::handVert;
    request.fragment = &shaders::skinFrag;
    request.input = Input::hand;
    addPipeline(handPipeline, request);
    request = litRequest("ground");
    request.vertex = &shaders::groundVert;
    request.fragment = &shaders::groundFrag;
    request.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    addPipeline(groundPipeline, request);
    request = litRequest("sky");
    request.vertex = &shaders::screenVert;
    request.fragment = &shaders::skyFrag;
    request.depth = PipelineRequest::Depth::test;
    addPipeline(skyPipeline, request);
}

void Renderer::createBackdrop() {
    backdropPass_.emplace(
        RenderPass::picture(device_, {.color = format_.color,
                                      .depth = format_.depth,
                                      .samples = format_.samples,
                                      .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}));
    PipelineRequest request = litRequest("backdrop");
    request.vertex = &shaders::screenVert;
    request.fragment = &shaders::backdropFrag;
    request.depth = PipelineRequest::Depth::test;
    addPipeline(backdropPipeline, request);
}

void Renderer::createCutPipelines() {
    PipelineRequest request = litRequest("inside");
    request.vertex = &shaders::cutVert;
    request.fragment = &shaders::insideFrag;
    request.input = PipelineRequest::Input::cuts;
    addPipeline(insidePipeline, request);
    request.name = "picture.clipped";
    request.fragment = &shaders::clippedFrag;
    addPipeline(clippedPipeline, request);
}

void Renderer::createBallPipelines() {
    PipelineRequest request{.name = "picture.ball_shadow",
                            .vertex = &shaders::ballDepthVert,
                            .pass = maps_.shadow.pass.handle(),
                            .input = PipelineRequest::Input::balls,
                            .depth = PipelineRequest::Depth::testAndWrite};
    addPipeline(ballShadowPipeline, request);
    request.name = "picture.ball_plan";
    request.pass = maps_.plan.pass.handle();
    request.constants = plan;
    addPipeline(ballPlanPipeline, request);
    request = litRequest("ball");
    request.vertex = &shaders::ballVert;
    request.fragment = &shaders::skinFrag;
    request.input = PipelineRequest::Input::balls;
    addPipeline(ballPipeline, request);
}

Canvas Renderer::makeCanvas(VkExtent2D extent, std::span<const VkImageView> pictures) const {
    Canvas canvas(device_, pass_, format_, extent, pictures);
    if (backdropPass_) canvas.addBackdrop(device_, *backdropPass_, format_.color);
    return canvas;
}

void Renderer::record(VkCommandBuffer commands, std::uint32_t slot, Canvas& canvas, std::size_t picture,
                      const Camera& camera, const sim::Simulation& simulation,
                      const Overlay& overlay) const noexcept {
    const layout::FrameParams params = frameParams(light_, camera, canvas.aspect(), overlay.layers.section);
    sets_.write(slot, params);
    const bool isOpened = overlay.layers.section && canvas.hasCounts() && has(capPipeline);
    // Else something that is there: drivers look at a set as a whole.
    sets_.writeCounts(slot, isOpened ? canvas.counts() : maps_.floor.image.view(), maps_.nearest());
    const Sheet sheet{canvas, picture, slot};
    const Backdrop::Use backdrop = prepareBackdrop(sheet, params);
    sets_.bind(commands, slot);
    vk::Commands labels(device_, commands);
    labels.beginLabel("light maps");
    recordMaps(commands, simulation, overlay);
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
    recordPicture(commands, sheet, simulation, overlay, params, backdrop != Backdrop::Use::direct);
    labels.endLabel();
}

// Under a translucent skin balls throw the shadows, where there are some.
void Renderer::recordMaps(VkCommandBuffer commands, const sim::Simulation& simulation,
                          const Overlay& overlay) const noexcept {
    const Layers& layers = overlay.layers;
    const bool hasSkins =
        layers.skin == SkinLook::solid || (layers.skin == SkinLook::glass && !layers.hasBalls);
    const auto draw = [&](std::size_t ofSkins, std::size_t ofBalls) {
        const std::size_t ofOpened = opened(ofSkins, layers);
        if (hasSkins) drawSkins(commands, ofOpened, simulation);
        if (hasSkins) drawCuts(commands, ofOpened, ofOpened, simulation);
        drawColliders(commands, ofSkins, simulation);
        drawPokes(commands, ofSkins, simulation);
        drawBalls(commands, opened(ofBalls, layers), simulation, overlay);
    };
    const vk::DeviceFunctions& functions = device_.functions();
    const std::array far{VkClearValue{.depthStencil = {1, 0}}};
    const std::array open{VkClearValue{.color = {{1, 1, 1, 1}}}};
    const auto beginMap = [&](const LightMap& map, std::span<const VkClearValue> clear) {
        begin(commands, map.pass, map.framebuffer.handle(), map.image.extent(), clear);
    };
    beginMap(maps_.shadow, far);
    draw(shadowPipeline, ballShadowPipeline);
    functions.vkCmdEndRenderPass(commands);
    // Without a ground the other two are only cleared: the shaders' bindings stay readable.
    beginMap(maps_.plan, far);
    if (light_.ground) draw(planPipeline, ballPlanPipeline);
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
    begin(commands, *backdropPass_, canvas.backdrop().framebuffer(), canvas.extent(), empty);
    if (light_.ground) drawGround(commands, params, false);
    drawScreen(commands, skyPipeline);
    device_.functions().vkCmdEndRenderPass(commands);
}

void Renderer::recordPicture(VkCommandBuffer commands, const Sheet& sheet, const sim::Simulation& simulation,
                             const Overlay& overlay, const layout::FrameParams& params,
                             bool hasBackdrop) const noexcept {
    const Canvas& canvas = sheet.canvas;
    begin(commands, pass_, canvas.framebuffer(sheet.picture), canvas.extent(), empty);
    const Layers& layers = overlay.layers;
    drawThings(commands, simulation, layers, skinPipeline);
    drawThings(commands, simulation, layers, skinBacksPipeline);
    if (layers.map != ColorMap::none) {
        drawValues(commands, simulation, overlay);
    } else {
        drawBalls(commands, opened(ballPipeline, layers), simulation, overlay);
        if (layers.skin == SkinLook::solid)
            drawCuts(commands, opened(insidePipeline, layers), opened(clippedPipeline, layers), simulation);
    }
    drawCap(commands, canvas, layers);
    if (overlay.hand) drawHand(commands, simulation, *overlay.hand, handColor, 1);
    for (const Hand& pin : overlay.pins) drawHand(commands, simulation, pin, pinColor, -1);
    drawStroke(commands, overlay.stroke, sheet.slot);
    if (light_.ground) drawGround(commands, params, hasBackdrop);
    drawScreen(commands, hasBackdrop ? backdropPipeline : skyPipeline);
    recordLayers(commands, simulation, overlay);
    device_.functions().vkCmdEndRenderPass(commands);
}

// What a mesh bounds, in one draw for fronts and one for backs: of what is solid the backs are hidden then,
// and no light is reckoned for what the next triangle covers.
void Renderer::drawThings(VkCommandBuffer commands, const sim::Simulation& simulation, const Layers& layers,
                          std::size_t pipeline) const noexcept {
    drawColliders(commands, pipeline, simulation);
    drawPokes(commands, pipeline, simulation);
    if (layers.map == ColorMap::none && layers.skin == SkinLook::solid)
        drawSkins(commands, opened(pipeline, layers), simulation);
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
                                          pipelines_[pipeline]->handle());
}

void Renderer::bindMesh(VkCommandBuffer commands, const vk::BufferView& vertices,
                        const vk::BufferView& indices) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindVertexBuffers(commands, 0, 1, &vertices.buffer, &vertices.offset);
    functions.vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
}

void Renderer::push(VkCommandBuffer commands, const sim::Vec3& color, float gloss, const sim::Pose& pose,
                    float scale) const noexcept {
    const sim::Vec3& x = pose.position;
    const sim::Quaternion& q = pose.rotation;
    push(commands, {{color.x, color.y, color.z, gloss},
                    {x.x, x.y, x.z, light_.showsSleep ? 1.0f : 0.0f},
                    {q.x, q.y, q.z, q.w},
                    {scale, 0, 0, 0}});
}

void Renderer::push(VkCommandBuffer commands, const layout::SkinPush& values) const noexcept {
    device_.functions().vkCmdPushConstants(commands, sets_.layout(),
                                           VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                           sizeof(values), &values);
}

void Renderer::drawScreen(VkCommandBuffer commands, std::size_t pipeline) const noexcept {
    bind(commands, pipeline);
    device_.functions().vkCmdDraw(commands, 3, 1, 0, 0);
}

// Up to the haze, or as far as bodies darken it.
void Renderer::drawGround(VkCommandBuffer commands, const layout::FrameParams& params,
                          bool isLitAlone) const noexcept {
    bind(commands, groundPipeline);
    const layout::vec4 whole{params.stage.x, params.stage.z, 1.05f * params.ground.z, 0};
    const layout::vec4 lit{params.floor.x, params.floor.y, 0.5f * params.floor.z, 0};
    push(commands, {isLitAlone ? lit : whole, {}, {}, {}});
    device_.functions().vkCmdDraw(commands, 4, 1, 0, 0);
}

void Renderer::drawColliders(VkCommandBuffer commands, std::size_t pipeline,
                             const sim::Simulation& simulation) const noexcept {
    const auto& ranges = colliders_.ranges();
    if (ranges.empty()) return;
    bind(commands, pipeline);
    const std::span<const sim::Pose> poses = simulation.colliderPoses();
    bindMesh(commands, colliders_.vertices(), colliders_.indices());
    for (std::size_t i = 0; i < std::min(ranges.size(), poses.size()); ++i) {
        push(commands, ranges[i].color, colliderGloss, poses[i]);
        device_.functions().vkCmdDrawIndexed(commands, ranges[i].indexCount, 1, ranges[i].firstIndex,
                                             ranges[i].firstVertex, 0);
    }
}

// Where the simulation has them, which may be behind the pointer.
void Renderer::drawPokes(VkCommandBuffer commands, std::size_t pipeline,
                         const sim::Simulation& simulation) const noexcept {
    const ColliderMeshes::Range& sphere = poke_.ranges().front();
    for (const sim::PokeState& state : simulation.pokes()) {
        if (!state.isThere || state.poke.shape != sim::ColliderShape::sphere) continue;
        bind(commands, pipeline);
        bindMesh(commands, poke_.vertices(), poke_.indices());
        push(commands, sphere.color, colliderGloss, state.poke.pose, state.poke.radius);
        device_.functions().vkCmdDrawIndexed(commands, sphere.indexCount, 1, sphere.firstIndex,
                                             sphere.firstVertex, 0);
    }
}

void Renderer::drawSkins(VkCommandBuffer commands, std::size_t pipeline, const sim::Simulation& simulation,
                         const LayerBuffers& buffers) const noexcept {
    if (simulation.skins().empty()) return;
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView& values = buffers.skins;
    bind(commands, pipeline);
    bindMesh(commands, simulation.skinVertices(), simulation.skinIndices());
    if (values.size > 0) functions.vkCmdBindVertexBuffers(commands, 1, 1, &values.buffer, &values.offset);
    const vk::BufferView pieces = simulation.pieceDraws();
    for (std::size_t i = 0; i < simulation.skins().size(); ++i) {
        if (pipeline == skinCountPipeline && !light_.isClosed[i]) continue; // it encloses nothing
        const sim::SkinRange& skin = simulation.skins()[i];
        push(commands, values.size > 0 ? sim::Vec3{buffers.range} : skin.color, light_.gloss[i], {});
        functions.vkCmdDrawIndexed(commands, skin.indexCount, 1, skin.firstIndex, 0, 0);
        if (pieces.size > 0)
            functions.vkCmdDrawIndexedIndirect(commands, pieces.buffer, pieces.offset + i * pieces.stride, 1,
                                               static_cast<std::uint32_t>(pieces.stride));
    }
}

void Renderer::drawBalls(VkCommandBuffer commands, std::size_t pipeline, const sim::Simulation& simulation,
                         const Overlay& overlay) const noexcept {
    const bool isAll = overlay.layers.hasBalls && overlay.buffers.balls != nullptr;
    const Balls& balls = isAll ? *overlay.buffers.balls : balls_;
    if (balls.ranges().empty() || !has(pipeline)) return;
    const bool isMap = pipeline % pipelineCount == ballValuesPipeline || pipeline == ballValuesCountPipeline;
    bind(commands, pipeline);
    balls.bind(commands, simulation.positions(), isMap ? overlay.buffers.particles : vk::BufferView{});
    for (const BallRange& range : balls.ranges()) {
        push(commands, isMap ? sim::Vec3{overlay.buffers.range} : range.color, ballGloss, {});
        balls.draw(commands, range);
    }
}

void Renderer::drawHand(VkCommandBuffer commands, const sim::Simulation& simulation, const Hand& hand,
                        const sim::Vec3& color, float ball) const noexcept {
    bind(commands, handPipeline);
    const Vector3 &at = hand.target, &held = hand.offset;
    push(commands, {{color.x, color.y, color.z, ballGloss},
                    {at.x(), at.y(), at.z(), 0.02f * light_.radius()},
                    {held.x(), held.y(), held.z(), ball}});
    hand_.draw(commands, simulation.positions(), hand.particle);
}

// Both draws come from the device, which alone knows how much there is.
void Renderer::drawCuts(VkCommandBuffer commands, std::size_t ofInside, std::size_t ofClipped,
                        const sim::Simulation& simulation, const LayerBuffers& buffers) const noexcept {
    const sim::CutSurface surface = simulation.cutSurface();
    if (surface.draws.size == 0) return;
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView& values = buffers.cuts;
    const std::array bound{surface.vertices.buffer, surface.rest.buffer, values.buffer};
    const std::array offsets{surface.vertices.offset, surface.rest.offset, values.offset};
    functions.vkCmdBindVertexBuffers(commands, 0, values.size > 0 ? 3 : 2, bound.data(), offsets.data());
    functions.vkCmdBindIndexBuffer(commands, surface.indices.buffer, surface.indices.offset,
                                   VK_INDEX_TYPE_UINT32);
    for (const std::size_t draw : {std::size_t{0}, std::size_t{1}}) {
        bind(commands, draw == 0 ? ofInside : ofClipped);
        push(commands, {buffers.range}, 0, {});
        functions.vkCmdDrawIndexedIndirect(commands, surface.draws.buffer,
                                           surface.draws.offset + draw * surface.draws.stride, 1,
                                           static_cast<std::uint32_t>(surface.draws.stride));
    }
}

void Renderer::drawStroke(VkCommandBuffer commands, std::span<const Vector3> stroke,
                          std::uint32_t slot) const noexcept {
    if (stroke.size() < 2) return;
    const std::size_t first = slot * mostStrokePoints, count = std::min(stroke.size(), mostStrokePoints);
    auto* points = reinterpret_cast<sim::layout::vec4*>(strokes_.mapped()) + first;
    for (std::size_t i = 0; i < count; ++i) points[i] = {stroke[i].x(), stroke[i].y(), stroke[i].z(), 0};
    bind(commands, handPipeline);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Vector3& to = stroke[i + 1];
        push(commands, {{strokeColor.x, strokeColor.y, strokeColor.z, ballGloss},
                        {to.x(), to.y(), to.z(), 0.008f * light_.radius()},
                        {0, 0, 0, 0.3f}});
        hand_.draw(commands, strokes_.view(), static_cast<std::uint32_t>(first + i));
    }
}

} // namespace sinew::viewer
