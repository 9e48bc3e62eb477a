// Writes binary glTF 2 (.glb): bodies with normals, colors, and an inside of another material.
#pragma once

#include "mesh/export.hpp"

namespace sinew::mesh {

/// Triangles of one material, with vertices of their own.
struct ShadedPart {
    std::vector<Vec3> positions; ///< [m]
    std::vector<Vec3> normals;   ///< one a position, outward, of any length
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool isInside = false; ///< laid open by a cut
};

/// A body, or one of the pieces that a body was cut into.
struct ShadedMesh {
    std::string name;
    Vec3 color{0.78f, 0.36f, 0.32f}; ///< of the outside, linear RGB
    std::vector<ShadedPart> parts;
};

/// One node and one mesh for each that has triangles, one primitive for each of its parts. Throws ExportError
/// as writeWhole() does, and for a vertex that is not finite, an index beyond the vertices, or more than the
/// 4 GiB of the format.
void exportGlb(const std::filesystem::path& file, std::span<const ShadedMesh> meshes);

} // namespace sinew::mesh
