// Random strokes: squares of any direction, their middles spread evenly over a cuboid. They become blades
// like any others.
#include "scenes/blades.hpp"

#include "sim/core/random.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::scenes {

namespace {

using Eigen::Vector3d;

// A hair of rounding is no step.
double wholeSteps(double time, double dt) {
    return std::max(std::ceil(time / dt - hairOfStep), 0.0);
}

struct Square {
    Vector3d middle, along, across; // the sides' halves
};

Square randomSquare(sim::Random& random, const Vector3d& center, const Vector3d& size, double side) {
    Square square;
    for (double& x : square.middle) x = random.symmetric();
    square.middle = center + square.middle.cwiseProduct(size) / 2;
    const double height = random.symmetric(), turn = std::numbers::pi * random.symmetric(),
                 roll = std::numbers::pi * random.symmetric(), radius = std::sqrt(1 - height * height);
    const Vector3d normal(radius * std::cos(turn), radius * std::sin(turn), height); // evenly on the sphere
    const Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
    square.along = side / 2 * (std::cos(roll) * first + std::sin(roll) * second);
    square.across = normal.cross(square.along);
    return square;
}

sim::Vec3 toFloats(const Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Vector3d toEigen(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

} // namespace

void addStrokes(LoadedScene& loaded, const Section& section) {
    const double dt = double{loaded.scene.dt};
    const double duration = section.has("duration") ? section.value("duration") : 0;
    const double steps = std::max(wholeSteps(duration, dt), 1.0);
    const double pitch = std::max(wholeSteps(section.value("every"), dt), 1.0);
    if (pitch < steps)
        section.fail("every", "is shorter than a stroke's duration",
                     "let one begin after the other has ended");
    const Vector3d center = toEigen(section.point("center")) - toEigen(loaded.origin),
                   size = toEigen(section.point("size"));
    const double first = wholeSteps(section.value("begin"), dt);
    sim::Random random(section.count("seed"));
    for (std::uint32_t s = 0; s < section.count("count"); ++s) {
        const Square square = randomSquare(random, center, size, section.value("length"));
        const double from = first + s * pitch;
        BladeMotion motion{.name = "stroke " + std::to_string(s + 1),
                           .times = {from * dt, (from + steps) * dt},
                           .edges = {}};
        for (const double end : {-1.0, 1.0})
            motion.edges.push_back({toFloats(square.middle + end * square.across - square.along),
                                    toFloats(square.middle + end * square.across + square.along)});
        loaded.blades.push_back(std::move(motion));
    }
}

} // namespace sinew::scenes
