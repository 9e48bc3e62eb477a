// The tests by which compile() decides to add contact passes.
#include "sim/model/touching.hpp"

#include "sinew/inverse_masses.hpp"

#include <algorithm>

namespace sinew::sim {

std::vector<float> looseRadii(const Scene& scene) {
    std::vector<float> radii;
    for (const Particle& particle : scene.particles) radii.push_back(particle.radius);
    for (const Face& face : scene.faces)
        for (const std::uint32_t i : face.particles)
            if (!face.isSolid && scene.particles[i].radius <= face.thickness) radii[i] = 0;
    return radii;
}

std::vector<std::uint32_t> arrivals(const Scene& scene) {
    constexpr std::uint32_t ofAbsent = 0x80000000u; // each has a number of its own
    std::vector<std::uint32_t> result(scene.particles.size(), 0);
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        const std::uint32_t arrival = body.isAbsent ? ofAbsent + b : body.arrival;
        for (std::uint32_t i = 0; arrival != 0 && i < body.particleCount; ++i)
            if (body.firstParticle + i < result.size()) result[body.firstParticle + i] = arrival;
    }
    return result;
}

bool particlesTouch(const Scene& scene) {
    return particlesTouch(inverseMasses(scene), looseRadii(scene));
}

bool particlesTouch(std::span<const float> inverseMass, std::span<const float> looseRadii) {
    std::size_t wide = 0, moving = 0;
    for (std::size_t i = 0; i < looseRadii.size(); ++i) {
        if (looseRadii[i] <= 0) continue;
        ++wide;
        moving += inverseMass[i] > 0 ? 1 : 0;
    }
    return wide > 1 && moving > 0;
}

bool facesTouch(const Scene& scene) {
    return facesTouch(scene, inverseMasses(scene));
}

bool facesTouch(const Scene& scene, std::span<const float> inverseMass) {
    bool hasPoint = false, hasMoving = false;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        if (scene.particles[i].radius <= 0) continue;
        hasPoint = true;
        hasMoving = hasMoving || inverseMass[i] > 0;
    }
    if (!hasPoint || scene.faces.empty()) return false;
    const auto moves = [&](const Face& face) {
        return std::ranges::any_of(face.particles, [&](std::uint32_t i) { return inverseMass[i] > 0; });
    };
    return hasMoving || std::ranges::any_of(scene.faces, moves);
}

} // namespace sinew::sim
