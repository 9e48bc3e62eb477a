// Counts steps and converts status words to sentences.
#include "viewer/draw/stage.hpp"

#include "scenes/recovery.hpp"
#include "vk/check.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace sinew::viewer {

std::string Divergence::sentence() const {
    return "the simulation diverged: step " + std::to_string(step) + ", body \"" + body + "\", particle " +
           std::to_string(firstParticle) + ": " + std::to_string(particles) +
           (particles == 1 ? " particle is" : " particles are") +
           " not finite, the last finite state was kept: use more substeps, a lower omega or a softer "
           "material";
}

Stage::Stage(const vk::Device& device, sim::Scene scene, const sim::Settings& settings,
             const sim::Material& material)
    : given_(std::move(scene)), scene_(sim::withMaterial(given_, material)), settings_(settings),
      stiffness_(sim::inspectStiffness(scene_, settings)), growing_(device, scene_, settings_),
      gravity_(scene_.gravity), material_(material) {
    const sim::Vec3& g = scene_.gravity;
    const float length = std::hypot(g.x, g.y, g.z);
    if (length > 0) down_ = {g.x / length, g.y / length, g.z / length};
}

Stage::~Stage() {
    if (turning_.valid()) turning_.wait();
}

void Stage::recordReset(VkCommandBuffer commands) noexcept {
    growing_.simulation().recordReset(commands);
    steps_ = newest_ = played_ = 0;
}

app::SavedRun Stage::save(const vk::Device& device, vk::Queue& queue) const {
    app::SavedRun run = app::saveRun(device, growing_, queue);
    run.played = played_;
    run.material = material_;
    run.gravity = gravity_;
    return run;
}

void Stage::load(const vk::Device& device, const app::SavedRun& run, vk::Queue& queue) {
    if (run.material != material_) {
        turnNow(run.material);
        const VkCommandBuffer commands = queue.begin();
        growing_.simulation().recordReset(commands);
        recordTurn(commands);
        queue.wait(queue.submit(commands));
    }
    app::loadRun(device, growing_, run, queue);
    gravity_ = run.gravity;
    steps_ = newest_ = 0;
    played_ = run.played;
}

void Stage::recordStep(VkCommandBuffer commands, vk::Timestamps* timestamps, std::span<const sim::Grab> grabs,
                       const sim::Blade& blade, std::span<const sim::Poke> pokes) noexcept {
    recordTurn(commands);
    ++recordedSteps_;
    const sim::Blade scripted = blades_.at(played_++);
    sim::Step step{.dt = scene_.dt, .gravity = gravity_, .frame = ++steps_};
    newest_ = std::max(newest_, steps_);
    step.grabs = grabs;
    step.pokes = pokes;
    step.repeats = repeats_;
    step.blade = scripted.from.empty() ? blade : scripted;
    growing_.simulation().record(commands, step, timestamps);
}

void Stage::setGravity(float gravity) noexcept {
    gravity_ = down_;
    gravity_.x *= gravity;
    gravity_.y *= gravity;
    gravity_.z *= gravity;
}

sim::Scene Stage::sceneOf(const sim::Material& material, const sim::Settings& settings) const {
    sim::Scene scene = scenes::withoutDefaults(sim::withMaterial(given_, material), defaults_, settings);
    if (!blades_.areAny()) scenes::leaveWhole(scene, settings);
    return scene;
}

// Reads only the constant part of the step program: recordTurn() runs after it.
Stage::Turned Stage::prepare(const sim::Material& material) const {
    Turned turned{material, sceneOf(material, settings()), {}, std::nullopt};
    turned.change = simulation().prepareChange(turned.scene);
    turned.stiffness = sim::inspectStiffness(turned.scene, settings());
    return turned;
}

void Stage::beginTurn() {
    if (!wanted_ || turning_.valid() || ready_ || growth_) return; // growth: prepared after it
    turning_ = std::async(std::launch::async, [this, material = *std::exchange(wanted_, std::nullopt)] {
        return prepare(material);
    });
}

void Stage::turn(const sim::Material& material) {
    wanted_ = material;
    beginTurn();
}

void Stage::turnNow(const sim::Material& material) {
    ready_ = prepare(material);
    refused_.reset();
    if (ready_->change) return;
    ready_.reset();
    refused_ = material;
}

void Stage::wantShape(sim::Solver solver, std::uint32_t substeps) {
    const bool isBegun = reshaping_ && !refused_ && reshaping_->settings.solver == solver &&
                         reshaping_->settings.substeps == substeps && reshaping_->material == material_;
    if (!isBegun) reshaping_.reset();
    shape_ = Shape{solver, substeps};
}

void Stage::keepShape() {
    reshaping_.reset();
    shape_.reset();
}

std::future<std::unique_ptr<sim::Simulation>> Stage::make(const sim::Settings& settings,
                                                          const sim::Material& material) const {
    return std::async(std::launch::async, [this, settings, material] {
        return std::make_unique<sim::Simulation>(growing_.device(), sceneOf(material, settings), settings);
    });
}

void Stage::beginShape() {
    sim::Settings settings = growing_.settings();
    if (shape_) {
        settings.solver = shape_->solver;
        settings.substeps = shape_->substeps;
    }
    const sim::Material material = refused_ ? *refused_ : ready_ ? ready_->material : material_;
    reshaping_.emplace(Reshaping{settings, material, make(settings, material)});
}

bool Stage::isShapeMade() {
    if (!wantsShape()) return false;
    if (!reshaping_) beginShape();
    return reshaping_->making.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void Stage::reshape(vk::Queue& queue, const app::Bring& bring) {
    if (!wantsShape()) return;
    growth_.reset(); // made with the old solver; a lack of capacity is reported again
    wantedRoom_.reset();
    if (!reshaping_) beginShape();
    Reshaping next = *std::exchange(reshaping_, std::nullopt);
    shape_.reset();
    refused_.reset();
    ready_.reset();
    awaitTurn(); // it is prepared for the old simulation
    std::unique_ptr<sim::Simulation> made = next.making.get();
    sim::Scene before = std::exchange(scene_, sceneOf(next.material, next.settings));
    try {
        growing_.replaceBy(std::move(made), next.settings, queue, bring);
    } catch (...) {
        scene_ = std::move(before);
        throw;
    }
    stiffness_ = sim::inspectStiffness(scene_, next.settings);
    material_ = next.material;
}

void Stage::takeOver(const Stage& from, const app::Bring& bring) {
    growing_.takeOver(from.growing_, bring);
    gravity_ = from.gravity_;
    steps_ = from.steps_;
    newest_ = from.newest_;
    played_ = from.played_;
}

bool Stage::hasRoomOf(const Stage& other) const noexcept {
    return settings().contactRoom >= other.settings().contactRoom &&
           settings().cutSurfaceRoom >= other.settings().cutSurfaceRoom;
}

void Stage::recordTakeOver(VkCommandBuffer commands, const Stage& from) {
    assert(hasRoomOf(from));
    simulation().recordTakeOver(commands, from.simulation());
    gravity_ = from.gravity_;
    steps_ = from.steps_;
    newest_ = from.newest_;
    played_ = from.played_;
}

// While no steps are recorded, a later request replaces a prepared material.
Stage::Turn Stage::takeTurn(bool isPaused) {
    if (isPaused && wanted_) ready_.reset();
    beginTurn();
    if (!turning_.valid() || turning_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return Turn::none;
    Turned turned = turning_.get();
    if (!turned.change) return Turn::refused;
    ready_ = std::move(turned);
    return Turn::ready;
}

std::optional<sim::Material> Stage::recordTurn(VkCommandBuffer commands) noexcept {
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

// Before the simulation is replaced: the prepared material refers to the old one and must be prepared again.
void Stage::awaitTurn() {
    if (ready_ && !wanted_) wanted_ = ready_->material;
    ready_.reset();
    if (!turning_.valid()) return;
    try {
        const Turned turned = turning_.get();
        if (!wanted_) wanted_ = turned.material;
    } catch (const std::exception&) { // the material is invalid, and no longer wanted
    }
}

std::optional<Divergence> Stage::check(std::uint64_t step) const {
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

std::uint32_t Stage::neededRoom(std::uint64_t step) const {
    const sim::Status status = simulation().status(step);
    return status.frame == static_cast<std::uint32_t>(step) ? status.contactRoom : 0;
}

bool Stage::lacksLists(std::uint64_t step) const {
    const sim::Status status = simulation().status(step);
    return status.frame == static_cast<std::uint32_t>(step) && status.lacksLists;
}

// Undoes the counts of those steps.
void Stage::goBackBefore(std::uint64_t step) noexcept {
    played_ -= steps_ - (step - 1);
    steps_ = step - 1;
}

bool Stage::makeRoom(std::uint64_t step, vk::Queue& queue, const app::Bring& bring) {
    awaitTurn();
    if (!growing_.grow(neededRoom(step), queue, bring)) return false;
    goBackBefore(step);
    return true;
}

bool Stage::makeSurfaceRoom(std::uint32_t needed, vk::Queue& queue, const app::Bring& bring) {
    if (!growing_.lacksSurface(needed)) return false;
    awaitTurn();
    return growing_.growSurface(needed, queue, bring);
}

// Uses the scene as given, which is constant: the present scene may change meanwhile.
void Stage::beginGrowth(const sim::Settings& settings, bool isOfContacts) {
    growth_.emplace(Growing{settings, isOfContacts, material_, make(settings, material_), nullptr});
}

bool Stage::beginRoom(std::uint64_t step) {
    const std::uint32_t needed = neededRoom(step);
    const std::optional<sim::Settings> settings = growing_.roomForContacts(needed);
    if (!settings) return false;
    goBackBefore(step);
    if (growth_)
        wantedRoom_ = needed;
    else
        beginGrowth(*settings, true);
    return true;
}

bool Stage::beginSurfaceRoom(std::uint32_t needed) {
    if (!growing_.lacksSurface(needed)) return false;
    const std::optional<sim::Settings> settings = growing_.roomForSurface(needed);
    if (settings) beginGrowth(*settings, false);
    return settings.has_value();
}

Stage::Growth Stage::askGrowth() {
    if (!growth_) return Growth::none;
    if (growth_->made) return Growth::made;
    const bool isThere = growth_->making.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    if (!isThere || turning_.valid()) return Growth::making;
    Growing growth = *std::exchange(growth_, std::nullopt);
    try {
        growth.made = growth.making.get();
    } catch (const vk::Error&) {
        if (growth.isOfContacts) throw;
        growing_.lackSurface();
        beginWanted();
        return Growth::none;
    }
    if (growth.material != material_) { // changed meanwhile
        beginGrowth(growth.settings, growth.isOfContacts);
        return Growth::making;
    }
    growth_ = std::move(growth);
    return Growth::made;
}

void Stage::bringGrowth(vk::Queue& queue, const app::Bring& bring) {
    if (bring) bring(simulation(), queue, *growth_->made, queue);
}

void Stage::recordGrowth(VkCommandBuffer commands) noexcept {
    growth_->made->recordTakeOver(commands, simulation());
}

void Stage::endGrowth() {
    Growing growth = *std::exchange(growth_, std::nullopt);
    if (ready_ && !wanted_) wanted_ = ready_->material; // it was prepared for the old simulation
    ready_.reset();
    growing_.goOnIn(std::move(growth.made), growth.settings);
    beginWanted();
}

void Stage::beginWanted() {
    if (!wantedRoom_) return;
    const std::uint32_t needed = *std::exchange(wantedRoom_, std::nullopt);
    if (const auto settings = growing_.roomForContacts(needed)) beginGrowth(*settings, true);
}

} // namespace sinew::viewer
