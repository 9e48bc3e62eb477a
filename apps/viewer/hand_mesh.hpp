// What shows a hand that holds: a ball where it is, and a rope from there to what it holds.
#pragma once

#include "viewer/geometry.hpp"
#include "vk/buffer.hpp"

namespace sinew::viewer {

struct Hand {
    std::uint32_t particle = 0;       ///< that it holds
    Vector3 offset = Vector3::Zero(); ///< of the held point from the particle [m]
    Vector3 target = Vector3::Zero(); ///< where the hand is [m]
};

/// Vertices for hand.vert and indices, for one hand. Must not outlive its Device, which must not move.
class HandMesh {
public:
    explicit HandMesh(const vk::Device& device);

    /// With vertices (binding 0) and the public `positions` of the simulation (binding 1) and the pipeline
    /// bound by the caller's push constants.
    void draw(VkCommandBuffer commands, const vk::BufferView& positions,
              std::uint32_t particle) const noexcept;

private:
    const vk::Device& device_;
    vk::Buffer vertices_, indices_;
    std::uint32_t indexCount_;
};

} // namespace sinew::viewer
