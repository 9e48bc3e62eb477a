// The objects behind the handles of the C interface.
#pragma once

#include "capi/call.hpp"
#include "sinew/ranges.hpp"
#include "sinew/rooms.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

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
    std::array<sim::Grab, sim::ranges::mostGrabs + 1> grabs{};
    std::array<sim::HostCollider, sim::ranges::mostHostColliders + 1> hostColliders{};
    std::array<sim::ForceField, sim::ranges::mostFields + 1> fields{};
};

struct SimulationObject final : Object {
    static constexpr Kind kind = Kind::simulation;
    SimulationObject(DeviceObject& itsDevice, const sim::Scene& itsScene, const sim::Settings& itsSettings);
    ~SimulationObject() override;

    DeviceObject& device;
    sim::Settings settings;          ///< of `simulation`, with a number of substeps
    std::optional<sim::Scene> scene; ///< for successors; only on a device with a queue
    std::unique_ptr<sim::Simulation> simulation;
    std::uint32_t particles = 0, bodies = 0;
    StepInput input;
    std::deque<std::string> complaints; ///< not yet returned
    std::string told;                   ///< returned last
    // Of sinewStep():
    sim::Rooms rooms;
    bool isReset = false;
    std::uint64_t nextFrame = 0, stepsDone = 0;
    std::vector<std::unique_ptr<sim::Simulation>> predecessors; ///< kept for addresses that were given out
    bool isMapped = false;                                      ///< addresses of `simulation` were given out
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

/// Throws Failed (UNSUPPORTED) if the device has no queue of its own.
vk::Queue& queueOf(DeviceObject& device);
/// The step of the core, with spans into `input`. Allocates nothing.
sim::Step stepOf(const SinewStep& step, StepInput& input);
/// Empty for an output that the scene does not have. Throws for an unknown output.
vk::BufferView viewOf(const SimulationObject& object, std::uint32_t output);

} // namespace sinew::capi
