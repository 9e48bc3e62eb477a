// What shows a hand that holds: a ball where it is, and a rope from there to what it holds.
#pragma once

#include "viewer/draw/geometry.hpp"
#include "viewer/draw/layers.hpp"
#include "vk/buffer.hpp"

#include <span>

namespace sinew::viewer {

struct Hand {
    std::uint32_t particle = 0;       ///< that it holds
    Vector3 offset = Vector3::Zero(); ///< of the held point from the particle [m]
    Vector3 target = Vector3::Zero(); ///< where the hand is [m]
};

/// What is shown beside the bodies as they are: by tools, and layers.
struct Overlay {
    std::optional<Hand> hand;
    std::span<const Hand> pins = {};
    std::span<const Vector3> stroke = {}; ///< path of a blade, near the eye [m]; at most mostStrokePoints
    std::span<const Vector3> gauge = {};  ///< of its depth, likewise: two points or none
    Layers layers = {};
    LayerBuffers buffers = {}; ///< of what `layers` needs
};

/// The same for a second simulation, of whose state layers know nothing: those that need none.
Overlay overlayBeside(const Overlay& overlay);

constexpr std::size_t mostStrokePoints = 256;

/// Vertices for hand.vert or mark.vert and indices. Must not outlive its Device, which must not move.
class HandMesh {
public:
    /// A rope of so many sides and a ball as makeBall().
    struct Shape {
        std::uint32_t sides = 12, cuts = 2;
    };
    explicit HandMesh(const vk::Device& device) : HandMesh(device, Shape{}) {}
    HandMesh(const vk::Device& device, const Shape& shape);

    /// A rope from element `first` of `points` (vec4: the public positions, or a stroke) and a ball, as the
    /// push constants of the caller say; the pipeline must be bound. No rope where `removed` says so of the
    /// element.
    void draw(VkCommandBuffer commands, const vk::BufferView& points, const vk::BufferView& removed,
              std::uint32_t first) const noexcept;
    /// One for each of `points`, as the device says (VkDrawIndexedIndirectCommand, of indexCount() indices).
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
