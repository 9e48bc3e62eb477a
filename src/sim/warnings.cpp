// Warnings about a scene for a host and for who reads scene files.
#include "sim/complaints.hpp"
#include "sim/substeps.hpp"
#include "sim/validate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The shortest link or diameter of a scene [m]; infinite where it has neither.
double finestLength(const Scene& scene) {
    double finest = infinite;
    for (const DistanceConstraint& link : scene.distances)
        if (link.restLength > 0) finest = std::min(finest, double{link.restLength});
    for (const Particle& particle : scene.particles)
        if (particle.radius > 0) finest = std::min(finest, 2 * double{particle.radius});
    return finest;
}

// The largest coordinate of a particle that moves [m].
float farthestOf(const Scene& scene) {
    float farthest = 0;
    for (const Particle& particle : scene.particles)
        if (particle.inverseMass > 0)
            for (const float value : {particle.position.x, particle.position.y, particle.position.z})
                farthest = std::max(farthest, std::abs(value));
    return farthest;
}

// Positions are float32: far from the origin they are coarse against the spacing of particles, and a substep
// moves what is slow by a whole step of them or not at all.
void warnOfRounding(const Scene& scene, const Settings& settings, std::vector<std::string>& sentences) {
    const float farthest = farthestOf(scene);
    const double step = double{std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest};
    const std::uint32_t substeps = withSubsteps(scene, settings).substeps;
    const double speed = step * substeps / double{scene.dt}, finest = finestLength(scene);
    const double slow = std::isfinite(finest) ? std::max(0.01, 0.1 * finest) : 0.01; // [m/s]
    if (step < 1e-3 * finest && speed < slow) return;
    sentences.push_back(
        "positions are rounded to " + thousandths(step) + " mm at " + number(std::lround(double{farthest})) +
        " m from the origin, which is " + thousandths(speed) + " mm/s with " + number(substeps) +
        " substeps: slower motion is not exact, place bodies nearer to each other or take fewer substeps");
}

} // namespace

std::vector<std::string> warnings(const Scene& scene, const Settings& settings) {
    std::vector<std::string> sentences;
    warnOfRounding(scene, settings, sentences);
    return sentences;
}

} // namespace sinew::sim
