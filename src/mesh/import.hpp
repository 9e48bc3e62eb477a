// Import of a mesh file in isolation, because importers crash on hostile input: content sniffing, own header
// checks, one file and no other, a child process with limits and a wall clock, and an own check of every
// index and float.
#pragma once

#include "mesh/repair.hpp"

#include <filesystem>
#include <stdexcept>

namespace sinew::mesh {

/// Limits of an import. Exceeding one is an ImportError, detected before memory is allocated if a header
/// allows.
struct ImportLimits {
    std::uint64_t fileBytes = 512ull << 20;
    std::uint64_t triangles = 5'000'000;
    std::uint64_t addressSpaceBytes = 1ull << 30; ///< limit of the child, beyond that of the parent
    double cpuSeconds = 3, wallSeconds = 10;
    double bytesPerSecond =
        16e6; ///< large files get one second more of CPU time per this many bytes, and two of the clock
};

/// Text: "cannot read mesh: <file[:line or element]>: <why>: <what to do>". Exit code 3.
class ImportError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

enum class Format { obj, stl, ply, glb, gltf };

/// Reads OBJ, STL (text and binary), PLY (text and binary), glTF 2 with embedded buffers, and GLB; the
/// content decides, not the extension. All meshes of the file are joined into one, with node transforms
/// applied, triangulated, welded, and repaired as `how` says; `repairs`, if not null, receives the report.
/// `defects` are those of the result, except for degenerate and duplicate triangles, which are those of the
/// file. `weldWithin` as `weld` of repair() [units of the file]. Objects keep their names from OBJ ("o", or
/// "g" if it has no "o"), text STL ("solid") and glTF (nodes, or meshes). The first set of texture
/// coordinates is kept (OBJ "vt", PLY s, t or u, v, glTF TEXCOORD_0 of floats), with v upwards; (0, 0) where
/// a part has none. Never opens a second file. Throws ImportError. Forks: call before threads that hold locks
/// the child would need (malloc is safe).
TriangleMesh importMesh(const std::filesystem::path& file, MeshDefects& defects,
                        const ImportLimits& limits = {}, Repair how = Repair::close,
                        Repairs* repairs = nullptr, double weldWithin = 0);

} // namespace sinew::mesh
