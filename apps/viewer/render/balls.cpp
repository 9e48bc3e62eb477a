// Uses fewer triangles per ball if there are many balls, which are then small in the picture.
#include "viewer/render/balls.hpp"

#include "mesh/triangle_tree.hpp"
#include "mesh/vector3.hpp"
#include "sinew/inverse_masses.hpp"
#include "viewer/frame.h"
#include "viewer/render/geometry.hpp"
#include "viewer/render/mesh_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace sinew::viewer {

namespace {

// Colour of each particle's skin, if it has one.
using Color = std::optional<sim::Vec3>;
std::vector<Color> skinColors(const sim::Scene& scene) {
    std::vector<Color> colors(scene.particles.size());
    for (const sim::Skin& skin : scene.skins) {
        for (const std::uint32_t particle : skin.particles) colors[particle] = skin.color;
        for (const sim::CellEmbedding& cell : skin.cells)
            for (const std::uint32_t particle : cell.particles) colors[particle] = skin.color;
    }
    return colors;
}

// Skin colour of one of the body's particles, if there is one.
Color skinColor(const sim::Body& body, const std::vector<Color>& colors) {
    const auto first = colors.begin() + body.firstParticle, end = first + body.particleCount;
    const auto found = std::find_if(first, end, [](const Color& color) { return color.has_value(); });
    return found == end ? std::nullopt : *found;
}

// Length of each particle's shortest link [m]; `none` without links.
constexpr float none = std::numeric_limits<float>::max();
std::vector<float> shortestLinks(const sim::Scene& scene) {
    std::vector<float> shortest(scene.particles.size(), none);
    for (const sim::DistanceConstraint& link : scene.distances) {
        if (!(link.restLength > 0)) continue;
        for (const std::uint32_t end : {link.a, link.b})
            shortest[end] = std::min(shortest[end], link.restLength);
    }
    return shortest;
}

// Radius of a body's particles without contacts: `share` of the shortest link, or `speck` without links.
// Never below `least`.
struct Quiet {
    float share, speck, least;
};
float quietRadius(const sim::Body& body, const std::vector<float>& shortest, const Quiet& quiet) {
    const auto first = shortest.begin() + body.firstParticle;
    const float length =
        body.particleCount == 0 ? none : *std::min_element(first, first + body.particleCount);
    return length < none ? std::max(quiet.share * length, quiet.least) : quiet.speck;
}

enum class Which { bare, all };

BallList listBalls(const sim::Scene& scene, Which which) {
    BallList list;
    const std::vector<Color> colors = skinColors(scene);
    const std::vector<float> shortest = shortestLinks(scene);
    const float size = particleBounds(scene).diagonal().norm(), speck = 0.004f * size;
    const Quiet bare{.share = 0.4f, .speck = speck, .least = 0.012f * size}, covered{0.2f, speck, 0};
    list.radii.resize(scene.particles.size());
    for (const sim::Body& body : scene.bodies) {
        const Color skin = skinColor(body, colors);
        if (skin && which == Which::bare) continue;
        list.ranges.push_back({body.firstParticle, body.particleCount, skin.value_or(body.color)});
        const float quiet = quietRadius(body, shortest, skin ? covered : bare);
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
            list.radii[i] = scene.particles[i].radius > 0 ? scene.particles[i].radius : quiet;
    }
    if (list.ranges.empty()) list.radii.clear();
    return list;
}

std::uint32_t cutsFor(std::size_t balls) {
    return balls <= 3'000 ? 2 : balls <= 40'000 ? 1 : 0;
}

std::size_t countOf(const BallList& list) {
    std::size_t balls = 0;
    for (const BallRange& range : list.ranges) balls += range.count;
    return balls;
}

BallMesh icosahedron() {
    const float a = 0.52573111f, b = 0.85065081f; // icosahedron: 1 and the golden ratio, normalised
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

// Adds a face for every three corners that are mutual neighbours, facing outwards.
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

// What a body hangs on: the particles of it that never move, if others do.
std::vector<std::uint32_t> fixedInMovingBodies(const sim::Scene& scene) {
    const std::vector<float> inverseMasses = sim::inverseMasses(scene);
    std::vector<std::uint32_t> all;
    for (const sim::Body& body : scene.bodies) {
        std::vector<std::uint32_t> fixed;
        for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i)
            if (inverseMasses[i] == 0) fixed.push_back(i);
        if (fixed.size() < body.particleCount) all.insert(all.end(), fixed.begin(), fixed.end());
    }
    return all;
}

mesh::Vector3 restPlace(const sim::Scene& scene, const sim::CellEmbedding& cell) {
    mesh::Vector3 place = mesh::Vector3::Zero();
    for (std::size_t k = 0; k < cell.particles.size(); ++k)
        place += double{cell.share(k)} * mesh::toVector(scene.particles[cell.particles[k]].position);
    return place;
}

// The grid of a mesh body reaches up to a cell beyond its skin. Balls there would hover, unless they dip into
// it.
void removeBallsBesideSkins(const sim::Scene& scene, std::vector<float>& radii) {
    for (const sim::Skin& skin : scene.skins) {
        if (skin.cells.empty()) continue;
        const std::uint32_t first = skin.cells[0].particles[0];
        const auto body = std::ranges::find_if(scene.bodies, [&](const sim::Body& each) {
            return first >= each.firstParticle && first - each.firstParticle < each.particleCount;
        });
        if (body == scene.bodies.end()) continue;
        const auto begin = radii.begin() + body->firstParticle, end = begin + body->particleCount;
        if (std::all_of(begin, end, [](float radius) { return radius == 0; })) continue;
        std::vector<mesh::Vector3> places;
        for (const sim::CellEmbedding& cell : skin.cells) places.push_back(restPlace(scene, cell));
        const mesh::TriangleTree surface(places,
                                         skin.wholeTriangles.empty() ? skin.triangles : skin.wholeTriangles);
        for (auto radius = begin; radius < end; ++radius) {
            if (*radius == 0) continue;
            const mesh::Vector3 place = mesh::toVector(scene.particles[radius - radii.begin()].position);
            if (std::abs(surface.windingNumber(place)) < 0.5 && surface.distance(place) > 0.5f * *radius)
                *radius = 0;
        }
    }
}

} // namespace

BallList ballsOf(const sim::Scene& scene) {
    return listBalls(scene, Which::bare);
}

BallList allBallsOf(const sim::Scene& scene) {
    return listBalls(scene, Which::all);
}

BallList insidesOf(const sim::Scene& scene) {
    BallList list;
    const std::vector<Color> colors = skinColors(scene);
    std::vector<float> sums(scene.particles.size()), counts(scene.particles.size());
    for (const sim::DistanceConstraint& link : scene.distances)
        for (const std::uint32_t end : {link.a, link.b}) {
            sums[end] += link.restLength;
            counts[end] += 1;
        }
    for (const sim::Body& body : scene.bodies)
        if (skinColor(body, colors)) list.ranges.push_back({body.firstParticle, body.particleCount, {}});
    if (list.ranges.empty()) return list;
    for (std::size_t i = 0; i < sums.size(); ++i)
        list.radii.push_back(counts[i] > 0 ? sums[i] / (ICOSAHEDRON_INNER * counts[i]) : 0);
    return list;
}

BallList marksOf(const sim::Scene& scene, std::span<const sim::NamedHold> holds, float radius) {
    constexpr std::uint32_t longestGap = 8;
    std::vector<std::uint32_t> marked = fixedInMovingBodies(scene);
    for (const sim::NamedHold& hold : holds)
        marked.insert(marked.end(), hold.particles.begin(), hold.particles.end());
    if (marked.empty()) return {};
    BallList list{.ranges = {}, .radii = std::vector<float>(scene.particles.size())};
    for (const std::uint32_t i : marked) list.radii[i] = radius;
    for (const sim::DistanceConstraint& link : scene.distances) {
        if (!(link.restLength > 0) || list.radii[link.a] == 0 || list.radii[link.b] == 0) continue;
        for (const std::uint32_t end : {link.a, link.b})
            list.radii[end] = std::min(list.radii[end], 0.35f * link.restLength);
    }
    removeBallsBesideSkins(scene, list.radii);
    for (std::uint32_t i = 0; i < list.radii.size(); ++i) {
        if (list.radii[i] == 0) continue;
        if (list.ranges.empty() || i - list.ranges.back().first >= list.ranges.back().count + longestGap)
            list.ranges.push_back({i, 0, {}});
        list.ranges.back().count = i + 1 - list.ranges.back().first;
    }
    return list;
}

BallMesh makeBall(std::uint32_t cuts) {
    BallMesh ball = icosahedron();
    addFaces(ball);
    for (std::uint32_t i = 0; i < cuts; ++i) cut(ball);
    return ball;
}

Balls::Balls(const vk::Device& device, const BallList& list) : Balls(device, list, cutsFor(countOf(list))) {}

Balls::Balls(const vk::Device& device, const BallList& list, std::uint32_t cuts)
    : device_(device), ranges_(list.ranges) {
    if (ranges_.empty()) return;
    const BallMesh ball = makeBall(cuts);
    buffers_.push_back(
        filledBuffer(device, "balls.corners", ball.corners, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
    buffers_.push_back(filledBuffer(device, "balls.radii", list.radii, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
    buffers_.push_back(
        filledBuffer(device, "balls.triangles", ball.triangles, VK_BUFFER_USAGE_INDEX_BUFFER_BIT));
    indexCount_ = static_cast<std::uint32_t>(3 * ball.triangles.size());
}

void Balls::bind(VkCommandBuffer commands, const vk::BufferView& positions, const vk::BufferView& removed,
                 const vk::BufferView& values) const noexcept {
    const vk::BufferView corners = buffers_[0].view(), radii = buffers_[1].view(),
                         indices = buffers_[2].view();
    const std::array buffers{corners.buffer, positions.buffer, removed.buffer, radii.buffer, values.buffer};
    const std::array offsets{corners.offset, positions.offset, removed.offset, radii.offset, values.offset};
    const std::uint32_t count = values.size > 0 ? 5 : 4;
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindVertexBuffers(commands, 0, count, buffers.data(), offsets.data());
    functions.vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
}

void Balls::draw(VkCommandBuffer commands, const BallRange& range) const noexcept {
    device_.functions().vkCmdDrawIndexed(commands, indexCount_, range.count, 0, 0, range.first);
}

} // namespace sinew::viewer
