// Copies into mapped memory.
#include "viewer/input/state_probe.hpp"

#include "sinew/inspection.hpp"
#include "sinew/step.hpp"
#include "sinew/vk/commands.hpp"
#include "viewer/input/pick.hpp"

namespace sinew::viewer {

namespace {

vk::Buffer readback(const vk::Device& device, const std::string& name, const vk::BufferView& of) {
    return vk::Buffer(
        device,
        {.name = name, .count = of.size / of.stride, .stride = of.stride, .kind = vk::MemoryKind::readback});
}

bool isAway(const sim::layout::vec4& place) {
    constexpr float away = sim::Motion::absentPlace;
    return place.x == away && place.y == away && place.z == away;
}

} // namespace

StateProbe::StateProbe(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
                       const sim::Simulation& simulation)
    : device_(device), scene_(scene), settings_(settings), simulation_(simulation),
      particles_(sim::inspect(simulation).particles), positions_{simulation.positions(),
                                                                 readback(device, "probe.positions",
                                                                          simulation.positions())} {
    const vk::BufferView velocities = simulation.velocities(), pieces = simulation.pieces(),
                         links = sim::inspect(simulation).liveLinks;
    if (velocities.size > 0)
        velocities_.emplace(Copy{velocities, readback(device, "probe.velocities", velocities)});
    if (pieces.size > 0) pieces_.emplace(Copy{pieces, readback(device, "probe.pieces", pieces)});
    if (links.size > 0) links_.emplace(Copy{links, readback(device, "probe.links", links)});
}

void StateProbe::record(VkCommandBuffer handle) noexcept {
    isWhole_ = simulation_.drawnSkins().areWhole;
    vk::Commands commands(device_, handle);
    commands.barrier(); // earlier copies may have written the same memory
    commands.copy(positions_.from, positions_.to.view());
    if (pieces_) commands.copy(pieces_->from, pieces_->to.view());
    if (links_) commands.copy(links_->from, links_->to.view());
    commands.hostBarrier();
}

void StateProbe::recordVelocities(VkCommandBuffer handle) const noexcept {
    if (!velocities_) return;
    vk::Commands commands(device_, handle);
    commands.copy(velocities_->from, velocities_->to.view());
    commands.hostBarrier();
}

Box StateProbe::bounds() const {
    return bounds({.firstParticle = 0, .particleCount = static_cast<std::uint32_t>(particles_)});
}

Box StateProbe::bounds(const sim::Body& body) const {
    Box box;
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
        const sim::layout::vec4& place = positions()[i];
        if (isShown(i)) box.extend(Vector3(place.x, place.y, place.z));
    }
    return box;
}

bool StateProbe::isShown(std::uint32_t particle) const noexcept {
    const sim::layout::vec4& place = positions()[particle];
    return !isRemoved(pieces(), particle) && !isAway(place) && Vector3(place.x, place.y, place.z).allFinite();
}

std::span<const sim::layout::vec4> StateProbe::positions() const noexcept {
    return {reinterpret_cast<const sim::layout::vec4*>(positions_.to.mapped()), particles_};
}

std::span<const std::uint32_t> StateProbe::pieces() const noexcept {
    if (!pieces_) return {};
    return {reinterpret_cast<const std::uint32_t*>(pieces_->to.mapped()), particles_};
}

std::span<const sim::layout::vec4> StateProbe::velocities() const noexcept {
    if (!velocities_) return {};
    return {reinterpret_cast<const sim::layout::vec4*>(velocities_->to.mapped()), particles_};
}

std::function<bool(std::size_t)> StateProbe::liveLinks() {
    if (isWhole_ || !links_) // of an absent body both ends are away
        return [this](std::size_t d) { return !isAway(positions()[scene_.distances[d].a]); };
    if (!cutLinks_) cutLinks_.emplace(scene_, sim::particleSlots(scene_, settings_).slot);
    const std::span words(reinterpret_cast<const std::uint32_t*>(links_->to.mapped()), links_->to.count());
    return [this, words](std::size_t d) {
        const sim::DistanceConstraint& link = scene_.distances[d];
        return !isAway(positions()[link.a]) && !cutLinks_->isCut(d, words) && !isRemoved(pieces(), link.a) &&
               !isRemoved(pieces(), link.b);
    };
}

} // namespace sinew::viewer
