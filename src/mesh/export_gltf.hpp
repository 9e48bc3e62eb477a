// Writer of binary glTF 2 (.glb): bodies with normals, colors, and another material inside.
#pragma once

#include "mesh/export.hpp"

namespace sinew::mesh {

/// Triangles of one material, with their own vertices.
struct ShadedPart {
    std::vector<Vec3> positions; ///< [m]
    std::vector<Vec3> normals;   ///< one per position, outward, of any length
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool isInside = false; ///< opened by a cut
};

/// A body, or one of the pieces of a cut body.
struct ShadedMesh {
    std::string name;
    Vec3 color{0.78f, 0.36f, 0.32f}; ///< color of the outside, linear RGB
    std::vector<ShadedPart> parts;
};

/// Writes one node and one mesh for each mesh that has triangles, one primitive for each of its parts. Throws
/// ExportError as writeWhole() does, and for a vertex that is not finite, an index beyond the vertices, or
/// more than the 4 GiB of the format.
void exportGlb(const std::filesystem::path& file, std::span<const ShadedMesh> meshes);

} // namespace sinew::mesh
