// Bodies of triangle meshes in the C interface: the part that arrays and files share.
#pragma once

#include "capi/objects.hpp"
#include "mesh/to_scene.hpp"

namespace sinew::capi {

/// Adds a body of `mesh` with the values of `given`, and returns its index. Throws Failed, and what
/// mesh::addMesh() throws.
std::uint32_t addMeshBody(sim::Scene& scene, const mesh::TriangleMesh& mesh, const SinewMesh& given);

} // namespace sinew::capi
