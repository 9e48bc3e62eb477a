// Separations: what keeps a sheet from passing through itself, in `split`. Contacts divide a particle among
// all that it touches, so layers that are pressed together hard may pass in one substep. At the start of a
// substep each listed pair of a corner and a face of a sheet, or of two of its edges, has a plane halfway
// between them. A pair that this plane does not separate at the end of the substep has its ways limited.
// Two triangles pass each other only by a corner through a face, or by two edges, so listed pairs of a sheet
// never pass. Two sheets, faces of voxel bodies and faces that never give way have the other rules of
// docs/contact-rules.md. A scene without a moving sheet of at least eight particles has none of these passes.
#pragma once

#include "sim/collision/row_contacts.hpp"

namespace sinew::sim::collision::separations {

struct Separations {
    BufferId sheets = unbound; ///< by slot: the sheet that it is a corner of (collision/sheet_marks.h)
    std::vector<std::uint32_t> ofSlots; ///< the contents of `sheets`
    BufferId parts;                     ///< by slot: part of its way in the substep that a particle may go
    body_frames::Frames frames;         ///< of the lists of faces: their sums give the speed of a sheet

    /// Constants of the kernels that find contacts, which get `sheets` as well (collision/one_sheet.glsl).
    ProgramBuilder::Constants constants() const {
        constexpr std::uint32_t hasSheetsId = 6;
        return {{hasSheetsId, exist()}};
    }
    bool exist() const { return sheets != unbound; }
    bool hasBodies() const { return frames.chunks != BufferId{}; }
};

/// `sheets` = the moving faces of sheets, between particles.
Separations add(ProgramBuilder& program, const SceneModel& model, std::span<const layout::ContactFace> sheets,
                const body_frames::Frames& frames);

/// Appends the passes of faces, or of edges. `predicted`: positions and velocities before contacts end the
/// substep; `state`: after all else that moves particles.
void addPasses(ProgramBuilder& program, const Separations& separations, const row_contacts::Rows& rows,
               const ParticleBuffers& predicted, const ParticleBuffers& state);

} // namespace sinew::sim::collision::separations
