// On the host a step is one recording, submitted at once; the runner waits only for steps that are `inFlight`
// behind.
#include "sinew/runner.hpp"

#include "app/cut_links.hpp"
#include "app/guard.hpp"
#include "app/take_over.hpp"
#include "sim/compile/compile.hpp"
#include "sinew/cut_mesh.hpp"
#include "sinew/skin_mesh.hpp"
#include "sinew/vk/check.hpp"
#include "vk/allocator.hpp"

#include <chrono>
#include <numeric>

namespace sinew::tools {

namespace {

constexpr std::size_t mostFrameTimes = 65'536;

double nowMs() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

std::string bodyOf(const sim::Scene& scene, std::uint32_t particle) {
    for (const sim::Body& body : scene.bodies)
        if (particle >= body.firstParticle && particle - body.firstParticle < body.particleCount)
            return body.name;
    return {};
}

} // namespace

Runner::Runner(Session& session, const sim::Scene& scene, const sim::Settings& settings,
               scenes::ScriptedBlades blades)
    : session_(session), scene_(scene), settings_(settings), blades_(std::move(blades)), rooms_(settings),
      simulation_(std::make_unique<sim::Simulation>(session.device, scene, settings)),
      parts_(session.device.description().type == "software"), drain_(session.queue) {
    const auto phases = static_cast<std::uint32_t>(simulation().phases().size());
    for (std::uint32_t i = 0; i < sim::Simulation::framesInFlight; ++i)
        timestamps_.emplace_back(session.device, phases);
    phaseSums_.resize(phases);
    submitReset();
    submitStep(0);
    session_.queue.waitIdle();
    restart();
}

void Runner::restart() {
    submitReset();
    session_.queue.waitIdle();
    done_ = slowed_ = timed_ = recorded_ = played_ = 0;
    surfaceMissing_ = 0;
    lists_ = {};
    recordSum_ = 0;
    divergence_.reset();
    frameMs_.clear();
    deviceMs_.clear();
    std::ranges::fill(phaseSums_, 0.0);
}

app::SavedRun Runner::save() {
    app::SavedRun run = app::saveRun(session_.device, *simulation_, settings_, session_.queue);
    run.played = played_ + done_;
    return run;
}

void Runner::load(const app::SavedRun& run) {
    app::loadRun(session_.device, *simulation_, run, session_.queue);
    played_ = run.played;
}

void Runner::submitReset() {
    const VkCommandBuffer commands = session_.queue.begin();
    simulation_->recordReset(commands);
    session_.queue.submit(commands);
}

void Runner::submitStep(std::uint64_t frame) {
    const double start = nowMs();
    const std::size_t slot = frame % submitted_.size();
    submitted_[slot] = parts_.submit(session_.queue, *simulation_,
                                     {.dt = scene_.dt,
                                      .gravity = scene_.gravity,
                                      .frame = frame,
                                      .anchors = {},
                                      .repeats = true,
                                      .blade = blades_.at(played_ + frame)},
                                     &timestamps_[slot]);
    recordSum_ += nowMs() - start;
    ++recorded_;
}

/// False if the step and all submitted after it must be repeated.
bool Runner::finishStep(std::uint64_t frame) {
    const std::size_t slot = frame % submitted_.size();
    session_.queue.wait(submitted_[slot]);
    if (divergence_) return true; // was already in flight
    if (stepTimes_.awaits(frame)) stepTimes_.see(frame, firstUnfinished(frame), nowMs());
    const sim::Status status = simulation().status(frame);
    if (status.frame != static_cast<std::uint32_t>(frame))
        throw std::logic_error("the status of step " + std::to_string(frame) + " is that of another");
    if (status.contactRoom > 0 && makeRoom(status.contactRoom)) {
        stepTimes_.undo(frame);
        return false;
    }
    if (status.lacksLists) {
        session_.queue.waitIdle(); // for later steps
        stepTimes_.undo(frame);
        return false;
    }
    countTime(slot);
    if (status.contactRoom > 0)
        divergence_ = {.step = frame + 1, .isCrowded = true};
    else if (status.nonFinite > 0)
        divergence_ = {frame + 1, status.firstBadParticle, status.nonFinite,
                       bodyOf(scene_, status.firstBadParticle)};
    else {
        ++done_;
        lists_.calm += status.isCalm ? 1 : 0;
        slowed_ += status.slowed;
        cuts_ = {.links = status.linksCutInAll,
                 .pieces = status.pieces,
                 .debris = status.debris,
                 .debrisParticles = status.debrisParticles,
                 .debrisMass = double{status.debrisMass}};
        surfaceMissing_ = status.cutSurfaceMissing;
        if (settings_.keepsForces) forces_ = simulation().forces(frame);
    }
    return true;
}

/// The first step after `frame`, which has finished, that is in flight or not submitted.
std::uint64_t Runner::firstUnfinished(std::uint64_t frame) const {
    std::uint64_t finished = 0;
    const vk::Device& device = session_.device;
    vk::check(
        device.functions().vkGetSemaphoreCounterValue(device.handle(), session_.queue.timeline(), &finished),
        "vkGetSemaphoreCounterValue", "the runner");
    std::uint64_t next = frame + 1;
    while (next < next_ && submitted_[next % submitted_.size()] <= finished) ++next;
    return next;
}

void Runner::countTime(std::size_t slot) {
    const std::vector<double> phases = timestamps_[slot].milliseconds();
    if (frameMs_.size() < mostFrameTimes) {
        frameMs_.emplace_back();
        if (!phases.empty()) deviceMs_.emplace_back();
    }
    frameMs_[done_ % mostFrameTimes] = stepTimes_.take();
    if (!phases.empty())
        deviceMs_[done_ % mostFrameTimes] = std::accumulate(phases.begin(), phases.end(), 0.0);
    if (!phases.empty()) parts_.measured(deviceMs_[done_ % mostFrameTimes]);
    for (std::size_t i = 0; i < phases.size(); ++i) phaseSums_[i] += phases[i];
    timed_ += phases.empty() ? 0 : 1;
}

/// Goes on in a simulation with these settings: from the state before the steps that were undone, else after
/// the newest.
void Runner::continueWith(const sim::Settings& settings) {
    successor_.request({session_.device, [this] { return scene_; }, settings});
    sim::Successor::Made next = successor_.take();
    app::takeOver(*next.simulation, *simulation_, session_.queue);
    simulation_ = std::move(next.simulation);
    settings_ = next.settings;
    rooms_.adopt(settings_);
}

/// False if there can be no such room.
bool Runner::makeRoom(std::uint32_t needed) {
    const std::optional<sim::Settings> settings = rooms_.forContacts(settings_, needed);
    if (settings) continueWith(*settings);
    return settings.has_value();
}

/// Grows the surface of cuts; all steps have finished.
void Runner::makeSurfaceRoom() {
    if (!rooms_.lackSurface(surfaceMissing_)) return;
    const std::optional<sim::Settings> settings = rooms_.forSurface(settings_, surfaceMissing_);
    if (!settings) return;
    try {
        continueWith(*settings);
        surfaceMissing_ = 0;
    } catch (const vk::Error&) { // of memory, or a longer buffer than the device has
        rooms_.refuseSurface();
    }
}

void Runner::advance(std::uint64_t count, std::uint32_t inFlight,
                     const std::function<void(std::uint64_t)>& onStep) {
    const std::uint64_t end = done_ + count;
    std::uint64_t waiting = done_;
    next_ = done_;
    stepTimes_.start(done_, nowMs());
    while (waiting < end) {
        if (waiting == next_ && !divergence_) makeSurfaceRoom();
        const bool mayGoOn =
            next_ < end && !rooms_.lackSurface(surfaceMissing_) && !divergence_ && !app::isInterrupted();
        if (mayGoOn && next_ - waiting < inFlight) {
            submitStep(next_++);
        } else if (waiting < next_ && !finishStep(waiting)) {
            lists_.repeated += next_ - waiting;
            next_ = waiting;
        } else if (waiting < next_) {
            ++waiting;
            if (onStep) onStep(done_);
        } else {
            break;
        }
    }
    if (!divergence_) makeSurfaceRoom();
}

std::vector<std::string> Runner::complaints() {
    if (divergence_ && divergence_->isCrowded) return {};
    return simulation_->complaintsOfUse();
}

std::vector<double> Runner::phaseMs() const {
    std::vector<double> means;
    for (const double sum : phaseSums_)
        if (timed_ > 0) means.push_back(sum / static_cast<double>(timed_));
    return means;
}

double Runner::recordMs() const {
    return recorded_ == 0 ? 0 : recordSum_ / static_cast<double>(recorded_);
}

std::uint64_t Runner::deviceBytes() const {
    return session_.device.allocator().statistics().used;
}

State Runner::readState() {
    State state{session_.queue.download<std::array<float, 4>>(simulation().positions()),
                session_.queue.download<std::array<float, 4>>(simulation().velocities()),
                {},
                {}};
    if (simulation().pieces().size > 0)
        for (const std::uint32_t piece : session_.queue.download<std::uint32_t>(simulation().pieces()))
            state.isRemoved.push_back(piece == REMOVED_PIECE);
    if (std::ranges::any_of(scene_.bodies, &sim::Body::isAbsent)) {
        state.isRemoved.resize(scene_.particles.size());
        for (std::size_t i = 0; i < state.isRemoved.size(); ++i)
            state.isRemoved[i] = state.isRemoved[i] || state.isAway(i);
    }
    const sim::BufferId links = simulation().program().cutting.links;
    if (links != sim::BufferId{}) {
        const app::CutLinks cut(scene_, sim::stateLayout(scene_, settings_).slot);
        const auto words = session_.queue.download<std::uint32_t>(simulation().view(links));
        for (std::size_t d = 0; d < scene_.distances.size(); ++d) state.isCut.push_back(cut.isCut(d, words));
    }
    if (!settings_.sleeps) return state;
    const std::vector<float> inverseMass = sim::inverseMasses(scene_); // 0 on the device for sleepers
    for (std::size_t i = 0; i < inverseMass.size(); ++i) {
        const bool isAway = state.isAway(i);
        state.isAsleep.push_back(!isAway && inverseMass[i] > 0 && state.positions[i][3] == 0);
        if (isAway) continue;
        state.positions[i][3] = state.velocities[i][3] = inverseMass[i];
    }
    return state;
}

SkinMeshes Runner::readSkins() {
    SkinMeshes meshes;
    meshes.count.fragments = cuts_.pieces;
    if (scene_.skins.empty()) return meshes;
    const VkCommandBuffer commands = session_.queue.begin();
    simulation_->recordSkin(commands);
    session_.queue.wait(session_.queue.submit(commands));
    const app::Drawn drawn = app::downloadDrawn(session_.queue, simulation(), scene_, settings_);
    meshes.count = app::countPieces(scene_, drawn, cuts_.pieces);
    std::size_t first = 0;
    for (std::size_t s = 0; s < scene_.skins.size(); ++s) {
        const sim::Skin& skin = scene_.skins[s];
        std::vector<sim::Vec3> positions;
        for (std::size_t v = first; v < first + skin.vertexCount(); ++v) {
            const auto& x = drawn.skinVertices[v].position;
            positions.push_back({x.x, x.y, x.z});
        }
        auto cut = cutMeshes(scene_, s, drawn);
        meshes.pieces.push_back(cut ? std::move(*cut) : std::vector{skinMesh(skin, positions)});
        meshes.whole.push_back(joined(meshes.pieces.back(), skin.name));
        meshes.shaded.push_back(shadedPieces(scene_, s, drawn));
        first += skin.vertexCount();
    }
    return meshes;
}

} // namespace sinew::tools
