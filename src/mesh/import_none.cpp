// The import of a build without assimp (SINEW_IMPORT is off).
#include "mesh/import.hpp"

namespace sinew::mesh {

TriangleMesh importMesh(const std::filesystem::path& file, MeshDefects&, const ImportLimits&, Repair,
                        Repairs*, double) {
    throw ImportError("cannot read mesh: " + file.string() +
                      ": this build reads no mesh files (OBJ, STL, PLY, glTF, GLB), because it was made "
                      "without assimp: use a scene with cloth, boxes or shapes, or a build with assimp");
}

} // namespace sinew::mesh
