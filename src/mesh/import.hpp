// Reads a mesh file behind a wall: the importer is treated as hostile to its own input. Content sniffing, own
// header checks, one file and no other, a child process with limits and a wall clock, and an own check of
// every index and float.
#pragma once

#include "mesh/repair.hpp"

#include <filesystem>
#include <stdexcept>

namespace sinew::mesh {

/// What a file may cost. Exceeding one is an ImportError, found before memory is allocated where a header
/// tells.
struct ImportLimits {
    std::uint64_t fileBytes = 512ull << 20;
    std::uint64_t triangles = 5'000'000;
    std::uint64_t addressSpaceBytes = 1ull << 30; ///< of the child, beyond what the parent holds
    double cpuSeconds = 3, wallSeconds = 10;
    double bytesPerSecond =
        16e6; ///< large files have a second of CPU time more for each, and two of the clock
};

/// "cannot read mesh: <file[:line or element]>: <why>: <what to do>". Exit code 3.
class ImportError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

enum class Format { obj, stl, ply, glb, gltf };

/// OBJ, STL (text and binary), PLY (text and binary), glTF 2 with embedded buffers, GLB; the content decides,
/// not the extension. All meshes of the file joined into one, node transforms applied, triangulated, welded,
/// repaired as `how` says; `repairs`, if not null, becomes what was done. `defects` are those of the result,
/// but for the degenerate and duplicate triangles, which are those of the file. `weldWithin` as `weld` of
/// repair() [units of the file]. Objects keep the names that OBJ
/// ("o", or "g" where it has no "o"), text STL ("solid") and glTF (nodes, or meshes) give them. Never opens a
/// second file. Throws ImportError. Forks: call before threads that hold locks the child would need (malloc
/// is safe).
TriangleMesh importMesh(const std::filesystem::path& file, MeshDefects& defects,
                        const ImportLimits& limits = {}, Repair how = Repair::close,
                        Repairs* repairs = nullptr, double weldWithin = 0);

} // namespace sinew::mesh
