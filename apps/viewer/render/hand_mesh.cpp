// Makes a tube and a ball as one list of triangles.
#include "viewer/render/hand_mesh.hpp"

#include "viewer/render/balls.hpp"
#include "viewer/render/layer.hpp"
#include "viewer/render/mesh_buffer.hpp"

#include <cmath>

namespace sinew::viewer {

namespace {

using Corner = std::array<float, 4>; // rope: across, across, along, 0; ball: corner, 1

struct Mesh {
    std::vector<Corner> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Mesh makeMesh(const HandMesh::Shape& shape) {
    const std::uint32_t sides = shape.sides;
    const BallMesh ball = makeBall(shape.cuts);
    Mesh mesh{ball.corners, ball.triangles};
    for (Corner& corner : mesh.corners) corner[3] = 1;
    const auto first = static_cast<std::uint32_t>(mesh.corners.size());
    for (std::uint32_t side = 0; side < sides; ++side) {
        const float angle = 6.2831853f * static_cast<float>(side) / static_cast<float>(sides);
        for (const float along : {0.0f, 1.0f})
            mesh.corners.push_back({std::cos(angle), std::sin(angle), along, 0});
        const std::uint32_t a = first + 2 * side, b = first + 2 * ((side + 1) % sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
    }
    return mesh;
}

} // namespace

Overlay overlayBeside(const Overlay& overlay) {
    Overlay other = overlay;
    for (std::size_t i = 0; i < layerTable().size(); ++i)
        if (layerTable()[i]->make && !layerTable()[i]->isOfScene) other.layers.looks[i] = 0;
    other.buffers = {.balls = overlay.buffers.balls};
    return other;
}

HandMesh::HandMesh(const vk::Device& device, const Shape& shape)
    : device_(device), vertices_(filledBuffer(device, "hand.vertices", makeMesh(shape).corners,
                                              VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)),
      indices_(
          filledBuffer(device, "hand.indices", makeMesh(shape).triangles, VK_BUFFER_USAGE_INDEX_BUFFER_BIT)),
      indexCount_(static_cast<std::uint32_t>(3 * indices_.count())) {}

void HandMesh::draw(VkCommandBuffer commands, const vk::BufferView& points, const vk::BufferView& removed,
                    std::uint32_t first) const noexcept {
    bind(commands, std::array{points, removed});
    device_.functions().vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, first);
}

void HandMesh::drawIndirect(VkCommandBuffer commands, const vk::BufferView& points,
                            const vk::BufferView& draw) const noexcept {
    bind(commands, std::array{points});
    device_.functions().vkCmdDrawIndexedIndirect(commands, draw.buffer, draw.offset, 1, draw.stride);
}

void HandMesh::bind(VkCommandBuffer commands, std::span<const vk::BufferView> ofInstances) const noexcept {
    const vk::BufferView vertices = vertices_.view(), indices = indices_.view();
    std::array buffers{vertices.buffer, vertices.buffer, vertices.buffer};
    std::array offsets{vertices.offset, vertices.offset, vertices.offset};
    for (std::size_t i = 0; i < ofInstances.size(); ++i) {
        buffers[i + 1] = ofInstances[i].buffer;
        offsets[i + 1] = ofInstances[i].offset;
    }
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindVertexBuffers(commands, 0, static_cast<std::uint32_t>(1 + ofInstances.size()),
                                     buffers.data(), offsets.data());
    functions.vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
}

} // namespace sinew::viewer
