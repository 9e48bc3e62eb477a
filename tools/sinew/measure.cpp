// Sums are in double and in the scene's order, independent of the device.
#include "sinew/measure.hpp"

#include "app/cut_links.hpp"
#include "sim/core/hash.hpp"
#include "sinew/colliders.hpp"
#include "sinew/crossings.hpp"
#include "sinew/overlap.hpp"
#include "sinew/skin_mesh.hpp"
#include "sinew/step.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::tools {

namespace {

using Point = std::array<double, 3>;

Point pointOf(const std::array<float, 4>& v) {
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}
Point pointOf(const sim::Vec3& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}
double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Point& a) {
    return std::sqrt(dot(a, a));
}
Point sum(const Point& a, const Point& b, double scale) {
    return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}

/// Calls visit(constraint, (length - restLength) / restLength) for every live distance constraint.
template <typename Visit>
void forEachStrain(const sim::Scene& scene, const State& state, const Visit& visit) {
    if (state.positions.empty()) return;
    const auto holds = [&](std::size_t i) {
        const sim::DistanceConstraint& d = scene.distances[i];
        return state.holds(i) && state.has(d.a) && state.has(d.b);
    };
    const std::span<const float> places(state.positions.front().data(), 4 * state.positions.size());
    app::eachStrain(scene, places, holds,
                    [&](std::size_t i, double strain) { visit(scene.distances[i], strain); });
}

void measureStrain(const sim::Scene& scene, const State& state, Errors& errors) {
    app::StrainSum strains;
    forEachStrain(scene, state, [&](const sim::DistanceConstraint&, double strain) { strains.add(strain); });
    if (strains.result().links == 0) return;
    errors.strainRms = strains.result().rms;
    errors.strainMax = strains.result().largest;
}

bool isAway(const sim::Skin& skin, const State& state) {
    if (skin.vertexCount() == 0) return false;
    return state.isAway(skin.particles.empty() ? skin.cells.front().particles[0] : skin.particles.front());
}

void measureVolume(const sim::Scene& scene, const State& state, std::span<const mesh::TriangleMesh> skins,
                   Errors& errors) {
    for (std::size_t i = 0; i < skins.size(); ++i) {
        const sim::Skin& skin = scene.skins[i];
        if (isAway(skin, state)) continue;
        const mesh::MeshReport rest = mesh::inspect(skinMesh(skin, skinVertices(scene, skin)));
        if (!rest.defects.isClosed() || rest.volume == 0) continue;
        const double change = mesh::inspect(skins[i]).volume / rest.volume - 1;
        if (!errors.volume || std::abs(change) > std::abs(*errors.volume)) errors.volume = change;
    }
}

/// The component of a vector perpendicular to gravity, which gravity cannot change.
Point across(const Point& v, const Point& gravity) {
    const double square = dot(gravity, gravity);
    return square > 0 ? sum(v, gravity, -dot(v, gravity) / square) : v;
}

void measureMomentum(const sim::Scene& scene, const State& state, std::uint64_t frames, Errors& errors) {
    const bool isHeld =
        !scene.planes.empty() || !scene.colliders.empty() || !scene.fixed.empty() ||
        std::ranges::any_of(scene.particles, [](const sim::Particle& p) { return p.inverseMass == 0; });
    if (isHeld || scene.particles.empty()) return;
    Point before{}, after{};
    double scale = 0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        if (state.isAway(i)) continue;
        const double mass = 1 / double{scene.particles[i].inverseMass};
        const Point v = pointOf(state.velocities[i]);
        before = sum(before, pointOf(scene.particles[i].velocity), mass);
        after = sum(after, v, mass);
        scale += mass * length(v);
    }
    const double decay = std::exp(-double{scene.damping} * double{scene.dt} * static_cast<double>(frames));
    const Point gravity = pointOf(scene.gravity);
    const Point change = sum(across(after, gravity), across(before, gravity), -decay);
    errors.momentum = scale > 0 ? length(change) / scale : 0;
}

/// The greatest depth of a particle in a collider at `time` [s].
double depthInColliders(const sim::Scene& scene, const State& state, double time) {
    double deepest = 0;
    for (const sim::Collider& collider : scene.colliders) {
        const sim::Pose pose = sim::poseAt(collider, time);
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            const auto& x = state.positions[i];
            if (x[3] == 0 || !state.has(i)) continue;
            const double gap = sim::gapTo(collider, pose, {x[0], x[1], x[2]});
            deepest =
                std::max(deepest, double{scene.particles[i].contactOffset} + double{collider.margin} - gap);
        }
    }
    return deepest;
}

} // namespace

bool State::isAway(std::size_t particle) const {
    const std::array<float, 4>& x = positions[particle];
    return std::all_of(x.begin(), x.begin() + 3, [](float one) { return one == sim::Motion::absentPlace; });
}

Errors measurePenetration(const sim::Scene& scene, const State& state, std::uint64_t frames) {
    Errors errors;
    const std::optional<Overlap> overlap = overlapOf(scene, state);
    if (overlap) errors.penetrationRms = overlap->rms;
    if (scene.planes.empty() && scene.colliders.empty() && !overlap) return errors;
    double deepest = overlap ? overlap->max : 0;
    deepest =
        std::max(deepest, depthInColliders(scene, state, double{scene.dt} * static_cast<double>(frames)));
    for (const sim::Plane& plane : scene.planes) {
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            if (state.positions[i][3] == 0 || !state.has(i)) continue; // fixed: no plane moves it
            const double height = dot(pointOf(plane.normal), pointOf(state.positions[i]));
            const double depth = double{plane.offset} + double{scene.particles[i].contactOffset} - height;
            deepest = std::max(deepest, depth);
        }
    }
    errors.penetrationMax = deepest;
    return errors;
}

Errors measure(const sim::Scene& scene, const State& state, std::span<const mesh::TriangleMesh> skins,
               std::uint64_t frames) {
    Errors errors = measurePenetration(scene, state, frames);
    errors.crossings = crossingsOf(scene, state);
    measureStrain(scene, state, errors);
    measureVolume(scene, state, skins, errors);
    measureMomentum(scene, state, frames, errors);
    return errors;
}

double rigidStretch(const sim::Scene& scene, const State& state) {
    double most = 0;
    forEachStrain(scene, state, [&](const sim::DistanceConstraint& d, double strain) {
        if (d.compliance == 0) most = std::max(most, strain);
    });
    return most;
}

double kineticEnergy(const State& state) {
    double energy = 0;
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        if (const auto& v = state.velocities[i]; v[3] > 0 && state.has(i))
            energy += 0.5 * dot(pointOf(v), pointOf(v)) / double{v[3]};
    return energy;
}

double potentialEnergy(const sim::Scene& scene, const State& state) {
    double energy = 0;
    for (std::size_t i = 0; i < state.positions.size(); ++i)
        if (const auto& x = state.positions[i]; x[3] > 0 && state.has(i))
            energy -= dot(pointOf(scene.gravity), pointOf(x)) / double{x[3]};
    return energy;
}

std::uint64_t stateHash(const State& state) {
    const auto bytes = [](const auto& list) { return std::as_bytes(std::span(list)); };
    return sim::fnv1a(bytes(state.velocities), sim::fnv1a(bytes(state.positions)));
}

} // namespace sinew::tools
