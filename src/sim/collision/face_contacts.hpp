// Particles that touch triangles, in `split`: temporary constraints, solved after the links of a substep and
// before contacts between particles and boundary planes. A point p with weight 1 and the corners with the
// weights b of the nearest place on the face (beta = 1, -b_0, -b_1, -b_2) take
//
//   l_c = depth_c / D_c,   x_k += w_k sum_c beta_kc l_c n_c,   D_c = sum_k |beta_kc| w_k S_k,
//   S_k = sum over contacts c' of |beta_kc'|:
//
// a particle gives contact c the part |beta_kc| / S_k of its mass, and parts sum to 1. D_c is the sum of the
// absolute values of row c of J W J^T, so D - J W J^T is diagonally dominant with a diagonal >= 0 and the
// spectral radius of D^-1 J W J^T at most 1: stable, below the 4/3 that the order of `split` needs (contacts:
// 0.1). Friction lies in the same bound, for a row counts every direction. A contact that several faces
// share (an edge, a corner) is not softer for it. A scene in which nothing touches a face has none of this.
#pragma once

#include "sim/collision/face_lists.hpp"
#include "sim/collision/surfaces.hpp"

namespace sinew::sim::collision::face_contacts {

/// Whether a particle of the scene may touch a face: one with a radius, and it or a face can move.
bool areIn(const Scene& scene);

/// The radius with which a particle touches others as a ball, by particle [m]: 0 where faces around it as
/// thick as itself do so instead.
std::vector<float> looseRadii(const Scene& scene);

struct Contacts {
    face_lists::Lists lists;
    layout::FacePush push{};
    std::uint32_t faces = 0;      ///< of all kinds
    std::uint32_t firstInner = 0; ///< from there to push.moving: there only once a cut lays them open
    /// By face: a half of a square between two cells of a voxel body that may be cut, or beside one.
    std::vector<bool> isOfCells;
    BufferId opened;     ///< by face: whether this step has opened it; only where some are of cells
    bool sleeps = false; ///< whether the scene may
    surfaces::Surfaces surfaces;
    BufferId corners, directions, weights, shares, impulses;
    BufferId cornerEnds;    ///< by slot: behind the last face of it in `corners` that counts
    BufferId marks;         ///< contact_lists::linkedMarks; only where something keeps its rest or hasSolid()
    bool keepsRest = false; ///< of any particle
    BufferId bounces;       ///< only where something rebounds
    BufferId before;        ///< velocities when the substep began, set in each
    /// Positions and velocities that links have left; only where hasStops().
    BufferId linkedPositions, linkedVelocities;
    BufferId movingPoints; ///< slots of points that move; only where hasStops()
    BufferId stopRows; ///< of each face (forces::Stops); only where forces are kept and a point moves, too
    std::uint32_t movingPointCount = 0;

    bool hasInner() const { return firstInner < push.moving; }
    bool hasSolid() const { return push.sheets < push.moving; }
    /// Whether some face never gives way.
    bool hasStops() const { return lists.push.moving < faces; }
};

/// Only where areIn().
Contacts add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
             const ParticleBuffers& particles);

/// Constants of kernels in which pairs may keep their rest distance. `isFirst`: of the substeps of a step.
ProgramBuilder::Constants restConstants(bool keepsRest, bool isFirst);

/// Particles and faces that touch sleep together.
void joinIslands(const Contacts& contacts, sleep::Sleep& sleep);

/// Changes predicted positions and velocities where they stand. `isFirst`: of a step.
void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               bool isFirst);

/// Restitution, after all contacts of a substep, which `state` then is of; nothing where nothing rebounds.
void addBounces(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state);

/// Keeps particles in front of faces that never give way, exactly: after all other passes of a substep but
/// colliders, on `state`. Nothing where there is no such face.
void addStops(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& state);

/// The end of a step: what contacts remember is saved, or taken back with an undone step.
void addPublishing(ProgramBuilder& program, const Contacts& contacts);

/// Points that a face never touches though they are not its corners, as face_lists::Request says: those of
/// its own linked body that are nearer than 1.05 times touching at rest, and of a voxel body those that a
/// link joins to a corner. Those are 1.73 spacings away from the corner at most, and all others from 1.41 to
/// 2, by kind of links. `faces` between particles; `runs` = bodies whose links may be cut.
std::vector<std::uint32_t> excludedPoints(const Scene& scene, std::span<const layout::ContactFace> faces,
                                          std::span<const float> radii, const StateLayout& layout,
                                          std::span<const CutRun> runs = {});

} // namespace sinew::sim::collision::face_contacts
