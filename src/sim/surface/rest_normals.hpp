// Normals of a skin at rest, in the words of skin_normals.comp: a vertex beside a cut has this one, turned
// with the material, where others have theirs from the triangles around them, and the two must meet. Within
// a whole triangle of a split skin they go over from corner to corner, as they do before a cut.
#pragma once

#include "sim/surface/point.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim::surface {

/// By vertex, of length one, or zero without a triangle that has an area: normals of its triangles, weighted
/// by their angles. `rest` has the positions of the vertices.
std::vector<Point> restNormals(std::span<const std::array<std::uint32_t, 3>> triangles,
                               std::span<const Point> rest);

/// Vertices that are no corners of whole triangles, by their index: in a triangle whose parts have them,
/// whose index it is. Empty without Skin::wholeOf.
std::vector<layout::PartVertex> partVertices(const Skin& skin, std::span<const Point> rest);

/// Of a split skin as it is lit: corners of whole triangles have the normals of these, and vertices of parts
/// (`parts`, as above) what those are in between. Of another skin those of its triangles.
std::vector<Point> litNormals(const Skin& skin, std::span<const layout::PartVertex> parts,
                              std::span<const Point> rest);

} // namespace sinew::sim::surface
