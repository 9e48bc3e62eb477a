// Counts steps and converts status words to sentences.
#include "viewer/document/document.hpp"

#include "scenes/recovery.hpp"
#include "sim/core/counted.hpp"
#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace sinew::viewer {

std::string Divergence::sentence() const {
    return "The simulation became unstable (body \"" + body + "\", step " + std::to_string(step) + ").";
}

std::string Divergence::advice() const {
    return sentence() +
           " The last good state is shown. Press R, then try more substeps or a softer material.";
}

std::string Divergence::report() const {
    return sentence() + " " + sim::counted(particles, "particle is", "particles are") +
           " not finite, the first of them number " + std::to_string(firstParticle) +
           ". Try more substeps or a softer material.";
}

Document::Document(const vk::Device& device, sim::Scene scene, const sim::Settings& settings,
                   const sim::Material& material)
    : device_(device.anchored()), given_(std::move(scene)), scene_(sim::withMaterial(given_, material)),
      first_(settings), settings_(settings), stiffness_(sim::inspectStiffness(scene_, settings)),
      rooms_(settings), simulation_(std::make_unique<sim::Simulation>(device, scene_, settings)),
      gravity_(scene_.gravity), material_(material) {
    const sim::Vec3& g = scene_.gravity;
    const float length = std::hypot(g.x, g.y, g.z);
    if (length > 0) down_ = {g.x / length, g.y / length, g.z / length};
}

Document::~Document() {
    if (turning_.valid()) turning_.wait();
}

void Document::recordReset(VkCommandBuffer commands) noexcept {
    simulation_->recordReset(commands);
    steps_ = newest_ = played_ = 0;
}

app::SavedRun Document::save(const vk::Device& device, vk::Queue& queue) const {
    app::SavedRun run = app::saveRun(device, *simulation_, settings_, queue);
    run.played = played_;
    run.material = material_;
    run.gravity = gravity_;
    return run;
}

void Document::load(const vk::Device& device, const app::SavedRun& run, vk::Queue& queue) {
    if (run.material != material_) {
        turnNow(run.material);
        const VkCommandBuffer commands = queue.begin();
        simulation_->recordReset(commands);
        recordTurn(commands);
        queue.wait(queue.submit(commands));
    }
    app::loadRun(device, *simulation_, run, queue);
    gravity_ = run.gravity;
    steps_ = newest_ = 0;
    played_ = run.played;
}

void Document::recordStep(std::span<const VkCommandBuffer> parts, vk::Timestamps* timestamps,
                          std::span<const sim::Grab> grabs, const sim::Blade& blade,
                          std::span<const sim::HostCollider> hostColliders) noexcept {
    recordTurn(parts.front());
    ++recordedSteps_;
    const sim::Blade scripted = blades_.at(played_++);
    sim::Step step{.dt = scene_.dt, .gravity = gravity_, .frame = ++steps_};
    newest_ = std::max(newest_, steps_);
    step.grabs = grabs;
    step.hostColliders = hostColliders;
    step.repeats = repeats_;
    step.blade = scripted.from.empty() ? blade : scripted;
    simulation_->record(parts, step, timestamps);
}

void Document::setGravity(float gravity) noexcept {
    gravity_ = down_;
    gravity_.x *= gravity;
    gravity_.y *= gravity;
    gravity_.z *= gravity;
}

sim::Scene Document::sceneOf(const sim::Material& material, const sim::Settings& settings) const {
    sim::Scene scene = scenes::withoutDefaults(sim::withMaterial(given_, material), defaults_, settings);
    if (!blades_.areAny()) scenes::leaveWhole(scene, settings);
    return scene;
}

// Reads of the step program only what does not change meanwhile: recordTurn() waits for this.
Document::Turned Document::prepare(const sim::Material& material) const {
    Turned turned{material, sceneOf(material, settings()), {}, std::nullopt};
    turned.change = simulation().prepareChange(turned.scene);
    turned.stiffness = sim::inspectStiffness(turned.scene, settings());
    return turned;
}

void Document::beginTurn() {
    if (!wanted_ || turning_.valid() || ready_ || isGrowing()) return; // for the simulation that comes
    turning_ = std::async(std::launch::async, [this, material = *std::exchange(wanted_, std::nullopt)] {
        return prepare(material);
    });
}

void Document::turn(const sim::Material& material) {
    wanted_ = material;
    beginTurn();
}

void Document::turnNow(const sim::Material& material) {
    ready_ = prepare(material);
    refused_.reset();
    if (ready_->change) return;
    ready_.reset();
    refused_ = material;
}

void Document::wantShape(sim::Solver solver, std::uint32_t substeps) {
    const bool isBegun = next_ && !refused_ && next_->settings.solver == solver &&
                         next_->settings.substeps == substeps && next_->material == material_;
    if (!isBegun) dropShape();
    shape_ = Shape{solver, substeps};
}

void Document::keepShape() {
    dropShape();
    shape_.reset();
}

void Document::dropShape() {
    if (!next_ || next_->purpose != Purpose::shape) return;
    successor_.drop();
    next_.reset();
}

// The thread reads the scene as it was given, which never changes: the material may be turned meanwhile.
void Document::make(const sim::Settings& settings, const sim::Material& material) {
    successor_.request(
        {device_, [this, settings, material] { return sceneOf(material, settings); }, settings});
}

void Document::begin(const Next& next) {
    next_ = next;
    make(next.settings, next.material);
}

void Document::beginShape() {
    sim::Settings settings = settings_;
    if (shape_) {
        settings.solver = shape_->solver;
        settings.substeps = shape_->substeps;
    }
    begin({Purpose::shape, settings, refused_ ? *refused_ : ready_ ? ready_->material : material_});
}

// A growth for the surface makes way: what still lacks room then says so again.
bool Document::isShapeMade() {
    if (!wantsShape() || lacksContactRoom() || made_ || undoneSteps() > 0) return false;
    if (!next_ || next_->purpose != Purpose::shape) beginShape();
    return successor_.isReady();
}

void Document::reshape(vk::Queue& queue, const app::Bring& bring) {
    if (!wantsShape()) return;
    assert(!lacksContactRoom() && !made_ && undoneSteps() == 0);
    if (!next_ || next_->purpose != Purpose::shape) beginShape();
    const Next next = *std::exchange(next_, std::nullopt);
    shape_.reset();
    refused_.reset();
    ready_.reset();
    awaitTurn(); // it is prepared for the old simulation
    takeSuccessor(next.material, queue, bring);
    stiffness_ = sim::inspectStiffness(scene_, settings_);
}

void Document::takeSuccessor(const sim::Material& material, vk::Queue& queue, const app::Bring& bring) {
    sim::Successor::Made made = successor_.take();
    app::takeOver(*made.simulation, *simulation_, queue, bring);
    continueIn(std::move(made), material);
}

// Waits for a simulation with these rooms.
void Document::enlarge(const sim::Settings& settings, vk::Queue& queue, const app::Bring& bring) {
    next_.reset();
    make(settings, material_);
    takeSuccessor(material_, queue, bring);
}

// It has taken over, and nothing uses the simulation before it any more.
void Document::continueIn(sim::Successor::Made made, const sim::Material& material) {
    simulation_ = std::move(made.simulation);
    settings_ = made.settings;
    scene_ = std::move(made.scene);
    rooms_.adopt(settings_);
    material_ = material;
}

void Document::widen(const sim::Settings& roomy, vk::Queue& queue) {
    if (!sim::haveRoomsOf(settings_, roomy)) enlarge(sim::withRoomsOf(settings_, roomy), queue, {});
}

void Document::takeOver(const Document& from, const app::Bring& bring) {
    const sim::Settings roomy = sim::withRoomsOf(settings_, from.settings_);
    if (!sim::haveRoomsOf(settings_, roomy)) // else it was made with them: pipelines take their time
        simulation_ = std::make_unique<sim::Simulation>(device_, scene_, roomy);
    settings_ = roomy;
    rooms_.continueFrom(from.rooms_, roomy);
    app::takeOverByHost(device_, *simulation_, from.device_, *from.simulation_, bring);
    gravity_ = from.gravity_;
    steps_ = from.steps_;
    newest_ = from.newest_;
    played_ = from.played_;
}

bool Document::hasRoomOf(const Document& other) const noexcept {
    return sim::haveRoomsOf(settings_, other.settings_);
}

void Document::recordTakeOver(VkCommandBuffer commands, const Document& from) {
    assert(hasRoomOf(from));
    simulation().recordTakeOver(commands, from.simulation());
    gravity_ = from.gravity_;
    steps_ = from.steps_;
    newest_ = from.newest_;
    played_ = from.played_;
}

// While no steps are recorded, a later request replaces a prepared material.
Document::Turn Document::takeTurn(bool isPaused) {
    if (isPaused && wanted_) ready_.reset();
    beginTurn();
    if (!turning_.valid() || turning_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return Turn::none;
    const bool isOutdated = std::exchange(isTurnOutdated_, false);
    Turned turned = turning_.get();
    if (isOutdated) { // for the simulation before this one: once more
        if (!wanted_) wanted_ = std::move(turned.material);
        beginTurn();
        return Turn::none;
    }
    if (!turned.change) return Turn::refused;
    ready_ = std::move(turned);
    return Turn::ready;
}

std::optional<sim::Material> Document::recordTurn(VkCommandBuffer commands) noexcept {
    while (!recorded_.empty() && recorded_.front().step + sim::Simulation::framesInFlight < recordedSteps_)
        recorded_.pop_front();
    if (!isTurnReady()) return std::nullopt;
    Turned turned = *std::exchange(ready_, std::nullopt);
    simulation().recordChange(commands, *turned.change);
    recorded_.push_back({std::move(*turned.change), recordedSteps_});
    scene_ = std::move(turned.scene);
    stiffness_ = turned.stiffness;
    material_ = std::move(turned.material);
    return material_;
}

// Before the simulation makes way for another one: what is prepared is of this one. takeTurn() has it
// prepared again, or tells why it cannot be had.
void Document::awaitTurn() {
    if (ready_ && !wanted_) wanted_ = ready_->material;
    ready_.reset();
    if (!turning_.valid()) return;
    turning_.wait();
    isTurnOutdated_ = true;
}

std::optional<Divergence> Document::check(std::uint64_t step) const {
    const sim::Status status = simulation().status(step);
    if (status.contactRoom > 0 || status.nonFinite == 0 || status.frame != static_cast<std::uint32_t>(step))
        return std::nullopt;
    const auto holds = [&](const sim::Body& body) {
        return status.firstBadParticle - body.firstParticle < body.particleCount;
    };
    const auto body = std::ranges::find_if(scene_.bodies, holds);
    return Divergence{.step = step,
                      .particles = status.nonFinite,
                      .firstParticle = status.firstBadParticle,
                      .body = body == scene_.bodies.end() ? scene_.name : body->name};
}

std::uint32_t Document::neededRoom(std::uint64_t step) const {
    const sim::Status status = simulation().status(step);
    return status.frame == static_cast<std::uint32_t>(step) ? status.contactRoom : 0;
}

bool Document::lacksLists(std::uint64_t step) const {
    const sim::Status status = simulation().status(step);
    return status.frame == static_cast<std::uint32_t>(step) && status.lacksLists;
}

// The first of the steps that were undone is the next one.
void Document::goBackBefore(std::uint64_t step) noexcept {
    played_ -= steps_ - (step - 1);
    steps_ = step - 1;
}

bool Document::makeRoom(std::uint64_t step, vk::Queue& queue, const app::Bring& bring) {
    awaitTurn();
    const std::optional<sim::Settings> settings = rooms_.forContacts(settings_, neededRoom(step));
    if (!settings) return false;
    enlarge(*settings, queue, bring);
    goBackBefore(step);
    return true;
}

bool Document::makeSurfaceRoom(std::uint32_t needed, vk::Queue& queue, const app::Bring& bring) {
    if (!rooms_.lackSurface(needed)) return false;
    awaitTurn();
    const std::optional<sim::Settings> settings = rooms_.forSurface(settings_, needed);
    if (!settings) return false;
    try {
        enlarge(*settings, queue, bring);
    } catch (const vk::Error&) { // of memory, or a longer buffer than the device has
        rooms_.refuseSurface();
        return false;
    }
    return true;
}

bool Document::beginRoom(std::uint64_t step) {
    const std::uint32_t needed = neededRoom(step);
    const std::optional<sim::Settings> settings = rooms_.forContacts(settings_, needed);
    if (!settings) return false;
    goBackBefore(step);
    if (isGrowing())
        wantedRoom_ = needed;
    else
        begin({Purpose::contacts, *settings, material_});
    return true;
}

bool Document::beginSurfaceRoom(std::uint32_t needed) {
    assert(!next_ && !wantsShape());
    if (!rooms_.lackSurface(needed)) return false;
    const std::optional<sim::Settings> settings = rooms_.forSurface(settings_, needed);
    if (settings) begin({Purpose::surface, *settings, material_});
    return settings.has_value();
}

Document::Growth Document::askGrowth() {
    if (!isGrowing()) return Growth::none;
    if (made_) return Growth::made;
    if (!successor_.isReady() || turning_.valid()) return Growth::making;
    if (next_->material != material_) { // turned meanwhile
        begin({next_->purpose, next_->settings, material_});
        return Growth::making;
    }
    try {
        made_ = successor_.take();
    } catch (const vk::Error&) {
        if (std::exchange(next_, std::nullopt)->purpose == Purpose::contacts) throw;
        rooms_.refuseSurface();
        beginWanted();
        return Growth::none;
    }
    return Growth::made;
}

void Document::bringGrowth(vk::Queue& queue, const app::Bring& bring) {
    made_->simulation->checkTakeOver(*simulation_);
    if (bring) bring(*simulation_, queue, *made_->simulation, queue);
}

void Document::recordGrowth(VkCommandBuffer commands) noexcept {
    made_->simulation->recordTakeOver(commands, *simulation_);
}

void Document::endGrowth() {
    const Next next = *std::exchange(next_, std::nullopt);
    if (ready_ && !wanted_) wanted_ = ready_->material; // it was prepared for the old simulation
    ready_.reset();
    continueIn(*std::exchange(made_, std::nullopt), next.material);
    beginWanted();
}

void Document::beginWanted() {
    if (!wantedRoom_) return;
    const std::uint32_t needed = *std::exchange(wantedRoom_, std::nullopt);
    if (const auto settings = rooms_.forContacts(settings_, needed))
        begin({Purpose::contacts, *settings, material_});
}

} // namespace sinew::viewer
