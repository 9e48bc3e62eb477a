// How the skin of a mesh hangs on the lattice that carries it: a prism between each of
// its triangles and the particles that the corners go with, and below the prisms the tetrahedra that those
// particles enclose. Prisms and tetrahedra together are what the skin encloses, without gaps, so one rule
// for both gives a closed surface of any cut. Made once, on the host.
#pragma once

#include "layout.h"
#include "sim/lattice/placement.hpp"
#include "sim/scene.hpp"

#include <optional>
#include <span>

namespace sinew::sim::surface {

/// A skin among all of a scene.
struct SkinPlace {
    std::uint32_t index = 0, firstVertex = 0, firstTriangle = 0;
};

struct SkinComplex {
    std::uint32_t skin = 0, firstHung = 0;    ///< index of the skin; of `vertices`
    std::vector<layout::SkinPrism> prisms;    ///< of the skin's triangles, in their order
    std::vector<layout::HungVertex> vertices; ///< of the skin, in their order
    std::vector<layout::vec4> planes;         ///< likewise: normals of the parts around
    std::vector<layout::PartVertex> parts;    ///< of a mixed skin; indices in the skin
    std::vector<std::uint32_t> words;         ///< of slots from the box's origin on, as COMPLEX_FACES says
};

/// None where the skin has no anchors in this grid, or they are not as Skin::anchors says: where it is not
/// closed, and where it passes through itself or is thin so that the anchors enclose something twice or
/// inside out. Prisms and vertices count from `firstPrism` and `firstHung` on.
std::optional<SkinComplex> hangSkin(const Scene& scene, const Grid& grid, const lattice::Box& box,
                                    const SkinPlace& skin, std::uint32_t firstPrism, std::uint32_t firstHung);

/// Where particles that the skin goes with, but that lie outside of it, are for a blade: a little below the
/// nearest point of the skin [m], by slot. Else the surface of a cut sticks out of the skin by half a cell.
std::vector<std::pair<std::uint32_t, Vec3>> pullAnchors(const Scene& scene, const Grid& grid,
                                                        const lattice::Box& box, const SkinComplex& complex);

} // namespace sinew::sim::surface
