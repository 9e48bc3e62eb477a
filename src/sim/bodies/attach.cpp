// Bends, tethers and drags in physical units: the functions of bodies.hpp that make no body.
#include "sinew/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <stdexcept>
#include <tuple>

namespace sinew::sim {

namespace {

struct Edge {
    std::uint32_t to;
    double length;
};

// A path to a fixed particle, shortest first; equal lengths are ordered by index, so that the result is
// deterministic.
struct Way {
    double length;
    std::uint32_t particle, anchor;
    bool operator>(const Way& other) const {
        return std::tie(length, particle, anchor) > std::tie(other.length, other.particle, other.anchor);
    }
};

std::vector<std::vector<Edge>> linksOf(const Scene& scene) {
    std::vector<std::vector<Edge>> links(scene.particles.size());
    for (const DistanceConstraint& c : scene.distances) {
        links[c.a].push_back({c.b, double{c.restLength}});
        links[c.b].push_back({c.a, double{c.restLength}});
    }
    return links;
}

std::vector<bool> heldParticles(const Scene& scene) {
    std::vector<bool> isHeld;
    for (const Particle& particle : scene.particles) isHeld.push_back(particle.inverseMass == 0);
    for (const FixedConstraint& fixed : scene.fixed) isHeld[fixed.particle] = true;
    return isHeld;
}

double distanceBetween(const Scene& scene, std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = scene.particles[a].position, &q = scene.particles[b].position;
    return std::hypot(double{p.x} - double{q.x}, double{p.y} - double{q.y}, double{p.z} - double{q.z});
}

} // namespace

float bendComplianceOfPlate(float stiffness, float spacing) {
    return spacing * spacing / stiffness;
}

float bendComplianceOfRod(float stiffness, float spacing) {
    return spacing * spacing * spacing / stiffness;
}

// Dijkstra's algorithm from all fixed particles at once: a particle is settled once for each of its nearest
// anchors.
void addTethers(Scene& scene, const TetherPlan& plan) {
    if (std::uint64_t{plan.first} + plan.count > scene.particles.size())
        throw std::invalid_argument("tethers: there are no such particles");
    if (plan.perParticle == 0) return;
    const std::vector<std::vector<Edge>> links = linksOf(scene);
    const std::vector<bool> isHeld = heldParticles(scene);
    std::vector<std::vector<std::uint32_t>> anchors(scene.particles.size());
    std::priority_queue<Way, std::vector<Way>, std::greater<>> open;
    const auto isWithin = [&](std::uint32_t i) { return i - plan.first < plan.count; };
    for (std::uint32_t i = plan.first; i < plan.first + plan.count; ++i)
        if (isHeld[i]) open.push({0, i, i});
    while (!open.empty()) {
        const Way way = open.top();
        open.pop();
        std::vector<std::uint32_t>& known = anchors[way.particle];
        if (known.size() == plan.perParticle || std::ranges::find(known, way.anchor) != known.end()) continue;
        known.push_back(way.anchor);
        if (!isHeld[way.particle]) {
            const bool isStraight = plan.length == TetherLength::straight;
            const double length = isStraight ? distanceBetween(scene, way.particle, way.anchor) : way.length;
            scene.tethers.push_back(
                {way.particle, way.anchor, static_cast<float>(length * (1 + double{plan.slack}))});
        }
        for (const Edge& edge : links[way.particle])
            if (isWithin(edge.to) && !isHeld[edge.to])
                open.push({way.length + edge.length, edge.to, way.anchor});
    }
}

Attachment makeDrag(const Scene& scene, std::uint32_t particle, float mass, const DragFeel& feel) {
    const double rate = 2 * std::numbers::pi * double{feel.frequency}; // [1/s]
    return {.particle = particle,
            .anchor = scene.particles.at(particle).position,
            .compliance = static_cast<float>(1 / (double{mass} * rate * rate)),
            .maxForce = mass * feel.maxAcceleration,
            .maxSpeed = feel.maxSpeed};
}

} // namespace sinew::sim
