// Orders the one pass of `split`. Positions alternate between two buffers; the state always ends in the
// first.
#include "sim/solvers/split.hpp"

#include "kernels.hpp"
#include "sim/collision/planes.hpp"
#include "sim/constraints/distance.hpp"

#include <algorithm>
#include <limits>

namespace sinew::sim::solvers::split {

namespace {

constexpr std::uint32_t degreeId = 1, firstGroupEndId = 3; // constant_id in gather_split.glsl

// Uniform shares: min(kappa_a, kappa_b) never exceeds omega / (n_a w_a + n_b w_b), the bound of a clamped
// link.
float clampOf(float omega, std::uint32_t links, float inverseMass) {
    if (links == 0 || inverseMass == 0) return std::numeric_limits<float>::max();
    return omega / (2 * static_cast<float>(links) * inverseMass);
}

// A kernel without and with boundary planes.
struct Form {
    const vk::ShaderCode *plain, *planes;
    const vk::ShaderCode* code(bool hasPlanes) const { return hasPlanes ? planes : plain; }
};
constexpr Form drift{&kernels::driftSplit, &kernels::driftSplitPlanes};
constexpr Form general{&kernels::gatherSplit, &kernels::gatherSplitPlanes};
constexpr Form packed{&kernels::gatherSplitPacked, &kernels::gatherSplitPackedPlanes};

// The kernel for what the scene has, and the buffers that come after positions, next, velocities and step.
struct Gather {
    const vk::ShaderCode* code = nullptr;
    std::vector<BufferId> buffers;
    ProgramBuilder::Constants constants;
    layout::PackedSubstepPush push{}; // groups: of the packed form
};

void addPackedLinks(ProgramBuilder& program, const constraints::distance::GatherLinks& links,
                    const constraints::distance::PackedLinks& packedLinks, Gather& gather) {
    for (std::uint32_t group = 0; group < PACKED_GROUPS; ++group) {
        const std::size_t existing = std::min<std::size_t>(group, links.groups.size() - 1);
        gather.push.restLengths[group] = links.groups[existing].restLength;
        gather.push.units[group] = packedLinks.units[existing];
        if (group + 1 < PACKED_GROUPS)
            gather.constants[firstGroupEndId + group] = links.groups[existing].endSlot;
    }
    gather.buffers.push_back(program.upload("distance.links", packedLinks.links));
}

Gather addGather(ProgramBuilder& program, const Scene& scene) {
    Gather gather;
    const collision::planes::Colliders colliders = collision::planes::addColliders(program, scene);
    const bool hasPlanes = colliders.count > 0;
    if (hasPlanes) {
        gather.buffers = {colliders.planes, colliders.contactOffsets};
        gather.constants = colliders.constants();
    }
    const auto links = constraints::distance::gatherLinks(scene, inverseMasses(scene));
    if (links.degree == 0) {
        gather.code = drift.code(hasPlanes);
        return gather;
    }
    gather.constants[degreeId] = links.degree;
    const auto packedLinks = constraints::distance::pack(links);
    if (!packedLinks.links.empty()) {
        gather.code = packed.code(hasPlanes);
        addPackedLinks(program, links, packedLinks, gather);
    } else {
        gather.code = general.code(hasPlanes);
        gather.buffers.push_back(program.upload("distance.links", links.links));
    }
    return gather;
}

void addSubstep(ProgramBuilder& program, const Gather& gather, std::uint32_t count,
                std::span<const BufferId> buffers, bool isFirst) {
    layout::PackedSubstepPush push = gather.push;
    push.count = count;
    push.isFirst = isFirst;
    if (gather.code == packed.plain || gather.code == packed.planes) {
        program.dispatch(*gather.code, count, buffers, push, gather.constants);
    } else {
        program.dispatch(*gather.code, count, buffers, layout::SubstepPush{count, isFirst}, gather.constants);
    }
}

} // namespace

std::vector<float> positionW(const Scene& scene, const Settings& settings) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    const auto links = constraints::distance::gatherLinks(scene, inverseMass);
    std::vector<float> clamps;
    clamps.reserve(inverseMass.size());
    for (std::size_t i = 0; i < inverseMass.size(); ++i) {
        clamps.push_back(clampOf(settings.omega, links.count[i], inverseMass[i]));
    }
    return clamps;
}

void addPasses(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               const ParticleBuffers& particles) {
    const Gather gather = addGather(program, scene);
    BufferId current = particles.positions;
    BufferId next = program.scratch<layout::vec4>("state.next_positions", paddedCount(particles.count));
    for (std::uint32_t substep = 0; substep < settings.substeps; ++substep) {
        program.beginSubstep();
        std::vector<BufferId> buffers{current, next, particles.velocities, particles.step};
        buffers.insert(buffers.end(), gather.buffers.begin(), gather.buffers.end());
        addSubstep(program, gather, particles.count, buffers, substep == 0);
        std::swap(current, next);
    }
    program.endSubsteps();
    if (current != particles.positions) program.copy(current, particles.positions);
    if (gather.constants.contains(degreeId)) program.program().sweeps = settings.substeps;
}

} // namespace sinew::sim::solvers::split
