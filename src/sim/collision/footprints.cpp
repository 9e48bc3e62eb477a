// Hash maps of cells in the plane perpendicular to gravity, one for each octave of sizes.
#include "sim/collision/footprints.hpp"

#include <limits>

namespace sinew::sim::collision {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double ofFace = 0.7; // share of its longest edge: of half a square less than a side

// Distance to the nearest neighbour by links, or the reach of faces; 0 without links and faces.
std::vector<double> reachesOf(const Scene& scene) {
    std::vector<double> shortest(scene.particles.size(), infinite), reaches(scene.particles.size(), 0);
    for (const DistanceConstraint& c : scene.distances)
        for (const std::uint32_t end : {c.a, c.b})
            shortest[end] = std::min(shortest[end], double{c.restLength});
    for (std::size_t i = 0; i < reaches.size(); ++i)
        if (shortest[i] < infinite) reaches[i] = shortest[i];
    for (const Face& face : scene.faces) {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector edge = minus(toVector(scene.particles[face.particles[k]].position),
                                      toVector(scene.particles[face.particles[(k + 1) % 3]].position));
            longest = std::max(longest, std::sqrt(dot(edge, edge)));
        }
        for (const std::uint32_t corner : face.particles)
            reaches[corner] = std::max(reaches[corner], ofFace * longest);
    }
    return reaches;
}

double sizeOf(const Disc& disc) {
    return std::max(disc.radius, disc.reach);
}

} // namespace

Footprints::Footprints(const Scene& scene, std::span<const float> inverseMass, const Vector& down) {
    const std::array<Vector, 3> axes = frameOf(down);
    const std::vector<double> reaches = reachesOf(scene);
    for (std::uint32_t i = 0; i < scene.particles.size(); ++i) {
        const Vector place = toVector(scene.particles[i].position);
        const double radius{scene.particles[i].radius};
        if (radius > 0)
            discs_.push_back({.particle = i,
                              .depth = dot(place, axes[0]),
                              .x = dot(place, axes[1]),
                              .y = dot(place, axes[2]),
                              .radius = radius,
                              .reach = reaches[i],
                              .isStill = inverseMass[i] == 0});
    }
    std::ranges::stable_sort(discs_, {}, &Disc::depth);
    for (std::uint32_t d = 0; d < discs_.size(); ++d) addToOctave(d);
}

Footprints::Key Footprints::keyOf(const Octave& octave, double x, double y) {
    const auto cell = [&](double at) {
        return static_cast<std::int64_t>(std::clamp(std::floor(at / octave.width), -1e18, 1e18));
    };
    return {cell(x), cell(y)};
}

void Footprints::addToOctave(std::uint32_t d) {
    const Disc& disc = discs_[d];
    const int exponent = static_cast<int>(std::ceil(std::log2(sizeOf(disc))));
    Octave& octave = octaves_[exponent];
    octave.width = std::exp2(exponent);
    octave.mostRadius = std::max(octave.mostRadius, disc.radius);
    octave.mostReach = std::max(octave.mostReach, disc.reach);
    octave.cells[keyOf(octave, disc.x, disc.y)].push_back(d);
}

void Footprints::findAbove(const Disc& lower) {
    above_.clear();
    for (const auto& [exponent, octave] : octaves_) searchOctave(lower, octave);
    if (std::ranges::any_of(above_, [&](const Above& above) { return discs_[above.disc].isStill; }))
        std::ranges::sort(above_, std::ranges::greater{}, &Above::disc);
}

void Footprints::searchOctave(const Disc& lower, const Octave& octave) {
    const double half = std::max({lower.radius + octave.mostRadius, lower.reach, octave.mostReach});
    const Key low = keyOf(octave, lower.x - half, lower.y - half),
              high = keyOf(octave, lower.x + half, lower.y + half);
    const double count =
        static_cast<double>(high.first - low.first + 1) * static_cast<double>(high.second - low.second + 1);
    if (!(count < static_cast<double>(octave.cells.size()))) {
        for (const auto& [key, cell] : octave.cells) searchCell(lower, cell);
        return;
    }
    for (std::int64_t j = low.second; j <= high.second; ++j)
        for (std::int64_t i = low.first; i <= high.first; ++i)
            if (const auto found = octave.cells.find({i, j}); found != octave.cells.end())
                searchCell(lower, found->second);
}

// Overlaps (1 - d^2 / R^2)^2 of the particles of a grid with spacing a sum to 1 within 5 % if R = a.
void Footprints::searchCell(const Disc& lower, const std::vector<std::uint32_t>& cell) {
    const double own = std::max(2 * lower.radius, lower.reach);
    for (const std::uint32_t d : cell) {
        const Disc& upper = discs_[d];
        const double above = lower.depth - upper.depth;
        if (above <= 0) return; // so are all that follow
        const double width = std::max({upper.radius + lower.radius, upper.reach, lower.reach});
        const double x = lower.x - upper.x, y = lower.y - upper.y;
        const double inside = 1 - (x * x + y * y) / (width * width);
        if (inside <= 0) continue;
        const double overlap = inside * inside * std::min(1.0, above / std::min(upper.radius, lower.radius));
        above_.push_back({d, overlap, std::min(1.0, own * own / (width * width))});
    }
}

} // namespace sinew::sim::collision
