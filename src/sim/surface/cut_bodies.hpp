// What the surface of cuts is made of, body by body, before anything is built: skins that are the outer faces
// of cells, and skins of meshes with the prisms that they stand on.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <span>

namespace sinew::sim::surface {

/// Prisms of a body, the vertices of its skin and the slots that these go with, as the kernels over them say:
/// `first` and `count` among those of all bodies.
struct HungRange {
    layout::CutPush prisms{}, vertices{};
    layout::SkinSlotsPush slots{};
};

struct CutBodies {
    std::vector<layout::SkinFace> faces; ///< triangles of skins that pieces may stand for
    std::vector<std::uint32_t> complex;  ///< by slot, as COMPLEX_FACES says
    std::vector<layout::vec4> rest;      ///< by slot; w = index of the skin
    std::vector<layout::vec4> pulled;    ///< the same as blades see it; empty where that is no different
    std::vector<layout::SkinPrism> prisms;
    std::vector<layout::HungVertex> vertices;
    std::vector<layout::vec4> planes; ///< of these: normals of the triangles around
    std::vector<layout::WholeTriangle> wholes;
    std::vector<layout::PartVertex> parts; ///< that are no corners of these
    std::vector<std::uint32_t> mixed;      ///< skins that these are of, in their order
    std::vector<layout::SkinSlot> slots;   ///< that these go with
    std::vector<std::uint32_t> hanging;    ///< what hangs there
    std::vector<HungRange> ranges;         ///< of bodies with prisms
    double cells = 0;                      ///< of all bodies whose skin is clipped; 0 = there are none
    std::uint32_t room = 0;                ///< Settings::cutSurfaceRoom
    std::vector<std::uint32_t> skins;      ///< that are clipped
};

/// Of those bodies that may be cut and whose skin can be clipped; the others are left out. `runs` are those
/// of all that may be cut.
CutBodies readCutBodies(const Scene& scene, const Settings& settings, const StateLayout& layout,
                        std::span<const layout::CutPush> runs);

} // namespace sinew::sim::surface
