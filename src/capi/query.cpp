// Queries: rays and regions.
#include "sinew/sinew_query.h"

#include "capi/convert.hpp"
#include "capi/stepper.hpp"

#include "sinew/picking.hpp"
#include "sinew/validate.hpp"

#include <algorithm>

namespace sinew::capi {

namespace {

struct QueryObject final : Object {
    static constexpr Kind kind = Kind::query;
    QueryObject(DeviceObject& itsDevice, const sim::Scene& scene, const SinewQueryRoom& itsRoom)
        : Object(kind), device(itsDevice), room(itsRoom),
          particles(static_cast<std::uint32_t>(scene.particles.size())),
          caster(device.device, scene, sim::rayTargets(scene), room.rays, room.slots),
          finder(device.device, scene, room.particles, room.slots), rays(room.rays) {}
    /// Asks the simulation, unless it does so already.
    void watch(std::uint64_t id, const SimulationObject& object) {
        if (object.particles != particles)
            throw Failed{SINEW_ERROR_MISMATCH, "the simulation has " + std::to_string(object.particles) +
                                                   " particles, and the scene of the query " +
                                                   std::to_string(particles)};
        if (watched == id && replacements == object.replacements) return;
        caster.watch(*object.simulation);
        finder.watch(*object.simulation);
        watched = id;
        replacements = object.replacements;
    }

    DeviceObject& device;
    SinewQueryRoom room;
    std::uint32_t particles;
    sim::RayCaster caster;
    sim::RegionFinder finder;
    std::vector<std::optional<sim::RayQuery>> rays; ///< recording allocates nothing
    std::uint64_t watched = 0;                      ///< handle of the simulation
    std::uint64_t replacements = 0;                 ///< SimulationObject::replacements of what is watched
};

SinewQueryRoom roomOf(const SinewQueryRoom* room) {
    const SinewQueryRoom given = described(room, "SinewQueryRoom");
    if (given.rays == 0 || given.slots == 0)
        invalidArgument("SinewQueryRoom: rays and slots must be at least 1");
    return given;
}

/// A query and the simulation that it asks, in use by this call.
class UseOfQuery {
public:
    explicit UseOfQuery(std::uint64_t id)
        : query_(id, Access::write), simulation_(watchedBy(*query_), Access::write) {
        query_->watch(query_->watched, *simulation_);
    }
    QueryObject* operator->() const noexcept { return &*query_; }
    QueryObject& object() const noexcept { return *query_; }
    SimulationObject& simulation() const noexcept { return *simulation_; }

private:
    static std::uint64_t watchedBy(const QueryObject& query) {
        if (query.watched == 0)
            invalidArgument("the query has no simulation: call sinewSetQuerySimulation first");
        return query.watched;
    }
    Use<QueryObject> query_;
    Use<SimulationObject> simulation_;
};

void requireSlot(const QueryObject& query, std::uint32_t slot) {
    if (slot >= query.room.slots)
        invalidArgument("slot is " + std::to_string(slot) + ", and the query has " +
                        std::to_string(query.room.slots));
}

sim::RayQuery toRay(const SinewRay& ray) {
    return {.origin = toVec3(ray.origin),
            .direction = toVec3(ray.direction),
            .length = ray.length > 0 ? ray.length : sim::RayQuery{}.length,
            .meetsFixed = ray.skipsFixed == 0};
}

sim::RegionQuery toRegion(const SinewRegion& region) {
    return {.center = toVec3(region.center),
            .halfExtents = toVec3(region.halfExtents),
            .radius = region.radius,
            .findsFixed = region.skipsFixed == 0};
}

SinewRayHit hitOf(const QueryObject& query, std::uint32_t slot, std::uint32_t ray) {
    SinewRayHit hit{.size = sizeof hit,
                    .isMet = 0,
                    .particle = 0xffffffffu,
                    .body = 0xffffffffu,
                    .point = {},
                    .place = {},
                    .distance = 0};
    const std::optional<sim::RayHit> found = query.caster.hit(slot, ray);
    if (!found) return hit;
    hit.isMet = 1;
    hit.particle = found->particle;
    hit.body = found->body;
    hit.point = fromVec3(found->point);
    hit.place = fromVec3(found->place);
    hit.distance = found->distance;
    return hit;
}

void giveRegion(const QueryObject& query, std::uint32_t slot, std::uint32_t& count,
                std::uint32_t* particles) {
    const sim::RegionFinder::Found found = query.finder.found(slot);
    const std::size_t fitting = std::min<std::size_t>(count, found.particles.size());
    std::copy_n(found.particles.begin(), fitting, particles);
    count = found.count;
}

} // namespace

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewCreateQuery(SinewDevice device, SinewScene scene, const SinewQueryRoom* room,
                             SinewQuery* query) {
    return call(
        __func__,
        [&] {
            const SinewQueryRoom given = roomOf(room);
            requireNotNull(query, "query");
            const Use<DeviceObject> on(device.id, Access::read);
            const Use<SceneObject> of(scene.id, Access::read);
            sim::requireNone(sim::validate(of->scene, of->settings));
            query->id = addObject(std::make_unique<QueryObject>(*on, of->scene, given), &*on);
        },
        SINEW_ERROR_INVALID_SCENE);
}

SinewResult sinewCreateWorldQuery(SinewWorld world, const SinewQueryRoom* room, SinewQuery* query) {
    return call(__func__, [&] {
        const SinewQueryRoom given = roomOf(room);
        requireNotNull(query, "query");
        const UseOfWorld use(world.id);
        auto made = std::make_unique<QueryObject>(use->device, use->world.scene(), given);
        made->watch(companionOf(use.object()), use.simulation());
        query->id = addObject(std::move(made), &use->device);
    });
}

SinewResult sinewDestroyQuery(SinewQuery query) {
    return call(__func__, [&] { destroyObject(query.id, Kind::query); });
}

SinewResult sinewSetQuerySimulation(SinewQuery query, SinewSimulation simulation) {
    return call(__func__, [&] {
        const Use<QueryObject> use(query.id, Access::write);
        const Use<SimulationObject> of(simulation.id, Access::write);
        if (&of->device != &use->device)
            throw Failed{SINEW_ERROR_MISMATCH, "the simulation is on another device than the query"};
        use->watch(simulation.id, *of);
    });
}

SinewResult sinewRecordRays(SinewQuery query, VkCommandBuffer commands, uint32_t slot, const SinewRay* rays,
                            uint32_t count) {
    return call(__func__, [&] {
        requireNotNull(commands, "commands");
        requireArray(rays, count, "rays");
        const UseOfQuery use(query.id);
        requireSlot(use.object(), slot);
        if (count > use->room.rays)
            invalidArgument("count is " + std::to_string(count) + ", and the query has room for " +
                            std::to_string(use->room.rays) + " rays");
        std::transform(rays, rays + count, use->rays.begin(), toRay);
        use->caster.record(commands, slot, std::span(use->rays).first(count));
    });
}

SinewResult sinewGetRayHit(SinewQuery query, uint32_t slot, uint32_t ray, SinewRayHit* hit) {
    return call(__func__, [&] {
        const Result<SinewRayHit> result(hit, "SinewRayHit");
        const Use<QueryObject> use(query.id, Access::read);
        requireSlot(*use, slot);
        if (ray >= use->room.rays) invalidArgument("there is no ray " + std::to_string(ray));
        result.give(hitOf(*use, slot, ray));
    });
}

SinewResult sinewRecordRegion(SinewQuery query, VkCommandBuffer commands, uint32_t slot,
                              const SinewRegion* region) {
    return call(__func__, [&] {
        requireNotNull(commands, "commands");
        requireNotNull(region, "region");
        const UseOfQuery use(query.id);
        requireSlot(use.object(), slot);
        use->finder.record(commands, slot, toRegion(*region));
    });
}

SinewResult sinewGetRegion(SinewQuery query, uint32_t slot, uint32_t* count, uint32_t* particles) {
    return call(__func__, [&] {
        requireNotNull(count, "count");
        requireArray(particles, *count, "particles");
        const Use<QueryObject> use(query.id, Access::read);
        requireSlot(*use, slot);
        giveRegion(*use, slot, *count, particles);
    });
}

SinewResult sinewCastRay(SinewQuery query, const SinewRay* ray, SinewRayHit* hit) {
    return call(__func__, [&] {
        requireNotNull(ray, "ray");
        const Result<SinewRayHit> result(hit, "SinewRayHit");
        const UseOfQuery use(query.id);
        Submitting queue(use->device);
        resetOnce(use.simulation(), queue);
        use->rays[0] = toRay(*ray);
        queue.run(use->device.device, [&](VkCommandBuffer commands) {
            use.simulation().simulation->recordSkin(commands);
            use->caster.record(commands, 0, std::span(use->rays).first(1));
        });
        result.give(hitOf(use.object(), 0, 0));
    });
}

SinewResult sinewFindParticles(SinewQuery query, const SinewRegion* region, uint32_t* count,
                               uint32_t* particles) {
    return call(__func__, [&] {
        requireNotNull(region, "region");
        requireNotNull(count, "count");
        requireArray(particles, *count, "particles");
        const UseOfQuery use(query.id);
        Submitting queue(use->device);
        resetOnce(use.simulation(), queue);
        queue.run(use->device.device,
                  [&](VkCommandBuffer commands) { use->finder.record(commands, 0, toRegion(*region)); });
        giveRegion(use.object(), 0, *count, particles);
    });
}

} // extern "C"
