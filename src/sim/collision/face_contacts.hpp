// Contacts of particles with triangles, in `split`: the participants. row_contacts.hpp says how contacts are
// solved, and why that is stable. A scene in which nothing touches a face has none of these passes.
#pragma once

#include "sim/collision/face_lists.hpp"
#include "sim/collision/impact_zones.hpp"
#include "sim/collision/row_contacts.hpp"
#include "sim/collision/separations.hpp"
#include "sim/model/scene_model.hpp"

namespace sinew::sim::collision::face_contacts {

struct Contacts {
    face_lists::Lists lists;
    row_contacts::Rows rows;
    std::uint32_t faces = 0;      ///< of all kinds
    std::uint32_t firstInner = 0; ///< from there to rows.push.moving: exist only once a cut exposes them
    /// By face: whether it is half of a square between two cells of a cuttable voxel body, or beside one.
    std::vector<bool> isOfCells;
    impact_zones::Zones zones;
    separations::Separations separations;
    BufferId opened; ///< by face: whether this step has opened it; only if some are of cells
    /// Positions and velocities after links; only if hasStops().
    BufferId linkedPositions, linkedVelocities;
    BufferId movingPoints; ///< slots of moving points; only if hasStops()
    BufferId stopRows;     ///< by face (forces::Stops); only if forces are kept and a point moves
    std::uint32_t movingPointCount = 0;

    bool hasInner() const { return firstInner < rows.push.moving; }
    bool hasSolid() const { return rows.push.sheets < rows.push.moving; }
    /// Whether some face is static or driven.
    bool hasStops() const { return lists.push.moving < faces; }
};

/// Requires faces that are touched.
Contacts add(ProgramBuilder& program, const SceneModel& model, const ParticleBuffers& particles);

/// Appends passes that change predicted positions and velocities in place. `isFirst`: first substep of a
/// step.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst);

enum class StopKind : bool {
    all,     ///< stops what passes a face, and what comes too near
    passing, ///< stops only what passes: after impact zones, whose members stay together
};

/// Appends the pass that keeps particles exactly in front of static and driven faces: after all other passes
/// of a substep except impact zones and colliders, and once more after zones, on `state`. Nothing if there is
/// no such face.
void addStops(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state, StopKind kind);

/// Appends the passes between these: what still passes a moving face, or would be pushed through one by a
/// stop, is stopped with it. `edges` of two sheets that pass each other too. `predicted` as in addPasses().
void addZones(ProgramBuilder& program, const Contacts& contacts,
              const std::optional<impact_zones::FoundEdges>& edges, const ParticleBuffers& predicted,
              const ParticleBuffers& state);

/// Smallest distance, in spacings, from a face between four nodes of a lattice to a point that no link joins
/// to one of its corners. Nodes are linked along edges (`kinds` 1), also along face diagonals (2), also along
/// body diagonals (3). With edges alone it is the distance of (1, 1, 1) from the longest edge of the face.
double leastUnlinked(std::uint32_t kinds);

/// Points that a face never touches although they are not its corners, as in face_lists::Request: points of
/// its own linked body with a rest distance below 1.05 times contact distance, and in a voxel body points
/// that a link joins to a corner. The latter are at most 1.73 spacings away from the corner, and all others
/// at least 1.22 to 2, by kind of links. `bodies` is that of linkedBodies(), `faces` are between particles;
/// `runs` = bodies whose links may be cut.
std::vector<std::uint32_t> excludedPoints(const Scene& scene, std::span<const std::uint32_t> bodies,
                                          std::span<const layout::ContactFace> faces,
                                          std::span<const float> radii, const StateLayout& layout,
                                          std::span<const CutRun> runs = {});

} // namespace sinew::sim::collision::face_contacts
