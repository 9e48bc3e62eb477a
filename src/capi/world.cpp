// Worlds: parts that come and go.
#include "sinew/sinew_world.h"

#include "capi/convert.hpp"
#include "capi/stepper.hpp"

#include "sinew/validate.hpp"
#include "sinew/vk/check.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace sinew::capi {

namespace {

/// The simulation of the world is another one: its handle before is stale. Allocates nothing.
void adopt(UseOfWorld& use) noexcept {
    const sim::World& world = use->world;
    SimulationObject& object = use.simulation();
    object.simulation = &use->world.simulation();
    object.settings = world.settings();
    object.particles = static_cast<std::uint32_t>(world.scene().particles.size());
    object.bodies = static_cast<std::uint32_t>(world.scene().bodies.size());
    if (!world.isChanging()) use->attachments = world.scene().attachments.size();
    ++use->takeOvers;
    renewCompanion(use.object());
}

bool recordChanges(UseOfWorld& use, VkCommandBuffer commands) {
    collectComplaints(use.simulation()); // of the simulation that may be replaced
    const bool isTakenOver = use->world.recordChanges(commands);
    if (isTakenOver) adopt(use);
    return isTakenOver;
}

/// Takes all changes over. No step is in flight.
void settle(UseOfWorld& use, Submitting& queue) {
    while (use->world.isChanging()) {
        queue.run(use->device.device, [&](VkCommandBuffer commands) {
            while (true) {
                const bool isReady = use->world.isReady();
                if (recordChanges(use, commands)) return;
                if (isReady)
                    throw Failed{SINEW_ERROR_DIVERGED,
                                 "the changes cannot be taken over: steps behind one that failed have to be "
                                 "taken again; reset the simulation of the world"};
                std::this_thread::sleep_for(std::chrono::microseconds(200));
            }
        });
        use->world.release();
    }
}

class WorldStepper final : public Stepper {
public:
    WorldStepper(UseOfWorld& use, Submitting& queue, const sim::Step& step)
        : Stepper(use.simulation(), queue, step), use_(use) {}

private:
    void growContacts(const sim::StepStatus& status) override {
        if (!use_->world.observe(status) || !use_->world.isChanging())
            throw Failed{SINEW_ERROR_DIVERGED,
                         "there is no room for " + std::to_string(status.contactRoom) +
                             " contact candidates for a particle on average: move bodies apart, or take a "
                             "smaller contactMargin"};
        use_.simulation()
            .simulation->complaintsOfUse(); // of the lack; the steps are repeated, and their mistakes
        settle(use_, queue_);
    }
    void growSurface(const sim::StepStatus& status) override {
        if (!status.isFinished || status.cutSurfaceMissing == 0) return;
        if (!use_->world.observe(status)) return; // the surface is then drawn as far as it fits
        try {
            settle(use_, queue_);
        } catch (const vk::Error& error) {
            if (error.failure() == vk::Failure::deviceLost) throw;
            log(SINEW_LOG_WARNING, error.what());
        }
    }

    UseOfWorld& use_;
};

SinewSceneCounts fromCounts(const sim::SceneCounts& counts) {
    return {.size = sizeof(SinewSceneCounts),
            .particles = counts.particles,
            .links = counts.distances,
            .bends = counts.bends,
            .tethers = counts.tethers,
            .fixed = counts.fixed,
            .attachments = counts.attachments,
            .faces = counts.faces,
            .planes = counts.planes,
            .colliders = counts.colliders,
            .bodies = counts.bodies,
            .grids = counts.grids,
            .skins = counts.skins};
}

sim::PartId toPart(const SinewPart& part) {
    return {.index = part.index, .generation = part.generation};
}

void requireOwnPart(SinewWorld world, const SinewPart& part) {
    if (part.world == 0) throw Failed{SINEW_ERROR_INVALID_HANDLE, "the handle of the part is null"};
    if (part.world != world.id) throw Failed{SINEW_ERROR_INVALID_HANDLE, "the part is one of another world"};
}

} // namespace

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewCreateWorld(SinewDevice device, SinewScene base, const SinewSettings* settings,
                             SinewWorld* world) {
    return call(
        __func__,
        [&] {
            const sim::Settings given = toSettings(settings);
            requireNotNull(world, "world");
            const Use<DeviceObject> on(device.id, Access::read);
            const Use<SceneObject> of(base.id, Access::read);
            for (const std::string& warning : sim::warnings(of->scene)) log(SINEW_LOG_WARNING, warning);
            auto made = std::make_unique<WorldObject>(*on, of->scene, given);
            auto simulation = std::make_unique<SimulationObject>(*on, made->world);
            world->id = addObject(std::move(made), &*on, std::move(simulation));
        },
        SINEW_ERROR_INVALID_SCENE);
}

SinewResult sinewDestroyWorld(SinewWorld world) {
    return call(__func__, [&] { destroyObject(world.id, Kind::world); });
}

SinewResult sinewGetWorldInfo(SinewWorld world, SinewWorldInfo* info) {
    return call(__func__, [&] {
        const Result<SinewWorldInfo> result(info, "SinewWorldInfo");
        const UseOfWorld use(world.id);
        result.give({.size = sizeof(SinewWorldInfo),
                     .isChanging = use->world.isChanging() ? 1u : 0u,
                     .isReady = use->world.isReady() ? 1u : 0u,
                     .substeps = use->world.settings().substeps,
                     .takeOvers = use->takeOvers,
                     .simulation = {companionOf(use.object())}});
    });
}

SinewResult sinewGetWorldSimulation(SinewWorld world, SinewSimulation* simulation) {
    return call(__func__, [&] {
        requireNotNull(simulation, "simulation");
        const UseOfWorld use(world.id);
        simulation->id = companionOf(use.object());
    });
}

SinewResult sinewAddPart(SinewWorld world, SinewScene scene, SinewPart* part) {
    return call(
        __func__,
        [&] {
            requireNotNull(part, "part");
            const UseOfWorld use(world.id);
            const Use<SceneObject> of(scene.id, Access::read);
            std::vector<sim::Vec3>& anchors = use.simulation().input.anchors;
            const std::size_t attachments = use->attachments + of->scene.attachments.size();
            anchors.resize(std::max(anchors.size(), attachments + 1)); // a take-over allocates nothing
            for (const std::string& warning : sim::warnings(of->scene)) log(SINEW_LOG_WARNING, warning);
            const sim::PartId added = use->world.add(of->scene);
            use->attachments = attachments;
            *part = {.world = world.id, .index = added.index, .generation = added.generation};
        },
        SINEW_ERROR_INVALID_SCENE);
}

SinewResult sinewRemovePart(SinewWorld world, SinewPart part) {
    return call(
        __func__,
        [&] {
            const UseOfWorld use(world.id);
            requireOwnPart(world, part);
            use->world.remove(toPart(part));
        },
        SINEW_ERROR_INVALID_HANDLE);
}

SinewResult sinewContainsPart(SinewWorld world, SinewPart part, uint32_t* isContained) {
    return call(__func__, [&] {
        requireNotNull(isContained, "isContained");
        const UseOfWorld use(world.id);
        *isContained = part.world == world.id && use->world.contains(toPart(part)) ? 1 : 0;
    });
}

SinewResult sinewFindPart(SinewWorld world, SinewPart part, SinewSceneCounts* first,
                          SinewSceneCounts* count) {
    return call(__func__, [&] {
        const Result<SinewSceneCounts> from(first, "SinewSceneCounts");
        const Result<SinewSceneCounts> number(count, "SinewSceneCounts");
        const UseOfWorld use(world.id);
        requireOwnPart(world, part);
        const std::optional<sim::PartRange> found = use->world.find(toPart(part));
        if (!found) {
            if (use->world.contains(toPart(part))) return SINEW_NOT_READY;
            throw Failed{SINEW_ERROR_INVALID_HANDLE, "the part is not, or no longer, in the world"};
        }
        from.give(fromCounts(found->first));
        number.give(fromCounts(found->count));
        return SINEW_OK;
    });
}

SinewResult sinewGetWorldCounts(SinewWorld world, SinewSceneCounts* counts) {
    return call(__func__, [&] {
        const Result<SinewSceneCounts> result(counts, "SinewSceneCounts");
        const UseOfWorld use(world.id);
        result.give(fromCounts(sim::countsOf(use->world.scene())));
    });
}

SinewResult sinewRecordChanges(SinewWorld world, VkCommandBuffer commands, uint32_t* isTakenOver) {
    return call(
        __func__,
        [&] {
            requireNotNull(commands, "commands");
            requireNotNull(isTakenOver, "isTakenOver");
            UseOfWorld use(world.id);
            *isTakenOver = recordChanges(use, commands) ? 1 : 0;
        },
        SINEW_ERROR_INVALID_SCENE);
}

SinewResult sinewGetWorldStatus(SinewWorld world, uint64_t frame, SinewStatus* status) {
    return call(__func__, [&] {
        const Result<SinewStatus> result(status, "SinewStatus");
        const UseOfWorld use(world.id);
        const sim::StepStatus from = use->world.status(frame);
        if (!from.isFinished) return SINEW_NOT_READY;
        result.give(fromStatus(from));
        return SINEW_OK;
    });
}

SinewResult sinewObserveStatus(SinewWorld world, const SinewStatus* status, uint32_t* isEnough) {
    return call(__func__, [&] {
        const SinewStatus given = described(status, "SinewStatus");
        requireNotNull(isEnough, "isEnough");
        const UseOfWorld use(world.id);
        sim::StepStatus observed;
        observed.isFinished = true;
        observed.contactRoom = given.contactRoom;
        observed.cutSurfaceMissing = given.cutSurfaceMissing;
        *isEnough = use->world.observe(observed) ? 1 : 0;
    });
}

SinewResult sinewReleaseReplaced(SinewWorld world) {
    return call(__func__, [&] {
        const UseOfWorld use(world.id);
        use->world.release();
    });
}

SinewResult sinewUpdateWorld(SinewWorld world) {
    return call(
        __func__,
        [&] {
            UseOfWorld use(world.id);
            Submitting queue(use->device);
            resetOnce(use.simulation(), queue);
            use->world.retry();
            settle(use, queue);
        },
        SINEW_ERROR_INVALID_SCENE);
}

SinewResult sinewStepWorld(SinewWorld world, const SinewStep* step, uint32_t count) {
    return call(
        __func__,
        [&] {
            const SinewStep given = described(step, "SinewStep", defaultStep);
            UseOfWorld use(world.id);
            Submitting queue(use->device);
            resetOnce(use.simulation(), queue);
            settle(use, queue);
            WorldStepper(use, queue, stepOf(given, use.simulation())).take(count);
        },
        SINEW_ERROR_INVALID_SCENE);
}

} // extern "C"
