// Attachment of a mesh skin to the lattice that carries it: a prism between each of its triangles and the
// anchor particles of its corners, and below the prisms the tetrahedra that those particles enclose. Prisms
// and tetrahedra together fill the skin without gaps, so one rule for both gives a closed surface of any cut.
// Made once, on the host.
#pragma once

#include "common/layout.h"
#include "sim/lattice/placement.hpp"
#include "sinew/scene.hpp"

#include <optional>
#include <span>

namespace sinew::sim::surface {

/// Indices of a skin among all of a scene.
struct SkinPlace {
    std::uint32_t index = 0, firstVertex = 0, firstTriangle = 0;
};

struct SkinComplex {
    std::uint32_t skin = 0, firstHung = 0;    ///< index of the skin; of `vertices`
    std::vector<layout::SkinPrism> prisms;    ///< one for each of the skin's triangles, in their order
    std::vector<layout::HungVertex> vertices; ///< one for each of the skin's, in their order
    std::vector<layout::vec4> planes;         ///< by vertex: normals of the parts around
    std::vector<layout::PartVertex> parts;    ///< of a split skin; indices in the skin
    std::vector<std::uint32_t> words;         ///< of slots from the box's origin on, see COMPLEX_FACES
};

/// None if the skin has no anchors in this grid or violates a condition of Skin::anchors: if it is not
/// closed, or if it intersects itself or is so thin that the anchors enclose a region twice or inside out.
/// Prisms and vertices are numbered from `firstPrism` and `firstHung` on.
std::optional<SkinComplex> hangSkin(const Scene& scene, const Grid& grid, const lattice::Box& box,
                                    const SkinPlace& skin, std::uint32_t firstPrism, std::uint32_t firstHung);

/// Positions for a blade of anchor particles outside the skin, by slot: slightly below the nearest point of
/// the skin [m]. Without them the surface of a cut would stick out of the skin by half a cell.
std::vector<std::pair<std::uint32_t, Vec3>> pullAnchors(const Scene& scene, const Grid& grid,
                                                        const lattice::Box& box, const SkinComplex& complex);

} // namespace sinew::sim::surface
