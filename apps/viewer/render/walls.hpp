// The walls of a scene: its boundary planes other than level ones, as the sides and the edges of an open box.
#pragma once

#include "viewer/render/collider_meshes.hpp"
#include "viewer/render/geometry.hpp"

namespace sinew::viewer {

struct WallMesh {
    ColliderMesh bars;  ///< closed, along the edges
    ColliderMesh sides; ///< flat, counter-clockwise seen from the free side
    bool isEmpty() const { return sides.indices.empty(); }
};

/// Planes have no ends: each is drawn as far as the other planes and twice the width of `region` reach, and
/// as high as bodies will stand in the box at rest, or a fifth of its width, but not above their start.
WallMesh wallsOf(const sim::Scene& scene, const Box& region);

/// Its buffers; an empty mesh has none. Must not outlive its Device.
class Walls {
public:
    Walls(const vk::Device& device, const WallMesh& mesh);

    struct Part {
        std::uint32_t firstIndex = 0, indexCount = 0;
        std::int32_t firstVertex = 0;
    };
    bool isEmpty() const noexcept { return sides_.indexCount == 0; }
    const Part& bars() const noexcept { return bars_; }
    const Part& sides() const noexcept { return sides_; }
    vk::BufferView vertices() const noexcept { return vertices_->view(); }
    vk::BufferView indices() const noexcept { return indices_->view(); }

private:
    Part bars_, sides_;
    std::optional<vk::Buffer> vertices_, indices_;
};

} // namespace sinew::viewer
