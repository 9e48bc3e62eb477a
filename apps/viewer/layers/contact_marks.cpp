// One kernel runs over all particles, one over all edges. The host writes planes and colliders, since it has
// their poses.
#include "viewer/layers/contact_marks.hpp"

#include "common/layout.h"
#include "sinew/inspection.hpp"
#include "viewer/layers/value_maps.hpp"
#include "viewer/render/balls.hpp"
#include "viewer/render/mesh_buffer.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t mostMarks = 1 << 15;
constexpr float nearness = 0.02f; // in radii
constexpr HandMesh::Shape shape{.sides = 5, .cuts = 0};

std::vector<layout::MarkParticle> markParticles(const sim::Scene& scene, const sim::ParticleSlots& slots) {
    const BallList balls = allBallsOf(scene);
    std::vector<layout::MarkParticle> particles;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        particles.push_back({slots.slot[i], scene.particles[i].contactOffset,
                             balls.radii.empty() ? 0 : nearness * balls.radii[i]});
    return particles;
}

std::uint32_t wallCount(const sim::Scene& scene) {
    return static_cast<std::uint32_t>(scene.planes.size() + scene.colliders.size());
}

layout::MarkWall wallOf(const sim::Plane& plane) {
    return {.core = {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset},
            .position = {0, 0, 0, 1},
            .rotation = {0, 0, 0, 1}};
}

layout::MarkWall wallOf(const sim::Collider& collider, const sim::Pose& pose) {
    const sim::Vec3 &x = pose.position, &e = collider.halfExtents;
    const sim::Quaternion& q = pose.rotation;
    layout::MarkWall wall{.core = {}, .position = {x.x, x.y, x.z, 0}, .rotation = {q.x, q.y, q.z, q.w}};
    if (collider.shape == sim::ColliderShape::box)
        wall.core = {e.x, e.y, e.z, collider.margin};
    else
        wall.core = {0, collider.shape == sim::ColliderShape::capsule ? collider.halfLength : 0, 0,
                     collider.radius + collider.margin};
    return wall;
}

constexpr float markSize = 0.004f; // of the ball of a mark, in radii of the scene
constexpr std::array bindings{
    VkVertexInputBindingDescription{0, sizeof(sim::layout::vec4), VK_VERTEX_INPUT_RATE_VERTEX},
    VkVertexInputBindingDescription{1, sizeof(layout::ContactMark), VK_VERTEX_INPUT_RATE_INSTANCE}};
constexpr std::array attributes{VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
                                VkVertexInputAttributeDescription{1, 1, VK_FORMAT_R32G32B32A32_SFLOAT,
                                                                  offsetof(layout::ContactMark, point)},
                                VkVertexInputAttributeDescription{2, 1, VK_FORMAT_R32G32B32A32_SFLOAT,
                                                                  offsetof(layout::ContactMark, normal)}};

// Contact points are hidden between the bodies, so marks are drawn through everything.
PipelineRequest markPipeline() {
    return {.name = "contacts",
            .vertex = &shaders::markVert,
            .fragment = &shaders::markFrag,
            .input = PipelineRequest::Input::own,
            .vertices = {bindings, attributes}};
}

constexpr std::array<Layer::Look, 1> looks{{{"contacts", "Contacts"}}};

} // namespace

constinit const Layer layer::contacts{.key = '5',
                                      .help = "contacts with their normals",
                                      .button = "Contacts",
                                      .looks = looks,
                                      .make = [](const LayerContext& of) -> std::unique_ptr<const LayerPart> {
                                          return std::make_unique<const ContactMarks>(
                                              of.device, of.scene, of.settings, of.simulation, of.slots);
                                      },
                                      .pipeline = markPipeline,
                                      .opened = &shaders::markSectionFrag};

ContactMarks::ContactMarks(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
                           const sim::Simulation& simulation, std::uint32_t slots, Room room)
    : device_(device), planes_(scene.planes), colliders_(scene.colliders),
      simulation_(simulation), push_{.count = static_cast<std::uint32_t>(scene.particles.size()),
                                     .walls = wallCount(scene),
                                     .firstWall = 0,
                                     .hasPairs = sim::inspect(simulation).contacts.pairs.size > 0,
                                     .hasFaces = sim::inspect(simulation).contacts.facePairs.size > 0,
                                     .room = room == Room::many ? mostMarks : 1,
                                     .edges = sim::inspect(simulation).contacts.edgeCount,
                                     .only = NO_PARTICLE},
      mesh_(device, shape),
      particles_(filledBuffer(device, "marks.particles",
                              markParticles(scene, sim::particleSlots(scene, settings)), 0)),
      bySlot_(filledBuffer(device, "marks.by_slot", particlesBySlot(sim::particleSlots(scene, settings)), 0)),
      walls_(device, {.name = "marks.walls",
                      .count = VkDeviceSize{slots} * wallCount(scene),
                      .stride = sizeof(layout::MarkWall),
                      .kind = vk::MemoryKind::upload}),
      nothing_(device, {.name = "marks.nothing", .count = 4, .stride = 4}),
      marks_(device, {.name = "marks",
                      .count = push_.room,
                      .stride = sizeof(layout::ContactMark),
                      .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}),
      draw_(device, {.name = "marks.draw",
                     .count = 1,
                     .stride = sizeof(layout::MarkDraw),
                     .usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}),
      draws_(device, {.name = "marks.draws",
                      .count = slots,
                      .stride = sizeof(layout::MarkDraw),
                      .kind = vk::MemoryKind::readback}),
      kernel_(device.kernels().get(device, shaders::markContacts, {})),
      ofEdges_(device.kernels().get(device, shaders::markEdges, {})), sets_(bindingSets()) {}

// Lists that a scene lacks are bound as empty buffers and never read.
vk::BindingSets ContactMarks::bindingSets() const {
    const sim::InspectedContacts lists = sim::inspect(simulation_).contacts;
    const auto viewOf = [&](vk::BufferView view, std::uint32_t stride) {
        if (view.size > 0) return view;
        view = nothing_.view();
        view.stride = stride;
        return view;
    };
    std::vector<vk::BindingRequest> requests{
        {kernel_.get(),
         {simulation_.positions(), particles_.view(), bySlot_.view(), walls_.view(), viewOf(lists.pairs, 8),
          viewOf(lists.pairLists, 8), viewOf(lists.faces, 16), viewOf(lists.facePairs, 8),
          viewOf(lists.faceLists, 8), marks_.view(), draw_.view(), removedParticles(simulation_)}}};
    if (push_.edges > 0)
        requests.push_back({ofEdges_.get(),
                            {simulation_.positions(), bySlot_.view(), lists.edges, lists.edgePairs,
                             lists.edgeLists, marks_.view(), draw_.view(), removedParticles(simulation_)}});
    return {device_, requests};
}

void ContactMarks::dispatch(vk::Commands& commands, const vk::Kernel& kernel, std::size_t set,
                            const layout::MarkPush& push, std::uint32_t items) const noexcept {
    commands.bind(kernel, sets_[set]);
    commands.push(kernel, &push, sizeof push);
    commands.dispatch((items + GROUP_ITEMS - 1) / GROUP_ITEMS);
}

void ContactMarks::writeWalls(std::uint32_t slot) const noexcept {
    auto* wall = reinterpret_cast<layout::MarkWall*>(walls_.mapped()) + std::size_t{slot} * push_.walls;
    for (const sim::Plane& plane : planes_) *wall++ = wallOf(plane);
    const std::span<const sim::Pose> poses = simulation_.colliderPoses();
    for (std::size_t c = 0; c < colliders_.size(); ++c)
        *wall++ = wallOf(colliders_[c], c < poses.size() ? poses[c] : colliders_[c].pose);
}

void ContactMarks::record(VkCommandBuffer commands, std::size_t, std::uint32_t slot) const noexcept {
    record(commands, slot, push_, push_.count);
}

void ContactMarks::recordOf(VkCommandBuffer commands, std::uint32_t slot,
                            std::uint32_t particle) const noexcept {
    layout::MarkPush push = push_;
    push.only = particle;
    record(commands, slot, push, 1);
}

void ContactMarks::record(VkCommandBuffer handle, std::uint32_t slot, layout::MarkPush push,
                          std::uint32_t items) const noexcept {
    writeWalls(slot);
    push.firstWall = slot * push.walls;
    const layout::MarkDraw empty{mesh_.indexCount(), 0, 0, 0, 0, 0, 0, 0};
    vk::BufferView read = draws_.view();
    read.offset += VkDeviceSize{slot} * read.stride;
    read.size = read.stride;
    vk::Commands commands(device_, handle);
    commands.beginLabel("contacts");
    commands.beginStep();
    commands.update(draw_.view(), &empty, sizeof empty);
    commands.barrier();
    dispatch(commands, *kernel_, 0, push, items);
    commands.barrier();
    if (push.edges > 0) {
        dispatch(commands, *ofEdges_, 1, push, push.edges);
        commands.barrier();
    }
    commands.copy(draw_.view(), read);
    commands.endStep();
    commands.hostBarrier();
    commands.endLabel();
}

LayerReading ContactMarks::reading(std::uint32_t slot) const {
    return {.legend = {{LegendLine::Kind::row, "contacts", grouped(found(slot))}}};
}

void ContactMarks::draw(const LayerDrawing& to) const noexcept {
    to.push({{}, {0, 0, 0, markSize * to.radius}, {}});
    mesh_.drawIndirect(to.commands, marks_.view(), draw_.view());
}

std::uint32_t ContactMarks::found(std::uint32_t slot) const noexcept {
    layout::MarkDraw draw;
    std::memcpy(&draw, draws_.mapped() + slot * sizeof draw, sizeof draw);
    return draw.found;
}

} // namespace sinew::viewer
