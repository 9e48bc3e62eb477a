// What shows a hand that holds: a ball where it is, and a rope from there to what it holds.
#pragma once

#include "viewer/geometry.hpp"

#include "vk/buffer.hpp"
#include <span>

namespace sinew::viewer {

struct Hand {
    std::uint32_t particle = 0;       ///< that it holds
    Vector3 offset = Vector3::Zero(); ///< of the held point from the particle [m]
    Vector3 target = Vector3::Zero(); ///< where the hand is [m]
};

/// What tools show over the bodies.
struct Overlay {
    std::optional<Hand> hand;
    std::span<const Vector3> stroke; ///< path of a blade, near the eye [m]; at most mostStrokePoints
};

constexpr std::size_t mostStrokePoints = 256;

/// Vertices for hand.vert and indices, for one hand. Must not outlive its Device, which must not move.
class HandMesh {
public:
    explicit HandMesh(const vk::Device& device);

    /// A rope from element `first` of `points` (vec4: the public positions, or a stroke) and a ball, as the
    /// push constants of the caller say; the pipeline must be bound.
    void draw(VkCommandBuffer commands, const vk::BufferView& points, std::uint32_t first) const noexcept;

private:
    const vk::Device& device_;
    vk::Buffer vertices_, indices_;
    std::uint32_t indexCount_;
};

} // namespace sinew::viewer
