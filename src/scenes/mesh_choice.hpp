// The choice of objects and components of a mesh by name.
#pragma once

#include "scenes/section.hpp"

#include "mesh/triangle_mesh.hpp"

namespace sinew::scenes {

/// Why a name chooses nothing of a mesh, and what to do.
struct UnknownObject {
    std::string why, whatToDo;
};
UnknownObject unknownObject(const mesh::TriangleMesh& mesh, const std::string& file, const std::string& name);

/// Leaves of the mesh what `object` names, and all where the section has no such key. Returns whether it has
/// one. Throws SceneError.
bool chooseObjects(mesh::TriangleMesh& mesh, const Section& section, const std::string& file);

} // namespace sinew::scenes
