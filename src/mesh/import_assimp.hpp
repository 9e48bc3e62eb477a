// The only interface to assimp. Assimp 5.2.5 crashes, hangs and opens side files on hostile input: call this
// only in a child process.
#pragma once

#include "mesh/import_checks.hpp"

namespace sinew::mesh {

/// The triangles of a file of the given format, with node transforms applied; each node is an object with its
/// own name or that of its mesh, empty if neither has one. `bytes` must have passed the checks of
/// import_checks.hpp. Coordinates of a texture that are whole numbers are left out. Throws Refusal.
Soup readTriangles(Format format, std::string_view bytes, const ImportLimits& limits,
                   const Announced& announced = {});

} // namespace sinew::mesh
