// Tables of the scene are made once. The buffers that a ray is cast at depend on the simulation.
#include "viewer/input/picker.hpp"

#include "common/layout.h"
#include "sinew/inspection.hpp"
#include "sinew/inverse_masses.hpp"
#include "viewer/document/document.hpp"
#include "viewer/render/mesh_buffer.hpp"
#include "viewer/render/removed.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace sinew::viewer {

namespace {

// Buffers must not be empty.
template <typename T>
vk::Buffer tableOf(const vk::Device& device, const std::string& name, std::vector<T> elements) {
    if (elements.empty()) elements.resize(1);
    return filledBuffer(device, name, elements, 0);
}

std::vector<layout::PickVertex> holdersOf(const sim::Scene& scene) {
    std::vector<layout::PickVertex> all;
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s) {
        const sim::Skin& skin = scene.skins[s];
        for (std::size_t v = 0; v < skin.vertexCount(); ++v) {
            layout::PickVertex vertex{.anchor = NO_PARTICLE, .skin = s};
            std::ranges::fill(vertex.particles, NO_PARTICLE);
            if (skin.cells.empty())
                vertex.particles[0] = skin.particles[v];
            else
                std::ranges::copy(skin.cells[v].particles, vertex.particles);
            if (!skin.cells.empty() && !skin.anchors.empty()) vertex.anchor = skin.anchors[v];
            all.push_back(vertex);
        }
    }
    return all;
}

// Pieces of a sheet are drawn with vertices of their own; its whole triangles have the same particles.
bool isSheet(const sim::Scene& scene, const sim::Skin& skin) {
    if (skin.particles.empty()) return false;
    const std::uint32_t one = skin.particles.front();
    return std::ranges::any_of(scene.grids, [&](const sim::Grid& grid) {
        return one - grid.firstParticle < grid.node.size() && grid.nodes[1] == 1;
    });
}

std::vector<std::uint32_t> sheetIndices(const sim::Scene& scene) {
    std::vector<std::uint32_t> indices;
    std::uint32_t firstVertex = 0;
    for (const sim::Skin& skin : scene.skins) {
        if (isSheet(scene, skin))
            for (const auto& triangle : skin.triangles)
                for (const std::uint32_t corner : triangle) indices.push_back(firstVertex + corner);
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
    return indices;
}

std::vector<layout::PickSkin> skinsOf(const sim::Scene& scene, const std::vector<bool>& isClosed) {
    std::vector<layout::PickSkin> skins;
    for (const sim::Skin& skin : scene.skins) {
        layout::PickSkin one{.isClosed = isClosed[skins.size()], .isSheet = isSheet(scene, skin)};
        if (skin.vertexCount() > 0) {
            const sim::Body body =
                bodyOf(scene, skin.cells.empty() ? skin.particles[0] : skin.cells[0].particles[0]);
            one.firstParticle = body.firstParticle;
            one.particleCount = body.particleCount;
        }
        skins.push_back(one);
    }
    return skins;
}

std::vector<float> radiiOf(const sim::Scene& scene, const BallList& balls) {
    std::vector<float> radii(scene.particles.size(), -1.0f);
    for (const BallRange& range : balls.ranges)
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) radii[i] = balls.radii[i];
    return radii;
}

// The visible range of a ray; `isOpened`: from `from` on it is behind a section plane.
struct Seen {
    float from = 0, to = static_cast<float>(PICK_FAR);
    bool isOpened = false;
};

Seen seenOf(const Ray& ray, const std::optional<Section>& section) {
    constexpr auto none = static_cast<float>(PICK_FAR);
    if (!section) return {};
    const float height = section->normal.dot(ray.origin) - section->offset;
    const float approach = -section->normal.dot(ray.direction);
    if (height <= 0) return {.to = approach < 0 ? height / approach : none};
    return {.from = approach > 0 ? height / approach : none, .isOpened = true};
}

} // namespace

Picker::Picker(const vk::Device& device, const Document& document, const SceneLight& light,
               std::uint32_t slots)
    : device_(device), document_(document), skinCaster_(device.kernels().get(device, shaders::castRay, {})),
      ballCaster_(device.kernels().get(device, shaders::castRayBalls, {})),
      cutCaster_(device.kernels().get(device, shaders::castRayCuts, {})),
      resolver_(device.kernels().get(device, shaders::resolvePick, {})),
      holders_(tableOf(device, "pick.holders", holdersOf(document.scene()))),
      sheetIndices_(tableOf(device, "pick.sheets", sheetIndices(document.scene()))),
      skins_(tableOf(device, "pick.skins", skinsOf(document.scene(), light.isClosed))),
      radii_(tableOf(device, "pick.radii", radiiOf(document.scene(), light.balls))),
      inverseMasses_(tableOf(device, "pick.inverse_masses", sim::inverseMasses(document.scene()))),
      push_{.sheetTriangles = static_cast<std::uint32_t>(sheetIndices(document.scene()).size() / 3),
            .particles = light.balls.ranges.empty()
                             ? 0
                             : static_cast<std::uint32_t>(document.scene().particles.size()),
            .skins = static_cast<std::uint32_t>(document.scene().skins.size())},
      nothing_(tableOf(device, "pick.nothing", std::vector<sim::layout::vec4>(8))),
      windings_(device, {.name = "pick.windings", .count = rays * std::max(push_.skins, 1u), .stride = 4}),
      hits_(device,
            {.name = "pick.hits", .count = rays * parts * PICK_CASTERS, .stride = sizeof(layout::PickHit)}),
      found_(device, {.name = "pick.found", .count = rays, .stride = sizeof(layout::PickAnswer)}),
      answers_(device, {.name = "pick.answers",
                        .count = VkDeviceSize{slots} * rays,
                        .stride = sizeof(layout::PickAnswer),
                        .kind = vk::MemoryKind::readback}) {
    restart();
}

void Picker::restart() {
    const sim::Simulation& simulation = document_.simulation();
    const vk::BufferView whole = sim::inspect(simulation).wholeIndices;
    sets_.emplace(bindingSets(simulation.skinIndices()));
    wholeSets_.reset();
    if (whole.size > 0) wholeSets_.emplace(bindingSets(whole));
}

vk::BindingSets Picker::bindingSets(const vk::BufferView& indices) const {
    const sim::Simulation& simulation = document_.simulation();
    const sim::CutSurface cuts = simulation.cutSurface();
    const auto there = [this](const vk::BufferView& view, std::uint32_t stride) {
        vk::BufferView any = view.size > 0 ? view : nothing_.view();
        any.stride = stride;
        return any;
    };
    constexpr std::uint32_t vertexStride = sizeof(sim::layout::SkinVertex);
    const vk::BufferView drawn = there(indices, 4), vertices = there(simulation.skinVertices(), vertexStride),
                         cutIndices = there(cuts.indices, 4),
                         cutVertices = there(cuts.vertices, vertexStride),
                         cutRest = there(cuts.rest, sizeof(sim::layout::CutVertex)),
                         counts = there(cuts.counts, sizeof(sim::layout::SurfaceState)),
                         slots = there(cuts.particles, 4), positions = simulation.positions(),
                         removed = removedParticles(simulation), windings = windings_.view(),
                         hits = hits_.view();
    const std::array requests{
        // in the order of Part
        vk::BindingRequest{
            skinCaster_.get(),
            {drawn, vertices, windings, hits, sheetIndices_.view(), holders_.view(), skins_.view(), removed}},
        vk::BindingRequest{ballCaster_.get(), {positions, radii_.view(), removed, hits}},
        vk::BindingRequest{cutCaster_.get(), {cutIndices, cutVertices, windings, hits, cutRest, counts}},
        vk::BindingRequest{resolver_.get(),
                           {drawn, holders_.view(), sheetIndices_.view(), counts, cutIndices, cutRest, slots,
                            positions, inverseMasses_.view(), removed, skins_.view(), windings, hits,
                            found_.view()}}};
    return {device_, requests};
}

layout::PickPush Picker::pushOf(const Cast& cast, std::uint32_t ray,
                                const std::optional<Section>& section) const noexcept {
    const sim::Simulation::DrawnSkins drawn = document_.simulation().drawnSkins();
    const Vector3 &from = cast.ray.origin, &way = cast.ray.direction;
    const Seen seen = seenOf(cast.ray, section);
    layout::PickPush push = push_;
    push.origin = {from.x(), from.y(), from.z(), seen.from};
    push.direction = {way.x(), way.y(), way.z(), seen.to};
    for (const sim::SkinRange& skin : drawn.ranges) push.triangles += skin.indexCount / 3;
    push.isOpened = seen.isOpened;
    push.isMoving = cast.among == Among::moving;
    push.ray = ray;
    push.firstHit = ray * parts * PICK_CASTERS;
    push.hasCuts = !drawn.areWhole && document_.simulation().cutSurface().counts.size > 0;
    return push;
}

// A part that the scene lacks is left out. Returns the number of hits.
std::uint32_t Picker::recordCast(vk::Commands& commands, const vk::BindingSets& sets,
                                 layout::PickPush push) const noexcept {
    const std::uint32_t first = push.firstHit, skins = push.triangles + push.sheetTriangles;
    const auto add = [&](const vk::Kernel& kernel, Part part, std::uint32_t firstItem) {
        push.firstItem = firstItem;
        commands.bind(kernel, sets[part]);
        commands.push(kernel, &push, sizeof push);
        commands.dispatch(PICK_CASTERS / GROUP_ITEMS);
        push.firstHit += PICK_CASTERS;
    };
    if (skins > 0) add(*skinCaster_, ofSkins, 0);
    if (push.particles > 0) add(*ballCaster_, ofBalls, skins);
    if (push.hasCuts != 0) add(*cutCaster_, ofCuts, skins + push.particles);
    return push.firstHit - first;
}

// All rays are cast, then resolved.
void Picker::record(VkCommandBuffer handle, std::uint32_t slot, const Casts& casts,
                    const std::optional<Section>& section) const noexcept {
    const vk::BindingSets& sets = document_.simulation().drawnSkins().areWhole ? *wholeSets_ : *sets_;
    vk::BufferView read = answers_.view();
    read.offset += slot * found_.view().size;
    read.size = found_.view().size;
    vk::Commands commands(device_, handle);
    commands.beginLabel("pick");
    commands.beginStep();
    commands.fill(windings_.view(), 0);
    commands.barrier();
    std::array<layout::PickPush, rays> pushes;
    for (std::uint32_t i = 0; i < rays; ++i) {
        if (!casts[i]) continue;
        pushes[i] = pushOf(*casts[i], i, section);
        pushes[i].hits = recordCast(commands, sets, pushes[i]);
    }
    commands.barrier();
    for (std::uint32_t i = 0; i < rays; ++i) {
        if (!casts[i]) continue;
        commands.bind(*resolver_, sets[ofAll]);
        commands.push(*resolver_, &pushes[i], sizeof pushes[i]);
        commands.dispatch(1);
    }
    commands.barrier();
    commands.copy(found_.view(), read);
    commands.endStep();
    commands.hostBarrier();
    commands.endLabel();
}

std::optional<Pick> Picker::answer(std::uint32_t slot, std::size_t ray) const noexcept {
    layout::PickAnswer found;
    std::memcpy(&found, answers_.mapped() + (slot * rays + ray) * sizeof found, sizeof found);
    if (found.particle == NO_PARTICLE) return std::nullopt;
    const Vector3 point(found.point.x, found.point.y, found.point.z);
    return Pick{found.particle, point, point - Vector3(found.place[0], found.place[1], found.place[2]),
                found.point.w};
}

} // namespace sinew::viewer
