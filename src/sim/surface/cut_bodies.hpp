// Inputs of the surface of cuts, body by body, before buffers are built: skins that are the outer faces of
// cells, and skins of meshes with the prisms between skin and lattice.
#pragma once

#include "common/layout.h"
#include "common/texture_layout.h"
#include "sim/model/scene_model.hpp"

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
    std::vector<layout::PartVertex> parts;             ///< vertices that are no corners of whole triangles
    std::vector<layout::SkinSlot> slots;               ///< slots that prisms and vertices depend on
    std::vector<std::uint32_t> hanging;                ///< prisms and vertices by slot
    std::vector<HungRange> ranges;                     ///< one for each body with prisms
    std::vector<layout::TexturedPrism> texturedPrisms; ///< one for each of `prisms`, if a skin is textured
    std::vector<layout::TexturedWhole> texturedWholes;
    std::vector<layout::TexturedFace> texturedFaces;
    std::vector<layout::TexturedFacePush> texturedRanges; ///< of texturedFaces, one for each body
    double cells = 0;                 ///< of all bodies with a clipped skin; 0 = there are none
    std::uint32_t room = 0;           ///< Settings::cutSurfaceRoom
    std::vector<std::uint32_t> skins; ///< clipped skins
};

/// Reads cuttable bodies whose skin can be clipped; others are left out. `runs` are those of all cuttable
/// bodies.
CutBodies readCutBodies(const SceneModel& model, std::span<const layout::CutPush> runs);

} // namespace sinew::sim::surface
