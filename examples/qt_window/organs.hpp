// Organs in a world that changes while it runs: what the window and its pointer do to them.
#pragma once

#include "sinew/picking.hpp"
#include "sinew/world.hpp"

#include <array>
#include <deque>
#include <memory>
#include <optional>

struct Ray {
    sinew::sim::Vec3 from{}, direction{}; ///< [m]; unit length
};

class Organs {
public:
    static constexpr std::uint32_t mostFramesInFlight = 3; // QVulkanWindow::MAX_CONCURRENT_FRAME_COUNT

    explicit Organs(const sinew::vk::HostDevice& engine);

    /// An organ drops onto the table at `x`, `z` [m]. It arrives within some frames.
    void spawn(float x, float z);
    void removeOldest();
    /// Pulls what the ray meets, until release().
    void grab(const Ray& ray);
    /// Moves the grabbed point into the ray, at its distance.
    void pull(const Ray& ray);
    void release();
    /// Cuts what lies between the two rays; a stroke goes on with the next call.
    void cut(const Ray& from, const Ray& to);
    void endStroke() { isStroke_ = false; }

    /// Records a step and the skins. `slot`: of the frame in flight, whose former commands have finished.
    void record(VkCommandBuffer commands, std::uint32_t slot);
    const sinew::sim::Simulation& simulation() const { return world_.simulation(); }
    bool isChanging() const { return world_.isChanging(); } ///< organs have not arrived, or not left
    std::size_t count() const { return parts_.size(); }
    std::uint32_t pieces() const { return pieces_; } ///< of all organs, single particles included

private:
    void readPick(std::uint32_t slot);

    sinew::vk::Device device_;
    sinew::sim::World world_;
    std::deque<sinew::sim::PartId> parts_;
    std::uint64_t frame_ = 0, changedAt_ = 0;
    bool hasReplaced_ = false; ///< simulations that frames in flight may still read
    std::uint32_t pieces_ = 0;

    struct Caster {
        explicit Caster(const sinew::vk::Device& device, const sinew::sim::World& world)
            : rays(device, world.scene(), sinew::sim::rayTargets(world.scene()), 1, mostFramesInFlight) {
            rays.watch(world.simulation());
        }
        sinew::sim::RayCaster rays;
    };
    std::unique_ptr<Caster> caster_, replaced_;
    std::optional<Ray> asked_;                       ///< for the next recording
    std::array<bool, mostFramesInFlight> isAsked_{}; ///< by slot
    bool isGrabbing_ = false;
    std::optional<sinew::sim::Grab> grab_;
    std::optional<Ray> pointer_;
    float distance_ = 0; ///< of the held point from the eye [m]

    std::array<sinew::sim::Vec3, 2> bladeFrom_{}, bladeTo_{};
    bool hasBlade_ = false, isStroke_ = false, isCarried_ = false;
};
