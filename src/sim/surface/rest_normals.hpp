// Normals of a skin at rest, in the words of skin_normals.comp: a vertex beside a cut has this one, turned
// with the material, where others have theirs from the triangles around them, and the two must meet.
#pragma once

#include "sim/surface/point.hpp"

#include <span>
#include <vector>

namespace sinew::sim::surface {

/// By vertex, of length one, or zero where no triangle says anything: those of its triangles by their angles
/// there, of corners of whole triangles (of mixed skins) those of these. `rest` is where the vertices are.
std::vector<Point> restNormals(const Skin& skin, std::span<const Point> rest);

} // namespace sinew::sim::surface
