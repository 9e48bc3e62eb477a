// Particles that touch triangles, in `split`: who takes part. How contacts are solved, and why that is
// stable: row_contacts.hpp. A scene in which nothing touches a face has none of this.
#pragma once

#include "sim/collision/face_lists.hpp"
#include "sim/collision/row_contacts.hpp"

namespace sinew::sim::collision::face_contacts {

/// Whether a particle of the scene may touch a face: one with a radius, and it or a face can move.
bool areIn(const Scene& scene);

/// The radius with which a particle touches others as a ball, by particle [m]: 0 where faces around it as
/// thick as itself do so instead.
std::vector<float> looseRadii(const Scene& scene);

struct Contacts {
    face_lists::Lists lists;
    row_contacts::Rows rows;
    std::uint32_t faces = 0;      ///< of all kinds
    std::uint32_t firstInner = 0; ///< from there to rows.push.moving: there only once a cut lays them open
    /// By face: a half of a square between two cells of a voxel body that may be cut, or beside one.
    std::vector<bool> isOfCells;
    BufferId opened; ///< by face: whether this step has opened it; only where some are of cells
    /// Positions and velocities that links have left; only where hasStops().
    BufferId linkedPositions, linkedVelocities;
    BufferId movingPoints; ///< slots of points that move; only where hasStops()
    BufferId stopRows; ///< of each face (forces::Stops); only where forces are kept and a point moves, too
    std::uint32_t movingPointCount = 0;

    bool hasInner() const { return firstInner < rows.push.moving; }
    bool hasSolid() const { return rows.push.sheets < rows.push.moving; }
    /// Whether some face never gives way.
    bool hasStops() const { return lists.push.moving < faces; }
};

/// Only where areIn().
Contacts add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
             const ParticleBuffers& particles);

/// Changes predicted positions and velocities where they stand. `isFirst`: of a step.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst);

/// Keeps particles in front of faces that never give way, exactly: after all other passes of a substep but
/// colliders, on `state`. Nothing where there is no such face.
void addStops(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state);

/// How far from a face between four nodes of a lattice all points are at least that no link joins to a
/// corner, in spacings, where a node is linked along its edges (`kinds` 1), also along diagonals of faces
/// (2), also along those of cells (3). With edges alone it is that of (1, 1, 1) from the longest edge of the
/// face.
double leastUnlinked(std::uint32_t kinds);

/// Points that a face never touches though they are not its corners, as face_lists::Request says: those of
/// its own linked body that are nearer than 1.05 times touching at rest, and of a voxel body those that a
/// link joins to a corner. Those are 1.73 spacings away from the corner at most, and all others from 1.22 to
/// 2, by kind of links. `faces` between particles; `runs` = bodies whose links may be cut.
std::vector<std::uint32_t> excludedPoints(const Scene& scene, std::span<const layout::ContactFace> faces,
                                          std::span<const float> radii, const StateLayout& layout,
                                          std::span<const CutRun> runs = {});

} // namespace sinew::sim::collision::face_contacts
