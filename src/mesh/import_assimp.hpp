// The only way to assimp. Assimp 5.2.5 crashes, hangs and opens side files on hostile input: call this in a
// child only.
#pragma once

#include "mesh/import_checks.hpp"

namespace sinew::mesh {

/// The triangles of a file of the given format, node transforms applied, each node an object with the name
/// that it or its mesh has; empty where neither has one. Throws Refusal. `bytes` have passed the checks of
/// import_checks.hpp.
/// `announced`, where not 0, is the number of triangles that must be there before nodes repeat them.
Soup readTriangles(Format format, std::string_view bytes, const ImportLimits& limits,
                   std::uint64_t announced = 0);

} // namespace sinew::mesh
