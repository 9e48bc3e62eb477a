// Normals of a skin at rest, computed as in skin_normals.comp. A vertex beside a cut has its rest normal,
// rotated with the material, while other vertices have normals from the triangles around them; the two must
// agree. Within a whole triangle of a split skin normals are interpolated between its corners, as they are
// before a cut.
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

/// Vertices that are no corners of whole triangles, with the whole triangle that contains each; both are
/// indices. Empty if the skin is not split.
std::vector<layout::PartVertex> partVertices(const Skin& skin, std::span<const Point> rest);

/// Normals as drawn. In a split skin corners of whole triangles have the normals of these, and vertices of
/// parts (`parts`, see partVertices) interpolate them. In another skin normals are those of its triangles.
std::vector<Point> litNormals(const Skin& skin, std::span<const layout::PartVertex> parts,
                              std::span<const Point> rest);

} // namespace sinew::sim::surface
