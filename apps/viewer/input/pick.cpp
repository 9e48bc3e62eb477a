// The body and the surroundings of a particle.
#include "viewer/input/pick.hpp"

#include <algorithm>
#include <limits>

namespace sinew::viewer {

bool isRemoved(std::span<const std::uint32_t> pieces, std::uint32_t particle) {
    return !pieces.empty() && pieces[particle] == REMOVED_PIECE;
}

sim::Body bodyOf(const sim::Scene& scene, std::uint32_t particle) {
    const auto holds = [&](const sim::Body& body) {
        return particle - body.firstParticle < body.particleCount;
    };
    const auto found = std::ranges::find_if(scene.bodies, holds);
    return found == scene.bodies.end() ? sim::Body{} : *found;
}

float holdRadius(const sim::Scene& scene, std::uint32_t particle) {
    constexpr float none = std::numeric_limits<float>::infinity();
    float next = none;
    for (const sim::DistanceConstraint& link : scene.distances)
        if ((link.a == particle || link.b == particle) && link.restLength > 0)
            next = std::min(next, link.restLength);
    if (next == none) return 0; // a single particle
    Box box;
    for (const sim::Body& body : scene.bodies)
        if (particle - body.firstParticle < body.particleCount)
            for (std::uint32_t i = body.firstParticle; i < body.firstParticle + body.particleCount; ++i) {
                const sim::Vec3& x = scene.particles[i].position;
                box.extend(Vector3(x.x, x.y, x.z));
            }
    const float size = box.isEmpty() ? 0 : box.diagonal().norm();
    return std::max(size / 8, 1.5f * next);
}

} // namespace sinew::viewer
