// Distance constraints on the device, for each solver form: `jacobi` has a constraint pass over edges,
// `gauss_seidel` a pass over the edges of each color, `split` gathers edges per particle. Constraints without
// a moving end are left out.
#pragma once

#include "common/layout.h"
#include "sim/constraints/correction_slots.hpp"
#include "sim/model/scene_model.hpp"

namespace sinew::sim::constraints::distance {

/// The buffers of the constraint pass of `jacobi`.
struct Edges {
    std::uint32_t count = 0, firstSlot = 0;
    BufferId edges, multipliers; ///< multipliers: invalid if every constraint is rigid
    float dampingTime = 0;       ///< of the scene [s]
};

/// Reserves two slots a constraint: first for its end a, then for its end b.
Edges reserve(const SceneModel& model, CorrectionSlots& slots);

/// Uploads the edges; `weights` are the factors that the particle pass will apply, one a particle.
void upload(ProgramBuilder& program, const SceneModel& model, std::span<const float> weights, Edges& edges);

/// Appends the pass that writes every correction of this type.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Edges& edges,
             BufferId corrections, bool isFirstIteration);

/// The buffers of the passes of `gauss_seidel`: edges by color, each color padded to whole work groups.
struct ColoredEdges {
    struct Color {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Color> colors;
    BufferId edges, multipliers;                 ///< multipliers: invalid if nothing needs them
    std::uint32_t degree = 0;                    ///< slots a particle of the warm start; 0 = no warm start
    BufferId links;                              ///< of the warm start
    ProgramBuilder::Constants constants() const; ///< specialises degree
};
ColoredEdges uploadColors(ProgramBuilder& program, const SceneModel& model);

/// Position of a sweep in a step.
struct Sweep {
    bool isOpening = false; ///< the first of the step
    bool isClosing = false; ///< the last of its substep
};
/// Appends one pass a color, in place in `corrections` of the predicted positions.
void addSweep(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredEdges& edges,
              BufferId corrections, float warmStart, Sweep sweep);
/// Appends the internal damping of the velocities at the end of a substep of `gauss_seidel`: one pass a
/// color.
void addDamping(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredEdges& edges,
                float dampingTime);

/// Whether a constraint has an end that moves; others are left out of every pass.
bool canMove(const DistanceConstraint& constraint, std::span<const float> inverseMass);

/// A constraint in the list of `split`: between slots of the solver's state.
struct GatherLink {
    std::uint32_t a = 0, b = 0;
    float restLength = 0; ///< [m]
    float stiffness = 0;  ///< [N/m]
    float share = 0;      ///< k~ of solvers/shares.hpp [N/m]
};

/// Slots of the adjacency of `split` whose links share a rest length.
struct LinkGroup {
    std::uint32_t endSlot = 0; ///< one past the last
    float restLength = 0;      ///< [m]
    GatherLink stiffest;       ///< of the group
};

/// The adjacency of `split`, padded to `degree` slots with links of a particle to itself. There are at most
/// PACKED_GROUPS groups, and only if sorting slots by group adds little padding; else none.
struct GatherLinks {
    std::size_t particles = 0;
    std::uint32_t degree = 0;
    std::vector<layout::SplitLink> links; ///< in blocks of LINK_BLOCK particles: see layout.h
    std::vector<LinkGroup> groups;
    std::size_t element(std::size_t particle, std::uint32_t slot) const {
        return (particle / LINK_BLOCK * degree + slot) * LINK_BLOCK + particle % LINK_BLOCK;
    }
};
GatherLinks gatherLinks(std::span<const GatherLink> links, std::size_t particles);
/// Whether slots for all links would be mostly padding: a few particles have many more links than the others.
bool isIrregular(std::span<const GatherLink> links, std::size_t particles);
/// The adjacency of `split` without slots: the links of particle i are links[first[i]] to links[first[i + 1]
/// - 1].
struct RangedLinks {
    std::vector<layout::SplitLink> links;
    std::vector<std::uint32_t> first; ///< for `particles` rounded up to whole work groups, and the end
};
RangedLinks rangedLinks(std::span<const GatherLink> links, std::size_t particles);

/// Pads an empty list to `degree` slots, for kernels that also gather other terms.
void pad(GatherLinks& links, std::uint32_t degree);

/// The links in the packed form (layout.h), with the stiffness unit of every group. Empty if the scene does
/// not fit: no groups, too many particles, or a stiffness that no code represents to within float rounding.
struct PackedLinks {
    std::vector<std::uint32_t> links;
    std::vector<float> units, shares; ///< for each code of each group [N/m]
};
PackedLinks pack(const GatherLinks& links);

} // namespace sinew::sim::constraints::distance
