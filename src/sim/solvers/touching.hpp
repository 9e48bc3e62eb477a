// The contacts of a scene, in `split`: with faces, between edges, between particles; and the end of a substep
// in which particles do not touch each other.
#pragma once

#include "sim/collision/cut_faces.hpp"
#include "sim/collision/edge_contacts.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/collision/particle_contacts.hpp"
#include "sim/model/feature.hpp"

#include <optional>

namespace sinew::sim::solvers {

/// The contacts of a scene in the order of their passes: of particles with faces, of edges of faces, of
/// particles with particles.
struct Touching {
    std::optional<collision::face_contacts::Contacts> faces;
    std::optional<collision::edge_contacts::Contacts> edges;
    std::optional<collision::particle_contacts::Contacts> pairs;
    std::vector<collision::CutFilter> filters; ///< of faces, then of edges
    BufferId before;                           ///< velocities at the start of the substep
    /// Planes and the slots that hold a particle; only if no particles touch each other.
    rigid::planes::Planes planes;
    BufferId particles;
    std::uint32_t particleCount = 0;

    /// Starts a substep with these velocities, which stay until its contacts are solved.
    void begin(BufferId velocities);
    /// Appends the contacts of a substep: from predicted positions and velocities to those of `next`.
    void addPasses(ProgramBuilder& program, const ParticleBuffers& predicted, const ParticleBuffers& next,
                   bool isFirst) const;
    /// Appends restitution after all contacts of a substep; velocities alternate.
    void addBounces(ProgramBuilder& program, const ParticleBuffers& met, ParticleBuffers& current);
    /// Appends what keeps particles in front of faces, after projections.
    void addStops(ProgramBuilder& program, const ParticleBuffers& predicted,
                  const ParticleBuffers& state) const;
    /// Appends what takes recoils back, after all else that moves particles in a substep.
    void addRecoils(ProgramBuilder& program, const ParticleBuffers& predicted, const ParticleBuffers& state,
                    std::uint32_t substep) const;
    /// Whether recoils regard what static and driven faces give.
    bool receivesRows() const { return pairs && pairs->recoils.exist() && faces && faces->hasStops(); }
    /// Whether a particle may end a substep at another position than its velocity gives.
    bool moveUnseen() const {
        return pairs || (faces && (faces->hasStops() || faces->zones.exist() || faces->separations.exist()));
    }
};

/// Adds the buffers of contacts, their islands of sleep, and the updates of a step with a blade before its
/// substeps; keeps them.
Touching& addTouching(Build& build);
/// Appends these updates again, after links were restored.
void addCutFilters(Build& build);
/// Appends the end of a step: saves the memory of contacts, or restores it after an undone step.
void addContactMemory(Build& build);

} // namespace sinew::sim::solvers
