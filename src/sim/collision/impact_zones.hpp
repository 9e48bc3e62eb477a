// Impact zones: a loose point, or a corner of a sheet at another sheet, that passes a face in a substep after
// all contacts and constraints, although contacts act against it; and edges of two sheets that pass each
// other. Contacts divide a particle among all that it touches, so a fast or heavy ball may pass cloth whose
// particles are held by others. A search finds each such point whose path leads through a face, and each such
// pair of edges. The four particles of a pair join one zone, which moves on like one rigid body that does not
// turn: momentum is exact, and nothing passes within the zone. A zone may then pass others, so searches and
// solutions alternate, ZONE_ROUNDS times at most. If nothing is fast or deep enough to pass, all passes are
// empty.
#pragma once

#include "sim/model/state.hpp"

#include <optional>

namespace sinew::sim::collision::impact_zones {

struct Request {
    std::size_t slots = 0;    ///< of the state
    std::uint32_t moving = 0; ///< as in layout::FacePush
    std::uint32_t sheets = 0;
    std::uint32_t large = 0;       ///< as in layout::FaceFindPush
    std::uint32_t room = 0;        ///< elements of the lists
    bool areBetweenSheets = false; ///< whether a sheet may pass another
    /// By slot: radius [m] of a point without links that is no corner of a face, or of a corner of a sheet
    /// that may pass another sheet, else 0. Below 0, the point is tested with the faces of its list alone.
    std::vector<float> loose;
};

struct Zones {
    layout::ZonePush push{};
    /// Work groups of searches (zones_layout.h) and of solutions, written by the kernels that find contacts.
    BufferId finding = unbound, solving = unbound;
    BufferId meeting = unbound; ///< by element of the lists (meeting_marks.glsl)
    BufferId words = unbound, pairs = unbound, zones = unbound;
    bool areBetweenSheets = false; ///< as in Request

    bool exist() const { return words != unbound; }
};

/// Without a moving face or a loose point there are no zones, and all buffers are unbound.
Zones add(ProgramBuilder& program, const Request& request);

/// Contacts of points with faces.
struct FoundPoints {
    BufferId faces, contacts, lists;
    BufferId searched, large;            ///< small and wide faces that exist (face_lists::Lists)
    BufferId groups;                     ///< work groups that have a point with candidates
    BufferId sheets;                     ///< separations::Separations::sheets
    ProgramBuilder::Constants constants; ///< of the kernels that read it
};

/// Contacts between edges.
struct FoundEdges {
    BufferId edges, contacts, owners, thickness;
    BufferId looked;        ///< by slot: predicted positions at which edges were looked at
    BufferId bounds;        ///< of the grid: holds the number of elements in use
    BufferId meeting;       ///< by element of the lists, for edges of two sheets (meeting_marks.glsl)
    std::uint32_t most = 0; ///< largest number of invocations
};

/// Appends the passes; nothing if there are no zones. Without `edges` only points are searched for.
/// `predicted`: positions and velocities before contacts end the substep; `state` after it.
void addPasses(ProgramBuilder& program, const Zones& zones, const FoundPoints& points,
               const std::optional<FoundEdges>& edges, const ParticleBuffers& predicted,
               const ParticleBuffers& state);

} // namespace sinew::sim::collision::impact_zones
