// Counts steps and turns status words into sentences.
#include "viewer/draw/stage.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

std::string Divergence::sentence() const {
    return "the simulation diverged: step " + std::to_string(step) + ", body \"" + body + "\", particle " +
           std::to_string(firstParticle) + ": " + std::to_string(particles) +
           (particles == 1 ? " particle is" : " particles are") +
           " not finite, the last finite state was kept: use more substeps, a lower omega or a softer "
           "material";
}

Stage::Stage(const vk::Device& device, sim::Scene scene, const sim::Settings& settings)
    : scene_(std::move(scene)), settings_(settings), growing_(device, scene_, settings_),
      gravity_(scene_.gravity) {
    const sim::Vec3& g = scene_.gravity;
    const float length = std::hypot(g.x, g.y, g.z);
    if (length > 0) down_ = {g.x / length, g.y / length, g.z / length};
}

void Stage::recordReset(VkCommandBuffer commands) noexcept {
    growing_.simulation().recordReset(commands);
    steps_ = played_ = 0;
}

app::SavedRun Stage::save(const vk::Device& device, vk::Queue& queue) const {
    app::SavedRun run = app::saveRun(device, growing_, queue);
    run.played = played_;
    return run;
}

void Stage::load(const vk::Device& device, const app::SavedRun& run, vk::Queue& queue) {
    app::loadRun(device, growing_, run, queue);
    steps_ = 0;
    played_ = run.played;
}

void Stage::recordStep(VkCommandBuffer commands, vk::Timestamps* timestamps, std::span<const sim::Grab> grabs,
                       const sim::Blade& blade, std::span<const sim::Poke> pokes) noexcept {
    const sim::Blade scripted = blades_.at(played_++);
    sim::Step step{.dt = scene_.dt, .gravity = gravity_, .frame = ++steps_};
    step.grabs = grabs;
    step.pokes = pokes;
    step.blade = scripted.from.empty() ? blade : scripted;
    growing_.simulation().record(commands, step, timestamps);
}

void Stage::setGravity(float gravity) noexcept {
    gravity_ = down_;
    gravity_.x *= gravity;
    gravity_.y *= gravity;
    gravity_.z *= gravity;
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

bool Stage::makeRoom(std::uint64_t step, vk::Queue& queue) {
    if (!growing_.grow(neededRoom(step), queue)) return false;
    played_ -= steps_ - (step - 1);
    steps_ = step - 1;
    return true;
}

bool Stage::makeSurfaceRoom(std::uint32_t needed, vk::Queue& queue) {
    return growing_.lacksSurface(needed) && growing_.growSurface(needed, queue);
}

} // namespace sinew::viewer
