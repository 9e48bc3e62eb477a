// States that do not come from the previous step: of another simulation, of a saved copy, of another
// material, of earlier topology.
#include "sim/program/program.hpp"
#include "sim/simulation/simulation_state.hpp"
#include "sinew/scene.hpp"
#include "sinew/solver_names.hpp"

#include <stdexcept>

namespace sinew::sim {

namespace {

// The bits of 1e18f: a position that no particle has [m].
constexpr std::uint32_t farAwayBits = 0x5d5e0b6b;

} // namespace

void Simulation::State::requireSameScene(const State& other, const vk::BufferView& copy, std::uint64_t copied,
                                         bool isAlike, bool wasUncut) const {
    const auto refuse = [](const std::string& why) {
        throw std::invalid_argument("a simulation cannot take over: " + why);
    };
    const auto number = [](std::uint64_t value) { return std::to_string(value); };
    if (program.particleCount != other.program.particleCount)
        refuse("the other one has " + number(other.program.particleCount) + " particles, this one has " +
               number(program.particleCount) + ": make both of one scene");
    const bool isOfOneSolver = chosen.solver == other.chosen.solver;
    if (isOfOneSolver ? sceneKey.ofSplit != other.sceneKey.ofSplit
                      : sceneKey.ofAnySolver != other.sceneKey.ofAnySolver)
        refuse(
            "its particles, links, surroundings or bodies differ from those of the other one: make both of "
            "one scene, which may differ in material alone");
    if (!isOfOneSolver && !wasUncut && !mayBeCut())
        refuse(std::string("bodies of the other one may have been cut, which solver ") +
               solverName(chosen.solver) + " does not support: undo the cuts, or use split");
    if (isAlike && hasContacts && chosen.contactRoom < other.chosen.contactRoom)
        refuse("its settings.contactRoom is " + number(chosen.contactRoom) + ", that of the other one " +
               number(other.chosen.contactRoom) + ": give it at least as much");
    if (isAlike && other.hasMoreRoom(*this))
        refuse("it has less room for the surface of cuts than the other one: give it at least as much with "
               "settings.cutSurfaceRoom");
    if (copy.buffer != VK_NULL_HANDLE && copy.size < copied)
        refuse("the copy has " + number(copy.size) + " bytes, the other one hands over " + number(copied) +
               ": give all that recordHandOver() copied");
}

SceneChange::SceneChange(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SceneChange::SceneChange(SceneChange&&) noexcept = default;
SceneChange& SceneChange::operator=(SceneChange&&) noexcept = default;
SceneChange::~SceneChange() = default;

void Simulation::checkTakeOver(const Simulation& from, const vk::BufferView& copy,
                               const SavedState* saved) const {
    from.state_->goBack();
    const State& other = *from.state_;
    state_->requireSameScene(other, copy, from.handOverSize(), state_->isAlike(other),
                             saved != nullptr ? saved->isUncut : other.isUncut);
}

void Simulation::recordTakeOver(VkCommandBuffer buffer, const Simulation& from, const vk::BufferView& copy,
                                const SavedState* saved) {
    SINEW_ONE_THREAD(state_->oneThread);
    checkTakeOver(from, copy, saved);
    const State& other = *from.state_;
    const bool isAlike = state_->isAlike(other);
    recordReset(buffer);
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->recordTaking(commands, other, copy, isAlike);
    if (!isAlike) {
        commands.barrier();
        state_->executor.record(commands, List::initialise);
    }
    state_->recordSettling(commands); // material, or h, may differ
    if (state_->hasMoreRoom(other)) state_->recordSurface(commands);
    commands.endStep();
    state_->isChanged = true;
    if (saved != nullptr) {
        state_->moveTo(*saved);
        state_->follow(state_->pace, other, isAlike);
        state_->undoneH.reset(); // the copy contains the saved values of the last finite step
        return;
    }
    const State::Settled& end = other.lastSettled();
    state_->colliders.moveTo(end.time, end.hostColliders);
    state_->noteEnd(state_->settledEnd, end.pace);
    state_->follow(end.pace, other, isAlike);
    state_->anchors = other.anchors;
    if (isAlike) state_->grabs = other.grabs;
    state_->isUncut = other.isUncut;
    state_->hasNewTopology = other.hasNewTopology;
}

std::unique_ptr<Carrying> Simulation::makeCarrying(const Simulation& to, const Origins& origins) const {
    return std::make_unique<Carrying>(
        state_->device, CarriedState{.program = state_->program, .executor = state_->executor},
        CarriedState{.program = to.state_->program, .executor = to.state_->executor}, origins);
}

void Simulation::State::carry(const State& other, const Origins& origins) noexcept {
    const Settled& end = other.lastSettled();
    colliders.moveTo(end.time, end.hostColliders);
    noteEnd(settledEnd, end.pace);
    // Steps in flight have one h, else nothing is carried (isEndKnown()); H follows them, undone or not.
    follow({end.pace.h, other.pace.longest}, other, true);
    gravity = other.gravity;
    anchors.carry(other.anchors, origins.attachments);
    grabs.carry(other.grabs, origins.particles);
    isUncut = other.isUncut;
    hasNewTopology = other.hasNewTopology;
    isChanged = other.isChanged;
    changes = other.changes + 1; // one that was prepared for `other` is none for this program
    isCarried = true;
    std::erase_if(untold, [&](const std::string& warning) {
        return std::ranges::find(other.warned, warning) != other.warned.end();
    });
}

void Simulation::recordCarried(VkCommandBuffer buffer, const Simulation& from, const Carrying& carrying,
                               const Origins& origins, bool wakes) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    from.state_->goBack();
    State& own = *state_;
    const State& other = *from.state_;
    own.reset();
    vk::Commands commands(own.device, buffer);
    commands.beginStep();
    carrying.record(commands);
    commands.barrier();
    own.carry(other, origins);
    own.isChanged = own.isChanged || wakes;
    if (own.chosen.solver == Solver::split && own.pace.h > 0) {
        const float h = own.pace.h, half = 0.5f * h;
        const Vec3& g = own.gravity;
        carrying.recordArrivals(commands, {half * g.x, half * g.y, half * g.z}, own.theta * h);
        commands.barrier();
    }
    if (!other.isUncut) {
        own.executor.record(commands, List::rewrite);
        commands.barrier();
        carrying.recordCounts(commands);
    }
    own.recordSettling(commands);
    commands.endStep();
}

bool Simulation::fill() noexcept {
    return state_->executor.fill();
}

bool Simulation::recordFilling(VkCommandBuffer buffer, VkDeviceSize most) noexcept {
    vk::Commands commands(state_->device, buffer);
    return state_->executor.uploadRest(commands, most);
}

// The state on the device follows the steps in flight, undone or not, by the order of the queue.
bool Simulation::State::isEndKnown() const noexcept {
    const Settled& known = lastSettled();
    for (std::uint64_t i = 0; i < ring.slots(); ++i) {
        const RecordedStep& step = ring.step(nextFrame + i);
        if (!step.isRecorded || ring.isFinished(step.frame)) continue;
        if (step.repeats || !colliders.ways().empty() ||
            unsettled[ring.slotOf(step.frame)].end.pace.h != known.pace.h)
            return false;
    }
    return true;
}

bool Simulation::mayBeCarried() const noexcept {
    state_->readSteps();
    return !state_->lackedLists && state_->isEndKnown();
}

std::uint64_t Simulation::handOverSize() const noexcept {
    std::uint64_t size = 0;
    state_->forEachHanded([&](std::size_t, BufferId buffer) { size += view(buffer).size; });
    return size;
}

void Simulation::recordHandOver(VkCommandBuffer buffer, const vk::BufferView& to,
                                const vk::BufferView& saved) const noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    vk::BufferView target = to;
    state_->forEachHanded([&](std::size_t, BufferId handed) {
        const vk::BufferView own =
            saved.buffer == VK_NULL_HANDLE ? view(handed) : state_->placeIn(saved, handed);
        target.size = own.size;
        if (own.size > 0) commands.copy(own, target);
        target.offset += own.size;
    });
    commands.endStep();
    commands.hostBarrier();
}

std::optional<SceneChange> Simulation::prepareChange(const Scene& scene) const {
    const Settings& settings = state_->chosen;
    const StepProgram program = compileFor(state_->device, valid(scene, settings), settings);
    requireSameParticles(state_->program, program);
    std::optional<ProgramValues> values = valuesOf(state_->program, program);
    if (!values) return std::nullopt;
    auto parts = std::make_unique<SceneChange::Parts>(SceneChange::Parts{
        std::move(*values), {}, dampedBudget(scene, settings), scene.damping, state_->changes});
    for (const ProgramValues::Contents& one : parts->values.buffers) {
        const BufferSpec& spec = program.buffers[one.buffer.index];
        const vk::Buffer& buffer =
            parts->contents.emplace_back(state_->device, vk::BufferRequest{.name = spec.label + ".changed",
                                                                           .count = spec.count,
                                                                           .stride = spec.stride,
                                                                           .kind = vk::MemoryKind::upload});
        std::ranges::copy(one.initial, buffer.mapped());
        buffer.flush();
    }
    return SceneChange(std::move(parts));
}

bool Simulation::recordChange(VkCommandBuffer buffer, SceneChange& change) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    SceneChange::Parts& parts = *change.parts_;
    if (parts.changes != state_->changes) return false;
    state_->noteUnsettled();
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    for (std::size_t b = 0; b < parts.contents.size(); ++b) {
        const ProgramValues::Contents& one = parts.values.buffers[b];
        state_->executor.replace(commands, one.buffer, parts.contents[b].view(), one.isOfState);
    }
    take(state_->program, std::move(parts.values));
    state_->recordSettling(commands);
    commands.endStep();
    state_->budget = parts.budget;
    state_->damping = parts.damping;
    ++state_->changes;
    state_->isChanged = true;
    return true;
}

std::uint64_t Simulation::stateSize() const noexcept {
    std::uint64_t size = 0;
    for (const BufferId buffer : state_->written) size += view(buffer).size;
    return size;
}

std::uint64_t Simulation::stateKey() const noexcept {
    return keyOf(state_->program);
}

SavedState Simulation::recordSaveState(VkCommandBuffer buffer, const vk::BufferView& to) const {
    SINEW_ONE_THREAD(state_->oneThread);
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->written, to, State::Way::out);
    commands.endStep();
    const auto hostColliders = this->hostColliders(); // restores the host's part if steps must be repeated
    return {state_->pace.h,           state_->colliders.time(),
            state_->anchors.places(), {hostColliders.begin(), hostColliders.end()},
            state_->hasNewTopology,   state_->changes,
            state_->isUncut,          state_->undoneH,
            state_->pace.longest};
}

void Simulation::recordLoadState(VkCommandBuffer buffer, const vk::BufferView& from,
                                 const SavedState& saved) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->written, from, State::Way::back);
    if (saved.changes != state_->changes) {
        state_->recordSettling(commands);
        state_->isChanged = true;
    }
    commands.endStep();
    state_->moveTo(saved);
}

std::uint64_t Simulation::topologySize() const noexcept {
    std::uint64_t size = 0;
    for (const BufferId buffer : state_->program.cutting.topology) size += view(buffer).size;
    return size;
}

void Simulation::recordSaveTopology(VkCommandBuffer buffer, const vk::BufferView& to) const noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->program.cutting.topology, to, State::Way::out);
    commands.endStep();
}

void Simulation::recordLoadTopology(VkCommandBuffer buffer, const vk::BufferView& from) noexcept {
    SINEW_ONE_THREAD(state_->oneThread);
    state_->noteUnsettled();
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->program.cutting.topology, from, State::Way::back);
    for (const BufferId seen : state_->program.cutting.contactsSeen)
        commands.fill(view(seen), farAwayBits); // contact lists are rebuilt
    if (state_->changes > 0) state_->recordSettling(commands);
    commands.endStep();
    state_->hasNewTopology = true;
    ++state_->topologies;
    state_->isUncut = false; // the host cannot know
}

} // namespace sinew::sim
