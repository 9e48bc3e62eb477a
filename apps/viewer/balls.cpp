// Fewer triangles a ball where there are many, which are small in a picture then.
#include "viewer/balls.hpp"

#include "viewer/geometry.hpp"
#include "viewer/mesh_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace sinew::viewer {

namespace {

std::vector<bool> skinnedParticles(const sim::Scene& scene) {
    std::vector<bool> isSkinned(scene.particles.size());
    for (const sim::Skin& skin : scene.skins) {
        for (const std::uint32_t particle : skin.particles) isSkinned[particle] = true;
        for (const sim::CellEmbedding& cell : skin.cells)
            for (const std::uint32_t particle : cell.particles) isSkinned[particle] = true;
    }
    return isSkinned;
}

// Of particles that touch nothing: of linked ones 0.4 of the shortest link, of others a speck.
float quietRadius(const sim::Scene& scene, const sim::Body& body) {
    float shortest = std::numeric_limits<float>::max();
    for (const sim::DistanceConstraint& link : scene.distances)
        if (link.a - body.firstParticle < body.particleCount && link.restLength > 0)
            shortest = std::min(shortest, link.restLength);
    const bool isLinked = shortest < std::numeric_limits<float>::max();
    return isLinked ? 0.4f * shortest : 0.004f * particleBounds(scene).diagonal().norm();
}

std::uint32_t cutsFor(std::size_t balls) {
    return balls <= 3'000 ? 2 : balls <= 40'000 ? 1 : 0;
}

BallMesh icosahedron() {
    const float a = 0.52573111f, b = 0.85065081f; // 1 and the golden ratio, on the unit ball
    BallMesh ball;
    for (int axis = 0; axis < 3; ++axis)
        for (const float first : {-a, a})
            for (const float second : {-b, b}) {
                std::array<float, 4> corner{0, 0, 0, 1};
                corner[static_cast<std::size_t>(axis)] = first;
                corner[static_cast<std::size_t>((axis + 1) % 3)] = second;
                ball.corners.push_back(corner);
            }
    return ball;
}

Vector3 cornerOf(const BallMesh& ball, std::uint32_t i) {
    return Vector3(ball.corners[i][0], ball.corners[i][1], ball.corners[i][2]);
}

// Every three corners an edge apart, turned outwards.
void addFaces(BallMesh& ball) {
    const auto count = static_cast<std::uint32_t>(ball.corners.size());
    const auto areNear = [&](std::uint32_t i, std::uint32_t j) {
        return (cornerOf(ball, i) - cornerOf(ball, j)).norm() < 1.2f;
    };
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = i + 1; j < count; ++j)
            for (std::uint32_t k = j + 1; k < count; ++k) {
                if (!areNear(i, j) || !areNear(j, k) || !areNear(k, i)) continue;
                const Vector3 p = cornerOf(ball, i), q = cornerOf(ball, j), r = cornerOf(ball, k);
                const bool isOutward = (q - p).cross(r - p).dot(p) > 0;
                ball.triangles.push_back(isOutward ? std::array{i, j, k} : std::array{i, k, j});
            }
}

void cut(BallMesh& ball) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
        const auto [found, isNew] = middles.try_emplace({std::min(i, j), std::max(i, j)},
                                                        static_cast<std::uint32_t>(ball.corners.size()));
        if (isNew) {
            const Vector3 between = (cornerOf(ball, i) + cornerOf(ball, j)).normalized();
            ball.corners.push_back({between.x(), between.y(), between.z(), 1});
        }
        return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> quarters;
    for (const auto& [i, j, k] : ball.triangles) {
        const std::uint32_t ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
        for (const auto& quarter :
             {std::array{i, ij, ki}, std::array{j, jk, ij}, std::array{k, ki, jk}, std::array{ij, jk, ki}})
            quarters.push_back(quarter);
    }
    ball.triangles = std::move(quarters);
}

} // namespace

BallList ballsOf(const sim::Scene& scene) {
    BallList list;
    const std::vector<bool> isSkinned = skinnedParticles(scene);
    for (const sim::Body& body : scene.bodies) {
        const auto first = isSkinned.begin() + body.firstParticle;
        if (std::any_of(first, first + body.particleCount, [](bool is) { return is; })) continue;
        list.ranges.push_back({body.firstParticle, body.particleCount, body.color});
    }
    if (list.ranges.empty()) return list;
    list.radii.resize(scene.particles.size());
    for (const sim::Body& body : scene.bodies) {
        if (isSkinned[body.firstParticle]) continue;
        const float quiet = quietRadius(scene, body);
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
            list.radii[i] = scene.particles[i].radius > 0 ? scene.particles[i].radius : quiet;
    }
    return list;
}

BallMesh makeBall(std::uint32_t cuts) {
    BallMesh ball = icosahedron();
    addFaces(ball);
    for (std::uint32_t i = 0; i < cuts; ++i) cut(ball);
    return ball;
}

Balls::Balls(const vk::Device& device, const BallList& list) : device_(device), ranges_(list.ranges) {
    if (ranges_.empty()) return;
    std::size_t balls = 0;
    for (const BallRange& range : ranges_) balls += range.count;
    const BallMesh ball = makeBall(cutsFor(balls));
    buffers_.push_back(
        filledBuffer(device, "balls.corners", ball.corners, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
    buffers_.push_back(filledBuffer(device, "balls.radii", list.radii, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
    buffers_.push_back(
        filledBuffer(device, "balls.triangles", ball.triangles, VK_BUFFER_USAGE_INDEX_BUFFER_BIT));
    indexCount_ = static_cast<std::uint32_t>(3 * ball.triangles.size());
}

void Balls::bind(VkCommandBuffer commands, const vk::BufferView& positions) const noexcept {
    const vk::BufferView corners = buffers_[0].view(), radii = buffers_[1].view(),
                         indices = buffers_[2].view();
    const std::array buffers{corners.buffer, positions.buffer, radii.buffer};
    const std::array offsets{corners.offset, positions.offset, radii.offset};
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindVertexBuffers(commands, 0, buffers.size(), buffers.data(), offsets.data());
    functions.vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
}

void Balls::draw(VkCommandBuffer commands, const BallRange& range) const noexcept {
    device_.functions().vkCmdDrawIndexed(commands, indexCount_, range.count, 0, 0, range.first);
}

} // namespace sinew::viewer
