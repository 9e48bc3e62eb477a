// The façade: validates, compiles, owns the executor, and turns a Step into the parameters its kernels read.
#include "sim/simulation.hpp"

#include "layout.h"
#include "sim/collision/collider_paths.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/collision/particle_contacts.hpp"
#include "sim/constraints/attachment.hpp"
#include "sim/constraints/grab.hpp"
#include "sim/cutting/blade.hpp"
#include "sim/gpu_compile.hpp"
#include "sim/gpu_executor.hpp"
#include "sim/program_values.hpp"
#include "sim/ranges.hpp"
#include "sim/skin_ranges.hpp"
#include "sim/substeps.hpp"
#include "sim/validate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>

namespace sinew::sim {

namespace {

const Scene& valid(const Scene& scene, const Settings& settings) {
    requireNone(validate(scene, settings));
    return scene;
}

// Bits of a float, 1e18: nobody is there [m].
constexpr std::uint32_t farAwayBits = 0x5d5e0b6b;

// A step that is no number is the shortest one.
float withinRange(float dt) {
    const auto low = static_cast<float>(ranges::dt.low), high = static_cast<float>(ranges::dt.high);
    return dt >= low ? std::min(dt, high) : low;
}

} // namespace

struct SceneChange::Parts {
    ProgramValues values;
    std::vector<vk::Buffer> contents; // one for each of its buffers
    SplitBudget budget;
    float damping;
    std::uint32_t changes; // of the simulation, when it was prepared
};

SceneChange::SceneChange(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SceneChange::SceneChange(SceneChange&&) noexcept = default;
SceneChange& SceneChange::operator=(SceneChange&&) noexcept = default;
SceneChange::~SceneChange() = default;

namespace {

SplitBudget dampedBudget(const Scene& scene, const Settings& settings) {
    return scene.dampingTime > 0 ? splitBudget(scene, settings) : SplitBudget{};
}

} // namespace

struct Simulation::State {
    const vk::Device& device;
    Settings chosen; // with a number of substeps
    StepProgram program;
    GpuExecutor executor;
    std::vector<BufferId> written;
    vk::Buffer statusRing;                // one slot a frame in flight, read by the host
    std::optional<vk::Buffer> countsRing; // likewise; where bodies may be cut
    std::vector<SkinRange> skins, wholeSkins, mixedSkins;
    constraints::attachment::Anchors anchors;
    constraints::grab::Hands hands;
    collision::ColliderPaths colliders;
    cutting::BladeWords blade;
    std::array<bool, framesInFlight> hasBlade{}; // of the newest steps
    bool hasNewTopology = false;                 // loaded since the last step
    bool isUncut = false;                        // since the last reset, whatever comes of its steps
    std::uint32_t changes = 0;                   // of the material
    bool isChanged = false;                      // since the last step
    SplitBudget budget;
    float theta, omega, damping;
    std::uint32_t substeps;
    bool hasContacts; // between particles: gathers of `split` then store x, not x + theta h v
    std::array<float, framesInFlight> lostTime{}; // of the newest steps [s]
    float previousH = 0; // 0 before the first step: the half-kick that starts the leapfrog
    // A step that came to its end: its h, and where it left colliders and pokes.
    struct Settled {
        float h = 0;
        double time = 0;
        collision::PokeStates pokes{};
    };
    // Steps of which the host has not yet looked whether they came to their end, and the last that has.
    struct Unsettled {
        bool isRecorded = false;
        Settled end;
    };
    std::array<Unsettled, framesInFlight> unsettled{};
    std::uint64_t nextFrame = 0;
    Settled settledEnd;

    State(const vk::Device& d, const Scene& scene, const Settings& asked)
        : State(d, scene, withSubsteps(valid(scene, asked), asked), {}) {}

    struct Resolved {};
    State(const vk::Device& d, const Scene& scene, const Settings& settings, Resolved)
        : device(d), chosen(settings), program(compileFor(d, scene, settings)), executor(d, program),
          written(writtenByStep(program)), statusRing(d, {.name = "status.ring",
                                                          .count = framesInFlight,
                                                          .stride = sizeof(layout::StatusWords),
                                                          .kind = vk::MemoryKind::readback}),
          skins(rangesOf(scene.skins, Triangles::all)), wholeSkins(rangesOf(scene.skins, Triangles::whole)),
          mixedSkins(rangesOf(scene.skins, program.mixedRanges)), anchors(scene.attachments),
          hands(settings.grabs, scene.particles.size()),
          colliders(scene.colliders, scene.driven, settings.pokes), budget(dampedBudget(scene, settings)),
          theta(settings.solver == Solver::split ? settings.theta : 0), omega(settings.omega),
          damping(scene.damping), substeps(settings.substeps),
          hasContacts(collision::particle_contacts::areIn(scene) || collision::face_contacts::areIn(scene)) {
        if (program.cutting.counts != BufferId{})
            countsRing.emplace(d, vk::BufferRequest{.name = "cut.counts.ring",
                                                    .count = framesInFlight,
                                                    .stride = sizeof(layout::CutCounts),
                                                    .kind = vk::MemoryKind::readback});
    }

    layout::StepParams parameters(const Step& step, float dt) const {
        const float h = dt / static_cast<float>(substeps);
        const double longest = double{std::max(h, previousH)};
        const Vec3& g = step.gravity;
        return {.gravity = {g.x, g.y, g.z, 0},
                .h = h,
                .hPrevious = previousH,
                .thetaH = theta * h,
                .thetaHPrevious = theta * previousH,
                .velocityFactor = std::exp(-damping * h),
                .restSpeed = 2 * std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z) * h,
                .frame = static_cast<std::uint32_t>(step.frame),
                .dampingShare =
                    static_cast<float>(dampingBudget(budget, double{theta}, longest) / double{omega}),
                .multiplierScale = previousH > 0 ? std::min(1.0f, h * h / (previousH * previousH)) : 0,
                .thetaHStored = hasContacts ? 0 : theta * h,
                .wakes = step.wakes || hasNewTopology || isChanged ? 1u : 0u};
    }

    layout::StatusWords statusWords(std::uint64_t frame) const {
        layout::StatusWords words;
        std::memcpy(&words, statusRing.mapped() + frame % framesInFlight * sizeof(words), sizeof(words));
        return words;
    }

    layout::CutCounts cutCounts(std::uint64_t frame) const {
        layout::CutCounts counts{};
        if (countsRing)
            std::memcpy(&counts, countsRing->mapped() + frame % framesInFlight * sizeof(counts),
                        sizeof(counts));
        return counts;
    }

    // The last step before `frame` that settled has this `end`; where the one that this slot of the ring held
    // came to its end, that counts.
    Settled settled(std::uint64_t frame, const Settled& end) const {
        const Unsettled& step = unsettled[frame % framesInFlight];
        if (!step.isRecorded) return end;
        const layout::StatusWords words = statusWords(frame);
        return words.nonFinite == 0 && words.candidates == 0 ? step.end : end;
    }

    // Of the passes that only pokes need.
    std::array<layout::DispatchArguments, POKE_ARGUMENTS> pokeArguments() const {
        const std::uint32_t one = colliders.pokes().areAny() ? 1 : 0;
        const auto arguments = [one](std::uint32_t groups) {
            return layout::DispatchArguments{one * groups, 1, 1, 0};
        };
        static_assert(POKES_PLACED == 0 && POKES_TOUCHING == 1);
        return {arguments(program.pokes.placed), arguments(program.pokes.touching)};
    }

    static vk::BufferView slotOf(const vk::Buffer& ring, std::uint64_t frame) {
        vk::BufferView slot = ring.view();
        slot.size = slot.stride;
        slot.offset += slot.stride * (frame % framesInFlight);
        return slot;
    }

    // What steps have found out, where the host may read it.
    void recordStatus(vk::Commands& commands, std::uint64_t frame) const noexcept {
        commands.copy(executor.view(program.status), slotOf(statusRing, frame));
        if (countsRing) commands.copy(executor.view(program.cutting.counts), slotOf(*countsRing, frame));
    }

    // For the surface of cuts.
    bool hasMoreRoom(const State& other) const noexcept {
        return executor.view(program.cutSurface.rest).size >
                   other.executor.view(other.program.cutSurface.rest).size ||
               program.pieceVertices > other.program.pieceVertices;
    }

    // Writes what is missing of it, or has another place here.
    void recordSurface(vk::Commands& commands) noexcept {
        const auto setMissing = [&](BufferId buffer, std::size_t offset) {
            vk::BufferView word = executor.view(buffer);
            if (word.size == 0) return;
            word.offset += offset;
            word.size = sizeof(std::uint32_t);
            commands.fill(word, 1);
        };
        commands.barrier(); // they were copied
        setMissing(program.cutSurface.state, offsetof(layout::SurfaceState, missing));
        for (const BufferId state : program.sheetStates)
            setMissing(state, offsetof(layout::SheetState, missing));
        executor.surface(commands);
    }

    // What the scene alone says of a state that was put into the buffers.
    void recordSettling(vk::Commands& commands) noexcept {
        if (program.settle.empty()) return;
        commands.barrier(); // they were copied
        for (const BufferId list : program.cutting.lists) executor.restore(commands, list);
        commands.barrier();
        executor.settle(commands);
    }

    // Public positions and velocities, then all that is carried: calls use(index, buffer).
    template <typename Use> void forEachHanded(const Use& use) const {
        std::size_t index = 0;
        use(index++, program.positions);
        use(index++, program.velocities);
        for (const Carried& carried : program.carried) use(index++, carried.from);
    }

    // Copies what `other` hands over, from where it is or from `copy`; what is carried, too, if they are
    // alike: buffers of one name, of which there may be several, and the head of what has more room here.
    void recordTaking(vk::Commands& commands, const State& other, const vk::BufferView& copy,
                      bool isAlike) const noexcept {
        std::size_t next = 0; // of the own that are carried
        vk::BufferView place = copy;
        const auto nameOf = [](const StepProgram& of, std::size_t c) -> const std::string& {
            return of.buffers[of.carried[c].to.index].label;
        };
        other.forEachHanded([&](std::size_t index, BufferId handed) {
            vk::BufferView origin = other.executor.view(handed);
            if (copy.buffer != VK_NULL_HANDLE) {
                place.size = origin.size;
                origin = place;
                place.offset += place.size;
            }
            BufferId own = index == 0 ? program.positions : program.velocities;
            if (index > 1) {
                std::size_t found = next;
                while (found < program.carried.size() &&
                       nameOf(program, found) != nameOf(other.program, index - 2))
                    ++found;
                if (!isAlike || found == program.carried.size()) return;
                own = program.carried[found].to;
                next = found + 1;
            }
            vk::BufferView target = executor.view(own);
            target.size = origin.size = std::min(target.size, origin.size);
            if (target.size > 0) commands.copy(origin, target);
        });
    }

    // Where a copy of the state has a buffer; the buffer itself where it is no part of the state.
    vk::BufferView placeIn(const vk::BufferView& saved, BufferId buffer) const noexcept {
        vk::BufferView place = saved;
        for (const BufferId one : written) {
            place.size = executor.view(one).size;
            if (one == buffer) return place;
            place.offset += place.size;
        }
        return executor.view(buffer);
    }

    // The host's part of a state.
    void moveTo(const SavedState& saved) noexcept {
        previousH = saved.h;
        collision::PokeStates pokes{};
        std::copy_n(saved.pokes.begin(), std::min(saved.pokes.size(), pokes.size()), pokes.begin());
        settledEnd = {saved.h, saved.colliderTime, pokes};
        unsettled = {};
        anchors.moveTo(saved.anchors);
        hasNewTopology = saved.hasNewTopology;
        isUncut = saved.isUncut;
        hands.reset();
        colliders.moveTo(saved.colliderTime, pokes);
    }

    // Copies buffers out to where they stand one behind the other, or back from there.
    enum class Way { out, back };
    void copy(vk::Commands& commands, const std::vector<BufferId>& buffers, vk::BufferView copies,
              Way way) const noexcept {
        for (const BufferId buffer : buffers) {
            const vk::BufferView own = executor.view(buffer);
            copies.size = own.size;
            if (way == Way::out)
                commands.copy(own, copies);
            else
                commands.copy(copies, own);
            copies.offset += own.size;
        }
    }
};

Simulation::Simulation(const vk::Device& device, const Scene& scene, const Settings& settings)
    : state_(std::make_unique<State>(device, scene, settings)) {}

Simulation::~Simulation() = default;

void Simulation::recordReset(VkCommandBuffer buffer) noexcept {
    vk::Commands commands(state_->device, buffer);
    state_->executor.upload(commands);
    state_->previousH = 0;
    state_->settledEnd = {};
    state_->unsettled = {};
    state_->anchors.reset();
    state_->hands.reset();
    state_->colliders.moveTo(0);
    state_->isUncut = true;
}

void Simulation::record(VkCommandBuffer buffer, const Step& step, vk::Timestamps* timestamps) noexcept {
    const float dt = withinRange(step.dt);
    state_->lostTime[step.frame % framesInFlight] = std::max(0.0f, step.dt - dt);
    const layout::StepParams parameters = state_->parameters(step, dt);
    state_->settledEnd = state_->settled(step.frame, state_->settledEnd);
    state_->nextFrame = step.frame + 1;
    state_->anchors.advance(step.anchors, dt);
    state_->hands.advance(step.grabs, dt);
    state_->colliders.advance(dt, step.pokes);
    const collision::ColliderPaths& colliders = state_->colliders;
    const auto pokeArguments = state_->pokeArguments();
    state_->unsettled[step.frame % framesInFlight] = {
        true, {parameters.h, colliders.time(), colliders.pokes().states()}};
    const bool isBlade = state_->countsRing && state_->blade.read(step);
    const bool hasBlade = isBlade || state_->program.cutting.tears;
    state_->hasBlade[step.frame % framesInFlight] = hasBlade;
    state_->isUncut = state_->isUncut && !hasBlade;
    vk::Commands commands(state_->device, buffer);
    if (timestamps) timestamps->reset(commands);
    commands.beginStep();
    state_->executor.step(commands,
                          {std::as_bytes(std::span(&parameters, 1)), std::as_bytes(state_->anchors.values()),
                           std::as_bytes(colliders.ways()), std::as_bytes(colliders.pokes().shapes()),
                           std::as_bytes(std::span(pokeArguments)), std::as_bytes(state_->hands.values()),
                           state_->blade.head(), state_->blade.points()},
                          timestamps, hasBlade);
    commands.barrier();
    state_->recordStatus(commands, step.frame);
    commands.endStep();
    commands.hostBarrier();
    state_->previousH = parameters.h;
    state_->hasNewTopology = state_->isChanged = false;
}

void Simulation::recordTakeOver(VkCommandBuffer buffer, const Simulation& from, const vk::BufferView& copy,
                                const SavedState* saved) noexcept {
    recordReset(buffer);
    const State& other = *from.state_;
    const bool isAlike =
        state_->chosen.solver == other.chosen.solver && state_->program.order == other.program.order;
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->recordTaking(commands, other, copy, isAlike);
    if (!isAlike) {
        commands.barrier();
        state_->executor.adopt(commands);
    }
    state_->recordSettling(commands); // its material, or h, may be another one
    if (state_->hasMoreRoom(other)) state_->recordSurface(commands);
    commands.endStep();
    state_->isChanged = true;
    if (saved != nullptr) {
        state_->moveTo(*saved);
        if (!isAlike) state_->previousH = state_->settledEnd.h = 0;
        return;
    }
    State::Settled end = other.settledEnd;
    for (std::uint64_t frame = 0; frame < framesInFlight; ++frame) // from the oldest on
        end = other.settled(other.nextFrame + frame, end);
    state_->settledEnd = end;
    state_->previousH = isAlike ? end.h : 0;
    state_->anchors = other.anchors;
    if (isAlike) state_->hands = other.hands;
    state_->isUncut = other.isUncut;
    state_->hasNewTopology = other.hasNewTopology;
    state_->colliders.moveTo(end.time, end.pokes);
}

std::uint64_t Simulation::handOverSize() const noexcept {
    std::uint64_t size = 0;
    state_->forEachHanded([&](std::size_t, BufferId buffer) { size += view(buffer).size; });
    return size;
}

void Simulation::recordHandOver(VkCommandBuffer buffer, const vk::BufferView& to,
                                const vk::BufferView& saved) const noexcept {
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
    }
    return SceneChange(std::move(parts));
}

bool Simulation::recordChange(VkCommandBuffer buffer, SceneChange& change) noexcept {
    SceneChange::Parts& parts = *change.parts_;
    if (parts.changes != state_->changes) return false;
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
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->written, to, State::Way::out);
    commands.endStep();
    const auto pokes = this->pokes();
    return {state_->previousH,        state_->colliders.time(),
            state_->anchors.places(), {pokes.begin(), pokes.end()},
            state_->hasNewTopology,   state_->changes,
            state_->isUncut};
}

void Simulation::recordLoadState(VkCommandBuffer buffer, const vk::BufferView& from,
                                 const SavedState& saved) noexcept {
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
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->program.cutting.topology, to, State::Way::out);
    commands.endStep();
}

void Simulation::recordLoadTopology(VkCommandBuffer buffer, const vk::BufferView& from) noexcept {
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    state_->copy(commands, state_->program.cutting.topology, from, State::Way::back);
    for (const BufferId seen : state_->program.cutting.contactsSeen)
        commands.fill(view(seen), farAwayBits); // contacts are listed anew
    if (state_->changes > 0) state_->recordSettling(commands);
    commands.endStep();
    state_->hasNewTopology = true;
    state_->isUncut = false; // for all that the host knows
}

void Simulation::recordSkin(VkCommandBuffer buffer, SkinDetail detail) noexcept {
    vk::Commands commands(state_->device, buffer);
    commands.beginStep();
    if (detail == SkinDetail::drawn && drawnSkins().areWhole)
        state_->executor.wholeSkin(commands);
    else
        state_->executor.skin(commands);
    commands.endStep();
}

vk::BufferView Simulation::positions() const noexcept {
    return state_->executor.view(state_->program.positions);
}
vk::BufferView Simulation::velocities() const noexcept {
    return state_->executor.view(state_->program.velocities);
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
const std::vector<SkinRange>& Simulation::skins() const noexcept {
    return state_->skins;
}
Simulation::DrawnSkins Simulation::drawnSkins(Overlap overlap) const noexcept {
    const vk::BufferView whole = view(state_->program.wholeIndices);
    if (state_->isUncut && whole.size > 0) return {whole, state_->wholeSkins, true};
    const vk::BufferView mixed = view(state_->program.mixedIndices);
    if (overlap == Overlap::some && mixed.size > 0) return {mixed, state_->mixedSkins};
    return {skinIndices(), state_->skins};
}
CutSurface Simulation::cutSurface() const noexcept {
    const CutSurfaceBuffers& buffers = state_->program.cutSurface;
    return {view(buffers.vertices), view(buffers.rest),  view(buffers.indices),
            view(buffers.draws),    view(buffers.state), view(buffers.particles)};
}
vk::BufferView Simulation::pieceDraws() const noexcept {
    return state_->executor.view(state_->program.pieceDraws);
}
std::span<const Pose> Simulation::colliderPoses() const noexcept {
    return state_->colliders.poses();
}
std::span<const PokeState> Simulation::pokes() const noexcept {
    const collision::Pokes& pokes = state_->colliders.pokes();
    return std::span(pokes.states()).first(pokes.count());
}
vk::BufferView Simulation::view(BufferId buffer) const noexcept {
    return state_->executor.view(buffer);
}
const StepProgram& Simulation::program() const noexcept {
    return state_->program;
}

Status Simulation::status(std::uint64_t frame) const noexcept {
    const layout::StatusWords words = state_->statusWords(frame);
    const std::size_t slot = frame % framesInFlight;
    const layout::CutCounts counts = state_->cutCounts(frame);
    return {.frame = words.frame,
            .nonFinite = words.nonFinite,
            .firstBadParticle = ~words.invertedFirstBad,
            .contactRoom = words.candidates,
            .slowed = words.slowed,
            .sleeping = words.sleeping,
            .lostTime = state_->lostTime[slot],
            .linksCut = state_->hasBlade[slot] ? counts.linksOfStep : 0,
            .linksCutInAll = counts.links,
            .pieces = counts.pieces,
            .crumbs = counts.crumbs,
            .crumbParticles = counts.crumbParticles,
            .crumbMass = static_cast<float>(state_->program.cutting.crumbUnit * counts.crumbMass),
            .cutSurfaceMissing = counts.missing};
}

std::vector<std::string> Simulation::phases() const {
    std::vector<std::string> names;
    for (const std::uint32_t phase : state_->executor.timedPhases())
        names.push_back(state_->program.phases[phase]);
    return names;
}

} // namespace sinew::sim
