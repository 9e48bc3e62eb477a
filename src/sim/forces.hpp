// The impulses of a step: of contacts, planes, colliders, holds and hands. Kernels that change a
// velocity by one of these have a form that also adds mass times that change to elements of the particle's
// own (shaders/glsl/forces.glsl). Small passes at the end of the step sum these up in a fixed order, by body,
// plane, collider, hold and hand. The buffer of elements consists of sections of one vec4 a slot of the
// state,
//
//   contacts | holds | rows: an impulse section and a moment section each | entries: tethers, attachments
//
// with a row for each hand, plane, poke and collider, and rows for bodies with faces that never move. Such
// faces do not know the points near them: each point adds what they give to it to an element of its own in a
// row.
#pragma once

#include "layout.h"
#include "sim/compile.hpp"
#include "sim/complaints.hpp"

#include <array>

namespace sinew::sim::forces {

/// Complains about settings with which forces cannot be kept, and about holds of particles that do not exist.
void check(const Scene& scene, const Settings& settings, Complaints& complaints);

/// Complains where forces are kept and their elements do not fit into one buffer of 32 bits. All else must be
/// right.
void checkRoom(const Scene& scene, const Settings& settings, Complaints& complaints);

/// Faces that never move, by body and holds.
struct Stops {
    static constexpr std::uint32_t noBody = ~0u;
    /// Faces of one body, the first corners of which are in the same holds.
    struct Row {
        std::uint32_t body;               ///< index into Scene::bodies, or noBody
        std::vector<std::uint32_t> holds; ///< indices into Scene::holds, ascending
        std::uint32_t origin; ///< a particle of the body that never moves: moments are about its place
    };
    std::vector<Row> rows; ///< those of a body side by side; none where no particle can touch a face
    std::vector<std::uint32_t>
        ofParticle; ///< the row of faces that begin with the particle; 0 where it has none
};
/// Indices of particles and faces must be right.
Stops stopsOf(const Scene& scene, const Settings& settings);

/// The place of each impulse in the buffer of elements.
struct Forces {
    BufferId terms;
    std::uint32_t slots = 0;                            ///< elements of a section
    std::uint32_t grabs = 0, planes = 0, colliders = 0; ///< rows; pokes are the first of the colliders
    std::uint32_t tethers = 0;                          ///< entries before those of attachments
    std::uint32_t attachments = 0;
    Stops stops;

    std::uint32_t rows() const {
        return grabs + planes + colliders + static_cast<std::uint32_t>(stops.rows.size());
    }
    std::uint32_t firstStop() const { return grabs + planes + colliders; }
    std::uint32_t elementOf(std::uint32_t row) const { return (2 + 2 * row) * slots; }
    std::uint32_t firstEntry() const { return elementOf(rows()); }
    std::uint64_t elements() const { return (2 + 2 * std::uint64_t{rows()}) * slots + tethers + attachments; }

    // Constants that specialise the forms of kernels.
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

/// Before the substeps: room for all impulses, none so far.
std::shared_ptr<const Forces> add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                                  const StateLayout& layout);

/// A kernel, and its form that also keeps the impulses that it gives.
using Forms = std::array<const vk::ShaderCode*, 2>;

/// The one that `particles` ask for. For the second, `buffers` end with the elements, and `constants` say
/// where in them its own begin: `of` is Forces::ofPlanes or another of these.
const vk::ShaderCode& formFor(const ParticleBuffers& particles, const Forms& forms,
                              ProgramBuilder::Constants (Forces::*of)() const, std::vector<BufferId>& buffers,
                              ProgramBuilder::Constants& constants);

/// After the links of a substep of `split`, which has left in the velocities of what never moves what pulls
/// at it.
void addPulls(ProgramBuilder& program, const ParticleBuffers& particles);
/// Specialises the gathers of `split`, so that they do.
ProgramBuilder::Constants pullConstants();

/// After public positions are those of the end of the step.
void addSums(ProgramBuilder& program, const Scene& scene, const ParticleBuffers& particles);

} // namespace sinew::sim::forces
