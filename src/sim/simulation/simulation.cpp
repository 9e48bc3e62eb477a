// The façade: validates, compiles, owns the executor, and turns a Step into the parameters that kernels read.
#include "sim/simulation/simulation_state.hpp"

#include "sim/events/events.hpp"

#include "sinew/validate.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>

namespace sinew::sim {

namespace {

// `dt` within its range; NaN becomes the shortest step.
float withinRange(float dt) {
    const auto low = static_cast<float>(ranges::dt.low), high = static_cast<float>(ranges::dt.high);
    return dt >= low ? std::min(dt, high) : low;
}

} // namespace

const Scene& valid(const Scene& scene, const Settings& settings) {
    requireNone(validate(scene, settings));
    return scene;
}

SplitBudget dampedBudget(const Scene& scene, const Settings& settings) {
    return scene.dampingTime > 0 ? splitBudget(scene, settings) : SplitBudget{};
}

Simulation::Simulation(const vk::Device& device, const Scene& scene, const Settings& settings)
    : state_(std::make_unique<State>(device, scene, settings)) {}

Simulation::~Simulation() {
#ifndef NDEBUG
    if (const auto frame = state_->ring.oldestUnfinished())
        std::fprintf(
            stderr,
            "sinew: a simulation is destroyed, and step %llu was recorded and has not finished: wait "
            "for its submission first\n",
            static_cast<unsigned long long>(*frame));
#endif
}

// Conditions of a calm step. No grab may be active: grabs that change in an undone step would begin anew when
// it is repeated. There must be passes to leave out. An undone step must leave the state as it was before, in
// bits, which it does not with a substep of another length.
bool Simulation::State::mayBeCalm(float h) const noexcept {
    return isKeptWhereUndone && h == pace.h && calmSteps.areCalm() && grabs.areFree() &&
           !program.grids.empty();
}

void Simulation::State::readSteps() noexcept {
    for (std::uint64_t i = 0; i < ring.slots(); ++i) { // oldest first
        RecordedStep& step = ring.step(nextFrame + i);
        if (step.isRead || step.generation != generation || !ring.isFinished(step.frame)) continue;
        step.isRead = true;
        const layout::StatusWords words = ring.words(step.frame);
        if (lackedLists) continue; // undone too
        if (lackLists(words)) {
            lackedLists = step.frame;
            calmSteps.lacked();
        } else {
            calmSteps.finished(words.laterLists, step.isCalm);
        }
    }
}

void Simulation::State::noteBefore(std::uint64_t frame) noexcept {
    Before& slot = befores[ring.slotOf(frame)];
    const rigid::HostColliders& hostColliders = colliders.hostColliders();
    slot.pace = pace;
    slot.time = colliders.time();
    std::ranges::copy(hostColliders.states(), slot.hostColliders.begin());
    std::ranges::copy(anchors.values(), slot.anchors.begin());
    slot.grabs = grabs;
    slot.isUncut = isUncut;
    slot.hasNewTopology = hasNewTopology;
    slot.isChanged = isChanged;
    slot.changes = changes;
    slot.topologies = topologies;
    slot.frame = frame;
}

void Simulation::State::goBack() noexcept {
    readSteps();
    if (!lackedLists || isBack) return;
    const Before& slot = befores[ring.slotOf(*lackedLists)];
    if (slot.frame != lackedLists) return; // too many steps were in flight
    isBack = true;
    undoneH = pace.h;
    pace = slot.pace;
    colliders.moveTo(slot.time, slot.hostColliders);
    anchors.restore(slot.anchors);
    grabs.restore(*slot.grabs);
    isUncut = slot.isUncut && topologies == slot.topologies;
    hasNewTopology = slot.hasNewTopology || topologies != slot.topologies;
    isChanged = slot.isChanged || changes != slot.changes;
}

void Simulation::recordReset(VkCommandBuffer buffer) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    vk::Commands commands(state_->device, buffer);
    state_->executor.upload(commands);
    state_->reset();
}

void Simulation::State::reset() noexcept {
    pace = {};
    colliders.moveTo(0);
    noteEnd(settledEnd, pace);
    forgetUnsettled();
    hasState = true;
    anchors.reset();
    grabs.reset();
    fields.reset();
    isUncut = true;
}

void Simulation::record(VkCommandBuffer buffer, const Step& step, vk::Timestamps* timestamps) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    record(std::span(&buffer, 1), step, timestamps);
}

void Simulation::record(std::span<const VkCommandBuffer> parts, const Step& step,
                        vk::Timestamps* timestamps) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    const float dt = withinRange(step.dt);
    const bool isBlade = state_->blade.read(step, dt) && state_->mayBeCut();
    const bool mayCut = isBlade || state_->program.cutting.tears;
    state_->noteMisuse(step);
    state_->readSteps();
    state_->noteRepetition(step.frame);
    const bool isAgain = state_->lackedLists == step.frame;
    const bool givesUp = !step.repeats && state_->missesRepetition(step.frame);
    if (isAgain || givesUp) {
        state_->goBack();
        const std::optional<float> undoneH = state_->undoneH;
        state_->beginGeneration();
        state_->undoneH = undoneH;
    }
    state_->isBack = false;
    if (step.repeats) state_->noteBefore(step.frame);
    state_->settledEnd = state_->settled(step.frame, state_->settledEnd); // before its slot is reused
    state_->nextFrame = step.frame + 1;
    state_->anchors.advance(step.anchors, dt);
    state_->grabs.advance(step.grabs, dt);
    state_->fields.advance(step.fields);
    if (const std::size_t m = state_->motions.advance(step.motions); m < step.motions.size())
        state_->misuse.note(
            Misuse::badMotion, step.frame, m,
            static_cast<std::uint64_t>(motions::faultOf(step.motions[m], state_->program.motions)));
    const bool hasBlade = mayCut || state_->motions.undoCuts();
    const bool isCalm =
        step.repeats && !isAgain && !isBlade && state_->mayBeCalm(dt / static_cast<float>(state_->substeps));
    const std::uint32_t lists = (step.repeats ? LISTS_REPEATS : 0) | (isCalm ? LISTS_CALM : 0) |
                                (isAgain || givesUp || state_->isNewState ? LISTS_RESUMES : 0);
    const layout::StepParams parameters = state_->parameters(step, dt, lists);
    state_->ring.open({.isRecorded = true,
                       .frame = step.frame,
                       .lostTime = std::max(0.0f, step.dt - dt),
                       .hasBlade = hasBlade,
                       .isCalm = isCalm,
                       .repeats = step.repeats,
                       .generation = state_->generation});
    state_->colliders.advance(dt, step.hostColliders);
    const rigid::ColliderPaths& colliders = state_->colliders;
    const auto hostColliderArguments = state_->hostColliderArguments();
    const Pace pace = state_->pace.next(dt, parameters.h);
    State::Unsettled& unsettled = state_->unsettled[state_->ring.slotOf(step.frame)];
    unsettled.isRecorded = true;
    state_->noteEnd(unsettled.end, pace);
    state_->isUncut = state_->isUncut && !mayCut;
    vk::Commands commands(state_->device, parts.front());
    if (timestamps) timestamps->reset(commands);
    commands.beginStep();
    state_->executor.step(commands, parts.subspan(1),
                          {std::as_bytes(std::span(&parameters, 1)), std::as_bytes(state_->anchors.values()),
                           std::as_bytes(colliders.ways()), std::as_bytes(colliders.hostColliders().shapes()),
                           std::as_bytes(std::span(hostColliderArguments)),
                           std::as_bytes(state_->grabs.values()), state_->blade.head(),
                           state_->blade.points(), std::as_bytes(state_->fields.values()),
                           std::as_bytes(state_->fields.arguments()), std::as_bytes(state_->motions.values()),
                           std::as_bytes(state_->motions.arguments())},
                          timestamps, {.hasBlade = hasBlade, .isCalm = isCalm});
    commands.barrier();
    state_->recordStatus(commands, step.frame);
    state_->outputs.recordStep(commands, step.frame);
    commands.endStepForHost();
    state_->recordEnd(commands, step.frame);
    commands.hostBarrier();
    state_->pace = pace;
    state_->gravity = step.gravity;
    state_->undoneH.reset();
    state_->hasNewTopology = state_->isChanged = state_->isCarried = state_->isNewState = false;
}

void Simulation::recordSkin(VkCommandBuffer buffer, SkinDetail detail) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    if (!state_->hasState) state_->misuse.note(Misuse::noReset, state_->nextFrame);
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    if (detail == SkinDetail::drawn && drawnSkins().areWhole)
        state_->executor.record(commands, List::wholeSkin);
    else
        state_->executor.record(commands, List::skin);
    if (state_->outputs.areKept()) {
        commands.barrier();
        state_->outputs.recordSkin(commands);
    }
    commands.endStep();
}

vk::BufferView Simulation::positions() const noexcept {
    return state_->executor.view(state_->program.positions);
}
vk::BufferView Simulation::velocities() const noexcept {
    return state_->executor.view(state_->program.velocities);
}
vk::BufferView Simulation::previousPositions() const noexcept {
    return state_->executor.view(state_->program.previousPositions);
}
vk::BufferView Simulation::previousSkinVertices() const noexcept {
    return state_->executor.view(state_->program.previousSkinVertices);
}
vk::BufferView Simulation::pieces() const noexcept {
    return state_->executor.view(state_->program.cutting.pieces);
}
vk::BufferView Simulation::pieceSizes() const noexcept {
    return state_->executor.view(state_->program.cutting.pieceSizes);
}
vk::BufferView Simulation::skinVertices() const noexcept {
    return state_->executor.view(state_->program.skinVertices);
}
vk::BufferView Simulation::skinIndices() const noexcept {
    return state_->executor.view(state_->program.skinIndices);
}
vk::BufferView Simulation::textureCoordinates() const noexcept {
    return state_->executor.view(state_->program.textureCoordinates);
}
Outputs Simulation::outputs(std::uint64_t frame) const noexcept {
    return state_->outputs.outputs(frame);
}
const std::vector<SkinRange>& Simulation::skins() const noexcept {
    return state_->skins;
}
Simulation::DrawnSkins Simulation::drawnSkins() const noexcept {
    const vk::BufferView whole = view(state_->program.wholeIndices);
    if (state_->isUncut && whole.size > 0)
        return {whole, state_->wholeSkins, true, view(state_->program.wholeTextureCoordinates)};
    return {skinIndices(), state_->skins, false, textureCoordinates()};
}
CutSurface Simulation::cutSurface() const noexcept {
    const CutSurfaceBuffers& buffers = state_->program.cutSurface;
    return {
        view(buffers.vertices), view(buffers.rest),      view(buffers.indices),           view(buffers.draws),
        view(buffers.state),    view(buffers.particles), view(buffers.textureCoordinates)};
}
vk::BufferView Simulation::pieceDraws() const noexcept {
    return state_->executor.view(state_->program.pieceDraws);
}
std::span<const Pose> Simulation::colliderPoses() const noexcept {
    state_->goBack();
    return state_->colliders.poses();
}
std::span<const HostColliderState> Simulation::hostColliders() const noexcept {
    state_->goBack();
    return state_->colliders.hostColliders().states();
}
vk::BufferView Simulation::view(BufferId buffer) const noexcept {
    return state_->executor.view(buffer);
}
const std::byte* Simulation::mapped(const vk::BufferView& view) const noexcept {
    return state_->executor.mapped(view);
}
const StepProgram& Simulation::program() const noexcept {
    return state_->program;
}

Status Simulation::status(std::uint64_t frame) const noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    const StepRing& ring = state_->ring;
    if (!ring.isFinished(frame)) return {.frame = static_cast<std::uint32_t>(frame)};
    const layout::StatusWords words = ring.words(frame);
    const RecordedStep& step = ring.step(frame);
    const layout::CutCounts counts = ring.counts(frame);
    const bool lacksLists = State::lackLists(words);
    return {.frame = words.frame,
            .isFinished = true,
            .isUndone = ring.isUndone(frame),
            .stepsUndone = ring.undoneUntil(frame),
            .nonFinite = lacksLists ? 0 : words.nonFinite, // that state lacks contacts
            .firstBadParticle = ~words.invertedFirstBad,
            .contactRoom = words.candidates,
            .lacksLists = lacksLists,
            .isCalm = step.isCalm,
            .laterLists = words.laterLists,
            .slowed = words.slowed,
            .sleeping = words.sleeping,
            .lostTime = step.lostTime,
            .linksCut = step.hasBlade ? counts.linksOfStep : 0,
            .linksCutInAll = counts.links,
            .pieces = counts.pieces,
            .debris = counts.debris,
            .debrisParticles = counts.debrisParticles,
            .debrisMass = static_cast<float>(state_->program.cutting.debrisUnit * counts.debrisMass),
            .cutSurfaceMissing = counts.missing};
}

namespace {

Impulse impulseOf(const layout::ForceSum& sum) {
    return {{sum.impulse.x, sum.impulse.y, sum.impulse.z}, {sum.torque.x, sum.torque.y, sum.torque.z}};
}

} // namespace

Impulses Simulation::forces(std::uint64_t frame) const {
    SINEW_ONE_THREAD(state_->oneThread);
    const ForceBuffers& buffers = state_->program.forces;
    if (!state_->ring.isFinished(frame)) return {};
    Impulses impulses{.isFinished = true};
    const std::vector<layout::ForceSum> sums = state_->ring.forces(frame);
    if (sums.empty()) return impulses;
    for (std::uint32_t b = 0; b < buffers.bodies; ++b) {
        const auto of = [&](std::uint32_t kind) { return impulseOf(sums[FORCE_KINDS * b + kind]); };
        impulses.bodies.push_back({.contacts = of(FORCE_CONTACTS),
                                   .planes = of(FORCE_PLANES),
                                   .colliders = of(FORCE_COLLIDERS),
                                   .holds = of(FORCE_HOLDS),
                                   .grabs = of(FORCE_GRABS)});
    }
    auto next = sums.begin() + FORCE_KINDS * buffers.bodies;
    const auto take = [&](std::uint32_t count) {
        std::vector<Impulse> list;
        for (; count > 0; --count) list.push_back(impulseOf(*next++));
        return list;
    };
    impulses.grabs = take(buffers.grabs);
    impulses.planes = take(buffers.planes);
    impulses.hostColliders = take(buffers.hostColliders);
    impulses.colliders = take(buffers.colliders);
    next += buffers.stops; // already part of the bodies
    impulses.attachments = take(buffers.attachments);
    impulses.holds = take(buffers.holds);
    impulses.blade = take(buffers.blades);
    return impulses;
}

vk::BufferView Simulation::forceSums() const noexcept {
    return state_->executor.view(state_->program.forces.sums);
}

namespace {

// Sets what a body touches, from its index among all that it may.
void setPartner(Event& event, std::uint32_t partner, const EventBuffers& of) {
    const std::pair<EventPartner, std::uint32_t> lists[] = {{EventPartner::body, of.bodies},
                                                            {EventPartner::plane, of.planes},
                                                            {EventPartner::hostCollider, of.hostColliders},
                                                            {EventPartner::collider, of.colliders}};
    for (const auto& [kind, count] : lists) {
        event.partner = kind;
        event.other = partner;
        if (partner < count) return;
        partner -= count;
    }
}

} // namespace

Events Simulation::events(std::uint64_t frame) const {
    SINEW_ONE_THREAD(state_->oneThread);
    const StepRing& ring = state_->ring;
    if (!ring.isFinished(frame)) return {};
    const StepRing::Listed listed = ring.events(frame);
    Events events{.isFinished = true, .list = {}, .lost = listed.lost};
    for (const layout::EventEntry& entry : listed.entries) {
        Event& event = events.list.emplace_back(
            Event{.kind = events::kindOf(entry.kind), .body = entry.body, .count = entry.count});
        if ((bitOf(event.kind) & contactEvents) == 0) continue;
        setPartner(event, entry.partner, state_->program.events);
        event.count = (entry.count + state_->substeps - 1) / state_->substeps;
    }
    const std::uint32_t room = ring.words(frame).candidates;
    if (room > 0 && (state_->chosen.events & bitOf(EventKind::lacksRoom)) != 0)
        events.list.push_back({.kind = EventKind::lacksRoom, .count = room});
    return events;
}

const char* Simulation::faultOf(const Motion& motion) const noexcept {
    return motions::textOf(motions::faultOf(motion, state_->program.motions));
}

std::vector<std::string> Simulation::complaints() {
    SINEW_ONE_THREAD(state_->oneThread);
    state_->readSteps();
    const std::uint64_t end = state_->lackedLists.value_or(~std::uint64_t{0}); // later steps are undone
    if (const auto lack = state_->ring.lackOfRoom(state_->generation, end))
        state_->misuse.note(Misuse::contactRoom, lack->frame, lack->needed, state_->chosen.contactRoom);
    std::vector<std::string> sentences = std::exchange(state_->untold, {});
    std::ranges::move(state_->misuse.take(), std::back_inserter(sentences));
#ifndef NDEBUG
    state_->oneThread.takeTo(sentences);
#endif
    return sentences;
}

std::vector<std::string> Simulation::complaintsOfUse() {
    state_->untold.clear();
    return complaints();
}

std::optional<std::uint64_t> Simulation::oldestInFlight() const noexcept {
    return state_->ring.oldestUnfinished();
}

std::vector<std::string> Simulation::phases() const {
    std::vector<std::string> names;
    for (const std::uint32_t phase : state_->executor.timedPhases())
        names.push_back(state_->program.phases[phase]);
    return names;
}

} // namespace sinew::sim
