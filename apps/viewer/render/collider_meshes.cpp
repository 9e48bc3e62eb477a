// Every shape is a box grown by a radius: an eighth of a sphere at each corner, strips along the edges and
// rectangles between them; degenerate parts are omitted.
#include "viewer/render/collider_meshes.hpp"

#include "viewer/render/geometry.hpp"
#include "viewer/render/mesh_buffer.hpp"

#include <array>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t parts = 16; // of a quarter of a circle

Vector3 toVector(const sim::layout::vec4& v) {
    return {v.x, v.y, v.z};
}

class Builder {
public:
    Builder(const Vector3& core, float radius) : core_(core), radius_(radius) {}

    ColliderMesh build() {
        for (std::uint32_t corner = 0; corner < 8; ++corner)
            if (radius_ > 0) addEighth(corner);
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            if (core_[axis] > 0 && radius_ > 0) addStrips(axis);
            if (core_[(axis + 1) % 3] > 0 && core_[(axis + 2) % 3] > 0) addSides(axis);
        }
        return std::move(mesh_);
    }

private:
    static Vector3 signsOf(std::uint32_t corner) {
        const auto sign = [&](std::uint32_t bit) { return (corner >> bit & 1) != 0 ? -1.0f : 1.0f; };
        return {sign(0), sign(1), sign(2)};
    }

    std::uint32_t add(std::uint32_t corner, const Vector3& direction) {
        const Vector3 signs = signsOf(corner), n = direction.normalized().cwiseProduct(signs),
                      x = core_.cwiseProduct(signs) + radius_ * n;
        mesh_.vertices.push_back({{x.x(), x.y(), x.z(), 1}, {n.x(), n.y(), n.z(), 0}});
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& v = mesh_.vertices;
        const Vector3 x = toVector(v[a].position);
        const Vector3 n = (toVector(v[b].position) - x).cross(toVector(v[c].position) - x);
        const Vector3 outward = toVector(v[a].normal) + toVector(v[b].normal) + toVector(v[c].normal);
        if (n.dot(outward) < 0) std::swap(b, c);
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    void addEighth(std::uint32_t corner) {
        std::vector<std::uint32_t> last, row;
        for (std::uint32_t j = 0; j <= parts; ++j, last = std::exchange(row, {})) {
            for (std::uint32_t i = 0; i + j <= parts; ++i)
                row.push_back(add(corner, Vector3(float(i), float(j), float(parts - i - j))));
            for (std::size_t i = 0; j > 0 && i < row.size(); ++i) {
                addTriangle(last[i], last[i + 1], row[i]);
                if (i + 1 < row.size()) addTriangle(last[i + 1], row[i + 1], row[i]);
            }
        }
    }

    // Adds the four rounded edges along an axis.
    void addStrips(std::uint32_t axis) {
        const std::uint32_t u = (axis + 1) % 3, v = (axis + 2) % 3, far = 1u << axis;
        for (const std::uint32_t corner : {0u, 1u << u, 1u << v, 1u << u | 1u << v}) {
            std::array<std::uint32_t, 2> last{};
            for (std::uint32_t i = 0; i <= parts; ++i) {
                Vector3 direction = Vector3::Zero();
                direction[u] = float(i);
                direction[v] = float(parts - i);
                const std::array pair{add(corner, direction), add(corner | far, direction)};
                if (i > 0) {
                    addTriangle(last[0], last[1], pair[0]);
                    addTriangle(last[1], pair[1], pair[0]);
                }
                last = pair;
            }
        }
    }

    // Adds the two flat sides across an axis.
    void addSides(std::uint32_t axis) {
        const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
        const auto direction = Vector3(Vector3::Unit(axis));
        for (const std::uint32_t side : {0u, 1u << axis}) {
            const std::array corners{add(side, direction), add(side | u, direction), add(side | v, direction),
                                     add(side | u | v, direction)};
            addTriangle(corners[0], corners[1], corners[2]);
            addTriangle(corners[1], corners[3], corners[2]);
        }
    }

    Vector3 core_;
    float radius_;
    ColliderMesh mesh_;
};

} // namespace

ColliderMesh meshOf(const sim::Collider& collider) {
    const sim::Vec3& e = collider.halfExtents;
    switch (collider.shape) {
    case sim::ColliderShape::sphere:
        return Builder(Vector3::Zero(), collider.radius).build();
    case sim::ColliderShape::capsule:
        return Builder(Vector3(0, collider.halfLength, 0), collider.radius).build();
    case sim::ColliderShape::box:
        return Builder(Vector3(e.x, e.y, e.z), 0).build();
    }
    return {};
}

ColliderMeshes::ColliderMeshes(const vk::Device& device, const std::vector<sim::Collider>& colliders) {
    ColliderMesh all;
    for (const sim::Collider& collider : colliders) {
        const ColliderMesh mesh = meshOf(collider);
        ranges_.push_back({collider.color, static_cast<std::uint32_t>(all.indices.size()),
                           static_cast<std::uint32_t>(mesh.indices.size()),
                           static_cast<std::int32_t>(all.vertices.size())});
        all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        all.indices.insert(all.indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    if (colliders.empty()) return;
    vertices_ = filledBuffer(device, "colliders.vertices", all.vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices_ = filledBuffer(device, "colliders.indices", all.indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
}

} // namespace sinew::viewer
