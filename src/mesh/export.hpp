// Writers of OBJ and PLY files (export_gltf: GLB). Each writes a temporary file in the same folder, flushes
// it, then renames it.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <stdexcept>

namespace sinew::mesh {

/// Text: "cannot write <file>: <why>: <what to do>". Exit code 6.
class ExportError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Calls `write` with a stream on a temporary file, then flushes, syncs and renames it to `file`. On any
/// failure the temporary file is removed, the old file stays, and ExportError is thrown. All files of this
/// project are written by this function.
void writeWhole(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Writes one object a mesh. Throws ExportError.
void exportObj(const std::filesystem::path& file, std::span<const TriangleMesh> meshes);
/// Writes binary little endian. For several meshes, each face has a property `piece`, the index of its mesh
/// from 0 on. Throws ExportError.
void exportPly(const std::filesystem::path& file, std::span<const TriangleMesh> meshes);
void exportObj(const std::filesystem::path& file, const TriangleMesh& mesh);
void exportPly(const std::filesystem::path& file, const TriangleMesh& mesh);

/// A particle in a saved state, a PLY point: x y z, vx vy vz, inverse_mass (float each).
struct ParticleState {
    Vec3 position, velocity;
    float inverseMass = 0;
};
void exportParticles(const std::filesystem::path& file, std::span<const ParticleState> particles);
std::vector<ParticleState>
importParticles(const std::filesystem::path& file); ///< reads back what exportParticles wrote

} // namespace sinew::mesh
