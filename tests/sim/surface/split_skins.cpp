// Downloads through the queue of the tests.
#include "sim/surface/split_skins.hpp"

#include "mesh/to_scene.hpp"

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

std::vector<Triangle> drawnOf(const Simulation& simulation) {
    std::vector<Triangle> drawn = queue().download<Triangle>(simulation.drawnSkins().indices);
    std::erase_if(drawn, [](const Triangle& triangle) { return !isThere(triangle); });
    return drawn;
}

std::vector<layout::SkinVertex> drawnBy(Runner& runner, SkinDetail detail) {
    const VkCommandBuffer commands = queue().begin();
    runner.simulation().recordSkin(commands, detail);
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
