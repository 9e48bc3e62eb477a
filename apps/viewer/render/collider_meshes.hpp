// Triangle meshes of the colliders of a scene, which have no skin: made once, moved by a pose when drawn.
#pragma once

#include "common/layout.h"
#include "sinew/scene.hpp"
#include "sinew/vk/buffer.hpp"

#include <optional>
#include <vector>

namespace sinew::viewer {

struct ColliderMesh {
    std::vector<sim::layout::SkinVertex> vertices; ///< in the collider's own frame
    std::vector<std::uint32_t> indices;            ///< counter-clockwise seen from outside
};

/// The mesh of a sphere, capsule or box without its margin.
ColliderMesh meshOf(const sim::Collider& collider);

/// Must not outlive its Device.
class ColliderMeshes {
public:
    ColliderMeshes(const vk::Device& device, const std::vector<sim::Collider>& colliders);

    struct Range {
        sim::Vec3 color;
        std::uint32_t firstIndex = 0, indexCount = 0;
        std::int32_t firstVertex = 0;
    };
    /// One for each collider; empty if there are none, and there are no buffers then.
    const std::vector<Range>& ranges() const noexcept { return ranges_; }
    vk::BufferView vertices() const noexcept { return vertices_->view(); }
    vk::BufferView indices() const noexcept { return indices_->view(); }

private:
    std::vector<Range> ranges_;
    std::optional<vk::Buffer> vertices_, indices_;
};

} // namespace sinew::viewer
