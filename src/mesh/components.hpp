// Components of a triangle mesh: its connected surfaces, each with its cavities, and the selection of
// components by name.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <optional>

namespace sinew::mesh {

/// A connected surface: triangles that share vertices. A closed surface that faces inward and lies inside of
/// another component is a cavity and belongs to that component.
struct Component {
    std::string name;                     ///< name of its object if it is all of that object, else "part N"
    std::vector<std::uint32_t> triangles; ///< indices, ascending
    double volume = 0;                    ///< enclosed, less the cavities [m^3]; an estimate if it is open
    bool isClosed = false;                ///< every edge has two triangles or more
    bool isInward = false;                ///< it faces inward, and is no cavity; estimated if it is open
    std::size_t cavities = 0;
};

/// All components of a welded mesh, by decreasing volume: the first is "part 1". Components of a choice keep
/// the numbers that they have in the whole mesh.
std::vector<Component> components(const TriangleMesh& mesh);

/// One line such as "\"liver\": 1200 triangles, 0.00143 m^3"; also says if a component is open, has cavities
/// or is inside out.
std::string describe(const Component& component);

/// All names that choose() accepts: those of the objects, then "part 1", "part 2", ...
std::vector<std::string> names(const TriangleMesh& mesh);

/// The triangles of the objects and components with these names; an object takes precedence over a component.
/// Empty if a name is unknown; `unknown` then holds it.
std::optional<TriangleMesh> choose(const TriangleMesh& mesh, const std::vector<std::string>& names,
                                   std::string& unknown);

/// The triangles of one component.
TriangleMesh extract(const TriangleMesh& mesh, const Component& component);

} // namespace sinew::mesh
