// Components of a triangle mesh: its connected surfaces, each with the cavities in it, and the choice of some
// by name.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <optional>

namespace sinew::mesh {

/// A connected surface: triangles that share vertices. A closed surface that faces inward and lies inside of
/// another component is a cavity and belongs to that component.
struct Component {
    std::string name;                     ///< of its object where it is all of that object, else "part N"
    std::vector<std::uint32_t> triangles; ///< indices, ascending
    double volume = 0;                    ///< enclosed, less the cavities [m^3]; a guess where it is open
    bool isClosed = false;                ///< no edge has one triangle alone
    bool isInward = false; ///< it faces inward, and is no cavity; of an open one its volume is guessed
    std::size_t cavities = 0;
};

/// All components of a welded mesh, the largest volume first: the first is "part 1". Those of a choice keep
/// the numbers that they have in the whole mesh.
std::vector<Component> components(const TriangleMesh& mesh);

/// "\"liver\": 1200 triangles, 0.00143 m^3"; says where a component is open, has cavities or
/// is inside out.
std::string describe(const Component& component);

/// All names that choose() knows: those of the objects, then "part 1", "part 2", ...
std::vector<std::string> names(const TriangleMesh& mesh);

/// The triangles of the objects and components that are called so; a name is that of an object before it is
/// that of a component. Empty where a name is unknown, which is then in `unknown`.
std::optional<TriangleMesh> choose(const TriangleMesh& mesh, const std::vector<std::string>& names,
                                   std::string& unknown);

/// The triangles of one component.
TriangleMesh extract(const TriangleMesh& mesh, const Component& component);

} // namespace sinew::mesh
