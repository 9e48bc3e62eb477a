// Warnings about a scene for a host and for who reads scene files.
#include "sim/complaints.hpp"
#include "sim/rounding.hpp"
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

// Positions are float32: far from the origin they are coarse against the spacing of particles.
void warnOfRounding(const Scene& scene, std::vector<std::string>& sentences) {
    const Rounding rounding = roundingOf(scene);
    if (!(rounding.step >= 1e-3 * finestLength(scene))) return;
    sentences.push_back("positions are rounded to " + thousandths(rounding.step) + " mm at " +
                        number(std::lround(rounding.distance)) +
                        " m from the origin, which is coarse against the spacing of particles: place bodies "
                        "nearer to each other");
}

} // namespace

std::vector<std::string> warnings(const Scene& scene, const Settings& /*settings*/) {
    std::vector<std::string> sentences;
    warnOfRounding(scene, sentences);
    return sentences;
}

} // namespace sinew::sim
