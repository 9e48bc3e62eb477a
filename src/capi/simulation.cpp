// Simulations: making, recording and reading them.
#include "capi/convert.hpp"
#include "capi/objects.hpp"
#include "sinew/sinew_motions.h"
#include "sinew/sinew_query.h"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <algorithm>

namespace sinew::capi {

SimulationObject::SimulationObject(DeviceObject& itsDevice, const sim::Scene& itsScene,
                                   const sim::Settings& itsSettings)
    : Object(kind), device(itsDevice), settings(itsSettings),
      owned(std::make_unique<sim::Simulation>(device.device, itsScene, settings)), simulation(owned.get()),
      particles(static_cast<std::uint32_t>(itsScene.particles.size())),
      bodies(static_cast<std::uint32_t>(itsScene.bodies.size())),
      input{.anchors = std::vector<sim::Vec3>(itsScene.attachments.size() + 1),
            .bladeFrom = std::vector<sim::Vec3>(sim::ranges::mostBladePoints + 1),
            .bladeTo = std::vector<sim::Vec3>(sim::ranges::mostBladePoints + 1),
            .hostColliders = std::vector<sim::HostCollider>(settings.hostColliders + 1)},
      rooms(itsSettings) {
    settings = sim::withSubsteps(itsScene, settings); // of a scene that is valid: it was compiled
    if (device.queue) scene = itsScene;
}

SimulationObject::SimulationObject(DeviceObject& itsDevice, sim::World& itsWorld)
    : Object(kind), device(itsDevice), settings(itsWorld.settings()), simulation(&itsWorld.simulation()),
      particles(static_cast<std::uint32_t>(itsWorld.scene().particles.size())),
      bodies(static_cast<std::uint32_t>(itsWorld.scene().bodies.size())),
      input{.anchors = std::vector<sim::Vec3>(itsWorld.scene().attachments.size() + 1),
            .bladeFrom = std::vector<sim::Vec3>(sim::ranges::mostBladePoints + 1),
            .bladeTo = std::vector<sim::Vec3>(sim::ranges::mostBladePoints + 1),
            .hostColliders = std::vector<sim::HostCollider>(settings.hostColliders + 1)},
      rooms(settings) {}

SimulationObject::~SimulationObject() {
    if (!device.queue) return;
    const std::lock_guard lock(device.queueMutex);
    device.queue->drain(); // a call that failed may have left steps in flight
}

namespace {

/// The first of `given`, as many as there is room for in `list`.
template <typename Element, typename Given, typename Convert>
std::span<const Element> converted(std::span<Element> list, const Given* given, std::size_t count,
                                   const char* name, Convert&& convert) {
    requireArray(given, count, name);
    const std::size_t taken = std::min(count, list.size());
    for (std::size_t i = 0; i < taken; ++i) list[i] = convert(given[i]);
    return list.first(taken);
}

sim::Grab toGrab(const SinewGrab& grab) {
    return {.particle = grab.particle,
            .radius = grab.radius,
            .target = toVec3(grab.target),
            .stiffness = grab.stiffness,
            .damping = grab.damping,
            .maxAcceleration = grab.maxAcceleration,
            .maxSpeed = grab.maxSpeed};
}

sim::HostCollider toHostCollider(const SinewHostCollider& collider) {
    return {.shape = toShape(collider.shape),
            .radius = collider.radius,
            .halfLength = collider.halfLength,
            .halfExtents = toVec3(collider.halfExtents),
            .friction = collider.friction,
            .staticFriction = collider.staticFriction,
            .pose = toPose(collider.pose),
            .maxSpeed = collider.maxSpeed};
}

sim::ForceField toField(const SinewField& field) {
    if (field.kind > SINEW_FIELD_TURBULENCE)
        invalidArgument("there is no field of kind " + std::to_string(field.kind));
    return {.kind = static_cast<sim::FieldKind>(field.kind),
            .body = field.body,
            .vector = toVec3(field.vector),
            .center = toVec3(field.center),
            .radius = field.radius,
            .strength = field.strength,
            .scale = field.scale};
}

sim::Motion toMotion(const SinewMotion& motion) {
    return {.kind = static_cast<sim::MotionKind>(motion.kind),
            .body = motion.body,
            .center = toVec3(motion.center),
            .radius = motion.radius,
            .linear = toVec3(motion.linear),
            .angular = toVec3(motion.angular),
            .rotation = toQuaternion(motion.rotation)};
}

SinewImpulse fromImpulse(const sim::Impulse& impulse) {
    return {.linear = fromVec3(impulse.linear), .angular = fromVec3(impulse.angular)};
}

/// Copies a list out as far as there is room, and gives its length.
template <typename Element, typename Given, typename Convert>
void giveList(const std::vector<Given>& list, std::uint32_t& count, Element* elements, Convert&& convert) {
    const std::size_t copied = std::min<std::size_t>(count, list.size());
    for (std::size_t i = 0; i < copied; ++i) elements[i] = convert(list[i]);
    count = static_cast<std::uint32_t>(list.size());
}

std::vector<sim::Impulse> listOf(const sim::Impulses& impulses, std::uint32_t kind) {
    switch (kind) {
    case SINEW_IMPULSES_PLANES:
        return impulses.planes;
    case SINEW_IMPULSES_COLLIDERS:
        return impulses.colliders;
    case SINEW_IMPULSES_HOST_COLLIDERS:
        return impulses.hostColliders;
    case SINEW_IMPULSES_GRABS:
        return impulses.grabs;
    case SINEW_IMPULSES_ATTACHMENTS:
        return impulses.attachments;
    case SINEW_IMPULSES_HOLDS:
        return impulses.holds;
    case SINEW_IMPULSES_BLADE:
        return impulses.blade;
    default:
        invalidArgument("there are no impulses of kind " + std::to_string(kind));
    }
}

} // namespace

namespace {

std::span<const sim::Motion> motionsOf(const SinewStep& step, SimulationObject& object) {
    const auto motions =
        converted<sim::Motion>(object.input.motions, step.motions, step.motionCount, "motions", toMotion);
    for (std::size_t m = 0; m < std::min<std::size_t>(motions.size(), object.settings.motions); ++m)
        if (const char* fault = object.simulation->faultOf(motions[m]))
            invalidArgument("motion " + std::to_string(m) + " " + fault);
    return motions;
}

} // namespace

sim::Step stepOf(const SinewStep& step, SimulationObject& object) {
    StepInput& input = object.input;
    const auto vector = [](const SinewVec3& v) { return toVec3(v); };
    return {
        .dt = step.dt,
        .gravity = toVec3(step.gravity),
        .frame = step.frame,
        .anchors = converted<sim::Vec3>(input.anchors, step.anchors, step.anchorCount, "anchors", vector),
        .grabs = converted<sim::Grab>(input.grabs, step.grabs, step.grabCount, "grabs", toGrab),
        .hostColliders = converted<sim::HostCollider>(
            input.hostColliders, step.hostColliders, step.hostColliderCount, "hostColliders", toHostCollider),
        .fields = converted<sim::ForceField>(input.fields, step.fields, step.fieldCount, "fields", toField),
        .motions = motionsOf(step, object),
        .wakes = step.wakes != 0,
        .repeats = step.repeats != 0,
        .blade = {.from = converted<sim::Vec3>(input.bladeFrom, step.bladeFrom, step.bladeCount, "bladeFrom",
                                               vector),
                  .to = converted<sim::Vec3>(input.bladeTo, step.bladeTo, step.bladeCount, "bladeTo", vector),
                  .isCarried = step.bladeIsCarried != 0},
        .ray = {.from = toVec3(step.rayFrom), .to = toVec3(step.rayTo), .radius = step.rayRadius}};
}

SinewStatus fromStatus(const sim::StepStatus& status) {
    const auto flag = [](bool value) { return value ? 1u : 0u; };
    return {.size = sizeof(SinewStatus),
            .frame = status.frame,
            .stepsUndone = status.stepsUndone,
            .isUndone = flag(status.isUndone),
            .nonFinite = status.nonFinite,
            .firstBadParticle = status.firstBadParticle,
            .contactRoom = status.contactRoom,
            .lacksLists = flag(status.lacksLists),
            .isCalm = flag(status.isCalm),
            .laterLists = status.laterLists,
            .slowed = status.slowed,
            .sleeping = status.sleeping,
            .lostTime = status.lostTime,
            .linksCut = status.linksCut,
            .linksCutInAll = status.linksCutInAll,
            .pieces = status.pieces,
            .debris = status.debris,
            .debrisParticles = status.debrisParticles,
            .debrisMass = status.debrisMass,
            .cutSurfaceMissing = status.cutSurfaceMissing};
}

void collectComplaints(SimulationObject& object) {
    for (std::string& complaint : object.simulation->complaintsOfUse())
        object.complaints.push_back(std::move(complaint));
}

vk::BufferView viewOf(const SimulationObject& object, std::uint32_t output) {
    const sim::Simulation& simulation = *object.simulation;
    switch (output) {
    case SINEW_POSITIONS:
        return simulation.positions();
    case SINEW_VELOCITIES:
        return simulation.velocities();
    case SINEW_SKIN_VERTICES:
        return simulation.skinVertices();
    case SINEW_SKIN_INDICES:
        return simulation.skinIndices();
    case SINEW_PIECES:
        return simulation.pieces();
    case SINEW_PIECE_SIZES:
        return simulation.pieceSizes();
    case SINEW_PIECE_DRAWS:
        return simulation.pieceDraws();
    case SINEW_CUT_VERTICES:
        return simulation.cutSurface().vertices;
    case SINEW_CUT_REST:
        return simulation.cutSurface().rest;
    case SINEW_CUT_INDICES:
        return simulation.cutSurface().indices;
    case SINEW_CUT_DRAWS:
        return simulation.cutSurface().draws;
    case SINEW_FORCE_SUMS:
        return simulation.forceSums();
    case SINEW_PREVIOUS_POSITIONS:
        return simulation.previousPositions();
    case SINEW_PREVIOUS_SKIN_VERTICES:
        return simulation.previousSkinVertices();
    case SINEW_TEXTURE_COORDINATES:
        return simulation.textureCoordinates();
    case SINEW_CUT_TEXTURE_COORDINATES:
        return simulation.cutSurface().textureCoordinates;
    default:
        invalidArgument("there is no output " + std::to_string(output));
    }
}

namespace {

vk::BufferView viewIn(const sim::Outputs& outputs, std::uint32_t output) {
    switch (output) {
    case SINEW_POSITIONS:
        return outputs.positions;
    case SINEW_VELOCITIES:
        return outputs.velocities;
    case SINEW_SKIN_VERTICES:
        return outputs.skinVertices;
    case SINEW_SKIN_INDICES:
        return outputs.skinIndices;
    case SINEW_PIECE_DRAWS:
        return outputs.pieceDraws;
    case SINEW_CUT_VERTICES:
        return outputs.cutSurface.vertices;
    case SINEW_CUT_REST:
        return outputs.cutSurface.rest;
    case SINEW_CUT_INDICES:
        return outputs.cutSurface.indices;
    case SINEW_CUT_DRAWS:
        return outputs.cutSurface.draws;
    case SINEW_TEXTURE_COORDINATES:
        return outputs.textureCoordinates;
    case SINEW_CUT_TEXTURE_COORDINATES:
        return outputs.cutSurface.textureCoordinates;
    default:
        invalidArgument("no frame keeps an output " + std::to_string(output));
    }
}

} // namespace

SinewStep defaultStep() {
    const sim::Step from;
    SinewStep step{};
    step.size = sizeof step;
    step.dt = from.dt;
    step.gravity = fromVec3(from.gravity);
    return step;
}

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewCreateSimulation(SinewDevice device, SinewScene scene, const SinewSettings* settings,
                                  SinewSimulation* simulation) {
    return call(
        __func__,
        [&] {
            const sim::Settings given = toSettings(settings);
            requireNotNull(simulation, "simulation");
            const Use<DeviceObject> on(device.id, Access::read);
            const Use<SceneObject> of(scene.id, Access::read);
            for (const std::string& warning : sim::warnings(of->scene)) log(SINEW_LOG_WARNING, warning);
            simulation->id = addObject(std::make_unique<SimulationObject>(*on, of->scene, given), &*on);
        },
        SINEW_ERROR_INVALID_SCENE);
}

SinewResult sinewDestroySimulation(SinewSimulation simulation) {
    return call(__func__, [&] { destroyObject(simulation.id, Kind::simulation); });
}

SinewResult sinewGetSimulationInfo(SinewSimulation simulation, SinewSimulationInfo* info) {
    return call(__func__, [&] {
        const Result<SinewSimulationInfo> result(info, "SinewSimulationInfo");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const sim::Simulation& made = *object->simulation;
        result.give({.size = sizeof(SinewSimulationInfo),
                     .particles = object->particles,
                     .bodies = object->bodies,
                     .skins = static_cast<std::uint32_t>(made.skins().size()),
                     .solver = static_cast<std::uint32_t>(object->settings.solver),
                     .substeps = object->settings.substeps,
                     .contactRoom = object->settings.contactRoom,
                     .cutSurfaceRoom = object->settings.cutSurfaceRoom,
                     .stepsDone = object->stepsDone,
                     .nextFrame = object->nextFrame,
                     .stateSize = made.stateSize(),
                     .stateKey = made.stateKey(),
                     .oldestInFlight = made.oldestInFlight().value_or(UINT64_MAX)});
    });
}

SinewGrab sinewDefaultGrab(void) {
    const sim::Grab grab;
    return {.particle = 0,
            .radius = grab.radius,
            .target = fromVec3(grab.target),
            .stiffness = grab.stiffness,
            .damping = grab.damping,
            .maxAcceleration = grab.maxAcceleration,
            .maxSpeed = grab.maxSpeed};
}

SinewHostCollider sinewDefaultHostCollider(void) {
    const sim::HostCollider from;
    SinewHostCollider collider{};
    collider.friction = from.friction;
    collider.pose.rotation.w = 1;
    collider.maxSpeed = from.maxSpeed;
    return collider;
}

SinewMotion sinewDefaultMotion(void) {
    SinewMotion motion{};
    motion.body = SINEW_ALL_BODIES;
    motion.rotation.w = 1;
    return motion;
}

SinewField sinewDefaultField(void) {
    SinewField field{};
    field.body = SINEW_ALL_BODIES;
    field.scale = 1;
    return field;
}

SinewResult sinewRecordReset(SinewSimulation simulation, VkCommandBuffer commands) {
    return call(__func__, [&] {
        requireNotNull(commands, "commands");
        const Use<SimulationObject> object(simulation.id, Access::write);
        object->simulation->recordReset(commands);
    });
}

SinewResult sinewRecordStep(SinewSimulation simulation, VkCommandBuffer commands, const SinewStep* step) {
    return call(__func__, [&] {
        const SinewStep given = described(step, "SinewStep", defaultStep);
        requireNotNull(commands, "commands");
        const Use<SimulationObject> object(simulation.id, Access::write);
        object->simulation->record(commands, stepOf(given, *object));
    });
}

SinewResult sinewRecordSkin(SinewSimulation simulation, VkCommandBuffer commands) {
    return call(__func__, [&] {
        requireNotNull(commands, "commands");
        const Use<SimulationObject> object(simulation.id, Access::write);
        object->simulation->recordSkin(commands);
    });
}

SinewResult sinewRecordTakeOver(SinewSimulation simulation, VkCommandBuffer commands, SinewSimulation from) {
    return call(
        __func__,
        [&] {
            requireNotNull(commands, "commands");
            if (simulation.id == from.id) invalidArgument("a simulation cannot take over from itself");
            const Use<SimulationObject> object(simulation.id, Access::write);
            const Use<SimulationObject> other(from.id, Access::write);
            if (&object->device != &other->device)
                throw Failed{SINEW_ERROR_MISMATCH, "the two simulations are on two devices"};
            object->simulation->recordTakeOver(commands, *other->simulation);
        },
        SINEW_ERROR_MISMATCH);
}

SinewResult sinewGetView(SinewSimulation simulation, uint32_t output, SinewBufferView* view) {
    return call(__func__, [&] {
        requireNotNull(view, "view");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const vk::BufferView found = viewOf(*object, output);
        *view = {.buffer = found.buffer, .offset = found.offset, .size = found.size, .stride = found.stride};
    });
}

SinewResult sinewGetFrameView(SinewSimulation simulation, uint64_t frame, uint32_t output,
                              SinewBufferView* view) {
    return call(__func__, [&] {
        requireNotNull(view, "view");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const sim::Outputs outputs = object->simulation->outputs(frame);
        const vk::BufferView found = viewIn(outputs, output);
        *view = {.buffer = found.buffer, .offset = found.offset, .size = found.size, .stride = found.stride};
        return outputs.isKept ? SINEW_OK : SINEW_NOT_READY;
    });
}

SinewResult sinewGetSkin(SinewSimulation simulation, uint32_t index, SinewSkin* skin) {
    return call(__func__, [&] {
        const Result<SinewSkin> result(skin, "SinewSkin");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const std::vector<sim::SkinRange>& skins = object->simulation->skins();
        if (index >= skins.size()) return SINEW_END;
        SinewSkin found{.size = sizeof found,
                        .firstIndex = skins[index].firstIndex,
                        .indexCount = skins[index].indexCount,
                        .color = fromVec3(skins[index].color),
                        .name = {}};
        copyText(skins[index].name, found.name);
        result.give(found);
        return SINEW_OK;
    });
}

SinewResult sinewGetStatus(SinewSimulation simulation, uint64_t frame, SinewStatus* status) {
    return call(__func__, [&] {
        const Result<SinewStatus> result(status, "SinewStatus");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const sim::StepStatus from = object->simulation->status(frame);
        if (!from.isFinished) return SINEW_NOT_READY;
        result.give(fromStatus(from));
        return SINEW_OK;
    });
}

SinewResult sinewGetBodyImpulses(SinewSimulation simulation, uint64_t frame, uint32_t* count,
                                 SinewBodyImpulses* impulses) {
    return call(__func__, [&] {
        requireNotNull(count, "count");
        requireArray(impulses, *count, "impulses");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const sim::Impulses all = object->simulation->forces(frame);
        if (!all.isFinished) return SINEW_NOT_READY;
        giveList(all.bodies, *count, impulses, [](const sim::BodyImpulses& body) {
            return SinewBodyImpulses{.contacts = fromImpulse(body.contacts),
                                     .planes = fromImpulse(body.planes),
                                     .colliders = fromImpulse(body.colliders),
                                     .holds = fromImpulse(body.holds),
                                     .grabs = fromImpulse(body.grabs)};
        });
        return SINEW_OK;
    });
}

SinewResult sinewGetImpulses(SinewSimulation simulation, uint64_t frame, uint32_t kind, uint32_t* count,
                             SinewImpulse* impulses) {
    return call(__func__, [&] {
        requireNotNull(count, "count");
        requireArray(impulses, *count, "impulses");
        const Use<SimulationObject> object(simulation.id, Access::write);
        const sim::Impulses all = object->simulation->forces(frame);
        const std::vector<sim::Impulse>& list = listOf(all, kind);
        if (!all.isFinished) return SINEW_NOT_READY;
        giveList(list, *count, impulses, fromImpulse);
        return SINEW_OK;
    });
}

SinewResult sinewNextComplaint(SinewSimulation simulation, const char** sentence) {
    return call(__func__, [&] {
        requireNotNull(sentence, "sentence");
        const Use<SimulationObject> object(simulation.id, Access::write);
        collectComplaints(*object);
        *sentence = nullptr;
        if (object->complaints.empty()) return SINEW_END;
        object->told = std::move(object->complaints.front());
        object->complaints.pop_front();
        *sentence = object->told.c_str();
        return SINEW_OK;
    });
}

} // extern "C"
