// First-fit edge coloring, tried in several orders for each connected body; the order with the fewest colors
// wins. In a grid or lattice the constraints of one direction form straight chains, which need two
// alternating colors: colored direction by direction, a body needs as many colors as an inner particle has
// constraints. A direction is recognised by the difference of the two indices (a full grid) or by the
// positions of the ends (voxels of any shape).
#include "sim/model/coloring.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::sim {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

// The constraints on each moving particle, and the connected bodies that they form.
class Graph {
public:
    Graph(const Scene& scene, std::span<const float> inverseMass)
        : scene_(scene), inverseMass_(inverseMass), first_(scene.particles.size() + 1, 0) {
        for (const DistanceConstraint& c : scene.distances)
            for (const std::uint32_t end : {c.a, c.b}) first_[end + 1] += moves(end);
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        incident_.resize(first_.back());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t c = 0; c < scene.distances.size(); ++c)
            for (const std::uint32_t end : {scene.distances[c].a, scene.distances[c].b})
                if (moves(end)) incident_[next[end]++] = c;
    }

    bool moves(std::uint32_t particle) const { return inverseMass_[particle] > 0; }
    const DistanceConstraint& constraint(std::uint32_t c) const { return scene_.distances[c]; }
    const Vec3& position(std::uint32_t particle) const { return scene_.particles[particle].position; }
    std::span<const std::uint32_t> incident(std::uint32_t particle) const {
        return std::span(incident_).subspan(first_[particle], first_[particle + 1] - first_[particle]);
    }

    /// Constraints of each body, ascending by their lower particle. Two bodies share no moving particle.
    std::vector<std::vector<std::uint32_t>> bodies() const {
        std::vector<std::vector<std::uint32_t>> result;
        std::vector<bool> isTaken(scene_.distances.size());
        for (std::uint32_t seed = 0; seed < scene_.distances.size(); ++seed) {
            const DistanceConstraint& c = constraint(seed);
            if (isTaken[seed] || (!moves(c.a) && !moves(c.b))) continue;
            std::vector<std::uint32_t>& body = result.emplace_back(1, seed);
            isTaken[seed] = true;
            for (std::size_t next = 0; next < body.size(); ++next)
                for (const std::uint32_t end : {constraint(body[next]).a, constraint(body[next]).b})
                    for (const std::uint32_t other : incident(end))
                        if (!isTaken[other]) isTaken[other] = true, body.push_back(other);
            sortByParticle(body);
        }
        return result;
    }

    void sortByParticle(std::span<std::uint32_t> constraints) const {
        std::ranges::sort(constraints, {}, [&](std::uint32_t c) {
            return std::array{std::min(constraint(c).a, constraint(c).b),
                              std::max(constraint(c).a, constraint(c).b), c};
        });
    }

private:
    const Scene& scene_;
    std::span<const float> inverseMass_;
    std::vector<std::uint32_t> first_, incident_; // incident_[first_[i]] ... : constraints on particle i
};

using Groups = std::vector<std::vector<std::uint32_t>>;
constexpr std::size_t mostDirections = 32; // a regular body has at most 13

// Groups of constraints that `isSame` calls parallel; empty if there are too many groups for a regular body.
template <typename IsSame> Groups groupBy(const std::vector<std::uint32_t>& body, const IsSame& isSame) {
    Groups groups;
    for (const std::uint32_t c : body) {
        const auto found =
            std::ranges::find_if(groups, [&](const auto& group) { return isSame(group[0], c); });
        if (found != groups.end()) {
            found->push_back(c);
        } else if (groups.size() < mostDirections) {
            groups.push_back({c});
        } else {
            return {};
        }
    }
    return groups;
}

std::uint32_t stepOf(const DistanceConstraint& c) {
    return c.a < c.b ? c.b - c.a : c.a - c.b;
}

bool isParallel(const Graph& graph, const DistanceConstraint& c, const DistanceConstraint& d) {
    constexpr double sine = 1e-3; // tolerates float32 rounding of positions
    const auto direction = [&](const DistanceConstraint& of) {
        const Vec3 &p = graph.position(of.a), &q = graph.position(of.b);
        return std::array{double{q.x} - p.x, double{q.y} - p.y, double{q.z} - p.z};
    };
    const auto u = direction(c), v = direction(d);
    const auto dot = [](const auto& r, const auto& s) { return r[0] * s[0] + r[1] * s[1] + r[2] * s[2]; };
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
    return uv * uv >= (1 - sine * sine) * uu * vv;
}

// Colors of the scene's constraints (none = not colored yet), assigned body by body.
class FirstFit {
public:
    FirstFit(const Graph& graph, std::size_t constraints) : graph_(graph), color_(constraints, none) {}

    /// Gives every group its own colors, and each constraint the lowest one that its moving ends do not have
    /// yet; returns one past the last color of each group.
    std::vector<std::uint32_t> apply(const Groups& groups) {
        std::vector<std::uint32_t> ends;
        for (const std::vector<std::uint32_t>& group : groups) {
            const std::uint32_t base = ends.empty() ? 0 : ends.back();
            std::uint32_t end = base;
            for (const std::uint32_t c : group) end = std::max(end, (color_[c] = lowestFree(c, base)) + 1);
            ends.push_back(end);
        }
        return ends;
    }
    void clear(const std::vector<std::uint32_t>& body) {
        for (const std::uint32_t c : body) color_[c] = none;
    }
    void rename(const std::vector<std::uint32_t>& body, const std::vector<std::uint32_t>& names) {
        for (const std::uint32_t c : body) color_[c] = names[color_[c]];
    }
    const std::vector<std::uint32_t>& colors() const { return color_; }

private:
    std::uint32_t lowestFree(std::uint32_t c, std::uint32_t base) {
        ++stamp_;
        for (const std::uint32_t end : {graph_.constraint(c).a, graph_.constraint(c).b})
            for (const std::uint32_t other : graph_.incident(end)) {
                const std::uint32_t taken = color_[other];
                if (taken == none) continue;
                if (taken >= stamps_.size()) stamps_.resize(taken + 1, 0);
                stamps_[taken] = stamp_;
            }
        std::uint32_t lowest = base;
        while (lowest < stamps_.size() && stamps_[lowest] == stamp_) ++lowest;
        return lowest;
    }

    const Graph& graph_;
    std::vector<std::uint32_t> color_;
    std::vector<std::uint64_t> stamps_; // by color: the constraint that last found it taken
    std::uint64_t stamp_ = 0;
};

// The position of each color in the order of solving; `ends` holds one past the last color of each group. The
// order is nested: half of a group's colors are solved before, and half after, all groups that follow. In a
// sweep a link pulls the links solved after it, which pull it only in the next substep. Nesting lets this
// one-sided pull cancel between the two colors of a direction, as long as strain is smooth. If the colors of
// two directions alternate, the pull adds up and drives slow modes: a rigid cloth never rests. An odd number
// of groups, such as the 9 and 13 directions of lattices, is taken in steps of two backwards from the first:
// with direction after direction, a warm start makes a stiff beam swing up.
std::vector<std::uint32_t> nestedTurns(const std::vector<std::uint32_t>& ends) {
    const auto groups = static_cast<std::uint32_t>(ends.size());
    const std::uint32_t stride = groups % 2 == 1 && groups > 2 ? groups - 2 : 1; // without a common divisor
    std::vector<std::uint32_t> turns(ends.back());
    std::uint32_t front = 0, back = ends.back();
    for (std::uint32_t k = 0; k < groups; ++k) {
        const std::uint32_t group = k * stride % groups;
        const std::uint32_t first = group == 0 ? 0 : ends[group - 1], end = ends[group];
        const std::uint32_t middle = first + (end - first + 1) / 2;
        for (std::uint32_t color = first; color < middle; ++color) turns[color] = front++;
        for (std::uint32_t color = middle; color < end; ++color) turns[color] = --back;
    }
    return turns;
}

// Tries all orders on one body and keeps the colors of the best.
void colorBody(const Graph& graph, const std::vector<std::uint32_t>& body, FirstFit& firstFit) {
    const std::array<Groups, 3> orders{
        groupBy(body,
                [&](std::uint32_t c, std::uint32_t d) {
                    return stepOf(graph.constraint(c)) == stepOf(graph.constraint(d));
                }),
        groupBy(body,
                [&](std::uint32_t c, std::uint32_t d) {
                    return isParallel(graph, graph.constraint(c), graph.constraint(d));
                }),
        Groups{body}}; // at most 2 d - 1 colors, on any graph
    const Groups* best = nullptr;
    std::uint32_t fewest = none;
    for (const Groups& groups : orders) {
        if (groups.empty()) continue;
        const std::uint32_t count = firstFit.apply(groups).back();
        firstFit.clear(body);
        if (count < fewest) fewest = count, best = &groups;
    }
    firstFit.rename(body, nestedTurns(firstFit.apply(*best)));
}

} // namespace

Coloring colorByParticles(const Scene& scene, std::span<const float> inverseMass) {
    const Graph graph(scene, inverseMass);
    FirstFit firstFit(graph, scene.distances.size());
    for (const std::vector<std::uint32_t>& body : graph.bodies()) colorBody(graph, body, firstFit);

    Coloring result;
    std::vector<std::vector<std::uint32_t>> members;
    for (std::uint32_t c = 0; c < scene.distances.size(); ++c) {
        const std::uint32_t color = firstFit.colors()[c];
        if (color == none) continue;
        if (color >= members.size()) members.resize(color + 1);
        members[color].push_back(c);
    }
    for (std::vector<std::uint32_t>& color : members) {
        graph.sortByParticle(color);
        result.order.insert(result.order.end(), color.begin(), color.end());
        result.ends.push_back(static_cast<std::uint32_t>(result.order.size()));
    }
    return result;
}

} // namespace sinew::sim
