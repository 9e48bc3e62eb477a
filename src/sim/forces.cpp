// The sections of the buffer of impulses, and which of its elements each sum consists of.
#include "sim/forces.hpp"

#include "kernels.hpp"
#include "sim/constraints/tether.hpp"

#include <algorithm>

namespace sinew::sim::forces {

namespace {

namespace k = kernels;

constexpr std::uint32_t forceSlotsId = 20, firstForceId = 21,
                        keepsPullsId = 22; // constant_ids in forces.glsl, split.glsl

// Chunks of one thing behind those of another, and the sums that they become.
struct Sums {
    std::vector<layout::ForceChunk> chunks;
    std::vector<layout::ForceRange> ranges;

    // Elements from `first` on; see layout::ForceChunk and layout::ForceRange.
    void add(std::uint32_t first, std::uint32_t count, std::uint32_t origin, std::uint32_t moment,
             std::uint32_t stop, float sign) {
        const auto firstPart = static_cast<std::uint32_t>(chunks.size());
        for (std::uint32_t done = 0; done < count; done += FORCE_CHUNK)
            chunks.push_back(
                {first + done, std::min<std::uint32_t>(FORCE_CHUNK, count - done), origin, moment});
        ranges.push_back(
            {firstPart, static_cast<std::uint32_t>(chunks.size()) - firstPart, origin, stop, sign, 0, 0, 0});
    }
};

// A kernel must not read an empty buffer.
template <typename T> BufferId uploadAny(ProgramBuilder& program, const char* label, std::vector<T> items) {
    if (items.empty()) items.push_back(T{});
    return program.upload(label, items);
}

// One more than the row of what the faces of each body have stopped, 0 where it has none.
std::vector<std::uint32_t> stopOfBodies(const Scene& scene, const Forces& forces) {
    std::vector<std::uint32_t> result(scene.bodies.size(), 0);
    for (std::uint32_t s = 0; s < forces.stops.bodies.size(); ++s)
        result[forces.stops.bodies[s]] = forces.grabs + forces.planes + forces.colliders + s + 1;
    return result;
}

// The elements of what a hold pulls with: at its particles, and by tethers to them.
std::vector<std::uint32_t> elementsOf(const NamedHold& hold, const Scene& scene, const Forces& forces,
                                      const std::vector<std::uint32_t>& slots,
                                      std::span<const Tether> tethers) {
    std::vector<bool> isHeld(scene.particles.size());
    const std::vector<float> inverseMass = inverseMasses(scene);
    std::vector<std::uint32_t> elements;
    for (const std::uint32_t particle : hold.particles) {
        isHeld[particle] = true;
        if (inverseMass[particle] == 0) elements.push_back(forces.slots + slots[particle]);
    }
    for (std::uint32_t t = 0; t < tethers.size(); ++t)
        if (isHeld[tethers[t].anchor]) elements.push_back(forces.firstEntry() + t);
    return elements;
}

void addRows(ProgramBuilder& program, const Scene& scene, const Forces& forces,
             const std::vector<std::uint32_t>& slots, const layout::ForcePush& push) {
    Sums sums;
    for (std::uint32_t row = 0; row < forces.rows(); ++row)
        sums.add(forces.elementOf(row), forces.slots, 0, forces.slots, 0, row < forces.grabs ? 1.0f : -1.0f);
    std::vector<std::uint32_t> elements;
    const auto addListed = [&](const std::vector<std::uint32_t>& listed) {
        sums.add(static_cast<std::uint32_t>(elements.size()), static_cast<std::uint32_t>(listed.size()), 0, 0,
                 0, 1);
        elements.insert(elements.end(), listed.begin(), listed.end());
    };
    for (std::uint32_t a = 0; a < forces.attachments; ++a)
        addListed({forces.firstEntry() + forces.tethers + a});
    const std::vector<Tether> tethers = constraints::tether::inOrder(scene);
    for (const NamedHold& hold : scene.holds) addListed(elementsOf(hold, scene, forces, slots, tethers));
    if (sums.ranges.empty()) return;
    ForceBuffers& built = program.program().forces;
    const auto chunks = static_cast<std::uint32_t>(sums.chunks.size());
    const auto count = static_cast<std::uint32_t>(sums.ranges.size());
    built.rowParts = program.scratch<layout::ForceSum>("forces.row_parts", std::max(chunks, 1u));
    layout::ForcePush pushed = push;
    pushed.count = chunks;
    if (chunks > 0)
        program.dispatch(k::sumForceRows, chunks,
                         {forces.terms, uploadAny(program, "forces.elements", elements),
                          program.upload("forces.row_chunks", sums.chunks), built.rowParts},
                         pushed);
    pushed.count = count;
    program.dispatch(
        k::addForceRows, count,
        {built.rowParts, program.upload("forces.rows", sums.ranges), program.program().status, built.sums},
        pushed);
}

void addBodies(ProgramBuilder& program, const Scene& scene, const Forces& forces,
               const std::vector<std::uint32_t>& slots, const layout::ForcePush& push) {
    if (scene.bodies.empty()) return;
    Sums sums;
    const std::vector<std::uint32_t> stops = stopOfBodies(scene, forces);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        sums.add(body.firstParticle, body.particleCount, body.firstParticle, 0, stops[b], 1);
    }
    ForceBuffers& built = program.program().forces;
    const BufferId positions = program.program().positions;
    const auto chunks = static_cast<std::uint32_t>(sums.chunks.size());
    built.parts = program.scratch<layout::BodyForcePart>("forces.parts", chunks);
    layout::ForcePush pushed = push;
    pushed.count = chunks;
    program.dispatch(k::sumBodyForces, chunks,
                     {forces.terms, positions, program.upload("forces.slots", slots),
                      program.upload("forces.chunks", sums.chunks), built.parts},
                     pushed, ProgramBuilder::Constants{{forceSlotsId, forces.slots}});
    pushed.count = static_cast<std::uint32_t>(sums.ranges.size());
    program.dispatch(k::addBodyForces, pushed.count,
                     {built.parts, program.upload("forces.bodies", sums.ranges), positions,
                      program.program().status, built.sums},
                     pushed);
}

// Whether a link or a bend pulls at a particle that never moves.
bool areLinksHeld(const Scene& scene) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    const auto isHeld = [&](std::uint32_t i) { return inverseMass[i] == 0; };
    return std::ranges::any_of(
               scene.distances,
               [&](const DistanceConstraint& link) { return isHeld(link.a) || isHeld(link.b); }) ||
           std::ranges::any_of(scene.bends, [&](const BendConstraint& bend) {
               return isHeld(bend.a) || isHeld(bend.b) || isHeld(bend.c);
           });
}

} // namespace

void check(const Scene& scene, const Settings& settings, Complaints& complaints) {
    for (std::size_t h = 0; h < scene.holds.size(); ++h)
        for (const std::uint32_t particle : scene.holds[h].particles)
            complaints.checkIndex(particle, scene.particles.size(), "particles",
                                  [h] { return element("hold", h) + ".particles"; });
    if (!settings.keepsForces) return;
    if (settings.sleeps)
        complaints.add("settings.keepsForces",
                       "is set, but bodies that sleep have no forces: leave out one of the two");
    if (settings.solver != Solver::split && areLinksHeld(scene))
        complaints.add("settings.keepsForces",
                       std::string("is set, but solver ") + solverName(settings.solver) +
                           " does not know with which force links are held: use split");
}

Stops stopsOf(const Scene& scene) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    const auto neverMoves = [&](const Face& face) {
        return std::ranges::all_of(face.particles, [&](std::uint32_t i) { return inverseMass[i] == 0; });
    };
    constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> bodyOf(scene.particles.size(), none), rowOf(scene.bodies.size(), none);
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        for (std::uint32_t i = 0; i < body.particleCount; ++i) bodyOf[body.firstParticle + i] = b;
    }
    Stops stops{.ofParticle = std::vector<std::uint32_t>(scene.particles.size(), 0)};
    bool hasOthers = false;
    for (const Face& face : scene.faces) {
        if (!neverMoves(face)) continue;
        const std::uint32_t body = bodyOf[face.particles[0]];
        hasOthers = hasOthers || body == none;
        if (body == none || rowOf[body] != none) continue;
        rowOf[body] = static_cast<std::uint32_t>(stops.bodies.size());
        stops.bodies.push_back(body);
    }
    const auto last = static_cast<std::uint32_t>(stops.bodies.size());
    stops.rows = last + (hasOthers ? 1 : 0);
    for (const Face& face : scene.faces) {
        if (!neverMoves(face)) continue;
        const std::uint32_t body = bodyOf[face.particles[0]];
        stops.ofParticle[face.particles[0]] = body == none ? last : rowOf[body];
    }
    return stops;
}

ProgramBuilder::Constants Forces::constants(std::uint32_t first) const {
    return {{forceSlotsId, slots}, {firstForceId, first}};
}

ProgramBuilder::Constants pullConstants() {
    return {{keepsPullsId, 1}};
}

std::shared_ptr<const Forces> add(ProgramBuilder& program, const Scene& scene, const Settings& settings,
                                  const StateLayout& layout) {
    auto forces = std::make_shared<Forces>(
        Forces{.slots = static_cast<std::uint32_t>(layout.count),
               .grabs = settings.grabs,
               .planes = static_cast<std::uint32_t>(scene.planes.size()),
               .colliders = settings.pokes + static_cast<std::uint32_t>(scene.colliders.size()),
               .tethers = static_cast<std::uint32_t>(constraints::tether::inOrder(scene).size()),
               .attachments = static_cast<std::uint32_t>(scene.attachments.size()),
               .stops = stopsOf(scene)});
    const std::uint64_t elements =
        (2 + 2 * std::uint64_t{forces->rows()}) * forces->slots + forces->tethers + forces->attachments;
    forces->terms = program.scratch<layout::vec4>("forces.terms", elements);
    program.fill(forces->terms, 0);
    program.program().forces.terms = forces->terms;
    return forces;
}

void addPulls(ProgramBuilder& program, const ParticleBuffers& particles) {
    const Forces& forces = *particles.forces;
    program.dispatch(k::takePulls, forces.slots, {particles.velocities, forces.terms},
                     layout::CountPush{forces.slots}, forces.ofContacts());
}

void addSums(ProgramBuilder& program, const Scene& scene, const ParticleBuffers& particles) {
    const Forces& forces = *particles.forces;
    ForceBuffers& built = program.program().forces;
    built.bodies = static_cast<std::uint32_t>(scene.bodies.size());
    built.grabs = forces.grabs;
    built.planes = forces.planes;
    built.colliders = static_cast<std::uint32_t>(scene.colliders.size());
    built.pokes = forces.colliders - built.colliders;
    built.stops = forces.stops.rows;
    built.attachments = forces.attachments;
    built.holds = static_cast<std::uint32_t>(scene.holds.size());
    const std::uint32_t firstRow = FORCE_KINDS * built.bodies;
    const std::uint32_t count = firstRow + forces.rows() + built.attachments + built.holds;
    built.sums = program.scratch<layout::ForceSum>("forces.sums", std::max(count, 1u));
    const layout::ForcePush push{0, forces.grabs, forces.planes, forces.colliders, firstRow};
    addRows(program, scene, forces, particles.layout.slot, push);
    addBodies(program, scene, forces, particles.layout.slot, push);
}

} // namespace sinew::sim::forces
