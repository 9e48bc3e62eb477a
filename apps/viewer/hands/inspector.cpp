// Picks on the host; contacts are counted on the device, of what was found the time before.
#include "viewer/hands/inspector.hpp"

#include "sim/compile.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/state_probe.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::chrono::milliseconds pause{100};

struct Links {
    std::size_t count = 0;
    Strain strain;
};

Links linksAt(const sim::Scene& scene, std::uint32_t particle, std::span<const sim::layout::vec4> positions) {
    Links links;
    double squares = 0;
    for (const sim::DistanceConstraint& link : scene.distances) {
        if ((link.a != particle && link.b != particle) || !(link.restLength > 0)) continue;
        const sim::layout::vec4 &a = positions[link.a], &b = positions[link.b];
        const double length =
            std::hypot(double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z});
        const double strain = length / double{link.restLength} - 1;
        squares += strain * strain;
        links.strain.largest = std::max(links.strain.largest, std::abs(strain));
        ++links.count;
    }
    if (links.count > 0) links.strain.rms = std::sqrt(squares / static_cast<double>(links.count));
    return links;
}

} // namespace

Found foundAt(const sim::Scene& scene, std::uint32_t particle, std::span<const sim::layout::vec4> positions,
              std::span<const sim::layout::vec4> velocities, bool isCut) {
    const sim::layout::vec4& x = positions[particle];
    const bool isFixed = sim::inverseMasses(scene)[particle] == 0;
    const Links links = linksAt(scene, particle, positions);
    Found found{.body = scene.name,
                .particle = particle,
                .position = {x.x, x.y, x.z},
                .isFixed = isFixed,
                .isAsleep = !isFixed && x.w == 0,
                .links = links.count};
    for (const sim::Body& body : scene.bodies)
        if (particle - body.firstParticle < body.particleCount) found.body = body.name;
    if (!velocities.empty()) {
        const sim::layout::vec4& v = velocities[particle];
        found.speed = std::hypot(v.x, v.y, v.z);
    }
    if (links.count > 0 && !isCut) found.strain = links.strain;
    return found;
}

Inspector::Inspector(const Stage& stage, std::uint32_t slots) : stage_(stage), asked_(slots) {}

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

void Inspector::settle(std::uint32_t slot, const BallList& balls, const StateProbe& probe, bool isCut,
                       const std::optional<Opened>& opened, const ContactMarks* counter) {
    const Asked asked = std::exchange(asked_[slot], {});
    if (!asked.ray || !isOn_) return;
    const sim::Scene& scene = stage_.scene();
    const auto met = pick(scene, balls, *asked.ray, probe.seen(), Among::all, opened);
    found_.reset();
    if (!met) return;
    found_ = foundAt(scene, met->particle, probe.positions(), probe.velocities(), isCut);
    if (asked.counted == met->particle && counter != nullptr) found_->contacts = counter->found(slot);
}

} // namespace sinew::viewer
