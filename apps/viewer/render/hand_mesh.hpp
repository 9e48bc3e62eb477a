// The mesh that shows a grab: a ball at the hand, and a rope from there to the held point.
#pragma once

#include "sinew/vk/buffer.hpp"
#include "viewer/render/geometry.hpp"
#include "viewer/render/layers.hpp"

#include <span>

namespace sinew::viewer {

struct Hand {
    std::uint32_t particle = 0;       ///< held particle
    Vector3 offset = Vector3::Zero(); ///< from the particle to the held point [m]
    Vector3 target = Vector3::Zero(); ///< position of the hand [m]
};

/// Everything drawn in addition to the plain bodies, by tools and layers.
struct Overlay {
    std::optional<Hand> hand;
    std::span<const Hand> pins = {};
    std::span<const Vector3> stroke = {}; ///< path of a blade, near the eye [m]; at most mostStrokePoints
    std::span<const Vector3> gauge = {};  ///< shows the blade's depth, near the eye [m]: 2 points or none
    Layers layers = {};
    LayerBuffers buffers = {}; ///< buffers for `layers`
};

/// The overlay of a second simulation: only the layers that need no buffers.
Overlay overlayBeside(const Overlay& overlay);

constexpr std::size_t mostStrokePoints = 256;

/// Vertices for hand.vert or mark.vert, and indices. Must not outlive its Device, which must not move.
class HandMesh {
public:
    /// Number of sides of the rope; the ball is makeBall(cuts).
    struct Shape {
        std::uint32_t sides = 12, cuts = 2;
    };
    explicit HandMesh(const vk::Device& device) : HandMesh(device, Shape{}) {}
    HandMesh(const vk::Device& device, const Shape& shape);

    /// Draws a rope from element `first` of `points` (vec4: the public positions, or a stroke) and a ball,
    /// with the push constants of the caller; the pipeline must be bound. Draws no rope if `removed` marks
    /// the element.
    void draw(VkCommandBuffer commands, const vk::BufferView& points, const vk::BufferView& removed,
              std::uint32_t first) const noexcept;
    /// Draws one for each of `points`; the count comes from the device (VkDrawIndexedIndirectCommand with
    /// indexCount() indices).
    void drawIndirect(VkCommandBuffer commands, const vk::BufferView& points,
                      const vk::BufferView& draw) const noexcept;
    std::uint32_t indexCount() const noexcept { return indexCount_; }

private:
    void bind(VkCommandBuffer commands, std::span<const vk::BufferView> ofInstances) const noexcept;

    const vk::Device& device_;
    vk::Buffer vertices_, indices_;
    std::uint32_t indexCount_;
};

} // namespace sinew::viewer
