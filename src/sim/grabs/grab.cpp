// The buffers of grabs, and the motion of the held points.
#include "sim/grabs/grab.hpp"

#include "kernels.hpp"
#include "sim/constraints/moving_point.hpp"
#include "sim/forces/forces.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::grabs {

namespace {

static_assert(MOST_GRABS == ranges::mostGrabs);

constexpr std::uint32_t comeAndGoId = 1; // constant_id in select_grabbed.comp

constexpr float mostGain = 1e8f; // the largest useful value in float32

// The linked component of each particle, and the mass of the component.
std::vector<layout::GrabBody> bodiesOf(const SceneModel& model) {
    const std::vector<float>& inverseMass = model.inverseMass;
    const std::vector<std::uint32_t>& components = model.components();
    std::vector<double> masses(components.size());
    for (std::size_t i = 0; i < components.size(); ++i)
        if (inverseMass[i] > 0) masses[components[i]] += 1 / double{inverseMass[i]};
    std::vector<layout::GrabBody> bodies;
    for (std::size_t i = 0; i < components.size(); ++i) {
        const double mass = masses[components[i]];
        const double part = inverseMass[i] > 0 ? 1 / double{inverseMass[i]} / mass : 0;
        bodies.push_back(
            {components[i], static_cast<float>(part), static_cast<float>(mass), model.layout.slot[i]});
    }
    return bodies;
}

layout::GrabPush pushOf(const Grabs& grabs, std::uint32_t substep, std::uint32_t substeps, Kick kick) {
    layout::GrabPush push = grabs.push;
    push.fraction = static_cast<float>(substep + 1) / static_cast<float>(substeps);
    push.lateKick = kick == Kick::half ? 0.5f : 0;
    return push;
}

IndirectItems itemsOf(const Grabs& grabs) {
    return {grabs.pulling, 0, grabs.push.count};
}

// Whether squares of differences of such positions fit into float32.
bool isPlace(const Vec3& v) {
    constexpr float farthest = 1e9f; // [m]
    return std::abs(v.x) <= farthest && std::abs(v.y) <= farthest && std::abs(v.z) <= farthest;
}

bool isNumber(const Grab& grab) {
    return isPlace(grab.target) && std::isfinite(grab.radius) && std::isfinite(grab.stiffness) &&
           std::isfinite(grab.damping) && std::isfinite(grab.maxAcceleration) && !std::isnan(grab.maxSpeed);
}

} // namespace

void add(Build& build) {
    ProgramBuilder& program = build.program;
    const SceneModel& model = build.model;
    const Settings& settings = model.settings;
    if (settings.grabs == 0) return;
    const auto count = static_cast<std::uint32_t>(model.scene.particles.size());
    const layout::GrabPush push{count, (count - 1) / GROUP_ITEMS + 1, settings.grabs, 0, 0};
    const std::vector<layout::DispatchArguments> none{{0, 1, 1, 0}};
    auto grabs = std::make_shared<Grabs>(
        Grabs{.push = push,
              .requests = program.scratch<layout::GrabRequest>("grab.requests", settings.grabs),
              .states = program.scratch<layout::GrabState>("grab.states", settings.grabs),
              .bodies = program.upload("grab.bodies", bodiesOf(model)),
              .grips = program.scratch<layout::Grip>("grab.grips", count),
              .held = program.scratch<std::uint32_t>("grab.held", count),
              .holding = program.upload("grab.holding", none),
              .pulling = program.upload("grab.pulling", none)});
    program.addToState(grabs->states, grabs->states, {.of = Elements::one});
    program.addToState(grabs->grips, grabs->grips, {.of = Elements::particles});
    program.addToState(grabs->held, grabs->held, {.of = Elements::one, .values = Elements::particles});
    program.addToState(grabs->pulling, grabs->pulling, {.of = Elements::one});
    program.updateGrabs(grabs->requests);
    build.particles.grabs = grabs;
}

void addChoice(Build& build) {
    const ParticleBuffers& particles = build.particles;
    if (!particles.grabs) return;
    ProgramBuilder& program = build.program;
    const Grabs& grabs = *particles.grabs;
    const bool comeAndGo = std::ranges::any_of(build.model.scene.bodies, &Body::isAbsent);
    program.dispatch(kernels::openGrabs, grabs.push.grabs,
                     {grabs.requests, grabs.states, grabs.holding, grabs.pulling}, grabs.push);
    program.dispatchIndirect(kernels::selectGrabbed, {grabs.holding, 0, grabs.push.count},
                             {grabs.requests, grabs.states, grabs.bodies,
                              boundIf(!comeAndGo, program.program().positions), grabs.grips, grabs.held,
                              grabs.pulling, boundIf(comeAndGo, particles.positions),
                              boundIf(comeAndGo, particles.velocities), boundIf(comeAndGo, particles.step)},
                             grabs.push, {{comeAndGoId, comeAndGo}});
}

void addPass(Build& build, const Substep& substep) {
    const ParticleBuffers& particles = substep.particles;
    if (!particles.grabs) return;
    const Grabs& grabs = *particles.grabs;
    std::vector<BufferId> buffers{grabs.requests,      grabs.states,         grabs.bodies,
                                  grabs.grips,         grabs.held,           grabs.pulling,
                                  particles.positions, particles.velocities, particles.step};
    if (substep.isOpen()) buffers.push_back(substep.corrections);
    const layout::GrabPush push = pushOf(grabs, substep.index, build.model.settings.substeps, substep.kick);
    ProgramBuilder::Constants constants;
    forces::bindTo(particles, &forces::Forces::ofGrabs, buffers, constants);
    build.program.dispatchIndirect(substep.isOpen() ? kernels::solveGrabsOpen : kernels::solveGrabs,
                                   itemsOf(grabs), buffers, push, constants);
}

bool GrabRequests::areFree() const noexcept {
    return std::ranges::all_of(values(),
                               [](const layout::GrabRequest& request) { return request.serial == 0; });
}

void GrabRequests::carry(const GrabRequests& other, std::span<const std::uint32_t> origins) noexcept {
    serial_ = other.serial_;
    requests_ = other.requests_;
    for (layout::GrabRequest& request : requests_) {
        if (request.serial == 0) continue;
        const auto found = std::ranges::find(origins, request.particle);
        if (found == origins.end())
            request = {};
        else
            request.particle = static_cast<std::uint32_t>(found - origins.begin());
    }
}

void GrabRequests::advance(std::span<const Grab> grabs, float dt) noexcept {
    for (std::size_t k = 0; k < count_; ++k) {
        layout::GrabRequest& request = requests_[k];
        if (k >= grabs.size() || !isNumber(grabs[k]) || grabs[k].particle >= particles_) {
            request = {};
            continue;
        }
        const Grab& grab = grabs[k];
        const bool isHeld = request.serial > 0 && request.particle == grab.particle;
        const Vec3& target = grab.target;
        const layout::vec4 from = isHeld ? request.to : layout::vec4{target.x, target.y, target.z, 0};
        const layout::vec4 to =
            constraints::movedTowards(from, target, double{std::max(grab.maxSpeed, 0.0f)} * double{dt});
        request = {.from = from,
                   .to = to,
                   .velocity = {(to.x - from.x) / dt, (to.y - from.y) / dt, (to.z - from.z) / dt, 0},
                   .serial = isHeld ? request.serial : ++serial_,
                   .particle = grab.particle,
                   .radius = std::max(grab.radius, 0.0f),
                   .stiffness = std::clamp(grab.stiffness, 0.0f, mostGain),
                   .damping = std::clamp(grab.damping, 0.0f, mostGain),
                   .maxAcceleration = std::clamp(grab.maxAcceleration, 0.0f, mostGain),
                   .unused0 = 0,
                   .unused1 = 0};
    }
}

} // namespace sinew::sim::grabs
