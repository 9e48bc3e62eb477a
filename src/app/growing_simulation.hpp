// A simulation that gets more room where a step finds too little for its contacts or for the surface of its
// cuts: what a program does about Status::contactRoom, of which the step was undone by then and is to be done
// again, and about Status::cutSurfaceMissing. One of other settings, or on another device, goes on where it
// stands.
#pragma once

#include "sim/simulation.hpp"
#include "vk/queue.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace sinew::app {

/// What became of Settings::contactRoom.
struct ContactRoom {
    std::uint32_t room = 0;   ///< candidates of one, on average
    std::uint32_t needed = 0; ///< by a step that had less; 0 = none has
    std::uint32_t grown = 0;  ///< times
};

/// What became of Settings::cutSurfaceRoom.
struct SurfaceRoom {
    std::uint32_t needed = 0; ///< triangles and vertices; 0 = there was always enough
    std::uint32_t grown = 0;  ///< times
    bool isShort = false;     ///< there can be no such room: the surface of cuts is not drawn
};

/// Brings states that somebody keeps over to a simulation that is about to take over from another one, while
/// both are there and have finished: all that `to` holds is written over afterwards. Throws nothing.
using Bring = std::function<void(const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
                                 vk::Queue& taking)>;

class GrowingSimulation {
public:
    /// As sim::Simulation. `device` and `scene` must outlive it and stay where they are.
    GrowingSimulation(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings);

    /// Another one after grow(), with other buffers.
    sim::Simulation& simulation() noexcept { return *simulation_; }
    const sim::Simulation& simulation() const noexcept { return *simulation_; }
    /// Those of simulation(), with the room that it has.
    const sim::Settings& settings() const noexcept { return settings_; }
    const vk::Device& device() const noexcept { return device_; }
    /// Complaints of simulation(), without the warnings of its scene: those are said where it is loaded.
    std::vector<std::string> complaints();
    const ContactRoom& contactRoom() const noexcept { return room_; }

    /// What a simulation() has to be made with after a step whose Status::contactRoom is `needed`, or after
    /// steps of which Status::cutSurfaceMissing was `needed` at most: grow() and growSurface() in two, for
    /// who makes it in another thread. Nothing where there can be no such room.
    std::optional<sim::Settings> roomForContacts(std::uint32_t needed);
    std::optional<sim::Settings> roomForSurface(std::uint32_t needed);
    /// There is no memory for what roomForSurface() said: nothing is to be drawn beyond.
    void lackSurface() { surface_.isShort = true; }
    /// Goes on in `next`, which is of such settings and has taken over from simulation(): nothing that uses
    /// that is on its way any more.
    void goOnIn(std::unique_ptr<sim::Simulation> next, const sim::Settings& settings);

    /// After a step whose Status::contactRoom is `needed`: waits for `queue`, in which every step was
    /// submitted, and goes on in a simulation with that much room, rounded up, in the state before that step.
    /// False, and nothing has changed, where no simulation has as much. Throws vk::Error where the device has
    /// no memory for it.
    bool grow(std::uint32_t needed, vk::Queue& queue, const Bring& bring = {});

    /// After steps of which Status::cutSurfaceMissing was `needed` at most, all of them finished: whether
    /// there is to be more room, and was not less than that before.
    bool lacksSurface(std::uint32_t needed) const noexcept;
    /// Goes on after the newest step in a simulation with that much room and half as much again. False, and
    /// nothing has changed, where the device has no memory for it. Waits for `queue`.
    bool growSurface(std::uint32_t needed, vk::Queue& queue, const Bring& bring = {});
    const SurfaceRoom& surfaceRoom() const noexcept { return surface_; }

    /// Goes on after the newest step in a simulation of the scene as it is now and of `settings`, which may
    /// differ from settings() as Simulation::recordTakeOver allows. Waits for `queue`, in which all was
    /// submitted. Throws as sim::Simulation, and nothing has changed then.
    void replace(const sim::Settings& settings, vk::Queue& queue, const Bring& bring = {});
    /// The same in `next`, which was made of that scene and of `settings` on device().
    void replaceBy(std::unique_ptr<sim::Simulation> next, const sim::Settings& settings, vk::Queue& queue,
                   const Bring& bring = {});

    /// Goes on after the newest step in a simulation with at least those rooms of `roomy`, where there is
    /// less. As replace().
    void widen(const sim::Settings& roomy, vk::Queue& queue);

    /// Goes on where `from` stands, which is of the same scene, of whatever material, and of such settings,
    /// on this device or another one; with as much room as that has. By way of the host, whichever device it
    /// is. All steps of both have finished. Waits, on queues of its own. Throws as sim::Simulation and
    /// vk::Queue: it is then to be reset, and `from` is as it was.
    void takeOver(const GrowingSimulation& from, const Bring& bring = {});

private:
    void makeRoomOf(const GrowingSimulation& other);

    const vk::Device& device_;
    const sim::Scene& scene_;
    sim::Settings settings_;
    std::unique_ptr<sim::Simulation> simulation_;
    ContactRoom room_;
    SurfaceRoom surface_;
};

/// `settings` with at least the rooms of `other`.
sim::Settings withRoomOf(sim::Settings settings, const sim::Settings& other);

/// Why a simulation that cannot grow() stops at `step`, and what to do about it.
std::string tooCrowded(std::uint64_t step);

} // namespace sinew::app
