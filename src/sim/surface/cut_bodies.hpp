// Inputs of the surface of cuts, body by body, before buffers are built: skins that are the outer faces of
// cells, and skins of meshes with the prisms between skin and lattice.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"

#include <span>

namespace sinew::sim::surface {

/// Prisms of a body, the vertices of its skin and the slots that both depend on, as push constants of the
/// kernels over them: `first` and `count` are ranges in the lists of all bodies.
struct HungRange {
    layout::CutPush prisms{}, vertices{};
    layout::SkinSlotsPush slots{};
};

struct CutBodies {
    std::vector<layout::SkinFace> faces; ///< triangles of skins that pieces may replace
    std::vector<std::uint32_t> complex;  ///< by slot, see COMPLEX_FACES
    std::vector<layout::vec4> rest;      ///< by slot; w = index of the skin
    std::vector<layout::vec4> pulled;    ///< `rest` as blades see it; empty if it does not differ
    std::vector<layout::SkinPrism> prisms;
    std::vector<layout::HungVertex> vertices;
    std::vector<layout::vec4> planes; ///< by vertex: normals of the triangles around
    std::vector<layout::WholeTriangle> wholes;
    std::vector<layout::PartVertex> parts; ///< that are no corners of these
    std::vector<layout::SkinSlot> slots;   ///< that vertices go with
    std::vector<std::uint32_t> hanging;    ///< what hangs there
    std::vector<HungRange> ranges;         ///< of bodies with prisms
    double cells = 0;                      ///< of all bodies whose skin is clipped; 0 = there are none
    std::uint32_t room = 0;                ///< Settings::cutSurfaceRoom
    std::vector<std::uint32_t> skins;      ///< clipped skins
};

/// Reads cuttable bodies whose skin can be clipped; others are left out. `runs` are those of all cuttable
/// bodies.
CutBodies readCutBodies(const Scene& scene, const Settings& settings, const StateLayout& layout,
                        std::span<const layout::CutPush> runs);

} // namespace sinew::sim::surface
