// A simulation to which bodies, colliders and other parts of a scene are added, and from which they are
// removed, while it runs.
#pragma once

#include "sinew/append.hpp"
#include "sinew/export.hpp"
#include "sinew/rooms.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <vector>

namespace sinew::sim {

/// Names a part of a World. Never names another part, even after the part is gone.
struct SINEW_API PartId {
    std::uint32_t index = 0xffffffffu, generation = 0;
    bool operator==(const PartId&) const = default;
};

/// The elements of a part in the lists of World::scene(): `count` of each kind, from `first` on.
struct SINEW_API PartRange {
    SceneCounts first{}, count{};
};

/// A scene of parts, and its simulation. A part is a Scene of its own: bodies with their constraints, faces,
/// grids and skins, colliders, planes, attachments. After a change, a thread makes a simulation of the new
/// scene beside the one that runs; between two steps that one takes over all that lives on: positions,
/// velocities, cuts, the memory of contacts, grabs and sleep. With `split` and `jacobi` the state has the
/// same bits afterwards. Its steps have the bits that they have without the change if nothing new touches it
/// and the new scene has the same kernels; other bodies may lead to another order of sums, or to another unit
/// of integer sums, and then to another last digit. With `gauss_seidel` the multipliers of the last step are
/// lost. All that sleeps wakes if a part is removed, if one with colliders or planes arrives, or if the
/// number of substeps or levels grows.
///
/// A material that was changed by Simulation::recordChange() lasts until the next take-over.
///
/// Never submits or waits, owns no queue. One thread uses a World and its simulation.
class SINEW_API World {
public:
    /// Makes the simulation of `base`, whose elements stay for good; as the constructor of Simulation.
    /// `settings` hold for all simulations; with 0 substeps or autoLevels, the number is chosen for `base`,
    /// and grows with the parts that need more. The caller records Simulation::recordReset().
    World(const vk::Device& device, Scene base, const Settings& settings);
    /// Waits for the thread. All commands recorded with the simulations, also with those that were replaced,
    /// must have finished.
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Adds a part, at the positions and velocities in it. It arrives with a later recordChanges(). Overlaps
    /// within the part count as in a scene at load; place it where it overlaps nothing else. Gravity, step
    /// length, damping and default contact properties are those of the base. Throws std::invalid_argument
    /// with the sentences of validate() for the part alone, or for a particle that belongs to no body.
    /// The thread reads the running simulation: do not call its recordChange() while isChanging().
    PartId add(Scene part);
    /// Removes a part, also one that has not arrived yet. Throws std::invalid_argument if it is not, or no
    /// longer, part of the world.
    void remove(PartId part);
    /// Whether the part was added and not removed since; it may not have arrived.
    bool contains(PartId part) const noexcept;
    /// The place of the part in scene(); empty before it arrives, and after it has left.
    std::optional<PartRange> find(PartId part) const noexcept;

    /// Simulation::status() of any step since the last release(), before a take-over or after.
    StepStatus status(std::uint64_t frame) const noexcept;
    /// Simulation::events() of such a step. Indices are those of the scene that the step was recorded with.
    Events events(std::uint64_t frame) const;
    /// Reads the status of a finished step: if it lacked room for contacts or for the surface of cuts, a
    /// simulation with more is made. Returns false if there is no more to be had: beyond ranges.hpp, or
    /// because a making with it has failed.
    bool observe(const StepStatus& status);

    /// Call before each step, with the command buffer that the step will be recorded into. Begins to make a
    /// simulation if there are changes and none is being made. While one is made, may record copies into its
    /// buffers; the commands must be submitted. If it is ready, records the take-over and returns true:
    /// simulation(), scene() and all indices and views are then new. Steps may be in flight, except those
    /// with Step::repeats, those of another length than the last that was finished, those of a scene with
    /// colliders that move or with Settings::hostColliders, and all after observe() has asked for more room
    /// for contacts. No step may wait to be recorded again. Throws what the making threw, after which the
    /// world goes on without the parts that were to arrive; parts that were to leave stay until the next
    /// change, or a retry(). `commands` as in Simulation::recordReset().
    bool recordChanges(VkCommandBuffer commands);
    /// Parts that a failed making has kept from leaving are a change again. release() does it too if it has
    /// something to destroy.
    void retry() noexcept;
    /// Whether recordChanges() would take over if no step were in flight: let these finish.
    bool isReady() const;
    /// Destroys, on a thread, the simulations that were replaced. Call when all commands that were recorded
    /// with them have finished: those of the take-over, and all that draw or read their buffers.
    void release();
    /// Whether changes have not arrived yet.
    bool isChanging() const noexcept;

    Simulation& simulation() noexcept { return *simulation_; }
    const Simulation& simulation() const noexcept { return *simulation_; }
    const Scene& scene() const noexcept { return scene_; } ///< that of simulation()
    const Settings& settings() const noexcept { return settings_; }

private:
    struct SINEW_LOCAL Making;
    struct Slot {
        std::uint32_t generation = 0;
        bool isWanted = false;
        std::uint32_t arrival = 0;              ///< Body::arrival of its bodies
        std::uint32_t substeps = 0, levels = 0; ///< that it needs, or the host asked for
        std::shared_ptr<const Scene> scene{};
    };
    /// A part in a scene: its slot and generation, and its place.
    struct Placed {
        PartId part{};
        PartRange range{};
    };
    SINEW_LOCAL const Slot* slotOf(PartId part) const noexcept;
    SINEW_LOCAL void begin();
    SINEW_LOCAL bool isMade() const;
    SINEW_LOCAL bool mayTakeOver() const noexcept;
    SINEW_LOCAL std::uint32_t contactRoomFor(std::size_t particles, std::size_t faces) const;
    SINEW_LOCAL void forget(Slot& slot) noexcept;
    SINEW_LOCAL void giveUp(const Making& making) noexcept;

    const vk::Device& device_;
    vk::KeptKernels kernels_; ///< those of the take-over, and of parts that return
    Settings asked_;          ///< by the host, with the rooms of the next simulation
    Settings settings_;       ///< of simulation_
    bool choosesSubsteps_, choosesLevels_;
    std::shared_ptr<const Scene> base_;
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> freeSlots_;
    std::uint32_t arrivals_ = 0;
    Rooms rooms_;
    std::uint32_t refusedRoom_ = 0xffffffffu; ///< Settings::contactRoom that could not be had
    bool hasChanged_ = false;                 ///< since the newest making began
    bool isLeaving_ = false;                  ///< parts that a failed making has kept
    Scene scene_;
    std::vector<Placed> placed_; ///< parts in scene_, in order
    std::unique_ptr<Simulation> simulation_;
    std::vector<std::unique_ptr<Making>> replaced_; ///< each with the simulation that it replaced
    std::future<void> destroying_;
    std::unique_ptr<Making> making_;
};

} // namespace sinew::sim
