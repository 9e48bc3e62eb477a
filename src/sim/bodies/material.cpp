// Factors by particle, which links and grids look up at their ends.
#include "sinew/material.hpp"

#include "sim/model/links.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace sinew::sim {

namespace {

std::vector<double> factorsOf(const Scene& scene, const Material& material) {
    std::vector<double> factors(scene.particles.size(), double{material.stiffness});
    const std::size_t count = std::min(scene.bodies.size(), material.bodies.size());
    for (std::size_t b = 0; b < count; ++b) {
        const Body& body = scene.bodies[b];
        const auto first = factors.begin() + body.firstParticle;
        for (double& factor : std::span(first, body.particleCount)) factor *= double{material.bodies[b]};
    }
    return factors;
}

// A compliance above 0 stays above 0: 0 would be rigid, which needs another step program.
float softened(float compliance, double factor) {
    constexpr double least = 1e-20, most = 1e30; // [m/N]
    if (compliance == 0) return 0;
    return static_cast<float>(std::clamp(double{compliance} / factor, least, most));
}

void stiffen(Scene& scene, std::span<const double> factors) {
    forEachKind(scene, [&]<typename Link>(std::vector<Link>& links) {
        for (Link& link : links)
            link.compliance = softened(link.compliance, LinkTraits<Link>::factor(link, factors));
    });
    for (Grid& grid : scene.grids) {
        const double factor = factors[grid.firstParticle];
        for (float& compliance : grid.compliance) compliance = softened(compliance, factor);
        grid.volumeStiffness = static_cast<float>(double{grid.volumeStiffness} * factor);
        grid.recoveryPressure = static_cast<float>(double{grid.recoveryPressure} * factor);
    }
}

// Sets both coefficients: static friction below `friction` counts as `friction`.
template <typename Touched> void setFriction(Touched& touched, float friction) {
    touched.friction = friction;
    touched.staticFriction = 0;
}

} // namespace

Scene withMaterial(Scene scene, const Material& material) {
    stiffen(scene, factorsOf(scene, material));
    if (material.damping) scene.damping = *material.damping;
    if (!material.friction) return scene;
    for (Plane& plane : scene.planes) setFriction(plane, *material.friction);
    for (Collider& collider : scene.colliders) setFriction(collider, *material.friction);
    for (Surface& surface : scene.contacts.surfaces) setFriction(surface, *material.friction);
    setFriction(scene.contacts, *material.friction);
    return scene;
}

} // namespace sinew::sim
