// Looks triangles up in the order of drawing.
#include "sim/surface/mixed_skins.hpp"

#include "mesh/to_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

namespace sinew::test {

using namespace sim;
using Eigen::Vector3d;

void addBody(Scene& scene, const mesh::TriangleMesh& mesh) {
    mesh::MeshBody body{.name = "body", .youngModulus = 1e5f, .isCuttable = true};
    body.voxels.resolution = 14;
    mesh::addMesh(scene, mesh, body);
}

void addOrgan(Scene& scene) {
    addBody(scene, mesh::generate("organ", 49));
}

Scene organScene() {
    Scene scene{.name = "organ", .gravity = {0, 0, 0}};
    addOrgan(scene);
    return scene;
}

bool isThere(const Triangle& triangle) {
    return triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
}

std::vector<Triangle> download(const vk::BufferView& indices) {
    return queue().download<Triangle>(indices);
}

std::vector<std::vector<Triangle>> drawnOf(const Simulation& simulation) {
    const Simulation::DrawnSkins drawn = simulation.drawnSkins(Overlap::some);
    EXPECT_FALSE(drawn.areWhole);
    const std::vector<Triangle> all = download(drawn.indices);
    const auto draws = queue().download<layout::DrawArguments>(drawn.draws);
    EXPECT_EQ(draws.size(), drawn.ranges.size());
    std::vector<std::vector<Triangle>> result;
    for (std::size_t s = 0; s < draws.size(); ++s) {
        EXPECT_EQ(draws[s].firstIndex, drawn.ranges[s].firstIndex);
        EXPECT_LE(draws[s].indexCount, drawn.ranges[s].indexCount);
        EXPECT_EQ(draws[s].instanceCount, 1u);
        EXPECT_EQ(draws[s].vertexOffset, 0);
        const auto first = all.begin() + draws[s].firstIndex / 3;
        result.emplace_back(first, first + draws[s].indexCount / 3);
        EXPECT_TRUE(std::ranges::all_of(result.back(), isThere)) << "what is not drawn is not met";
    }
    return result;
}

namespace {

// Triangles of `all`, in order, that are next in the drawn list, with points in place of the others.
std::vector<Triangle> take(const std::vector<Triangle>& all, std::span<const Triangle>& drawn) {
    std::vector<Triangle> result(all.size());
    for (std::size_t t = 0; t < all.size() && !drawn.empty(); ++t) {
        if (drawn.front() != all[t]) continue;
        result[t] = all[t];
        drawn = drawn.subspan(1);
    }
    return result;
}

} // namespace

Mixed::Mixed(const Simulation& simulation, const Skin& skin, std::uint32_t firstVertex) {
    const auto placed = [&](std::vector<Triangle> triangles) {
        for (Triangle& triangle : triangles)
            for (std::uint32_t& corner : triangle) corner += firstVertex;
        return triangles;
    };
    const std::vector<Triangle> all = drawnOf(simulation).back();
    std::span<const Triangle> drawn(all);
    wholes = take(placed(skin.wholeTriangles), drawn);
    parts = take(placed(skin.triangles), drawn);
    EXPECT_TRUE(drawn.empty()) << drawn.size() << " are in no order, or are nothing of the skin";
    const std::vector<Triangle> full = download(simulation.skinIndices());
    left.assign(full.end() - static_cast<std::ptrdiff_t>(skin.triangles.size()), full.end());
    for (std::size_t t = 0; t < parts.size(); ++t) partsOf[skin.wholeOf[t]].push_back(t);
}

bool Mixed::hasAllParts(std::uint32_t whole) const {
    for (const std::size_t t : partsOf.at(whole))
        if (isThere(left[t]) && parts[t] != left[t]) return false;
    return true;
}

std::size_t Mixed::count() const {
    return static_cast<std::size_t>(std::ranges::count_if(wholes, isThere) +
                                    std::ranges::count_if(parts, isThere));
}

std::vector<layout::SkinVertex> drawnBy(Runner& runner, SkinDetail detail, Overlap overlap) {
    const VkCommandBuffer commands = queue().begin();
    runner.simulation().recordSkin(commands, detail, overlap);
    queue().wait(queue().submit(commands));
    return queue().download<layout::SkinVertex>(runner.simulation().skinVertices());
}

Vector3d normalOf(const layout::SkinVertex& vertex) {
    return {double{vertex.normal.x}, double{vertex.normal.y}, double{vertex.normal.z}};
}

Vector3d placeOf(const layout::SkinVertex& vertex) {
    return {double{vertex.position.x}, double{vertex.position.y}, double{vertex.position.z}};
}

} // namespace sinew::test
