// Impact zones: a loose point, or a corner of a sheet at another sheet, that passes a face in a substep after
// all contacts and constraints, although contacts act against it. Contacts divide a particle among all that
// it touches, so a fast or heavy ball may pass cloth whose particles are held by others. A search finds each
// such point whose path leads through a face. The point and the corners of the face join one zone, which
// moves on like one rigid body that does not turn: momentum is exact, and nothing passes within the zone. A
// zone may then pass other faces, so searches and solutions alternate, ZONE_ROUNDS times at most. If nothing
// is fast or deep enough to pass, all passes are empty.
#pragma once

#include "sim/model/state.hpp"

namespace sinew::sim::collision::impact_zones {

struct Request {
    std::size_t slots = 0;    ///< of the state
    std::uint32_t moving = 0; ///< as in layout::FacePush
    std::uint32_t sheets = 0;
    std::uint32_t large = 0; ///< as in layout::FaceFindPush
    std::uint32_t room = 0;  ///< elements of the lists
    /// By slot: radius [m] of a point without links that is no corner of a face, else 0. Below 0, the point
    /// is tested with the faces of its list alone: so are corners of sheets, with faces of other sheets.
    std::vector<float> loose;
};

struct Zones {
    layout::ZonePush push{};
    /// Work groups of the search and of the solution, written by the kernel that finds contacts.
    BufferId finding = unbound, solving = unbound;
    BufferId meeting = unbound; ///< by element of the lists: whether the pair comes within reach
    BufferId words = unbound, pairs = unbound, zones = unbound;

    bool exist() const { return words != unbound; }
};

/// Without a moving face or a loose point there are no zones, and all buffers are unbound.
Zones add(ProgramBuilder& program, const Request& request);

/// Contacts of points with faces.
struct Found {
    BufferId faces, contacts, lists;
    BufferId searched, large;            ///< small and wide faces that exist (face_lists::Lists)
    BufferId groups;                     ///< work groups that have a point with candidates
    BufferId sheets;                     ///< separations::Separations::sheets
    ProgramBuilder::Constants constants; ///< of the kernels that read it
};

/// Appends the passes; nothing if there are no zones. `predicted`: positions and velocities before contacts
/// end the substep; `state` after it.
void addPasses(ProgramBuilder& program, const Zones& zones, const Found& found,
               const ParticleBuffers& predicted, const ParticleBuffers& state);

} // namespace sinew::sim::collision::impact_zones
