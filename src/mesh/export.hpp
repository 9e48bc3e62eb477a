// Writes OBJ and PLY files (export_gltf: GLB) whole: to a temporary name in the same folder, flushed, then
// renamed.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <stdexcept>

namespace sinew::mesh {

/// "cannot write <file>: <why>: <what to do>". Exit code 6.
class ExportError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Calls `write` with a stream on a temporary file, then flushes, syncs and renames it to `file`. On any
/// failure the temporary is removed, the old file stays, and ExportError is thrown. Everything this project
/// writes goes through it.
void writeWhole(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// One object a mesh.
void exportObj(const std::filesystem::path& file, std::span<const TriangleMesh> meshes);
/// Binary little endian. Where there are several meshes, each face says which it is of: property `piece`,
/// from 0 on.
void exportPly(const std::filesystem::path& file, std::span<const TriangleMesh> meshes);
void exportObj(const std::filesystem::path& file, const TriangleMesh& mesh);
void exportPly(const std::filesystem::path& file, const TriangleMesh& mesh);

/// Particles as PLY points: x y z, vx vy vz, inverse_mass (float each).
struct ParticleState {
    Vec3 position, velocity;
    float inverseMass = 0;
};
void exportParticles(const std::filesystem::path& file, std::span<const ParticleState> particles);
std::vector<ParticleState>
importParticles(const std::filesystem::path& file); ///< reads back what exportParticles wrote

} // namespace sinew::mesh
