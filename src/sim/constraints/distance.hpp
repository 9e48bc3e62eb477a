// Distance constraints on the device: what each solver form needs of them. `jacobi` has a constraint pass
// over edges, `gauss_seidel` one over those of each color, `split` gathers them per particle. Constraints
// whose ends both never move are left out.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"
#include "sim/solvers/correction_slots.hpp"

namespace sinew::sim::constraints::distance {

/// The buffers of the constraint pass of `jacobi`.
struct Edges {
    std::uint32_t count = 0, firstSlot = 0;
    BufferId edges, multipliers; ///< multipliers: invalid where every constraint is rigid
    float dampingTime = 0;       ///< of the scene [s]
};

/// Reserves two slots a constraint: first for its end a, then for its end b.
Edges reserve(const Scene& scene, solvers::CorrectionSlots& slots);

/// Uploads the edges; `weights` are the factors the particle pass will apply, one a particle.
void upload(ProgramBuilder& program, const Scene& scene, std::span<const float> weights, Edges& edges);

/// One pass that writes every correction of this type.
void addPass(ProgramBuilder& program, const ParticleBuffers& particles, const Edges& edges,
             BufferId corrections, bool isFirstIteration);

/// The buffers of the passes of `gauss_seidel`: edges by color, each color padded to whole work groups.
struct ColoredEdges {
    struct Color {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Color> colors;
    BufferId edges, multipliers; ///< multipliers: invalid where nothing needs them
    std::uint32_t degree = 0;    ///< slots a particle of the warm start; 0 = starts cold
    BufferId links;              ///< of the warm start
    bool usesTexels = true;
    ProgramBuilder::Constants constants() const; ///< specialises degree
};
ColoredEdges uploadColors(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                          const StateLayout& layout);

/// Which sweep of a step this is.
struct Sweep {
    bool isOpening = false; ///< the first of the step
    bool isClosing = false; ///< the last of its substep
};
/// One pass a color, in place in `corrections` of the predicted positions.
void addSweep(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredEdges& edges,
              BufferId corrections, float warmStart, Sweep sweep);
/// Internal damping of the velocities that a substep of `gauss_seidel` ends with: one pass a color.
void addDamping(ProgramBuilder& program, const ParticleBuffers& particles, const ColoredEdges& edges,
                float dampingTime);

/// Whether a constraint has an end that moves; others are left out of every pass.
bool canMove(const DistanceConstraint& constraint, std::span<const float> inverseMass);

/// A constraint as `split` lists it: between slots of the solver's state.
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
    GatherLink stiffest;       ///< of its links
};

/// The adjacency of `split`, padded to `degree` slots with links of a particle to itself. Groups: at most
/// PACKED_GROUPS, where slots can be sorted so without much more padding, else none.
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
/// Whether slots for all would be mostly padding: a few particles have many more links than the others.
bool isIrregular(std::span<const GatherLink> links, std::size_t particles);
/// The adjacency of `split` without slots: the links of particle i are links[first[i]] to links[first[i +
/// 1]].
struct RangedLinks {
    std::vector<layout::SplitLink> links;
    std::vector<std::uint32_t> first; ///< of `particles` rounded up to whole work groups, and the end
};
RangedLinks rangedLinks(std::span<const GatherLink> links, std::size_t particles);

/// Gives a list without links so many slots of padding, for kernels that gather something else as well.
void pad(GatherLinks& links, std::uint32_t degree);

/// The links in the packed form (layout.h), with the stiffness unit of every group; no links where the scene
/// does not fit: no groups, too many particles, or a stiffness that no code gives to within float rounding.
struct PackedLinks {
    std::vector<std::uint32_t> links;
    std::vector<float> units, shares; ///< for each code of each group [N/m]
};
PackedLinks pack(const GatherLinks& links);

} // namespace sinew::sim::constraints::distance
