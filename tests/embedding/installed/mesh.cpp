// A program that uses the component `mesh`: it makes a soft body of a mesh in memory, without files and
// without assimp.
#include "sinew/mesh/generate.hpp"
#include "sinew/mesh/to_scene.hpp"
#include "sinew/validate.hpp"

#include <cmath>
#include <cstdio>

int main() {
    const sinew::mesh::TriangleMesh mesh = sinew::mesh::generate("sphere", 32);
    sinew::sim::Scene scene;
    const sinew::mesh::AddedMesh added =
        sinew::mesh::addMesh(scene, mesh, {.voxels = {.resolution = 12}, .youngModulus = 3e4f});
    const auto complaints = sinew::sim::validate(scene, {.substeps = 16});
    for (const std::string& complaint : complaints) std::puts(complaint.c_str());
    std::printf("%zu particles, %zu skin triangles, %.4f m3 filled\n", scene.particles.size(),
                scene.skins.at(0).triangles.size(), added.voxels.filledVolume);
    const bool isBody = scene.bodies.size() == 1 && scene.particles.size() > 500 &&
                        scene.skins[0].triangles.size() == mesh.triangles.size();
    return isBody && complaints.empty() && added.voxels.filledVolume > 0 ? 0 : 1;
}
