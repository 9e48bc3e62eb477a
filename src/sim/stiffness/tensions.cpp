// Weight flows towards what holds a body: one loop over the particles, farthest first.
#include "sim/stiffness/tensions.hpp"

#include "sim/collision/loads.hpp"
#include "sim/collision/vectors.hpp"
#include "sim/stiffness/carried.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace sinew::sim::stiffness {

namespace {

using collision::acrossLength;
using collision::dot;
using collision::minus;
using collision::toVector;
using collision::Vector;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t nobody = ~0u;
constexpr double alongTheWay = 0.99; // share of a link's length by which it must lead nearer to what holds
// Factors from the load of a link to its tension (docs/accuracy.md): at a corner, where folds of a sheet
// meet; at the rim of a support below the middle of a sheet, since a round support makes folds all around it;
// and for everything that lies on a support, where it slides and folds.
constexpr double atCorners = 25, aroundIt = 5, whereCarried = 1.2;

// The links of each particle.
struct Neighbours {
    std::vector<std::uint32_t> first, link;

    explicit Neighbours(const Scene& scene) : first(scene.particles.size() + 1, 0) {
        for (const DistanceConstraint& c : scene.distances) ++first[c.a + 1], ++first[c.b + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        link.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t k = 0; k < scene.distances.size(); ++k)
            link[next[scene.distances[k].a]++] = link[next[scene.distances[k].b]++] = k;
    }
    std::span<const std::uint32_t> of(std::uint32_t i) const {
        return std::span(link).subspan(first[i], first[i + 1] - first[i]);
    }
};

std::uint32_t otherEnd(const DistanceConstraint& c, std::uint32_t end) {
    return c.a == end ? c.b : c.a;
}

// The shortest paths along links from each particle to the nearest held one.
struct Ways {
    std::vector<double> length;       // [m]
    std::vector<std::uint32_t> root;  // the held particle; nobody = it hangs on nothing
    std::vector<std::uint32_t> order; // nearest first
};

Ways waysTo(const Scene& scene, const Neighbours& neighbours, const std::vector<bool>& isHeld) {
    using Item = std::pair<double, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const std::size_t count = scene.particles.size();
    Ways ways{.length = std::vector(count, infinite), .root = std::vector(count, nobody), .order = {}};
    for (std::uint32_t i = 0; i < count; ++i)
        if (isHeld[i]) queue.push({ways.length[i] = 0, ways.root[i] = i});
    while (!queue.empty()) {
        const auto [length, i] = queue.top();
        queue.pop();
        if (length > ways.length[i]) continue;
        ways.order.push_back(i);
        for (const std::uint32_t k : neighbours.of(i)) {
            const DistanceConstraint& c = scene.distances[k];
            const std::uint32_t other = otherEnd(c, i);
            const double farther = length + double{c.restLength};
            if (farther >= ways.length[other]) continue;
            ways.length[other] = farther;
            ways.root[other] = ways.root[i];
            queue.push({farther, other});
        }
    }
    return ways;
}

// Tension over load of a horizontal span of length `way` between holds at the distance `apart`. A load in its
// middle makes the shallowest slope.
double steepness(double way, double apart, double tolerance) {
    if (apart <= 0) return 1;
    const double excess = std::max(way * (1 + tolerance) / apart - 1, tolerance);
    return std::sqrt(1 + 1 / (excess * (2 + excess)));
}

// By particle, the largest steepness of the spans that end in it.
std::vector<double> spansOf(const Scene& scene, const Ways& ways, const Vector& down, double tolerance) {
    std::vector<double> spans(scene.particles.size(), 1);
    for (const DistanceConstraint& c : scene.distances) {
        const std::uint32_t a = ways.root[c.a], b = ways.root[c.b];
        if (a == b || a == nobody || b == nobody || (a == c.a && b == c.b)) continue;
        const Vector apart =
            minus(toVector(scene.particles[a].position), toVector(scene.particles[b].position));
        const double way = ways.length[c.a] + double{c.restLength} + ways.length[c.b];
        const double span = steepness(way, acrossLength(apart, down), tolerance);
        for (const std::uint32_t end : {c.a, c.b}) spans[end] = std::max(spans[end], span);
    }
    return spans;
}

// How each particle is held.
struct Holds {
    std::vector<bool> isHeld, isSharp;
    std::vector<bool> isCarried;  ///< held from below, not by a pin or an attachment
    std::vector<bool> isInMiddle; ///< its support in the middle of a sheet reaches no edge of the sheet
    explicit Holds(std::size_t count) : isHeld(count), isSharp(count), isCarried(count), isInMiddle(count) {}
    bool operator==(const Holds&) const = default;
};

// Particles of components with a rigid link.
std::vector<std::uint32_t> withRigidLinks(const Scene& scene, std::span<const std::uint32_t> components) {
    std::vector<bool> isRigid(scene.particles.size());
    for (const DistanceConstraint& c : scene.distances)
        if (c.compliance == 0) isRigid[components[c.a]] = true;
    std::vector<std::uint32_t> particles;
    for (std::uint32_t i = 0; i < components.size(); ++i)
        if (isRigid[components[i]]) particles.push_back(i);
    return particles;
}

// A body's weight, passed from particle to particle.
struct Flow {
    const Scene& scene;
    std::span<const float> inverseMass;
    const Neighbours& neighbours;
    Vector down{};
    double gravity = 0, tolerance = 0;
    std::span<const double> onto; // mass of other bodies, by particle [kg]
    std::vector<double> tensions = std::vector<double>(scene.distances.size(), 0.0);

    // Slanted links go slack as a hanging sheet becomes narrow: only links along the path bear it, longer
    // ones more.
    double partOf(const Ways& ways, std::uint32_t from, const DistanceConstraint& c) const {
        const double drop = ways.length[from] - ways.length[otherEnd(c, from)];
        return drop > alongTheWay * double{c.restLength} ? drop : 0;
    }

    // Mass of other bodies on `i`, which pulls at all its sides: this walk follows one of them. A chain has
    // one side, a sheet whose particles have eight links has four.
    double ontoLinks(std::uint32_t i) const {
        return onto[i] * 2 / static_cast<double>(std::max<std::size_t>(2, neighbours.of(i).size()));
    }

    // Whether `i` is at a corner of what holds it: fewer than half of its neighbours are held, and no two of
    // those are on opposite sides. Chains have no corners.
    bool isAtCorner(const Holds& holds, std::uint32_t i) const {
        const std::span<const std::uint32_t> links = neighbours.of(i);
        if (!holds.isHeld[i] || !holds.isSharp[i] || links.size() <= 2) return false;
        std::vector<Vector> held; // directions
        for (const std::uint32_t k : links) {
            const std::uint32_t other = otherEnd(scene.distances[k], i);
            if (!holds.isHeld[other]) continue;
            const Vector way =
                minus(toVector(scene.particles[other].position), toVector(scene.particles[i].position));
            const double length = std::sqrt(dot(way, way));
            for (const Vector& before : held)
                if (dot(way, before) < -0.9 * length) return false;
            if (length > 0) held.push_back({way[0] / length, way[1] / length, way[2] / length});
        }
        return 2 * held.size() < links.size();
    }

    // By particle whether it belongs to a connected group of carried particles, none of which is at an edge
    // of its sheet, that is, has fewer links than the most in its component. Chains have no middle.
    std::vector<bool> inMiddle(const std::vector<bool>& isCarried,
                               std::span<const std::uint32_t> components) const {
        const std::size_t count = isCarried.size();
        std::vector<std::size_t> most(count, 0);
        for (std::uint32_t i = 0; i < count; ++i)
            most[components[i]] = std::max(most[components[i]], neighbours.of(i).size());
        std::vector<bool> isSeen(count), result(count);
        std::vector<std::uint32_t> group;
        for (std::uint32_t start = 0; start < count; ++start) {
            if (!isCarried[start] || isSeen[start]) continue;
            group.assign(1, start);
            isSeen[start] = true;
            bool isInMiddle = true;
            for (std::size_t n = 0; n < group.size(); ++n) {
                const std::span<const std::uint32_t> links = neighbours.of(group[n]);
                isInMiddle = isInMiddle && links.size() > 2 && links.size() == most[components[group[n]]];
                for (const std::uint32_t k : links) {
                    const std::uint32_t other = otherEnd(scene.distances[k], group[n]);
                    if (!isCarried[other] || isSeen[other]) continue;
                    isSeen[other] = true;
                    group.push_back(other);
                }
            }
            for (const std::uint32_t i : group) result[i] = isInMiddle;
        }
        return result;
    }

    // By particle how far it may fall before its path to the nearest held one is straight.
    std::vector<double> fallsOf(const Holds& holds) const {
        const Ways ways = waysTo(scene, neighbours, holds.isHeld);
        std::vector<double> falls(ways.length.size(), infinite);
        for (const std::uint32_t i : ways.order) {
            const Vector drop = minus(toVector(scene.particles[ways.root[i]].position),
                                      toVector(scene.particles[i].position));
            falls[i] = ways.length[i] + dot(drop, down);
        }
        return falls;
    }

    void run(const Holds& holds) {
        const std::vector<bool>& isHeld = holds.isHeld;
        const Ways ways = waysTo(scene, neighbours, isHeld);
        std::vector<double> spans = spansOf(scene, ways, down, tolerance);
        std::vector<double> loads(scene.particles.size(), 0);
        for (auto i = ways.order.rbegin(); i != ways.order.rend(); ++i) {
            if (isHeld[*i]) break; // these are the nearest of all
            if (inverseMass[*i] > 0) loads[*i] += gravity * (1 / double{inverseMass[*i]} + ontoLinks(*i));
            double sum = 0;
            for (const std::uint32_t k : neighbours.of(*i)) sum += partOf(ways, *i, scene.distances[k]);
            if (sum == 0) continue;
            for (const std::uint32_t k : neighbours.of(*i)) {
                const DistanceConstraint& c = scene.distances[k];
                const double part = partOf(ways, *i, c);
                if (part == 0) continue;
                const std::uint32_t other = otherEnd(c, *i);
                const double load = loads[*i] * part / sum,
                             slope = (ways.length[*i] - ways.length[other]) / double{c.restLength};
                loads[other] += load;
                spans[other] = std::max(spans[other], spans[*i]);
                const double folds = isAtCorner(holds, other)  ? atCorners
                                     : holds.isInMiddle[other] ? aroundIt
                                                               : 1,
                             margin = holds.isCarried[ways.root[*i]] ? whereCarried : 1;
                tensions[k] = std::max(tensions[k], margin * folds * load / slope * spans[*i]);
            }
        }
    }
};

} // namespace

std::vector<double> tensionsOf(const Scene& scene, std::span<const float> inverseMass,
                               std::span<const std::uint32_t> components, double tolerance) {
    const auto [gravity, down] = collision::pullOf(scene);
    if (gravity == 0) return std::vector<double>(scene.distances.size(), 0.0);
    const Neighbours neighbours(scene);
    const std::vector<double> onto = collision::loads::massesOnto(scene, inverseMass, components);
    Flow flow{.scene = scene,
              .inverseMass = inverseMass,
              .neighbours = neighbours,
              .down = down,
              .gravity = gravity,
              .tolerance = tolerance,
              .onto = onto};
    Holds holds(scene.particles.size());
    for (std::size_t i = 0; i < holds.isHeld.size(); ++i) holds.isHeld[i] = inverseMass[i] == 0;
    for (const Attachment& attachment : scene.attachments) holds.isHeld[attachment.particle] = true;
    const std::vector<double> falls = flow.fallsOf(holds);
    flow.run(holds);
    const std::vector<std::uint32_t> asked = withRigidLinks(scene, components);
    const Supports supports(scene, components, down, asked);
    Holds before = holds;
    for (const double time : timesOf(scene)) {
        const Support support = supports.at(time);
        Holds carried = holds;
        for (const std::uint32_t i : asked)
            if (!holds.isHeld[i] && support.ways[i] < infinite && support.ways[i] <= falls[i]) {
                carried.isHeld[i] = carried.isCarried[i] = true;
                carried.isSharp[i] = support.isSharp[i];
            }
        if (carried == before) continue;
        before = carried;
        carried.isInMiddle = flow.inMiddle(carried.isCarried, components);
        flow.run(carried);
    }
    return std::move(flow.tensions);
}

} // namespace sinew::sim::stiffness
