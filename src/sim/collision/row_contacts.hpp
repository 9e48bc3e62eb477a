// Contacts of points with faces and of edges with edges, in `split`: temporary constraints, solved after the
// links of a substep and before contacts between particles and boundary planes. Each contact is a row: four
// particles with weights beta (1 for a point, -b for the corners of a face, with b the barycentric
// coordinates of its nearest point; 1 - s, s, -(1 - t), -t for the ends of two edges), a direction n, a depth
// and a memory. All rows together apply
//
//   l_c = depth_c / D_c,   x_k += w_k sum_c beta_kc l_c n_c,   D_c = sum_k |beta_kc| w_k S_k,
//   S_k = sum over contacts c' of |beta_kc'|:
//
// a particle gives contact c the share |beta_kc| / S_k of its mass, and shares sum to 1. D_c is the sum of
// the absolute values of row c of J W J^T, so D - J W J^T is diagonally dominant with a diagonal >= 0 and the
// spectral radius of D^-1 J W J^T is at most 1: stable, below the bound 4/3 that the update order of `split`
// requires. Friction is within the same bound, because a row counts every direction. A contact shared by
// several faces (an edge, a corner) does not become softer. Sums have a fixed order, without float atomics.
//
// The code that finds contacts sets the particles of a row (shaders/glsl/collision/row.glsl) and the contact
// point.
#pragma once

#include "sim/collision/pooled_lists.hpp"
#include "sim/collision/surfaces.hpp"
#include "sim/forces/forces.hpp"
#include "sim/model/state.hpp"
#include "sim/sleep/sleep.hpp"

#include <array>

namespace sinew::sim::collision::row_contacts {

/// The differences between contacts of points with faces and contacts of edges.
struct Kind {
    const char* name = nullptr; ///< of buffers
    bool areEdges = false;
    const vk::ShaderCode* touch = nullptr; ///< finds contacts
    std::uint32_t searched = 0;            ///< the list that `touch` visits, as in touched.h
    ProgramBuilder::Constants (forces::Forces::*forces)() const = nullptr; ///< elements of impulses
    /// Constants of all kernels of rows.
    ProgramBuilder::Constants constants() const {
        constexpr std::uint32_t areEdgesId = 8; // constant_id in row_kind.glsl
        return {{areEdgesId, areEdges}};
    }
};

extern const Kind faces, edges;

/// Work groups for which a pass has work.
struct Groups {
    IndirectItems items;
    BufferId listed;
};

/// The rows around each slot of the state: first entry of each, one more for the end, then 4 x face + corner,
/// or 4 x edge + end. Rows of faces that a cut may expose come last, behind `ends`.
struct Corners {
    std::vector<std::uint32_t> entries, ends;
};

/// The table of entries by slot; those of `later` count only once a cut has exposed them.
Corners cornersOf(std::span<const std::vector<std::uint32_t>> first,
                  std::span<const std::vector<std::uint32_t>> later = {});

struct Rows {
    const Kind* kind = nullptr;
    layout::FacePush push{};
    pooled_lists::Lists lists;
    BufferId shapes;            ///< layout::ContactFace or layout::ContactEdge
    IndirectItems elements;     ///< used entries of `lists`
    BufferId bounds;            ///< of the grid: holds the number of entries
    Groups particles;           ///< work groups with a particle in a row
    hash_grid::Touched touched; ///< what touches in a substep
    surfaces::Surfaces surfaces;
    BufferId marks;         ///< contact_lists::linkedMarks; another buffer if the kernels read none
    bool keepsRest = false; ///< of any particle

    bool sleeps = false;                    ///< whether the scene may sleep
    BufferId corners, cornerEnds;           ///< see Corners
    BufferId directions, weights, impulses; ///< by element of `lists`
    BufferId shares;                        ///< by slot
    BufferId before;                        ///< velocities at the start of the substep, set in each
    std::vector<BufferId> touching;         ///< additional buffers of the kernel that finds contacts
    /// Rows of static faces, their places and candidates, for the impulses on them; only of faces.
    std::array<BufferId, 3> forceRows{unbound, unbound, unbound};
};

/// Makes the buffers of `rows`; members up to `keepsRest` must be set.
void add(ProgramBuilder& program, Rows& rows, const Corners& corners, const ParticleBuffers& particles);

/// Appends a pass over the work groups with a particle in a row, or over the used entries of the lists. The
/// kernel gets the list of these groups, or the bounds of the grid, after `buffers`.
void addOverParticles(ProgramBuilder& program, const Rows& rows, const vk::ShaderCode& code,
                      std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants = {});
void addOverRows(ProgramBuilder& program, const Rows& rows, const vk::ShaderCode& code,
                 std::vector<BufferId> buffers, const ProgramBuilder::Constants& constants = {});

/// Appends a pass over what touches: `list` as in touched.h. The kernel gets the lists after `buffers`.
void addOverTouched(ProgramBuilder& program, const Rows& rows, std::uint32_t list, const vk::ShaderCode& code,
                    std::vector<BufferId> buffers, ProgramBuilder::Constants constants = {});

/// The lists of what touches, for `rows` that have `room` candidates and as many slots as the state.
hash_grid::Touched addTouched(ProgramBuilder& program, const std::string& name, std::uint32_t slots,
                              std::uint32_t room);

/// Constants of kernels with pairs that may keep their rest distance. `isFirst`: first substep of a step.
ProgramBuilder::Constants restConstants(bool keepsRest, bool isFirst);

/// Joins particles of a row into one island of sleep.
void joinIslands(const Rows& rows, sleep::Sleep& sleep);

/// Appends passes that find contacts in the present lists, and change predicted positions and velocities in
/// place. `constants` are those of the kernel that finds contacts.
void addPasses(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& predicted,
               const ProgramBuilder::Constants& constants);

/// Appends restitution, after all contacts of a substep, on its final `state`; nothing without restitution.
void addBounces(ProgramBuilder& program, const Rows& rows, const ParticleBuffers& state);

/// Appends the end of a step: saves the memory of contacts, or restores it after an undone step.
void addPublishing(ProgramBuilder& program, const Rows& rows, const hash_grid::Grid& grid);

} // namespace sinew::sim::collision::row_contacts
