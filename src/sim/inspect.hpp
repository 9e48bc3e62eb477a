// Buffers of a step program that are worth showing, found in its list of passes: what may touch, and what the
// skins of cut sheets hang on. Simulation::view has them.
#pragma once

#include "sim/program.hpp"

namespace sinew::sim {

/// What may touch (collision/contact_lists.hpp, face_lists.hpp): lists by slot of layout::ContactCandidate,
/// their lengths, elements from one candidate of a slot to the next. Invalid, 0, where a scene has none.
struct ContactListBuffers {
    BufferId pairs, pairCounts;
    std::uint32_t pairRow = 0;
    BufferId faces; ///< layout::ContactFace, between slots
    BufferId facePairs, faceCounts;
    std::uint32_t faceRow = 0;
};
ContactListBuffers contactLists(const StepProgram& program);

/// What the vertices hang on that the skin of a sheet has along cuts (surface/sheet_pieces.hpp).
struct PieceVertices {
    BufferId vertices;       ///< layout::SheetVertex
    std::uint32_t first = 0; ///< of skinVertices
};
std::vector<PieceVertices> piecesOfSheets(const StepProgram& program);

} // namespace sinew::sim
