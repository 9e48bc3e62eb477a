// Contacts of points with faces and of edges with edges, in `split`: temporary constraints, solved after the
// links of a substep and before contacts between particles and boundary planes. Each is a row: four particles
// with weights beta (1 for a point, -b for the corners of a face at the nearest place on it; 1 - s, s,
// -(1 - t), -t for the ends of two edges), a direction n, a depth and a memory. Together they take
//
//   l_c = depth_c / D_c,   x_k += w_k sum_c beta_kc l_c n_c,   D_c = sum_k |beta_kc| w_k S_k,
//   S_k = sum over contacts c' of |beta_kc'|:
//
// a particle gives contact c the part |beta_kc| / S_k of its mass, and parts sum to 1. D_c is the sum of the
// absolute values of row c of J W J^T, so D - J W J^T is diagonally dominant with a diagonal >= 0 and the
// spectral radius of D^-1 J W J^T at most 1: stable, below the 4/3 that the order of `split` needs (contacts:
// 0.1). Friction lies in the same bound, for a row counts every direction. A contact that several faces
// share (an edge, a corner) is not softer for it. Sums have a fixed order, without float atomics.
//
// Whoever finds contacts says which particles a row has (shaders/glsl/row.glsl) and where they touch.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/collision/surfaces.hpp"
#include "sim/forces.hpp"
#include "sim/sleep.hpp"

namespace sinew::sim::collision::row_contacts {

/// A kind of contacts: its kernels.
struct Kind {
    const char* name = nullptr; ///< of buffers
    const vk::ShaderCode* touch = nullptr;
    bool touchesLists = false; ///< whether that runs over owners of lists, not over single rows
    const vk::ShaderCode* share = nullptr;
    const vk::ShaderCode* press = nullptr;
    const vk::ShaderCode* bounce = nullptr;
    const vk::ShaderCode* rebound = nullptr;
    forces::Forms gather{}, gatherRebound{};
    ProgramBuilder::Constants (forces::Forces::*forces)() const = nullptr; ///< elements that these add to
    const vk::ShaderCode* wake = nullptr;
    const vk::ShaderCode* join = nullptr;
};

extern const Kind faces, edges;

/// Work groups in which a pass has something to do.
struct Groups {
    IndirectItems items;
    BufferId listed;
};

/// The rows around each slot of the state: first entry of each, one more for the end, then 4 x face + corner,
/// or 4 x edge + end. Those of faces that a cut may lay open come last, behind `ends`.
struct Corners {
    std::vector<std::uint32_t> entries, ends;
};

/// The table of entries by slot; those of `later` count only once a cut has laid them open.
Corners cornersOf(std::span<const std::vector<std::uint32_t>> first,
                  std::span<const std::vector<std::uint32_t>> later = {});

struct Rows {
    const Kind* kind = nullptr;
    layout::FacePush push{};
    pooled_lists::Lists lists;
    BufferId shapes;        ///< of layout::ContactFace or layout::ContactEdge
    IndirectItems elements; ///< of `lists`, those in use
    BufferId bounds;        ///< of the grid: how many these are
    Groups particles;       ///< whoever is in a row
    surfaces::Surfaces surfaces;
    BufferId marks;         ///< contact_lists::linkedMarks, or anything where nothing needs them
    bool keepsRest = false; ///< any particle

    bool sleeps = false;                    ///< whether the scene may
    BufferId corners, cornerEnds;           ///< as Corners
    BufferId directions, weights, impulses; ///< by element of `lists`
    BufferId bounces;                       ///< likewise; only where something rebounds
    BufferId shares;                        ///< by slot
    BufferId before;                        ///< velocities when the substep began, set in each
    std::vector<BufferId> touching;         ///< what the kernel that finds contacts binds besides
    std::vector<BufferId> forceRows;        ///< likewise those that gather them, where forces are kept
};

/// Makes the buffers of `rows`, of which all up to `keepsRest` is set.
void add(ProgramBuilder& program, Rows& rows, const Corners& corners, const ParticleBuffers& particles);

/// Constants of kernels in which pairs may keep their rest distance. `isFirst`: of the substeps of a step.
ProgramBuilder::Constants restConstants(bool keepsRest, bool isFirst);

/// Joins particles of a row into one island of sleep.
void joinIslands(const Rows& rows, sleep::Sleep& sleep);

/// Finds what touches in the lists that there are, and changes predicted positions and velocities where they
/// stand. `constants` of the kernel that finds it.
void addPasses(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& predicted,
               const ProgramBuilder::Constants& constants);

/// Restitution, after all contacts of a substep, which `state` then is of; nothing where nothing rebounds.
void addBounces(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& state);

/// The end of a step: what contacts remember is saved, or taken back with an undone step.
void addPublishing(ProgramBuilder& program, const Rows& rows, const hash_grid::Grid& grid);

} // namespace sinew::sim::collision::row_contacts
