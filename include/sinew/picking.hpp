// Rays and regions of the host: what they meet of the bodies of a simulation. Kernels find it; a few bytes
// come back with the frame, and nothing waits.
#pragma once

#include "sinew/export.hpp"
#include "sinew/simulation.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sinew::sim {

struct SINEW_API RayQuery {
    Vec3 origin{};            ///< [m]
    Vec3 direction{0, 0, -1}; ///< unit length
    float length = 3e38f;     ///< nothing beyond is met [m]
    bool meetsFixed = true;   ///< false: no particle that never moves is returned
};

/// The side of a plane that rays pass through, as in a section view. They meet the inside of closed skins at
/// the plane.
struct SINEW_API HiddenSide {
    Vec3 normal{0, 0, 1}; ///< unit length, towards the hidden side
    float offset = 0;     ///< distance of the plane from the origin along the normal [m]
};

struct SINEW_API RayHit {
    std::uint32_t particle = 0; ///< the nearest to the point of those that hold what is met there
    std::uint32_t body = 0;     ///< index in Scene::bodies; 0xffffffff = the particle belongs to none
    Vec3 point{};               ///< where the ray meets the body [m]
    Vec3 place{};               ///< of the particle [m]
    float distance = 0;         ///< from the origin to the point [m]
};

/// The parts of a scene besides its skins that rays meet.
struct SINEW_API RayTargets {
    std::vector<float> radii{};   ///< of the ball of each particle [m]; below 0 = none
    std::vector<bool> isClosed{}; ///< for each skin: whether it has an inside, for HiddenSide
};
/// Balls with the contact radius for particles of bodies without a skin; no skin is closed.
SINEW_API RayTargets rayTargets(const Scene& scene);

/// Casts rays at the skins and balls of a simulation, also at surfaces of cuts; removed fragments are not
/// met. Owns its buffers; must not outlive the Device, nor commands recorded with it. One thread.
class SINEW_API RayCaster {
public:
    /// For the scene of the simulations that watch() is given. At most `rays` rays a recording, and `slots`
    /// recordings in flight at a time; both at least 1. Throws vk::Error.
    RayCaster(const vk::Device& device, const Scene& scene, const RayTargets& targets, std::uint32_t rays,
              std::uint32_t slots);
    ~RayCaster();
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    /// Casts at this simulation from now on; it must live until the next call, and all recorded commands must
    /// have finished. Call it before record(), and after another simulation has taken over. Throws vk::Error.
    void watch(const Simulation& simulation);

    /// Records rays, of which those beyond the number given at construction are ignored. Balls are those of
    /// the newest recorded step, skins those of the newest Simulation::recordSkin(). The previous commands of
    /// `slot` must have finished. `commands` as in Simulation::recordReset(). Allocates nothing.
    void record(VkCommandBuffer commands, std::uint32_t slot, std::span<const std::optional<RayQuery>> rays,
                const std::optional<HiddenSide>& hidden = {}) const noexcept;
    /// The hit of a ray of that recording, once its commands have finished: also once a step that was
    /// recorded behind them has (Simulation::status). Empty if it met no body, or only fixed particles that
    /// were not asked for.
    std::optional<RayHit> hit(std::uint32_t slot, std::size_t ray) const noexcept;

private:
    struct SINEW_LOCAL State;
    std::unique_ptr<State> state_;
};

/// A box along the axes, grown by a radius: a sphere if the half extents are 0.
struct SINEW_API RegionQuery {
    Vec3 center{}, halfExtents{}; ///< [m]
    float radius = 0;             ///< [m]
    bool findsFixed = true;       ///< false: particles that never move do not count
};

/// Finds the particles whose positions lie in a region, without those of removed fragments. As RayCaster.
class SINEW_API RegionFinder {
public:
    /// `room`: particles that are returned at most. Throws vk::Error.
    RegionFinder(const vk::Device& device, const Scene& scene, std::uint32_t room, std::uint32_t slots);
    ~RegionFinder();
    RegionFinder(const RegionFinder&) = delete;
    RegionFinder& operator=(const RegionFinder&) = delete;

    void watch(const Simulation& simulation);
    /// Records the search at the positions of the newest recorded step.
    void record(VkCommandBuffer commands, std::uint32_t slot, const RegionQuery& region) const noexcept;
    struct Found {
        std::uint32_t count = 0; ///< of all particles in the region
        /// Their indices, ascending: all, or any `room` of them if there are more.
        std::vector<std::uint32_t> particles{};
    };
    /// Valid as RayCaster::hit(). Allocates its list.
    Found found(std::uint32_t slot) const;

private:
    struct SINEW_LOCAL State;
    std::unique_ptr<State> state_;
};

} // namespace sinew::sim
