// Draw calls for the parts of a scene, with a given pipeline.
#include "viewer/render/renderer.hpp"

#include "sinew/inspection.hpp"

#include <algorithm>

namespace sinew::viewer {

namespace {

constexpr float ballGloss = 0.6f;      // times that of skins: balls are hard and dry
constexpr float colliderGloss = 0.15f; // less than tissue

} // namespace

// Draws closed meshes, once for front faces and once for back faces: backs of closed bodies are then hidden
// by depth, and no hidden fragment is shaded.
void Renderer::drawThings(VkCommandBuffer commands, const sim::Simulation& simulation, const Layers& layers,
                          std::size_t pipeline) const noexcept {
    drawColliders(commands, pipeline, simulation);
    drawHostColliders(commands, pipeline, simulation);
    if (layers.map() != ColorMap::none || layers.skin() != SkinLook::solid) return;
    OfSkins pipelines(opened(pipeline, layers));
    pipelines.leavesSheets = true;
    drawSkins(commands, pipelines, simulation);
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

// Draws with a count that only the device knows.
void Renderer::drawIndirect(VkCommandBuffer commands, const vk::BufferView& draws,
                            std::size_t which) const noexcept {
    device_.functions().vkCmdDrawIndexedIndirect(commands, draws.buffer, draws.offset + which * draws.stride,
                                                 1, static_cast<std::uint32_t>(draws.stride));
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

// Draws the ground up to the haze, or only the square that bodies can darken.
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

// Draws the spheres at the simulation's positions, which may lag behind the pointer.
void Renderer::drawHostColliders(VkCommandBuffer commands, std::size_t pipeline,
                                 const sim::Simulation& simulation) const noexcept {
    const ColliderMeshes::Range& sphere = sphere_.ranges().front();
    for (const sim::HostColliderState& state : simulation.hostColliders()) {
        if (!state.isThere || state.hostCollider.shape != sim::ColliderShape::sphere) continue;
        bind(commands, pipeline);
        bindMesh(commands, sphere_.vertices(), sphere_.indices());
        push(commands, sphere.color, colliderGloss, state.hostCollider.pose, state.hostCollider.radius);
        device_.functions().vkCmdDrawIndexed(commands, sphere.indexCount, 1, sphere.firstIndex,
                                             sphere.firstVertex, 0);
    }
}

void Renderer::drawSkins(VkCommandBuffer commands, OfSkins pipelines, const sim::Simulation& simulation,
                         const LayerBuffers& buffers) const noexcept {
    if (simulation.skins().empty()) return;
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView& values = buffers.skins;
    const std::size_t pipeline = pipelines.any;
    std::size_t bound = pipeline;
    bind(commands, bound);
    const sim::Simulation::DrawnSkins drawn = simulation.drawnSkins();
    bindMesh(commands, simulation.skinVertices(), drawn.indices);
    if (values.size > 0) functions.vkCmdBindVertexBuffers(commands, 1, 1, &values.buffer, &values.offset);
    const vk::BufferView pieces = simulation.pieceDraws();
    for (std::size_t i = 0; i < simulation.skins().size(); ++i) {
        if (pipelines.leavesSheets && light_.isSheet[i]) continue;
        if (pipeline == skinCountPipeline && !light_.isClosed[i]) continue; // not closed
        const bool isOfBacks = pipeline == skinBacksPipeline || pipeline == skinBacksSurfacePipeline;
        if (isOfBacks && leavesBacks_ && light_.isOutward[i]) continue;
        const std::size_t own = light_.isOutward[i] ? pipelines.solids : pipelines.any;
        if (own != bound) bind(commands, bound = own);
        const sim::SkinRange& skin = drawn.ranges[i];
        push(commands, values.size > 0 ? sim::Vec3{buffers.range} : skin.color, light_.gloss[i], {});
        functions.vkCmdDrawIndexed(commands, skin.indexCount, 1, skin.firstIndex, 0, 0);
        if (pieces.size > 0) drawIndirect(commands, pieces, i);
    }
}

// Draws both sides of cloth. Pieces along cuts have vertices of their own, which have no place in the sheet.
void Renderer::drawSheets(VkCommandBuffer commands, const Layers& layers,
                          const sim::Simulation& simulation) const noexcept {
    if (light_.sheets.empty()) return;
    const sim::Simulation::DrawnSkins drawn = simulation.drawnSkins();
    const vk::BufferView places = sheets_.view(), pieces = simulation.pieceDraws();
    for (const bool isPieces : {false, true}) {
        if (isPieces && pieces.size == 0) return;
        bind(commands, opened(isPieces ? clothPiecesPipeline : clothPipeline, layers));
        bindMesh(commands, simulation.skinVertices(), drawn.indices);
        if (!isPieces)
            device_.functions().vkCmdBindVertexBuffers(commands, 1, 1, &places.buffer, &places.offset);
        for (std::size_t i = 0; i < light_.isSheet.size(); ++i) {
            if (!light_.isSheet[i]) continue;
            const sim::SkinRange& skin = drawn.ranges[i];
            push(commands, skin.color, light_.gloss[i], {});
            if (isPieces)
                drawIndirect(commands, pieces, i);
            else
                device_.functions().vkCmdDrawIndexed(commands, skin.indexCount, 1, skin.firstIndex, 0, 0);
        }
    }
}

void Renderer::drawBalls(VkCommandBuffer commands, std::size_t pipeline, const sim::Simulation& simulation,
                         const Overlay& overlay) const noexcept {
    const bool isAll = overlay.layers.has(layer::particles) && overlay.buffers.balls != nullptr;
    const Balls& balls = isAll ? *overlay.buffers.balls : balls_;
    if (balls.ranges().empty() || !has(pipeline)) return;
    const bool isMap = pipeline % pipelineCount == ballValuesPipeline || pipeline == ballValuesCountPipeline;
    bind(commands, pipeline);
    balls.bind(commands, simulation.positions(), removedParticles(simulation),
               isMap ? overlay.buffers.particles : vk::BufferView{});
    for (const BallRange& range : balls.ranges()) {
        push(commands, isMap ? sim::Vec3{overlay.buffers.range} : range.color, ballGloss, {});
        balls.draw(commands, range);
    }
}

// Walls cast no shadows either.
void Renderer::drawWalls(VkCommandBuffer commands, std::size_t pipeline, const Walls::Part& part,
                         const layout::vec4& color) const noexcept {
    if (walls_.isEmpty()) return;
    bind(commands, pipeline);
    bindMesh(commands, walls_.vertices(), walls_.indices());
    push(commands, {color, {}, {0, 0, 0, 1}, {1, 0, 0, 0}});
    device_.functions().vkCmdDrawIndexed(commands, part.indexCount, 1, part.firstIndex, part.firstVertex, 0);
}

// Marks cast no shadows: they show constraints of the scene, like pins show those of the user.
void Renderer::drawMarks(VkCommandBuffer commands, const sim::Simulation& simulation,
                         const Layers& layers) const noexcept {
    if (marks_.ranges().empty()) return;
    bind(commands, opened(heldPipeline, layers));
    marks_.bind(commands, simulation.positions(), removedParticles(simulation));
    push(commands, pinColor, ballGloss, {});
    for (const BallRange& range : marks_.ranges()) marks_.draw(commands, range);
}

void Renderer::drawHand(VkCommandBuffer commands, const sim::Simulation& simulation, const Hand& hand,
                        const sim::Vec3& color, float ball) const noexcept {
    bind(commands, handPipeline);
    const Vector3 &at = hand.target, &held = hand.offset;
    push(commands, {{color.x, color.y, color.z, ballGloss},
                    {at.x(), at.y(), at.z(), pinShare * light_.radius()},
                    {held.x(), held.y(), held.z(), ball}});
    hand_.draw(commands, simulation.positions(), removedParticles(simulation), hand.particle);
}

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
        drawIndirect(commands, surface.draws, draw);
    }
}

void Renderer::drawStroke(VkCommandBuffer commands, std::span<const Vector3> stroke, const sim::Vec3& color,
                          std::size_t first) const noexcept {
    if (stroke.size() < 2) return;
    const std::size_t count = std::min(stroke.size(), mostStrokePoints);
    auto* points = reinterpret_cast<sim::layout::vec4*>(strokes_.mapped()) + first;
    for (std::size_t i = 0; i < count; ++i) points[i] = {stroke[i].x(), stroke[i].y(), stroke[i].z(), 0};
    bind(commands, handPipeline);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Vector3& to = stroke[i + 1];
        push(commands, {{color.x, color.y, color.z, ballGloss},
                        {to.x(), to.y(), to.z(), 0.008f * light_.radius()},
                        {0, 0, 0, 0.3f}});
        hand_.draw(commands, strokes_.view(), strokes_.view(), static_cast<std::uint32_t>(first + i));
    }
}

} // namespace sinew::viewer
