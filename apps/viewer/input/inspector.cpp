// The device counts the contacts of the particle that was picked last.
#include "viewer/input/inspector.hpp"

#include "sinew/inverse_masses.hpp"
#include "viewer/document/document.hpp"
#include "viewer/input/state_probe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::chrono::milliseconds pause{100};

app::LinkStrain strainAt(const sim::Scene& scene, std::uint32_t particle,
                         std::span<const sim::layout::vec4> positions,
                         const std::function<bool(std::size_t)>& holds) {
    const std::span<const float> places(&positions.front().x, 4 * positions.size());
    return app::strainOf(scene, places, [&](std::size_t d) {
        const sim::DistanceConstraint& link = scene.distances[d];
        return (link.a == particle || link.b == particle) && holds(d);
    });
}

} // namespace

Found foundAt(const sim::Scene& scene, std::uint32_t particle, std::span<const sim::layout::vec4> positions,
              std::span<const sim::layout::vec4> velocities, const std::function<bool(std::size_t)>& holds) {
    const sim::layout::vec4& x = positions[particle];
    const bool isFixed = sim::inverseMasses(scene)[particle] == 0;
    const app::LinkStrain strain = strainAt(scene, particle, positions, holds);
    Found found{.body = scene.name,
                .particle = particle,
                .position = {x.x, x.y, x.z},
                .isFixed = isFixed,
                .isAsleep = !isFixed && x.w == 0,
                .links = strain.links};
    for (const sim::Body& body : scene.bodies)
        if (particle - body.firstParticle < body.particleCount) found.body = body.name;
    if (!velocities.empty()) {
        const sim::layout::vec4& v = velocities[particle];
        found.speed = std::hypot(v.x, v.y, v.z);
    }
    if (strain.links > 0) found.strain = {strain.rms, strain.largest};
    return found;
}

std::string stateText(const Found& found) {
    if (!found.hold.empty()) return "held by " + found.hold;
    if (found.isFixed) return "fixed";
    if (found.isAsleep) return "asleep";
    if (!found.speed) return "moves";
    char text[40];
    std::snprintf(text, sizeof text, "%.3g m/s", double{*found.speed});
    return text;
}

Inspector::Inspector(const Document& document, std::span<const sim::NamedHold> holds, std::uint32_t slots)
    : document_(document), holds_(holds), asked_(slots) {}

void Inspector::toggle() {
    isOn_ = !isOn_;
    last_.reset();
    found_.reset();
}

void Inspector::restart() {
    std::ranges::fill(asked_, Asked{});
    last_.reset();
}

bool Inspector::isDue(const Ray& ray) const {
    const bool isCounted = !found_ || found_->contacts;
    return isOn_ && (ray != last_ || !isCounted || Clock::now() - lastTime_ >= pause);
}

void Inspector::record(VkCommandBuffer commands, std::uint32_t slot, const Ray& ray,
                       const ContactMarks* counter) {
    last_ = ray;
    lastTime_ = Clock::now();
    asked_[slot] = {ray, std::nullopt};
    if (!found_ || counter == nullptr) return;
    counter->recordOf(commands, slot, found_->particle);
    asked_[slot].counted = found_->particle;
}

void Inspector::settle(std::uint32_t slot, const std::optional<Pick>& met, StateProbe& probe,
                       const ContactMarks* counter) {
    const Asked asked = std::exchange(asked_[slot], {});
    if (!asked.ray || !isOn_) return;
    found_.reset();
    if (!met) return;
    found_ =
        foundAt(document_.scene(), met->particle, probe.positions(), probe.velocities(), probe.liveLinks());
    if (const sim::NamedHold* hold = sim::holdOf(holds_, met->particle)) found_->hold = hold->name;
    if (asked.counted == met->particle && counter != nullptr) found_->contacts = counter->found(slot);
}

} // namespace sinew::viewer
