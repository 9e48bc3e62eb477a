// The private state of a Simulation, for the files of the façade alone. simulation.cpp constructs it and
// records steps; simulation_states.cpp takes states over, saves, loads and changes them.
#pragma once

#include "common/layout.h"
#include "sim/constraints/attachment.hpp"
#include "sim/cutting/blade.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sim/fields/fields.hpp"
#include "sim/grabs/grab.hpp"
#include "sim/model/rounding.hpp"
#include "sim/model/scene_key.hpp"
#include "sim/model/touching.hpp"
#include "sim/motions/motions.hpp"
#include "sim/program/program_values.hpp"
#include "sim/rigid/collider_paths.hpp"
#include "sim/simulation/calm_steps.hpp"
#include "sim/simulation/carrying.hpp"
#include "sim/simulation/misuse.hpp"
#include "sim/simulation/one_thread.hpp"
#include "sim/simulation/output_ring.hpp"
#include "sim/simulation/pace.hpp"
#include "sim/simulation/simulation_ring.hpp"
#include "sim/simulation/skin_ranges.hpp"
#include "sim/solvers/split.hpp"
#include "sinew/ranges.hpp"
#include "sinew/simulation.hpp"
#include "sinew/substeps.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>

namespace sinew::sim {

/// Returns `scene`. Throws std::invalid_argument with the complaints of validate(), if any.
const Scene& valid(const Scene& scene, const Settings& settings);
SplitBudget dampedBudget(const Scene& scene, const Settings& settings);

struct SceneChange::Parts {
    ProgramValues values;
    std::vector<vk::Buffer> contents; // new initial contents, one for each of values.buffers
    SplitBudget budget;
    float damping;
    std::uint32_t changes; // State::changes when it was prepared
};

struct Simulation::State {
#ifndef NDEBUG
    OneThread oneThread{"simulation"}; // and the world that owns it
#endif
    const vk::Device& device;
    Settings chosen; // with a resolved number of substeps
    StepProgram program;
    GpuExecutor executor;
    std::vector<BufferId> written;
    SceneKey sceneKey;
    StepRing ring;
    OutputRing outputs;
    MisuseLog misuse;
    bool hasState = false; // after a reset or take-over
    std::vector<SkinRange> skins, wholeSkins;
    constraints::attachment::Anchors anchors;
    grabs::GrabRequests grabs;
    fields::FieldRequests fields;
    motions::MotionRequests motions;
    rigid::ColliderPaths colliders;
    cutting::BladeWords blade;
    bool hasNewTopology = false; // loaded since the last step
    bool isUncut = false;        // since the last reset: no step can have cut anything
    std::uint32_t changes = 0;   // number of material changes
    bool isChanged = false;      // since the last step
    bool isCarried = false;      // its state came from a scene with other bodies since the last step
    SplitBudget budget;
    float theta, omega, damping;
    std::uint32_t substeps;
    bool storesPlaces; // gathers of `split` store x, not x + theta h v: if contacts follow, or forces are
                       // kept
    bool hasContacts;  // of particles or faces
    Pace pace;         // of the last step; the leapfrog starts with a half kick
    Vec3 gravity{};    // of the last step [m/s^2]
    // A finished step: its substeps, and the poses of colliders and host colliders at its end. The list has
    // its length from the start: recording allocates nothing.
    struct Settled {
        Pace pace{};
        double time = 0;
        rigid::HostColliderStates hostColliders;
    };
    // A step whose result the host has not read yet, and the state of the host at its end.
    struct Unsettled {
        bool isRecorded = false;
        Settled end;
    };
    std::vector<Unsettled> unsettled;        // by slot of the ring
    std::vector<std::string> warned, untold; // warnings of the scene
    std::uint64_t nextFrame = 0;
    Settled settledEnd;
    // The host's part of the state before a step, by slot of the ring, for hosts that repeat steps.
    struct Before {
        Pace pace{};
        double time = 0;
        rigid::HostColliderStates hostColliders;
        std::vector<layout::vec4> anchors;
        std::optional<grabs::GrabRequests> grabs;
        bool isUncut = false, hasNewTopology = false, isChanged = false;
        std::uint32_t changes = 0, topologies = 0;
        std::optional<std::uint64_t> frame; // of that step
    };
    std::vector<Before> befores;
    const bool
        isKeptWhereUndone; // the whole state is restored; else an undone step loses velocities or remainders
    std::optional<float> undoneH; // substep of the undone steps, if the next step follows these [s]
    std::uint32_t topologies = 0; // number of loaded topologies
    CalmSteps calmSteps;
    bool isNewState = true;                   // no step was recorded since it came from elsewhere
    std::uint32_t generation = 0;             // of steps: see beginGeneration()
    std::optional<std::uint64_t> lackedLists; // the first step of this generation that lacked lists
    bool isBack = false;                      // the host's part is as it was before that step

    State(const vk::Device& d, const Scene& scene, const Settings& asked)
        : State(d, scene, withSubsteps(valid(scene, asked), asked), {}) {}

    struct Resolved {};
    State(const vk::Device& d, const Scene& scene, const Settings& settings, Resolved)
        : device(d.anchored()), chosen(settings), program(compileFor(d, scene, settings)),
          executor(d, program, outputUseOf(d, settings)), written(writtenByStep(program)),
          sceneKey(sim::sceneKey(scene)), ring(d, settings.framesInFlight, resultSizes(program)),
          outputs(d, program, executor, settings), skins(rangesOf(scene.skins, Triangles::all)),
          wholeSkins(rangesOf(scene.skins, Triangles::whole)), anchors(scene.attachments),
          grabs(settings.grabs, scene.particles.size()),
          fields(settings.fields, scene.bodies.size(), program.fields),
          motions(settings.motions, program.motions),
          colliders(scene.colliders, scene.driven, settings.hostColliders),
          budget(dampedBudget(scene, settings)), theta(settings.solver == Solver::split ? settings.theta : 0),
          omega(settings.omega), damping(scene.damping), substeps(settings.substeps),
          storesPlaces(solvers::split::contactsFollow(scene, settings)),
          hasContacts(particlesTouch(scene) || facesTouch(scene)), unsettled(settings.framesInFlight),
          warned(warnings(scene)), untold(warned), befores(settings.framesInFlight),
          isKeptWhereUndone(settings.publishesVelocities && !keepsRemainders(scene, settings.substeps)) {
        for (Before& one : befores) {
            one.anchors.resize(anchors.values().size());
            one.hostColliders.resize(settings.hostColliders);
        }
        for (Unsettled& one : unsettled) one.end.hostColliders.resize(settings.hostColliders);
        settledEnd.hostColliders.resize(settings.hostColliders);
    }

    // Sizes of the results that a step reads back beside its status.
    static ResultSizes resultSizes(const StepProgram& of) {
        const auto countOf = [&](BufferId buffer) -> std::size_t {
            return buffer == BufferId{} ? 0 : of.buffers[buffer.index].count;
        };
        return {of.cutting.counts != BufferId{}, countOf(of.forces.sums), countOf(of.events.list)};
    }

    bool mayBeCut() const noexcept {
        return program.cutting.counts != BufferId{};
    }

    layout::StepParams parameters(const Step& step, float dt, std::uint32_t lists) const {
        const float h = dt / static_cast<float>(substeps), longest = pace.longestOf(dt, h);
        const Vec3& g = step.gravity;
        return {.gravity = {g.x, g.y, g.z, fields.key()},
                .h = h,
                .hPrevious = pace.h,
                .thetaH = theta * h,
                .thetaHPrevious = theta * undoneH.value_or(pace.h),
                .velocityFactor = std::exp(-damping * h),
                .restSpeed = 2 * (std::sqrt(g.x * g.x + g.y * g.y + g.z * g.z) + fields.acceleration()) * h,
                .frame = static_cast<std::uint32_t>(step.frame),
                .dampingShare =
                    static_cast<float>(dampingBudget(budget, double{theta}, double{longest}) / double{omega}),
                .multiplierScale = pace.h > 0 ? std::min(1.0f, h * h / (pace.h * pace.h)) : 0,
                .thetaHStored = storesPlaces ? 0 : theta * h,
                .wakes = (step.wakes || hasNewTopology || isChanged ? WAKES_ALL : 0u) |
                         (isCarried ? WAKES_LISTS : 0u),
                .lists = lists,
                .longestH = longest};
    }

    // The last finished step before `frame`: the one in this slot of the ring if it has finished and was not
    // undone, else `end`.
    const Settled& settled(std::uint64_t frame, const Settled& end) const {
        const Unsettled& step = unsettled[ring.slotOf(frame)];
        if (!step.isRecorded) return end;
        const std::uint64_t recorded = ring.step(frame).frame;
        return ring.isFinished(recorded) && !ring.isUndone(recorded) ? step.end : end;
    }

    // The last finished step that was not undone.
    const Settled& lastSettled() const {
        const Settled* end = &settledEnd;
        for (std::uint64_t frame = 0; frame < ring.slots(); ++frame) // oldest first
            end = &settled(nextFrame + frame, *end);
        return *end;
    }

    // Dispatch arguments of the passes that run only for host colliders: 0 groups without one.
    std::array<layout::DispatchArguments, HOST_COLLIDER_ARGUMENTS> hostColliderArguments() const {
        const std::uint32_t one = colliders.hostColliders().areAny() ? 1 : 0;
        const auto arguments = [one](std::uint32_t groups) {
            return layout::DispatchArguments{one * groups, 1, 1, 0};
        };
        static_assert(HOST_COLLIDERS_PLACED == 0 && HOST_COLLIDERS_TOUCHING == 1);
        return {arguments(program.hostColliders.placed), arguments(program.hostColliders.touching)};
    }

    // Notes the parts of `step` that are ignored.
    void noteMisuse(const Step& step) noexcept {
        const std::uint64_t frame = step.frame;
        const RecordedStep& before = ring.step(frame);
        if (!hasState) misuse.note(Misuse::noReset, frame);
        if (before.isRecorded && !ring.isFinished(before.frame))
            misuse.note(Misuse::tooManyInFlight, frame, before.frame, ring.slots());
        const auto noteMore = [&](Misuse kind, std::size_t given, std::size_t allowed) {
            if (given > allowed) misuse.note(kind, frame, given, allowed);
        };
        noteMore(Misuse::tooManyGrabs, step.grabs.size(), chosen.grabs);
        noteMore(Misuse::tooManyHostColliders, step.hostColliders.size(), chosen.hostColliders);
        noteMore(Misuse::tooManyFields, step.fields.size(), chosen.fields);
        noteMore(Misuse::tooManyMotions, step.motions.size(), chosen.motions);
        noteMore(Misuse::tooManyAnchors, step.anchors.size(), anchors.count());
        const bool asksForBlade = !step.blade.from.empty() || !step.blade.to.empty();
        if ((asksForBlade || step.ray.radius > 0) && !mayBeCut())
            misuse.note(Misuse::nothingToCut, frame);
        else if (asksForBlade && !blade.hasQuads())
            misuse.note(Misuse::badBlade, frame, step.blade.from.size(), step.blade.to.size());
    }

    // Requires readSteps() first.
    void noteRepetition(std::uint64_t frame) noexcept {
        if (missesRepetition(frame)) misuse.note(Misuse::notRepeated, frame, *lackedLists);
    }

    // To be called before something is recorded that a repeated step must not go back beyond.
    void noteUnsettled() noexcept {
        goBack();
        for (std::uint64_t i = 0; i < ring.slots(); ++i) {
            const RecordedStep& step = ring.step(nextFrame + i);
            if (step.repeats && !step.isRead && step.generation == generation)
                return misuse.note(Misuse::mayBeRepeated, step.frame);
        }
    }

    // Records the copy of a step's results to host-visible memory.
    void recordStatus(vk::Commands& commands, std::uint64_t frame) const noexcept {
        if (program.particleCount == 0) { // no pass writes the status then
            const layout::StatusWords words{.frame = static_cast<std::uint32_t>(frame)};
            commands.update(executor.view(program.status), &words, sizeof words);
            commands.barrier();
        }
        ring.record(commands, frame,
                    {executor.view(program.status), executor.view(program.cutting.counts),
                     executor.view(program.forces.sums), executor.view(program.events.list)});
    }

    // Records the mark that a step has finished: after a barrier that follows all its results for the host.
    void recordEnd(vk::Commands& commands, std::uint64_t frame) const noexcept {
        ring.recordEnd(commands, frame, executor.view(program.status));
    }

    // True if both have the same solver and order of particles: a take-over then carries all that a step
    // leaves.
    bool isAlike(const State& other) const noexcept {
        return chosen.solver == other.chosen.solver && program.order == other.program.order;
    }

    // Throws std::invalid_argument, with the reason, if this state cannot continue from one of `other`.
    void requireSameScene(const State& other, const vk::BufferView& copy, std::uint64_t copied, bool isAlike,
                          bool isUncut) const;

    // Whether the surface of cuts has more room here.
    bool hasMoreRoom(const State& other) const noexcept {
        return executor.view(program.cutSurface.rest).size >
                   other.executor.view(other.program.cutSurface.rest).size ||
               program.pieceVertices > other.program.pieceVertices;
    }

    // Rewrites the parts of the surface of cuts that are missing or have another place here.
    void recordSurface(vk::Commands& commands) noexcept {
        const auto setMissing = [&](BufferId buffer, std::size_t offset) {
            vk::BufferView word = executor.view(buffer);
            if (word.size == 0) return;
            word.offset += offset;
            word.size = sizeof(std::uint32_t);
            commands.fill(word, 1);
        };
        commands.barrier(); // both were copied
        setMissing(program.cutSurface.state, offsetof(layout::SurfaceState, missing));
        for (const BufferId state : program.sheetStates)
            setMissing(state, offsetof(layout::SheetState, missing));
        executor.surface(commands);
    }

    // Records the passes that recompute values which follow from the scene alone, after a state was put into
    // the buffers.
    void recordSettling(vk::Commands& commands) noexcept {
        if (program[List::refresh].empty()) return;
        commands.barrier(); // the state was copied
        for (const BufferId list : program.cutting.lists) executor.restore(commands, list);
        commands.barrier();
        executor.record(commands, List::refresh);
    }

    // The host's part of a reset.
    void reset() noexcept;
    // Whether lastSettled() is the same whichever of the steps in flight will be undone, and none of them may
    // have to be recorded again.
    bool isEndKnown() const noexcept;

    // Continues the host's part of `other`, whose scene has other bodies.
    void carry(const State& other, const Origins& origins) noexcept;

    // Calls use(index, buffer) for public positions and velocities, then for all carried buffers.
    template <typename Use> void forEachHanded(const Use& use) const {
        std::size_t index = 0;
        use(index++, program.positions);
        use(index++, program.velocities);
        for (const StateBuffer& stateBuffer : program.stateBuffers) use(index++, stateBuffer.from);
    }

    // Copies the state of `other`, from its buffers or from `copy`. If both are alike, carried buffers are
    // copied too, matched by name (several may have the same one); a smaller buffer fills the head of a
    // larger one.
    void recordTaking(vk::Commands& commands, const State& other, const vk::BufferView& copy,
                      bool isAlike) const noexcept {
        std::size_t next = 0; // next candidate among own carried buffers
        vk::BufferView place = copy;
        const auto nameOf = [](const StepProgram& of, std::size_t c) -> const std::string& {
            return of.buffers[of.stateBuffers[c].to.index].label;
        };
        other.forEachHanded([&](std::size_t index, BufferId handed) {
            vk::BufferView origin = other.executor.view(handed);
            if (copy.buffer != VK_NULL_HANDLE) {
                place.size = origin.size;
                origin = place;
                place.offset += place.size;
            }
            BufferId own = index == 0 ? program.positions : program.velocities, saved;
            if (index > 1) {
                std::size_t found = next;
                while (found < program.stateBuffers.size() &&
                       nameOf(program, found) != nameOf(other.program, index - 2))
                    ++found;
                if (!isAlike || found == program.stateBuffers.size()) return;
                own = program.stateBuffers[found].to;
                next = found + 1;
                if (program.stateBuffers[found].carry.of == Elements::bodyPartners &&
                    !program.events.hasPartnersOf(other.program.events))
                    return; // the entries of other partners
                // a saved copy that only this program has, because it keeps forces, starts as the value taken
                // over
                const StateBuffer& theirs = other.program.stateBuffers[index - 2];
                if (theirs.from == theirs.to && program.stateBuffers[found].from != own)
                    saved = program.stateBuffers[found].from;
            }
            for (const BufferId copied : {own, saved}) {
                vk::BufferView target = executor.view(copied);
                target.size = origin.size = std::min(target.size, origin.size);
                if (target.size > 0) commands.copy(origin, target);
            }
        });
    }

    // The place of a buffer in a copy of the state; the buffer itself if it is not part of the state.
    vk::BufferView placeIn(const vk::BufferView& saved, BufferId buffer) const noexcept {
        vk::BufferView place = saved;
        for (const BufferId one : written) {
            place.size = executor.view(one).size;
            if (one == buffer) return place;
            place.offset += place.size;
        }
        return executor.view(buffer);
    }

    void forgetUnsettled() noexcept {
        for (Unsettled& one : unsettled) one.isRecorded = false;
        calmSteps = {};
        isNewState = true;
        outputs.forget();
        beginGeneration();
    }

    void beginGeneration() noexcept {
        ++generation;
        lackedLists.reset();
        isBack = false;
        undoneH.reset();
    }

    // True if repeating the step helps. A step that lacks room for contacts needs another simulation first.
    static bool lackLists(const layout::StatusWords& words) noexcept {
        return words.lacksLists > 0 && words.candidates == 0;
    }
    bool mayBeCalm(float h) const noexcept;
    // Reads from finished steps how long lists stay valid, oldest step first.
    void readSteps() noexcept;
    // Restores the host's part of the state to match the device once a step is known to have lacked lists;
    // all later steps are undone too.
    void goBack() noexcept;
    // Saves the host's part of the state before `frame`, which may lack lists, is recorded.
    void noteBefore(std::uint64_t frame) noexcept;
    // Whether the host can no longer repeat the step that lacked lists, because `frame` takes its slot of the
    // ring.
    bool missesRepetition(std::uint64_t frame) const noexcept {
        return lackedLists && frame >= *lackedLists + ring.slots();
    }

    // Goes on at the pace of another program; anew if it is not alike.
    void follow(const Pace& before, const State& other, bool isAlike) noexcept {
        pace = isAlike ? before.inSubsteps(other.substeps, substeps) : Pace{};
        settledEnd.pace = pace;
    }

    // Sets the host's part of the state.
    void moveTo(const SavedState& saved) noexcept {
        pace = {saved.h, saved.longestH};
        colliders.moveTo(saved.colliderTime, saved.hostColliders);
        noteEnd(settledEnd, pace);
        forgetUnsettled();
        undoneH = saved.undoneH;
        anchors.moveTo(saved.anchors);
        isCarried = true; // a state saved right after a take-over has other groups that run
        hasNewTopology = saved.hasNewTopology;
        isUncut = saved.isUncut;
        grabs.reset();
    }

    // Sets `end` to where the colliders are now.
    void noteEnd(Settled& end, const Pace& itsPace) const noexcept {
        end.pace = itsPace;
        end.time = colliders.time();
        std::ranges::copy(colliders.hostColliders().states(), end.hostColliders.begin());
    }

    // Copies buffers into consecutive ranges of `copies`, or back from there.
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

} // namespace sinew::sim
