// Holds are FixedConstraints of particles: an inverse mass of 0, which costs no pass.
#include "sinew/holds.hpp"

#include "sinew/colliders.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace sinew::sim {

Gap insideOf(const Collider& shape) {
    return [shape](const Vec3& x) { return gapTo(shape, shape.pose, x) - double{shape.margin}; };
}

Gap insideOf(const Plane& halfSpace) {
    const Vec3 n = halfSpace.normal;
    const double offset = double{halfSpace.offset};
    return [n, offset](const Vec3& x) {
        return offset - double{n.x} * double{x.x} - double{n.y} * double{x.y} - double{n.z} * double{x.z};
    };
}

Selection select(const Scene& scene, const Body& body, const Gap& gap) {
    Selection selection{.gap = std::numeric_limits<double>::infinity()};
    for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
        const double here = gap(scene.particles.at(i).position);
        if (here <= 0) selection.particles.push_back(i);
        if (here >= selection.gap) continue;
        selection.gap = here;
        selection.nearest = i;
    }
    return selection;
}

void hold(Scene& scene, std::span<const std::uint32_t> particles) {
    const std::size_t count = scene.particles.size();
    std::vector<bool> isFixed(count);
    for (const FixedConstraint& fixed : scene.fixed)
        if (fixed.particle < count) isFixed[fixed.particle] = true;
    for (const std::uint32_t particle : particles)
        if (particle >= count)
            throw std::invalid_argument("hold: there is no particle " + std::to_string(particle));
    for (const std::uint32_t particle : particles) {
        scene.particles[particle].velocity = {};
        if (isFixed[particle]) continue;
        isFixed[particle] = true;
        scene.fixed.push_back({particle});
    }
}

void drive(Scene& scene, std::vector<std::uint32_t> particles, std::vector<Keyframe> path, PathEnd end) {
    hold(scene, particles);
    scene.driven.push_back({.path = std::move(path), .pathEnd = end, .particles = std::move(particles)});
}

const NamedHold* holdOf(std::span<const NamedHold> holds, std::uint32_t particle) {
    const auto found = std::ranges::find_if(
        holds, [&](const NamedHold& hold) { return std::ranges::binary_search(hold.particles, particle); });
    return found == holds.end() ? nullptr : &*found;
}

} // namespace sinew::sim
