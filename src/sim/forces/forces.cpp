// The sections of the buffer of impulses, and the elements that each sum consists of.
#include "sim/forces/forces.hpp"

#include "kernels.hpp"
#include "sim/model/links.hpp"
#include "sinew/inverse_masses.hpp"
#include "sinew/solver_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sinew::sim::forces {

namespace {

namespace k = kernels;

constexpr std::uint32_t forceSlotsId = 20, firstForceId = 21,
                        keepsPullsId = 22; // constant_ids in forces.glsl, split.glsl

// Limit of vec4 elements in a buffer with a 32-bit size, such as
// VkPhysicalDeviceLimits::maxStorageBufferRange.
constexpr std::uint64_t mostElements = ((std::uint64_t{1} << 32) - 1) / sizeof(layout::vec4);
static_assert(mostElements < FORCE_SUBTRACTED);

// Chunks of elements, consecutive for each sum, and the ranges of chunks that form the sums.
struct Sums {
    std::vector<layout::ForceChunk> chunks;
    std::vector<layout::ForceRange> ranges;

    // Appends a sum of the elements from `first` on; see layout::ForceChunk and layout::ForceRange.
    void add(std::uint32_t first, std::uint32_t count, std::uint32_t origin, std::uint32_t moment,
             float sign) {
        const auto firstPart = static_cast<std::uint32_t>(chunks.size());
        for (std::uint32_t done = 0; done < count; done += FORCE_CHUNK)
            chunks.push_back(
                {first + done, std::min<std::uint32_t>(FORCE_CHUNK, count - done), origin, moment});
        ranges.push_back(
            {firstPart, static_cast<std::uint32_t>(chunks.size()) - firstPart, origin, sign, 0, 0, 0, 0});
    }

    // Appends a sum of one part without elements, which a pass of its own writes; its sign is -1.
    void addPart() {
        constexpr std::uint32_t isNotListed = 1; // layout::ForceChunk::moment
        ranges.push_back({static_cast<std::uint32_t>(chunks.size()), 1, 0, -1, 0, 0, 0, 0});
        chunks.push_back({0, 0, 0, isNotListed});
    }
};

// A buffer with at least one element, since a kernel must not bind an empty buffer.
template <typename T> BufferId uploadAny(ProgramBuilder& program, const char* label, std::vector<T> items) {
    if (items.empty()) items.push_back(T{});
    return program.upload(label, items);
}

// Whether the particle can touch faces and be pushed by them.
bool isMovingPoint(const Particle& particle, float inverseMass) {
    return particle.radius > 0 && inverseMass > 0;
}

// Sets the rows of static faces of each body; these follow all rows of the other kinds.
void setStops(std::vector<layout::ForceRange>& bodies, const Forces& forces) {
    for (std::uint32_t r = 0; r < forces.stops.rows.size(); ++r) {
        const Stops::Row& row = forces.stops.rows[r];
        if (row.body == Stops::noBody) continue;
        layout::ForceRange& range = bodies[row.body];
        if (range.stops++ == 0) range.firstStop = forces.grabs + forces.planes + forces.summedColliders() + r;
        range.stopOrigin = row.origin;
    }
}

// The elements that sum to the impulse of hold `h`: links at its particles, tethers to them, and the opposite
// of contacts with them and their faces.
std::vector<std::uint32_t> elementsOf(std::uint32_t h, const SceneModel& model, const Forces& forces) {
    const Scene& scene = model.scene;
    const std::vector<std::uint32_t>& slots = model.layout.slot;
    const std::vector<Tether>& tethers = model.tethers();
    std::vector<bool> isHeld(scene.particles.size());
    std::vector<std::uint32_t> elements;
    for (const std::uint32_t particle : scene.holds[h].particles) {
        if (isHeld[particle]) continue;
        isHeld[particle] = true;
        if (!model.moves(particle)) {
            elements.push_back(forces.slots + slots[particle]);
            elements.push_back(slots[particle] | FORCE_SUBTRACTED);
        }
    }
    for (std::uint32_t t = 0; t < tethers.size(); ++t)
        if (isHeld[tethers[t].anchor]) elements.push_back(forces.firstEntry() + t);
    for (std::uint32_t r = 0; r < forces.stops.rows.size(); ++r) {
        if (!std::ranges::binary_search(forces.stops.rows[r].holds, h)) continue;
        for (std::size_t i = 0; i < scene.particles.size(); ++i) // the row has the elements of the points
            if (isMovingPoint(scene.particles[i], model.inverseMass[i]))
                elements.push_back(forces.elementOf(forces.firstStop() + r) + slots[i]);
    }
    return elements;
}

void addRows(ProgramBuilder& program, const SceneModel& model, const Forces& forces,
             const layout::ForcePush& push) {
    Sums sums;
    std::uint32_t firstSummed = 0; // part of the colliders that are summed as whole numbers
    for (std::uint32_t row = 0; row < forces.rows(); ++row) {
        if (forces.summed > 0 && row == forces.grabs + forces.planes) {
            firstSummed = static_cast<std::uint32_t>(sums.chunks.size());
            for (std::uint32_t c = 0; c < forces.summed; ++c) sums.addPart();
        } else {
            sums.add(forces.elementOf(row), forces.slots, 0, forces.slots, row < forces.grabs ? 1.0f : -1.0f);
        }
    }
    std::vector<std::uint32_t> elements;
    const auto addListed = [&](const std::vector<std::uint32_t>& listed) {
        sums.add(static_cast<std::uint32_t>(elements.size()), static_cast<std::uint32_t>(listed.size()), 0, 0,
                 1);
        elements.insert(elements.end(), listed.begin(), listed.end());
    };
    for (std::uint32_t a = 0; a < forces.attachments; ++a)
        addListed({forces.firstEntry() + forces.tethers + a});
    for (std::uint32_t h = 0; h < model.scene.holds.size(); ++h) addListed(elementsOf(h, model, forces));
    const CuttingBuffers& cutting = program.program().cutting;
    const auto bladePart = static_cast<std::uint32_t>(sums.chunks.size());
    const bool hasBlade = cutting.bladeForce != BufferId{};
    if (hasBlade) sums.addPart();
    if (sums.ranges.empty()) return;
    ForceBuffers& built = program.program().forces;
    const auto chunks = static_cast<std::uint32_t>(sums.chunks.size());
    const auto count = static_cast<std::uint32_t>(sums.ranges.size());
    built.rowParts = program.scratchOfStep<layout::ForceSum>("forces.row_parts", std::max(chunks, 1u));
    layout::ForcePush pushed = push;
    pushed.count = chunks;
    if (chunks > 0)
        program.dispatch(k::sumForceRows, chunks,
                         {forces.terms, uploadAny(program, "forces.elements", elements),
                          program.upload("forces.row_chunks", sums.chunks), built.rowParts},
                         pushed);
    if (forces.summed > 0)
        program.dispatch(
            k::readColliderForces, forces.summed, {forces.colliderForces, built.rowParts},
            layout::ColliderForcePush{forces.summed, firstSummed, 1 / forces.colliderForceScale});
    if (hasBlade) {
        program.dispatch(k::readColliderForces, 1, {cutting.bladeForce, built.rowParts},
                         layout::ColliderForcePush{1, bladePart, 1 / cutting.bladeForceScale});
        program.fill(cutting.bladeForce, 0); // a step without a blade records no pass that does so
    }
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
    for (const Body& body : scene.bodies)
        sums.add(body.firstParticle, body.particleCount, body.firstParticle, 0, 1);
    setStops(sums.ranges, forces);
    ForceBuffers& built = program.program().forces;
    const BufferId positions = program.program().positions;
    const auto chunks = static_cast<std::uint32_t>(sums.chunks.size());
    built.parts = program.scratchOfStep<layout::BodyForcePart>("forces.parts", chunks);
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

// Whether a link pulls at a static particle.
bool areLinksHeld(const Scene& scene) {
    const std::vector<float> inverseMass = inverseMasses(scene);
    bool areHeld = false;
    forEachLink(scene, [&](const auto& ends) {
        for (const std::uint32_t end : ends) areHeld = areHeld || inverseMass[end] == 0;
    });
    return areHeld;
}

// A power of two, such that 1e-12 of the momentum of all that moves at 1 m/s is about a whole number.
float forceScaleOf(const SceneModel& model) {
    double mass = 0;
    for (const float inverse : model.inverseMass)
        if (inverse > 0) mass += 1 / double{inverse};
    return static_cast<float>(std::exp2(std::round(std::log2(1e12 / std::max(mass, 1e-12)))));
}

// All members except the buffers.
Forces placesOf(const SceneModel& model) {
    const Scene& scene = model.scene;
    const std::uint32_t colliders =
        model.settings.hostColliders + static_cast<std::uint32_t>(scene.colliders.size());
    const bool areFew = colliders <= MOST_COLLIDER_ROWS;
    return {.slots = static_cast<std::uint32_t>(model.layout.count),
            .grabs = model.settings.grabs,
            .planes = static_cast<std::uint32_t>(scene.planes.size()),
            .colliders = areFew ? colliders : 1,
            .summed = areFew ? 0 : colliders,
            .tethers = static_cast<std::uint32_t>(model.tethers().size()),
            .attachments = static_cast<std::uint32_t>(scene.attachments.size()),
            .stops = stopsOf(model)};
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
    if (settings.solver == Solver::jacobi && linkCount(scene) > 0)
        complaints.add(
            "settings.keepsForces",
            "is set, but solver jacobi averages the effects of links on a particle, so that the forces on a "
            "body do not equal those that it exerts: use split");
    else if (settings.solver != Solver::split && areLinksHeld(scene))
        complaints.add("settings.keepsForces",
                       std::string("is set, but solver ") + solverName(settings.solver) +
                           " does not compute the holding forces of the links: use split");
}

void checkRoom(const SceneModel& model, Complaints& complaints) {
    const std::uint64_t elements = placesOf(model).elements();
    if (elements <= mostElements) return;
    complaints.add("settings.keepsForces", "is set, but " + number(elements) +
                                               " impulses of particles do not fit in one buffer, at most " +
                                               number(mostElements) +
                                               " do: leave out planes, colliders, bodies with static or "
                                               "driven faces, grabs or host colliders, or take "
                                               "fewer particles");
}

Stops stopsOf(const SceneModel& model) {
    const Scene& scene = model.scene;
    Stops stops{.ofParticle = std::vector<std::uint32_t>(scene.particles.size(), 0)};
    bool hasPoint = false;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        hasPoint = hasPoint || isMovingPoint(scene.particles[i], model.inverseMass[i]);
    if (!hasPoint || model.settings.solver != Solver::split) return stops;
    std::vector<std::uint32_t> bodyOf(scene.particles.size(), Stops::noBody);
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        std::fill_n(bodyOf.begin() + body.firstParticle, body.particleCount, b);
    }
    std::vector<std::vector<std::uint32_t>> holdsOf(scene.particles.size());
    for (std::uint32_t h = 0; h < scene.holds.size(); ++h)
        for (const std::uint32_t i : scene.holds[h].particles)
            if (holdsOf[i].empty() || holdsOf[i].back() != h) holdsOf[i].push_back(h);
    using Key = std::pair<std::uint32_t, std::vector<std::uint32_t>>; // body and holds
    std::map<Key, std::vector<std::uint32_t>> corners;
    for (const Face& face : scene.faces)
        if (std::ranges::none_of(face.particles, [&](std::uint32_t i) { return model.moves(i); })) {
            const std::uint32_t first = face.particles[0];
            corners[{bodyOf[first], holdsOf[first]}].push_back(first);
        }
    for (const auto& [key, firsts] : corners) {
        const bool isSameBody = !stops.rows.empty() && stops.rows.back().body == key.first;
        for (const std::uint32_t i : firsts)
            stops.ofParticle[i] = static_cast<std::uint32_t>(stops.rows.size());
        stops.rows.push_back({key.first, key.second, isSameBody ? stops.rows.back().origin : firsts.front()});
    }
    return stops;
}

ProgramBuilder::Constants Forces::constants(std::uint32_t first) const {
    return {{forceSlotsId, slots}, {firstForceId, first}};
}

ProgramBuilder::Constants pullConstants() {
    return {{keepsPullsId, 1}};
}

void add(Build& build) {
    if (!build.model.settings.keepsForces) return;
    ProgramBuilder& program = build.program;
    auto forces = std::make_shared<Forces>(placesOf(build.model));
    forces->terms = program.scratchOfStep<layout::vec4>("forces.terms", forces->elements());
    program.fill(forces->terms, 0);
    if (forces->summed > 0) {
        forces->colliderForces =
            program.scratchOfStep<layout::ColliderForce>("forces.colliders", forces->summed);
        forces->colliderForceScale = forceScaleOf(build.model);
        program.fill(forces->colliderForces, 0);
    }
    program.program().forces.terms = forces->terms;
    build.particles.forces = forces;
}

void bindTo(const ParticleBuffers& particles, ProgramBuilder::Constants (Forces::*of)() const,
            std::vector<BufferId>& buffers, ProgramBuilder::Constants& constants) {
    buffers.push_back(particles.forces ? particles.forces->terms : unbound);
    if (particles.forces) constants.merge(((*particles.forces).*of)());
}

void addPulls(Build& build, const Substep& substep) {
    if (!substep.particles.forces) return;
    const Forces& forces = *substep.particles.forces;
    build.program.dispatch(k::extractHoldImpulses, forces.slots, {substep.particles.velocities, forces.terms},
                           layout::CountPush{forces.slots}, forces.ofContacts());
}

void addSums(Build& build) {
    if (!build.particles.forces) return;
    ProgramBuilder& program = build.program;
    const SceneModel& model = build.model;
    const Forces& forces = *build.particles.forces;
    const Scene& scene = model.scene;
    ForceBuffers& built = program.program().forces;
    built.bodies = static_cast<std::uint32_t>(scene.bodies.size());
    built.grabs = forces.grabs;
    built.planes = forces.planes;
    built.colliders = static_cast<std::uint32_t>(scene.colliders.size());
    built.hostColliders = forces.summedColliders() - built.colliders;
    built.stops = static_cast<std::uint32_t>(forces.stops.rows.size());
    built.attachments = forces.attachments;
    built.holds = static_cast<std::uint32_t>(scene.holds.size());
    built.blades = program.program().cutting.bladeForce != BufferId{} ? 1 : 0;
    const std::uint32_t firstRow = FORCE_KINDS * built.bodies;
    const std::uint32_t count = firstRow + forces.sums() + built.attachments + built.holds + built.blades;
    built.sums = program.scratchOfStep<layout::ForceSum>("forces.sums", std::max(count, 1u));
    const layout::ForcePush push{0, forces.grabs, forces.planes, forces.colliders, firstRow};
    addRows(program, model, forces, push);
    addBodies(program, scene, forces, model.layout.slot, push);
}

} // namespace sinew::sim::forces
