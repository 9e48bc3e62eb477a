// Impulses of a step: of contacts, planes, colliders, holds and grabs. Kernels that change a velocity by such
// an impulse also add, where forces are kept, mass times this change to elements of the particle
// (shaders/glsl/forces/forces.glsl). Small passes at the end of the step sum the elements in a fixed order,
// by body, plane, collider, hold and grab. The buffer of elements consists of sections of one vec4 for each
// slot of the state,
//
//   contacts | holds | rows: an impulse section and a moment section each | entries: tethers, attachments
//
// with a row for each grab, plane, host collider and collider, and rows for bodies with static faces. Many
// colliders have one row, which bodies read, and whole numbers that sum the impulses on each. Static
// faces have no list of the points near them: each point adds its impulse on them to its own element in a
// row.
#pragma once

#include "common/layout.h"
#include "sim/core/complaints.hpp"
#include "sim/model/feature.hpp"

#include <array>

namespace sinew::sim::forces {

/// Complains about settings that exclude forces, and about holds of particles that do not exist.
void check(const Scene& scene, const Settings& settings, Complaints& complaints);

/// Complains if forces are kept and their elements exceed one buffer of 32 bits. Everything else must be
/// valid.
void checkRoom(const SceneModel& model, Complaints& complaints);

/// Rows of static faces, by body and holds.
struct Stops {
    static constexpr std::uint32_t noBody = ~0u;
    /// Faces of one body whose first corners are in the same holds.
    struct Row {
        std::uint32_t body;               ///< index into Scene::bodies, or noBody
        std::vector<std::uint32_t> holds; ///< indices into Scene::holds, ascending
        std::uint32_t origin;             ///< a static particle of the body: moments are about its position
    };
    std::vector<Row> rows; ///< those of a body side by side; none if no particle can touch a face
    std::vector<std::uint32_t>
        ofParticle; ///< row of the faces whose first corner is the particle; 0 if there is none
};
Stops stopsOf(const SceneModel& model);

/// Layout of the buffer of elements.
struct Forces {
    BufferId terms;
    std::uint32_t slots = 0; ///< elements of a section
    std::uint32_t grabs = 0, planes = 0,
                  colliders = 0;  ///< rows; host colliders are the first of the colliders
    std::uint32_t summed = 0;     ///< colliders of that one row if there are many, else 0
    BufferId colliderForces;      ///< layout::ColliderForce of each of these
    float colliderForceScale = 0; ///< layout::ColliderPush::forceScale
    std::uint32_t tethers = 0;    ///< entries before those of attachments
    std::uint32_t attachments = 0;
    Stops stops;

    std::uint32_t rows() const {
        return grabs + planes + colliders + static_cast<std::uint32_t>(stops.rows.size());
    }
    std::uint32_t firstStop() const { return grabs + planes + colliders; }
    std::uint32_t summedColliders() const { return summed > 0 ? summed : colliders; }
    std::uint32_t sums() const { return rows() - colliders + summedColliders(); } ///< of rows
    std::uint32_t elementOf(std::uint32_t row) const { return (2 + 2 * row) * slots; }
    std::uint32_t firstEntry() const { return elementOf(rows()); }
    std::uint64_t elements() const { return (2 + 2 * std::uint64_t{rows()}) * slots + tethers + attachments; }

    // Constants of kernels where forces are kept.
    ProgramBuilder::Constants ofContacts() const { return constants(0); }
    ProgramBuilder::Constants ofGrabs() const { return constants(elementOf(0)); }
    ProgramBuilder::Constants ofPlanes() const { return constants(elementOf(grabs)); }
    ProgramBuilder::Constants ofColliders() const { return constants(elementOf(grabs + planes)); }
    ProgramBuilder::Constants ofStops() const { return constants(elementOf(firstStop())); }
    ProgramBuilder::Constants ofTethers() const { return constants(firstEntry()); }
    ProgramBuilder::Constants ofAttachments() const { return constants(firstEntry() + tethers); }

private:
    ProgramBuilder::Constants constants(std::uint32_t first) const;
};

/// Sets build.particles.forces: creates the buffer of elements, and appends the pass before the substeps that
/// clears it. Nothing unless forces are kept.
void add(Build& build);

/// Appends the buffer of elements to `buffers` and the start of the section that `of` names to `constants`;
/// if `particles` keep no forces, leaves that binding empty. `of` is Forces::ofPlanes or a similar function.
void bindTo(const ParticleBuffers& particles, ProgramBuilder::Constants (Forces::*of)() const,
            std::vector<BufferId>& buffers, ProgramBuilder::Constants& constants);

/// Appends the passes after the links of a substep of `split`, which has left the forces on static particles
/// in their velocities.
void addPulls(Build& build, const Substep& substep);
/// Specialises the gathers of `split` to leave these forces.
ProgramBuilder::Constants pullConstants();

/// Appends the sums, after public positions have their values at the end of the step.
void addSums(Build& build);

} // namespace sinew::sim::forces
