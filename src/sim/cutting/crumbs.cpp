// A removed piece stays a piece by its links, and every step with a cut finds it again: the state after a
// step does not depend on the marks before it.
#include "sim/cutting/crumbs.hpp"

#include "kernels.hpp"
#include "sim/cutting/crumb_skins.hpp"
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
    buffers.crumbUnit = all / CRUMB_MASS;
    const auto pieces = firstContents<std::uint32_t>(program, buffers.pieces),
               sizes = firstContents<std::uint32_t>(program, buffers.pieceSizes);
    std::vector<layout::CrumbParticle> crumbs;
    for (std::size_t i = 0; i < masses.size(); ++i)
        crumbs.push_back(
            {masses[i] > 0 ? static_cast<std::uint32_t>(masses[i] / buffers.crumbUnit) : 0, // the sum fits
             pieces[i] == NO_PARTICLE ? 0 : sizes[pieces[i]]});
    return program.upload("crumbs.particles", crumbs);
}

void addToTopology(ProgramBuilder& program, BufferId buffer) {
    program.program().cutting.topology.push_back(buffer);
    program.carry(buffer, buffer);
}

} // namespace

void addCrumbs(ProgramBuilder& program, const Scene& scene, Cut& cut, const ParticleBuffers& particles) {
    if (scene.crumbs < 2) return;
    program.program().cutting.crumbs = scene.crumbs;
    cut.crumbParticles = uploadParticles(program, scene);
    cut.stretched = addCrumbSkins(program, scene, cut, particles.layout);
    if (particles.sleep) addToTopology(program, particles.sleep->limits);
}

void addCrumbRemoval(ProgramBuilder& program, const Cut& cut, const ParticleBuffers& particles) {
    const CuttingBuffers& buffers = program.program().cutting;
    if (buffers.crumbs == 0) return;
    const auto runs = static_cast<std::uint32_t>(cut.runs.size());
    const auto add = [&](const vk::ShaderCode& code, std::initializer_list<BufferId> bound) {
        for (std::uint32_t r = 0; r < runs; ++r) {
            const layout::CutPush& push = cut.runs[r].push;
            program.dispatchIndirect(code, {cut.arguments, 2 * runs + r, push.count}, bound,
                                     layout::CrumbPush{push.first, push.count, buffers.crumbs});
        }
    };
    add(k::removeCrumbs,
        {cut.labels, cut.particles, buffers.pieceSizes, buffers.pieces, buffers.counts, cut.crumbParticles});
    add(k::forgetCrumbs, {cut.particles, buffers.pieces, buffers.pieceSizes});
    for (const ContactGrid& grid : buffers.contactGrids)
        add(k::leaveContacts, {cut.particles, buffers.pieces, grid.radii, grid.bounds});
    if (particles.grabs) add(k::dropCrumbs, {cut.particles, buffers.pieces, particles.grabs->bodies});
    if (particles.sleep) add(k::restCrumbs, {cut.particles, buffers.pieces, particles.sleep->limits});
}

} // namespace sinew::sim::cutting
