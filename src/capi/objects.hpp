// The objects behind the handles of the C interface.
#pragma once

#include "capi/call.hpp"
#include "sinew/ranges.hpp"
#include "sinew/rooms.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"
#include "sinew/world.hpp"

#include <deque>
#include <mutex>
#include <optional>

namespace sinew::capi {

/// A device, with loader and queue if it was made by sinewCreateDevice().
struct DeviceObject final : Object {
    static constexpr Kind kind = Kind::device;
    DeviceObject(std::unique_ptr<vk::Loader> itsLoader, vk::Device itsDevice)
        : Object(kind), loader(std::move(itsLoader)), device(std::move(itsDevice)) {
        if (loader) queue.emplace(device);
    }
    const std::unique_ptr<vk::Loader> loader; ///< null if borrowed
    const vk::Device device;
    std::mutex queueMutex; ///< guards the queue: one thread at a time submits
    std::optional<vk::Queue> queue;
};

struct SceneObject final : Object {
    static constexpr Kind kind = Kind::scene;
    SceneObject() : Object(kind) {}
    sim::Scene scene;
    sim::Settings settings; ///< those of the scene's file
};

/// Room for the lists of a step, so that recording allocates nothing. There is place for one item too many:
/// the core notices, and complains.
struct StepInput {
    std::vector<sim::Vec3> anchors, bladeFrom, bladeTo;
    std::vector<sim::HostCollider> hostColliders;
    std::array<sim::Grab, sim::ranges::mostGrabs + 1> grabs{};
    std::array<sim::ForceField, sim::ranges::mostFields + 1> fields{};
    std::array<sim::Motion, sim::ranges::mostMotions + 1> motions{};
};

/// Events of the steps of one call, with the frame of each.
struct StepEvents {
    std::vector<std::pair<std::uint64_t, sim::Event>> list;
    std::uint32_t lost = 0;
};

struct SimulationObject final : Object {
    static constexpr Kind kind = Kind::simulation;
    SimulationObject(DeviceObject& itsDevice, const sim::Scene& itsScene, const sim::Settings& itsSettings);
    /// The present simulation of a world, which outlives this object.
    SimulationObject(DeviceObject& itsDevice, sim::World& itsWorld);
    ~SimulationObject() override;

    DeviceObject& device;
    sim::Settings settings;                 ///< of `simulation`, with a number of substeps
    std::optional<sim::Scene> scene;        ///< for successors; only on a device with a queue
    std::unique_ptr<sim::Simulation> owned; ///< null for that of a world
    sim::Simulation* simulation;
    std::uint32_t particles = 0, bodies = 0;
    StepInput input;
    std::deque<std::string> complaints; ///< not yet returned
    std::string told;                   ///< returned last
    // Used by sinewStep():
    sim::Rooms rooms;
    bool isReset = false; ///< also of a world's
    std::uint64_t nextFrame = 0, stepsDone = 0;
    StepEvents stepEvents;
    std::vector<std::unique_ptr<sim::Simulation>> predecessors; ///< kept for addresses that were given out
    bool isMapped = false;                                      ///< addresses of `simulation` were given out
    std::uint64_t replacements = 0; ///< of `simulation` by one with more room, behind the same handle
};

struct WorldObject final : Object {
    static constexpr Kind kind = Kind::world;
    WorldObject(DeviceObject& itsDevice, const sim::Scene& base, const sim::Settings& settings)
        : Object(kind), device(itsDevice), world(itsDevice.device, base, settings),
          attachments(base.attachments.size()) {}
    DeviceObject& device;
    sim::World world;
    std::uint64_t takeOvers = 0;
    std::size_t attachments; ///< at least as many as any scene has that is being made
};

struct StateObject final : Object {
    static constexpr Kind kind = Kind::state;
    StateObject() : Object(kind) {}
    sim::SavedState host;
    std::uint64_t key = 0, size = 0;
    std::vector<std::byte> bytes; ///< empty if the host has them
};

/// Removes what was added to a scene, unless keep() was called: a call that fails leaves the scene as it was.
class Addition {
public:
    explicit Addition(sim::Scene& scene);
    ~Addition();
    Addition(const Addition&) = delete;
    Addition& operator=(const Addition&) = delete;
    void keep() noexcept { isKept_ = true; }

private:
    sim::Scene& scene_;
    std::array<std::size_t, 14> sizes_;
    bool isKept_ = false;
};

/// A world and its simulation, in use by this call: one thread uses both.
class UseOfWorld {
public:
    explicit UseOfWorld(std::uint64_t id)
        : world_(id, Access::write), simulation_(companionOf(*world_), Access::write) {}
    WorldObject* operator->() const noexcept { return &*world_; }
    WorldObject& object() const noexcept { return *world_; }
    SimulationObject& simulation() const noexcept { return *simulation_; }

private:
    Use<WorldObject> world_;
    Use<SimulationObject> simulation_;
};

/// Throws Failed (UNSUPPORTED) if the device has no queue of its own.
vk::Queue& queueOf(DeviceObject& device);
/// The step of the core, with spans into the object's input. Allocates nothing. Throws for a motion that has
/// no effect.
sim::Step stepOf(const SinewStep& step, SimulationObject& object);
SinewStatus fromStatus(const sim::StepStatus& status);
/// Moves complaints of the core to those that are not yet returned.
void collectComplaints(SimulationObject& object);
/// Empty for an output that the scene does not have. Throws for an unknown output.
vk::BufferView viewOf(const SimulationObject& object, std::uint32_t output);

} // namespace sinew::capi
