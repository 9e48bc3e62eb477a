// A skin that was cut, with its inside, as one closed mesh to export or to measure.
#pragma once

#include "layout.h"
#include "mesh/triangle_mesh.hpp"

#include <optional>

namespace sinew::tools {

/// What the device has of skins and of the surface of cuts, after recordSkin().
struct CutDownload {
    std::vector<sim::layout::SkinVertex> skinVertices, vertices;
    std::vector<std::uint32_t> skinIndices, indices;
    std::vector<sim::layout::CutVertex> rest;
    std::vector<sim::layout::DrawArguments> draws, pieceDraws; // of the surface; by skin
};

/// What is left of the skin of a sheet, and what it falls into, which has vertices of its own. None where
/// that skin is not cut, or of no sheet.
std::optional<mesh::TriangleMesh> cutSheet(const sim::Scene& scene, std::size_t index,
                                           const CutDownload& download);

/// What is left of skin `index` of the scene, the pieces beside cuts and the inside, joined point by point:
/// both sides of a cut stay apart where they lie on each other. None where that skin is not cut.
std::optional<mesh::TriangleMesh> cutMesh(const sim::Scene& scene, std::size_t index,
                                          const CutDownload& download);

} // namespace sinew::tools
