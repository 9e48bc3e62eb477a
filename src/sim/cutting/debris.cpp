// A removed piece stays a piece by its links, and every step with a cut finds it again: the state after a
// step does not depend on the marks before it.
#include "sim/cutting/debris.hpp"

#include "kernels.hpp"
#include "sim/cutting/debris_skins.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/program/first_contents.hpp"
#include "sim/sleep/sleep.hpp"

namespace sinew::sim::cutting {

namespace {

namespace k = kernels;

// Masses of cuttable particles [kg]; 0 for static ones.
std::vector<double> massesOf(const Scene& scene) {
    std::vector<double> masses(scene.particles.size());
    for (const Grid& grid : scene.grids) {
        if (!grid.isCuttable) continue;
        for (std::uint32_t i = grid.firstParticle; i < grid.firstParticle + grid.node.size(); ++i)
            if (scene.particles[i].inverseMass > 0) masses[i] = 1 / double{scene.particles[i].inverseMass};
    }
    return masses;
}

BufferId uploadParticles(ProgramBuilder& program, const Scene& scene) {
    const std::vector<double> masses = massesOf(scene);
    double all = 0;
    for (const double mass : masses) all += mass;
    CuttingBuffers& buffers = program.program().cutting;
    buffers.debrisUnit = all / DEBRIS_MASS;
    const auto pieces = firstContents<std::uint32_t>(program, buffers.pieces),
               sizes = firstContents<std::uint32_t>(program, buffers.pieceSizes);
    std::vector<layout::DebrisParticle> debris;
    for (std::size_t i = 0; i < masses.size(); ++i)
        debris.push_back(
            {masses[i] > 0 ? static_cast<std::uint32_t>(masses[i] / buffers.debrisUnit) : 0, // the sum fits
             pieces[i] == NO_PARTICLE ? 0 : sizes[pieces[i]]});
    return program.upload("debris.particles", debris);
}

void addToTopology(ProgramBuilder& program, BufferId buffer) {
    program.program().cutting.topology.push_back(buffer);
    program.addToState(buffer, buffer);
}

} // namespace

void addDebris(ProgramBuilder& program, const Scene& scene, Cut& cut, const ParticleBuffers& particles) {
    if (scene.debris < 2) return;
    program.program().cutting.debris = scene.debris;
    cut.debrisParticles = uploadParticles(program, scene);
    cut.debrisSkins = addDebrisSkins(program, scene, cut, particles.layout);
    if (particles.sleep) addToTopology(program, particles.sleep->limits);
}

void addDebrisRemoval(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const CuttingBuffers& buffers = program.program().cutting;
    if (buffers.debris == 0) return;
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    const auto add = [&](const vk::ShaderCode& code, std::initializer_list<BufferId> bound) {
        for (std::uint32_t r = 0; r < runs; ++r) {
            const layout::CutPush& push = cut.runs[r].push;
            program.dispatchIndirect(code, {cut.arguments, 2 * runs + r, push.count}, bound,
                                     layout::DebrisPush{push.first, push.count, buffers.debris});
        }
    };
    add(k::removeDebris,
        {cut.labels, cut.particles, buffers.pieceSizes, buffers.pieces, buffers.counts, cut.debrisParticles});
    add(k::clearDebrisSizes, {cut.particles, buffers.pieces, buffers.pieceSizes});
    for (const ContactGrid& grid : buffers.contactGrids)
        add(k::removeDebrisContacts, {cut.particles, buffers.pieces, grid.radii, grid.bounds});
    if (particles.grabs) add(k::releaseDebris, {cut.particles, buffers.pieces, particles.grabs->bodies});
    if (particles.sleep) add(k::putDebrisToSleep, {cut.particles, buffers.pieces, particles.sleep->limits});
}

} // namespace sinew::sim::cutting
