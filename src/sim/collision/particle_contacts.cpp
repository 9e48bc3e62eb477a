// The host side of contacts between particles: which form of each kernel, and the order of the passes.
#include "sim/collision/particle_contacts.hpp"

#include "kernels.hpp"
#include "sim/ranges.hpp"

#include <algorithm>
#include <array>

namespace sinew::sim::collision::particle_contacts {

namespace {

namespace k = kernels;

// gather_contacts without and with friction; [0] without planes, [1] with, [2] with planes that rebound.
using Forms = std::array<std::array<const vk::ShaderCode*, 3>, 2>;
constexpr Forms texelForms{
    {{&k::gatherContacts, &k::gatherContactsPlanes, &k::gatherContactsRebound},
     {&k::gatherContactsFriction, &k::gatherContactsFrictionPlanes, &k::gatherContactsFrictionRebound}}};
constexpr Forms loadForms{
    {{&k::gatherContactsLoads, &k::gatherContactsPlanesLoads, &k::gatherContactsReboundLoads},
     {&k::gatherContactsFrictionLoads, &k::gatherContactsFrictionPlanesLoads,
      &k::gatherContactsFrictionReboundLoads}}};

const vk::ShaderCode& gatherForm(const Contacts& contacts) {
    const Forms& forms = contacts.lists.grid.usesTexels ? texelForms : loadForms;
    const std::size_t planes = contacts.planes.count == 0 ? 0 : contacts.hasRebound ? 2 : 1;
    return *forms[contacts.hasFriction ? 1 : 0][planes];
}

// By state slot; below 0 = touches nothing.
std::vector<float> radiiOf(const Scene& scene, const StateLayout& layout) {
    std::vector<float> radii(layout.count, -1);
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        if (scene.particles[i].radius > 0) radii[layout.slot[i]] = scene.particles[i].radius;
    return radii;
}

float medianRadius(const Scene& scene) {
    std::vector<float> radii;
    for (const Particle& particle : scene.particles)
        if (particle.radius > 0) radii.push_back(particle.radius);
    std::ranges::nth_element(radii, radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2));
    return radii[radii.size() / 2];
}

contact_lists::Exclusions exclusionsOf(const Scene& scene, const StateLayout& layout) {
    std::vector<float> radii;
    for (const Particle& particle : scene.particles)
        radii.push_back(particle.radius > 0 ? particle.radius : -1);
    return contact_lists::excludedPairs(scene, radii, layout);
}

void addListUpdate(ProgramBuilder& program, const Contacts& contacts, BufferId positions) {
    const contact_lists::Lists& lists = contacts.lists;
    contact_lists::addWatch(program, lists, positions);
    if (contacts.hasFriction)
        program.dispatchIndirect(
            k::keepSlips, lists.grid.particles,
            {lists.contacts, lists.counts, contacts.slips, contacts.kept, contacts.keptCounts}, lists.push);
    contact_lists::addLists(program, lists, positions);
    if (contacts.hasFriction)
        program.dispatchIndirect(
            k::returnSlips, lists.grid.particles,
            {lists.contacts, lists.counts, contacts.slips, contacts.kept, contacts.keptCounts}, lists.push);
}

} // namespace

bool areIn(const Scene& scene) {
    std::size_t wide = 0, moving = 0;
    const std::vector<float> inverseMass = inverseMasses(scene);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        if (scene.particles[i].radius <= 0) continue;
        ++wide;
        moving += inverseMass[i] > 0 ? 1 : 0;
    }
    return wide > 1 && moving > 0;
}

Contacts add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
             const StateLayout& layout) {
    const std::vector<float> radii = radiiOf(scene, layout);
    Contacts contacts{
        .lists = contact_lists::add(program, {.radii = radii,
                                              .margin = settings.contactMargin * medianRadius(scene),
                                              .capacity = settings.contactRoom,
                                              .limit = ranges::mostContactRoom,
                                              .exclusions = exclusionsOf(scene, layout),
                                              .usesTexels = settings.forms.usesTexels}),
        .planes = planes::addColliders(program, scene, layout),
        .hasFriction = scene.contacts.friction > 0,
        .hasRebound =
            std::ranges::any_of(scene.planes, [](const Plane& plane) { return plane.restitution > 0; })};
    const std::uint32_t row = contacts.lists.push.row;
    contacts.push = {contacts.lists.push.count, row, scene.contacts.friction};
    contacts.touching = program.scratch<layout::vec4>("contacts.touching", layout.count);
    if (contacts.hasFriction) {
        const std::size_t elements = std::size_t{row} * settings.contactRoom;
        contacts.slips = program.scratch<layout::vec4>("contacts.slips", elements);
        contacts.kept = program.scratch<layout::vec4>("contacts.kept", elements);
        contacts.keptCounts = program.scratch<std::uint32_t>("contacts.kept_counts", layout.count);
        contacts.saved = program.scratch<layout::vec4>("contacts.slips.saved", elements);
        contacts.savedCounts = program.scratch<std::uint32_t>("contacts.counts.saved", layout.count);
        for (const BufferId buffer : {contacts.lists.contacts, contacts.lists.counts, contacts.slips,
                                      contacts.saved, contacts.savedCounts})
            program.carry(buffer, buffer);
    }
    if (contacts.hasRebound) contacts.before = program.scratch<layout::vec4>("contacts.before", layout.count);
    return contacts;
}

void addOpening(ProgramBuilder& program, const Contacts& contacts, BufferId velocities) {
    if (contacts.hasRebound) program.copy(velocities, contacts.before);
}

void addPasses(ProgramBuilder& program, const Contacts& contacts, const ParticleBuffers& predicted,
               const ParticleBuffers& next) {
    const contact_lists::Lists& lists = contacts.lists;
    addListUpdate(program, contacts, predicted.positions);
    program.dispatch(
        lists.grid.usesTexels ? k::countContacts : k::countContactsLoads, contacts.push.count,
        {predicted.positions, lists.contacts, lists.counts, predicted.velocities, contacts.touching},
        contacts.push);
    std::vector<BufferId> buffers{contacts.touching,   lists.contacts, predicted.velocities, lists.counts,
                                  predicted.positions, next.positions, next.velocities,      predicted.step};
    if (contacts.hasFriction) buffers.push_back(contacts.slips);
    if (contacts.planes.count > 0)
        buffers.insert(buffers.end(), {contacts.planes.planes, contacts.planes.contactOffsets});
    if (contacts.hasRebound) buffers.push_back(contacts.before);
    program.dispatch(gatherForm(contacts), contacts.push.count, buffers, contacts.push,
                     contacts.planes.count > 0 ? contacts.planes.constants() : ProgramBuilder::Constants{});
}

void addPublishing(ProgramBuilder& program, const Contacts& contacts) {
    std::vector<BufferId> buffers{program.program().status, contacts.lists.grid.detected};
    if (contacts.hasFriction)
        buffers.insert(buffers.end(), {contacts.lists.contacts, contacts.lists.counts, contacts.slips,
                                       contacts.saved, contacts.savedCounts});
    program.dispatch(contacts.hasFriction ? k::publishSlips : k::publishLists, contacts.push.count, buffers,
                     contacts.push);
}

} // namespace sinew::sim::collision::particle_contacts
