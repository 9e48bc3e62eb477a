// Tables of the scene are made once. The buffers that a ray is cast at depend on the simulation.
#include "kernels.hpp"
#include "sim/simulation/picking_tables.hpp"
#include "simulation/pick.h"
#include "sinew/inspection.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/picking.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace sinew::sim {

namespace {

std::vector<layout::PickVertex> holdersOf(const Scene& scene) {
    std::vector<layout::PickVertex> all;
    for (std::uint32_t s = 0; s < scene.skins.size(); ++s) {
        const Skin& skin = scene.skins[s];
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
bool isSheet(const Scene& scene, const Skin& skin) {
    if (skin.particles.empty()) return false;
    const std::uint32_t one = skin.particles.front();
    return std::ranges::any_of(scene.grids, [&](const Grid& grid) {
        return one - grid.firstParticle < grid.node.size() && grid.nodes[1] == 1;
    });
}

std::vector<std::uint32_t> sheetIndices(const Scene& scene) {
    std::vector<std::uint32_t> indices;
    std::uint32_t firstVertex = 0;
    for (const Skin& skin : scene.skins) {
        if (isSheet(scene, skin))
            for (const auto& triangle : skin.triangles)
                for (const std::uint32_t corner : triangle) indices.push_back(firstVertex + corner);
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
    return indices;
}

std::uint32_t bodyOf(const Scene& scene, std::uint32_t particle) {
    const auto found = std::ranges::find_if(
        scene.bodies, [&](const Body& body) { return particle - body.firstParticle < body.particleCount; });
    return found == scene.bodies.end() ? NO_PARTICLE
                                       : static_cast<std::uint32_t>(found - scene.bodies.begin());
}

std::uint32_t particleOf(const Skin& skin) {
    return skin.cells.empty() ? skin.particles[0] : skin.cells[0].particles[0];
}

std::vector<layout::PickSkin> skinsOf(const Scene& scene, const std::vector<bool>& isClosed) {
    std::vector<layout::PickSkin> skins;
    for (const Skin& skin : scene.skins) {
        const std::size_t s = skins.size();
        layout::PickSkin one{.isClosed = s < isClosed.size() && isClosed[s], .isSheet = isSheet(scene, skin)};
        const std::uint32_t body = skin.vertexCount() > 0 ? bodyOf(scene, particleOf(skin)) : NO_PARTICLE;
        if (body != NO_PARTICLE) {
            one.firstParticle = scene.bodies[body].firstParticle;
            one.particleCount = scene.bodies[body].particleCount;
        }
        skins.push_back(one);
    }
    return skins;
}

std::vector<std::uint32_t> bodiesOf(const Scene& scene) {
    std::vector<std::uint32_t> bodies(scene.particles.size(), NO_PARTICLE);
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
        std::fill_n(bodies.begin() + scene.bodies[b].firstParticle, scene.bodies[b].particleCount, b);
    return bodies;
}

float dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr auto farthest = static_cast<float>(PICK_FAR);

// The visible range of a ray; `isOpened`: from `from` on it is behind the plane.
struct Seen {
    float from = 0, to = farthest;
    bool isOpened = false;
};

Seen seenOf(const RayQuery& ray, const std::optional<HiddenSide>& hidden) {
    if (!hidden) return {.to = ray.length};
    const float height = dot(hidden->normal, ray.origin) - hidden->offset;
    const float approach = -dot(hidden->normal, ray.direction);
    if (height <= 0) return {.to = std::min(approach < 0 ? height / approach : farthest, ray.length)};
    return {.from = approach > 0 ? height / approach : farthest, .to = ray.length, .isOpened = true};
}

// Dispatches of a ray, by index of their binding sets.
enum Part : std::uint32_t { ofSkins, ofBalls, ofCuts, ofAll, partCount = ofAll };

} // namespace

RayTargets rayTargets(const Scene& scene) {
    std::vector<bool> hasSkin(scene.bodies.size(), false);
    for (const Skin& skin : scene.skins) {
        if (skin.vertexCount() == 0) continue;
        const std::uint32_t body = bodyOf(scene, particleOf(skin));
        if (body != NO_PARTICLE) hasSkin[body] = true;
    }
    RayTargets targets{.radii = std::vector<float>(scene.particles.size(), -1.0f), .isClosed = {}};
    const std::vector<std::uint32_t> bodies = bodiesOf(scene);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if ((bodies[i] == NO_PARTICLE || !hasSkin[bodies[i]]) && scene.particles[i].radius > 0)
            targets.radii[i] = scene.particles[i].radius;
    return targets;
}

struct RayCaster::State {
    const vk::Device& device;
    std::uint32_t rays;
    std::shared_ptr<const vk::Kernel> skinCaster, ballCaster, cutCaster, resolver;
    // Tables of the scene.
    vk::Buffer holders, sheets, skins, radii, inverseMasses;
    std::vector<std::uint32_t> bodies;
    layout::PickPush push{};
    vk::Buffer nothing; // stands for buffers that a scene lacks
    vk::Buffer windings, hits, found, answers;
    const Simulation* simulation = nullptr;
    std::optional<vk::BindingSets> sets{}, wholeSets{}; // the second: while nothing is cut

    State(const vk::Device& on, const Scene& scene, const RayTargets& targets, std::uint32_t most,
          std::uint32_t slots)
        : device(on.anchored()), rays(most), skinCaster(device.kernels().get(device, kernels::castRay, {})),
          ballCaster(device.kernels().get(device, kernels::castRayBalls, {})),
          cutCaster(device.kernels().get(device, kernels::castRayCuts, {})),
          resolver(device.kernels().get(device, kernels::resolvePick, {})),
          holders(tableOf(device, "pick.holders", holdersOf(scene))),
          sheets(tableOf(device, "pick.sheets", sheetIndices(scene))),
          skins(tableOf(device, "pick.skins", skinsOf(scene, targets.isClosed))),
          radii(tableOf(device, "pick.radii", targets.radii)),
          inverseMasses(tableOf(device, "pick.inverse_masses", sim::inverseMasses(scene))),
          bodies(bodiesOf(scene)), push{.sheetTriangles =
                                            static_cast<std::uint32_t>(sheetIndices(scene).size() / 3),
                                        .particles =
                                            std::ranges::any_of(targets.radii,
                                                                [](float radius) { return radius >= 0; })
                                                ? static_cast<std::uint32_t>(scene.particles.size())
                                                : 0,
                                        .skins = static_cast<std::uint32_t>(scene.skins.size())},
          nothing(tableOf(device, "pick.nothing", std::vector<layout::vec4>(8))),
          windings(
              device,
              {.name = "pick.windings", .count = VkDeviceSize{rays} * std::max(push.skins, 1u), .stride = 4}),
          hits(device, {.name = "pick.hits",
                        .count = VkDeviceSize{rays} * partCount * PICK_CASTERS,
                        .stride = sizeof(layout::PickHit)}),
          found(device, {.name = "pick.found", .count = rays, .stride = sizeof(layout::PickAnswer)}),
          answers(device, {.name = "pick.answers",
                           .count = VkDeviceSize{slots} * rays,
                           .stride = sizeof(layout::PickAnswer),
                           .kind = vk::MemoryKind::readback}) {}

    vk::BindingSets bindingSets(const vk::BufferView& indices) const;
    layout::PickPush pushOf(const RayQuery& query, std::uint32_t ray,
                            const std::optional<HiddenSide>& hidden) const noexcept;
    void recordCast(vk::Commands& commands, const vk::BindingSets& of, layout::PickPush cast) const noexcept;
};

vk::BindingSets RayCaster::State::bindingSets(const vk::BufferView& indices) const {
    const CutSurface cuts = simulation->cutSurface();
    const auto there = [this](const vk::BufferView& view, std::uint32_t stride) {
        vk::BufferView any = view.size > 0 ? view : nothing.view();
        any.stride = stride;
        return any;
    };
    constexpr std::uint32_t vertexStride = sizeof(layout::SkinVertex);
    const vk::BufferView drawn = there(indices, 4),
                         vertices = there(simulation->skinVertices(), vertexStride),
                         cutIndices = there(cuts.indices, 4),
                         cutVertices = there(cuts.vertices, vertexStride),
                         cutRest = there(cuts.rest, sizeof(layout::CutVertex)),
                         counts = there(cuts.counts, sizeof(layout::SurfaceState)),
                         slots = there(cuts.particles, 4), positions = simulation->positions(),
                         removed = removedParticles(*simulation), windingsView = windings.view(),
                         hitsView = hits.view();
    const std::array requests{
        // in the order of Part
        vk::BindingRequest{
            skinCaster.get(),
            {drawn, vertices, windingsView, hitsView, sheets.view(), holders.view(), skins.view(), removed}},
        vk::BindingRequest{ballCaster.get(), {positions, radii.view(), removed, hitsView}},
        vk::BindingRequest{cutCaster.get(),
                           {cutIndices, cutVertices, windingsView, hitsView, cutRest, counts}},
        vk::BindingRequest{resolver.get(),
                           {drawn, holders.view(), sheets.view(), counts, cutIndices, cutRest, slots,
                            positions, inverseMasses.view(), removed, skins.view(), windingsView, hitsView,
                            found.view()}}};
    return {device, requests};
}

layout::PickPush RayCaster::State::pushOf(const RayQuery& query, std::uint32_t ray,
                                          const std::optional<HiddenSide>& hidden) const noexcept {
    const Simulation::DrawnSkins drawn = simulation->drawnSkins();
    const Seen seen = seenOf(query, hidden);
    layout::PickPush result = push;
    result.origin = {query.origin.x, query.origin.y, query.origin.z, seen.from};
    result.direction = {query.direction.x, query.direction.y, query.direction.z, seen.to};
    for (const SkinRange& skin : drawn.ranges) result.triangles += skin.indexCount / 3;
    result.isOpened = seen.isOpened;
    result.isMoving = query.meetsFixed ? 0u : 1u;
    result.ray = ray;
    result.firstHit = ray * partCount * PICK_CASTERS;
    result.hasCuts = !drawn.areWhole && simulation->cutSurface().counts.size > 0;
    const std::uint32_t areSkins = result.triangles + result.sheetTriangles > 0 ? 1 : 0,
                        areBalls = result.particles > 0 ? 1 : 0;
    result.hits = (areSkins + areBalls + result.hasCuts) * PICK_CASTERS;
    return result;
}

// A part that the scene lacks is left out.
void RayCaster::State::recordCast(vk::Commands& commands, const vk::BindingSets& of,
                                  layout::PickPush cast) const noexcept {
    const std::uint32_t triangles = cast.triangles + cast.sheetTriangles;
    const auto add = [&](const vk::Kernel& kernel, Part part, std::uint32_t firstItem) {
        cast.firstItem = firstItem;
        commands.bind(kernel, of[part]);
        commands.push(kernel, &cast, sizeof cast);
        commands.dispatch(PICK_CASTERS / GROUP_ITEMS);
        cast.firstHit += PICK_CASTERS;
    };
    if (triangles > 0) add(*skinCaster, ofSkins, 0);
    if (cast.particles > 0) add(*ballCaster, ofBalls, triangles);
    if (cast.hasCuts != 0) add(*cutCaster, ofCuts, triangles + cast.particles);
}

RayCaster::RayCaster(const vk::Device& device, const Scene& scene, const RayTargets& targets,
                     std::uint32_t rays, std::uint32_t slots)
    : state_(std::make_unique<State>(device, scene, targets, rays, slots)) {}
RayCaster::~RayCaster() = default;

void RayCaster::watch(const Simulation& simulation) {
    state_->simulation = &simulation;
    const vk::BufferView whole = inspect(simulation).wholeIndices;
    state_->sets.emplace(state_->bindingSets(simulation.skinIndices()));
    state_->wholeSets.reset();
    if (whole.size > 0) state_->wholeSets.emplace(state_->bindingSets(whole));
}

// All rays are cast, then resolved.
void RayCaster::record(VkCommandBuffer handle, std::uint32_t slot,
                       std::span<const std::optional<RayQuery>> given,
                       const std::optional<HiddenSide>& hidden) const noexcept {
    const State& own = *state_;
    const auto rays = given.first(std::min<std::size_t>(given.size(), own.rays));
    const vk::BindingSets& sets = own.simulation->drawnSkins().areWhole ? *own.wholeSets : *own.sets;
    vk::BufferView read = own.answers.view();
    read.offset += slot * own.found.view().size;
    read.size = own.found.view().size;
    vk::Commands commands(own.device, handle);
    commands.beginLabel("pick");
    commands.beginStep();
    commands.fill(own.windings.view(), 0);
    commands.barrier();
    const auto forEach = [&](const auto& use) {
        for (std::uint32_t i = 0; i < rays.size(); ++i)
            if (rays[i]) use(own.pushOf(*rays[i], i, hidden));
    };
    forEach([&](const layout::PickPush& push) { own.recordCast(commands, sets, push); });
    commands.barrier();
    forEach([&](const layout::PickPush& push) {
        commands.bind(*own.resolver, sets[ofAll]);
        commands.push(*own.resolver, &push, sizeof push);
        commands.dispatch(1);
    });
    commands.barrier();
    commands.copy(own.found.view(), read);
    commands.endStep();
    commands.hostBarrier();
    commands.endLabel();
}

std::optional<RayHit> RayCaster::hit(std::uint32_t slot, std::size_t ray) const noexcept {
    const State& own = *state_;
    own.answers.invalidate();
    layout::PickAnswer answer;
    std::memcpy(&answer, own.answers.mapped() + (std::size_t{slot} * own.rays + ray) * sizeof answer,
                sizeof answer);
    if (answer.particle == NO_PARTICLE) return std::nullopt;
    return RayHit{.particle = answer.particle,
                  .body = own.bodies[answer.particle],
                  .point = {answer.point.x, answer.point.y, answer.point.z},
                  .place = {answer.place[0], answer.place[1], answer.place[2]},
                  .distance = answer.point.w};
}

} // namespace sinew::sim
