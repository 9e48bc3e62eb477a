// Scenes from arrays, and their settings.
#include "capi/convert.hpp"
#include "capi/objects.hpp"

#include "sim/compile/compile.hpp"
#include "sinew/colliders.hpp"
#include "sinew/sinew_motions.h"
#include "sinew/start.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <limits>

namespace sinew::capi {

namespace {

// The lists of a scene that grow.
template <typename Scene, typename Function> void forEachList(Scene& scene, Function&& function) {
    std::size_t i = 0;
    function(scene.particles, i++);
    function(scene.distances, i++);
    function(scene.bends, i++);
    function(scene.attachments, i++);
    function(scene.tethers, i++);
    function(scene.fixed, i++);
    function(scene.planes, i++);
    function(scene.colliders, i++);
    function(scene.driven, i++);
    function(scene.faces, i++);
    function(scene.bodies, i++);
    function(scene.grids, i++);
    function(scene.skins, i++);
    function(scene.holds, i++);
}

/// Appends elements to `list`, each made by `convert`. Returns the index of the first one.
template <typename Element, typename Given, typename Convert>
std::uint32_t append(std::vector<Element>& list, std::uint32_t count, const Given* given, const char* name,
                     Convert&& convert) {
    requireArray(given, count, name);
    const std::size_t first = list.size();
    if (count > std::numeric_limits<std::uint32_t>::max() - first)
        invalidArgument("there would be more than 2^32 elements");
    // All at once: nothing is added if there is no memory for all.
    std::vector<Element> added;
    added.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) added.push_back(convert(given[i]));
    list.insert(list.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
    return static_cast<std::uint32_t>(first);
}

void giveTo(std::uint32_t* place, std::uint32_t value) {
    if (place != nullptr) *place = value;
}

std::string joined(const std::vector<std::string>& sentences) {
    std::string text;
    for (const std::string& sentence : sentences) text += (text.empty() ? "" : "\n") + sentence;
    return text;
}

void requireValid(const sim::Scene& scene, const sim::Settings& settings) {
    const std::vector<std::string> complaints = sim::validate(scene, settings);
    if (!complaints.empty()) throw Failed{SINEW_ERROR_INVALID_SCENE, joined(complaints)};
}

SinewSceneValues valuesOf(const sim::Scene& scene) {
    return {.size = sizeof(SinewSceneValues),
            .dt = scene.dt,
            .gravity = fromVec3(scene.gravity),
            .damping = scene.damping,
            .dampingTime = scene.dampingTime,
            .friction = scene.contacts.friction,
            .staticFriction = scene.contacts.staticFriction,
            .restitution = scene.contacts.restitution,
            .recoverySpeed = scene.contacts.recoverySpeed,
            .debris = scene.debris};
}

float limitOf(float given) {
    return given == 0 ? sim::Attachment::unlimited : given;
}

} // namespace

Addition::Addition(sim::Scene& scene) : scene_(scene) {
    forEachList(scene_, [&](const auto& list, std::size_t i) { sizes_[i] = list.size(); });
}

Addition::~Addition() {
    if (isKept_) return;
    forEachList(scene_, [&](auto& list, std::size_t i) {
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(sizes_[i]), list.end());
    });
}

void copyOut(std::span<const std::byte> data, std::size_t* size, void* bytes) {
    requireNotNull(size, "size");
    if (bytes != nullptr && *size < data.size())
        invalidArgument("there is room for " + std::to_string(*size) + " bytes of " +
                        std::to_string(data.size()));
    if (bytes != nullptr) std::memcpy(bytes, data.data(), data.size());
    *size = data.size();
}

sim::Settings toSettings(const SinewSettings* settings) {
    const SinewSettings given = described(settings, "SinewSettings", defaultSettings);
    if (given.solver > SINEW_SOLVER_GAUSS_SEIDEL)
        invalidArgument("there is no solver " + std::to_string(given.solver));
    return {.solver = static_cast<sim::Solver>(given.solver),
            .substeps = given.substeps,
            .tolerance = given.tolerance,
            .iterations = given.iterations,
            .omega = given.omega,
            .theta = given.theta,
            .levels = given.levels,
            .hasSharpClamp = given.hasSharpClamp != 0,
            .weight = given.weight,
            .overRelaxation = given.overRelaxation,
            .warmStart = given.warmStart,
            .contactMargin = given.contactMargin,
            .contactRoom = given.contactRoom,
            .cutSurfaceRoom = given.cutSurfaceRoom,
            .sleeps = given.sleeps != 0,
            .keepsForces = given.keepsForces != 0,
            .events = given.events,
            .eventRoom = given.eventRoom,
            .grabs = given.grabs,
            .hostColliders = given.hostColliders,
            .fields = given.fields,
            .motions = given.motions,
            .keepsPrevious = given.keepsPrevious != 0,
            .outputFrames = given.outputFrames,
            .outputUsage = given.outputUsage,
            .outputFamilies = given.outputFamilies,
            .isReversed = given.isReversed != 0,
            .framesInFlight = given.framesInFlight};
}

SinewSettings fromSettings(const sim::Settings& settings) {
    return {.size = sizeof(SinewSettings),
            .solver = static_cast<std::uint32_t>(settings.solver),
            .substeps = settings.substeps,
            .iterations = settings.iterations,
            .tolerance = settings.tolerance,
            .contactMargin = settings.contactMargin,
            .contactRoom = settings.contactRoom,
            .cutSurfaceRoom = settings.cutSurfaceRoom,
            .sleeps = settings.sleeps ? 1u : 0u,
            .keepsForces = settings.keepsForces ? 1u : 0u,
            .grabs = settings.grabs,
            .hostColliders = settings.hostColliders,
            .fields = settings.fields,
            .motions = settings.motions,
            .framesInFlight = settings.framesInFlight,
            .omega = settings.omega,
            .theta = settings.theta,
            .weight = settings.weight,
            .overRelaxation = settings.overRelaxation,
            .warmStart = settings.warmStart,
            .isReversed = settings.isReversed ? 1u : 0u,
            .levels = settings.levels,
            .events = settings.events,
            .eventRoom = settings.eventRoom,
            .keepsPrevious = settings.keepsPrevious ? 1u : 0u,
            .hasSharpClamp = settings.hasSharpClamp ? 1u : 0u,
            .outputFrames = settings.outputFrames,
            .outputUsage = settings.outputUsage,
            .outputFamilies = settings.outputFamilies};
}

SinewPlane defaultPlane() {
    return {.size = sizeof(SinewPlane), .normal = {0, 1, 0}};
}

SinewCollider defaultCollider() {
    SinewCollider collider{};
    collider.size = sizeof collider;
    collider.pose.rotation.w = 1;
    return collider;
}

SinewSettings defaultSettings() {
    return fromSettings({});
}

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewCreateScene(SinewScene* scene) {
    return call(__func__, [&] {
        requireNotNull(scene, "scene");
        scene->id = addObject(std::make_unique<SceneObject>());
    });
}

SinewResult sinewDestroyScene(SinewScene scene) {
    return call(__func__, [&] { destroyObject(scene.id, Kind::scene); });
}

SinewResult sinewGetSceneValues(SinewScene scene, SinewSceneValues* values) {
    return call(__func__, [&] {
        const Result<SinewSceneValues> result(values, "SinewSceneValues");
        const Use<SceneObject> object(scene.id, Access::read);
        result.give(valuesOf(object->scene));
    });
}

SinewResult sinewSetSceneValues(SinewScene scene, const SinewSceneValues* values) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        sim::Scene& to = object->scene;
        // Values that the header of the host lacks stay.
        const SinewSceneValues given = described(values, "SinewSceneValues", [&] { return valuesOf(to); });
        to.dt = given.dt;
        to.gravity = toVec3(given.gravity);
        to.damping = given.damping;
        to.dampingTime = given.dampingTime;
        to.contacts.friction = given.friction;
        to.contacts.staticFriction = given.staticFriction;
        to.contacts.restitution = given.restitution;
        to.contacts.recoverySpeed = given.recoverySpeed;
        to.debris = given.debris;
    });
}

SinewResult sinewGetSceneCounts(SinewScene scene, SinewSceneCounts* counts) {
    return call(__func__, [&] {
        const Result<SinewSceneCounts> result(counts, "SinewSceneCounts");
        const Use<SceneObject> object(scene.id, Access::read);
        const sim::Scene& from = object->scene;
        const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
        result.give({.size = sizeof(SinewSceneCounts),
                     .particles = count(from.particles),
                     .links = count(from.distances),
                     .bends = count(from.bends),
                     .tethers = count(from.tethers),
                     .fixed = count(from.fixed),
                     .attachments = count(from.attachments),
                     .faces = count(from.faces),
                     .planes = count(from.planes),
                     .colliders = count(from.colliders),
                     .bodies = count(from.bodies),
                     .grids = count(from.grids),
                     .skins = count(from.skins)});
    });
}

SinewResult sinewAddParticles(SinewScene scene, uint32_t count, const SinewParticle* particles,
                              uint32_t* first) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        giveTo(first,
               append(object->scene.particles, count, particles, "particles", [](const SinewParticle& given) {
                   return sim::Particle{.position = toVec3(given.position),
                                        .velocity = toVec3(given.velocity),
                                        .inverseMass = given.inverseMass,
                                        .contactOffset = given.contactOffset,
                                        .radius = given.radius,
                                        .keepsRest = given.keepsRest != 0};
               }));
    });
}

SinewResult sinewAddLinks(SinewScene scene, uint32_t count, const SinewLink* links) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        append(object->scene.distances, count, links, "links", [](const SinewLink& given) {
            return sim::DistanceConstraint{given.a, given.b, given.restLength, given.compliance};
        });
    });
}

SinewResult sinewAddBends(SinewScene scene, uint32_t count, const SinewBend* bends) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        append(object->scene.bends, count, bends, "bends", [](const SinewBend& given) {
            return sim::BendConstraint{given.a, given.b, given.c, given.compliance};
        });
    });
}

SinewResult sinewAddTethers(SinewScene scene, uint32_t count, const SinewTether* tethers) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        append(object->scene.tethers, count, tethers, "tethers", [](const SinewTether& given) {
            return sim::Tether{given.particle, given.anchor, given.length};
        });
    });
}

SinewResult sinewAddFixed(SinewScene scene, uint32_t count, const uint32_t* particles) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        append(object->scene.fixed, count, particles, "particles",
               [](std::uint32_t particle) { return sim::FixedConstraint{particle}; });
    });
}

SinewResult sinewAddAttachments(SinewScene scene, uint32_t count, const SinewAttachment* attachments,
                                uint32_t* first) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        giveTo(first, append(object->scene.attachments, count, attachments, "attachments",
                             [](const SinewAttachment& given) {
                                 return sim::Attachment{.particle = given.particle,
                                                        .anchor = toVec3(given.anchor),
                                                        .compliance = given.compliance,
                                                        .maxForce = limitOf(given.maxForce),
                                                        .maxSpeed = limitOf(given.maxSpeed)};
                             }));
    });
}

SinewResult sinewAddFaces(SinewScene scene, uint32_t count, const SinewFace* faces) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        append(object->scene.faces, count, faces, "faces", [](const SinewFace& given) {
            return sim::Face{.particles = {given.particles[0], given.particles[1], given.particles[2]},
                             .thickness = given.thickness,
                             .isSolid = given.isSolid != 0};
        });
    });
}

SinewResult sinewGetParticles(SinewScene scene, uint32_t first, uint32_t count, SinewParticle* particles) {
    return call(__func__, [&] {
        requireArray(particles, count, "particles");
        const Use<SceneObject> object(scene.id, Access::read);
        const std::vector<sim::Particle>& from = object->scene.particles;
        if (first > from.size() || count > from.size() - first)
            invalidArgument("particles " + std::to_string(first) + " to " +
                            std::to_string(std::uint64_t{first} + count) + " are asked for, and there are " +
                            std::to_string(from.size()));
        for (std::uint32_t i = 0; i < count; ++i) {
            const sim::Particle& particle = from[first + i];
            particles[i] = {.position = fromVec3(particle.position),
                            .velocity = fromVec3(particle.velocity),
                            .inverseMass = particle.inverseMass,
                            .radius = particle.radius,
                            .contactOffset = particle.contactOffset,
                            .keepsRest = particle.keepsRest ? 1u : 0u};
        }
    });
}

SinewResult sinewAddBody(SinewScene scene, const char* name, uint32_t firstParticle, uint32_t particleCount,
                         uint32_t* body) {
    return call(__func__, [&] {
        requireNotNull(name, "name");
        const Use<SceneObject> object(scene.id, Access::write);
        object->scene.bodies.push_back(
            {.name = name, .firstParticle = firstParticle, .particleCount = particleCount});
        giveTo(body, static_cast<std::uint32_t>(object->scene.bodies.size() - 1));
    });
}

SinewResult sinewGetBody(SinewScene scene, uint32_t index, SinewBody* body) {
    return call(__func__, [&] {
        const Result<SinewBody> result(body, "SinewBody");
        const Use<SceneObject> object(scene.id, Access::read);
        if (index >= object->scene.bodies.size()) return SINEW_END;
        const sim::Body& from = object->scene.bodies[index];
        SinewBody found{.size = sizeof found,
                        .firstParticle = from.firstParticle,
                        .particleCount = from.particleCount,
                        .restVolume = from.restVolume,
                        .name = {}};
        copyText(from.name, found.name);
        result.give(found);
        return SINEW_OK;
    });
}

SinewResult sinewSetAbsent(SinewScene scene, uint32_t body, uint32_t isAbsent) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        std::vector<sim::Body>& bodies = object->scene.bodies;
        if (body >= bodies.size())
            invalidArgument("body " + std::to_string(body) + " is asked for, and there are " +
                            std::to_string(bodies.size()));
        bodies[body].isAbsent = isAbsent != 0;
    });
}

SinewResult sinewSetMotion(SinewScene scene, uint32_t body, SinewVec3 velocity, SinewVec3 spin,
                           SinewQuaternion rotation) {
    return call(__func__, [&] {
        const Use<SceneObject> object(scene.id, Access::write);
        sim::Scene& whole = object->scene;
        if (body >= whole.bodies.size())
            invalidArgument("body " + std::to_string(body) + " is asked for, and there are " +
                            std::to_string(whole.bodies.size()));
        const sim::Body& moved = whole.bodies[body];
        if (moved.firstParticle > whole.particles.size() ||
            moved.particleCount > whole.particles.size() - moved.firstParticle)
            invalidArgument("body " + moved.name + " names particles that do not exist yet");
        // start() moves all bodies from an index on, so a scene of this one alone is moved.
        sim::Scene alone;
        const auto first = whole.particles.begin() + moved.firstParticle;
        alone.particles.assign(first, first + moved.particleCount);
        alone.bodies.push_back(moved);
        alone.bodies[0].firstParticle = 0;
        for (const sim::FixedConstraint& fixed : whole.fixed)
            if (fixed.particle - moved.firstParticle < moved.particleCount)
                alone.fixed.push_back({fixed.particle - moved.firstParticle});
        sim::start(alone, 0,
                   {.velocity = toVec3(velocity), .spin = toVec3(spin), .rotation = toQuaternion(rotation)});
        std::ranges::copy(alone.particles, first);
    });
}

SinewResult sinewAddPlane(SinewScene scene, const SinewPlane* plane) {
    return call(__func__, [&] {
        const SinewPlane given = described(plane, "SinewPlane", defaultPlane);
        const Use<SceneObject> object(scene.id, Access::write);
        object->scene.planes.push_back({.normal = toVec3(given.normal),
                                        .offset = given.offset,
                                        .friction = given.friction,
                                        .restitution = given.restitution,
                                        .staticFriction = given.staticFriction});
    });
}

SinewResult sinewAddCollider(SinewScene scene, const SinewCollider* collider) {
    return call(__func__, [&] {
        const SinewCollider given = described(collider, "SinewCollider", defaultCollider);
        const Use<SceneObject> object(scene.id, Access::write);
        sim::Collider added{.shape = toShape(given.shape),
                            .radius = given.radius,
                            .halfLength = given.halfLength,
                            .halfExtents = toVec3(given.halfExtents),
                            .margin = given.margin,
                            .friction = given.friction,
                            .staticFriction = given.staticFriction,
                            .restitution = given.restitution,
                            .pose = toPose(given.pose),
                            .pathEnd = given.loops != 0 ? sim::PathEnd::loop : sim::PathEnd::hold};
        append(added.path, given.keyframeCount, given.keyframes, "keyframes", [](const SinewKeyframe& key) {
            return sim::Keyframe{.time = key.time, .pose = toPose(key.pose)};
        });
        object->scene.colliders.push_back(std::move(added));
    });
}

SinewResult sinewGetSceneSettings(SinewScene scene, SinewSettings* settings) {
    return call(__func__, [&] {
        const Result<SinewSettings> result(settings, "SinewSettings");
        const Use<SceneObject> object(scene.id, Access::read);
        result.give(fromSettings(object->settings));
    });
}

SinewResult sinewValidate(SinewScene scene, const SinewSettings* settings) {
    return call(__func__, [&] {
        const sim::Settings given = toSettings(settings);
        const Use<SceneObject> object(scene.id, Access::read);
        requireValid(object->scene, given);
    });
}

SinewResult sinewDescribe(SinewScene scene, const SinewSettings* settings, size_t* size, char* text) {
    return call(__func__, [&] {
        sim::Settings given = toSettings(settings);
        const Use<SceneObject> object(scene.id, Access::read);
        requireValid(object->scene, given);
        given = sim::withSubsteps(object->scene, given);
        const std::string description = sim::describe(sim::compile(object->scene, given));
        copyOut(std::as_bytes(std::span(description.c_str(), description.size() + 1)), size, text);
    });
}

} // extern "C"
