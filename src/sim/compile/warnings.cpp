// Warnings about a scene, for hosts and authors of scene files.
#include "sim/core/complaints.hpp"
#include "sim/model/rounding.hpp"
#include "sinew/validate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// The shortest link or diameter [m] that affects moving particles; infinite if there is neither. Diameters of
// fixed particles count if a moving particle can touch them.
double finestLength(const Scene& scene) {
    std::vector<bool> moves;
    for (const Particle& particle : scene.particles) moves.push_back(particle.inverseMass > 0);
    for (const FixedConstraint& held : scene.fixed)
        if (held.particle < moves.size()) moves[held.particle] = false;
    double finest = infinite;
    for (const DistanceConstraint& link : scene.distances)
        if (link.restLength > 0 && std::max(link.a, link.b) < moves.size() &&
            (moves[link.a] || moves[link.b]))
            finest = std::min(finest, double{link.restLength});
    bool touches = false;
    for (std::size_t i = 0; i < moves.size(); ++i)
        touches = touches || (scene.particles[i].radius > 0 && moves[i]);
    for (const Particle& particle : scene.particles)
        if (touches && particle.radius > 0) finest = std::min(finest, 2 * double{particle.radius});
    return finest;
}

// Positions are float32: far from the origin their steps are large relative to the spacing of particles.
void warnOfRounding(const Scene& scene, std::vector<std::string>& sentences) {
    constexpr double coarse = 1e-3; // of the finest length
    const Rounding rounding = roundingOf(scene);
    const double finest = finestLength(scene);
    if (!(rounding.step >= coarse * finest)) return;
    const double reach = std::exp2(std::ceil(std::log2(coarse * finest)) + 23); // finer steps below
    const std::string body = bodyOf(scene, rounding.particle);
    sentences.push_back("positions are rounded to " + thousandths(rounding.step) + " mm at " +
                        (rounding.distance < 10 ? thousandths(rounding.distance) + " mm"
                                                : number(std::lround(rounding.distance)) + " m") +
                        " from the origin" + (body.empty() ? "" : ", where body \"" + body + "\" is") +
                        ", which is coarse against the spacing of particles: place all within " +
                        number(reach) + " m of the origin");
}

} // namespace

std::vector<std::string> warnings(const Scene& scene) {
    std::vector<std::string> sentences;
    warnOfRounding(scene, sentences);
    return sentences;
}

} // namespace sinew::sim
