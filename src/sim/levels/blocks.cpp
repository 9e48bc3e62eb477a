// Blocks by dense tables of a level's grid; block links by direction and block, so that a body of a million
// links needs no hash table.
#include "sim/levels/blocks.hpp"

#include "sim/constraints/distance.hpp"
#include "sim/lattice/cells.hpp"
#include "sim/lattice/placement.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::levels {

namespace {

using Place = std::array<std::int32_t, 3>;

constexpr std::uint32_t none = 0xffffffffu;
constexpr double levelOmega = 0.95;
constexpr double surfaceWeight = 2; // a compromise: docs/levels.md, "Speed against error"

// Numbers of the blocks of a level's nodes, by place.
class Places {
public:
    explicit Places(const std::vector<Node>& nodes) {
        for (const Node& node : nodes)
            for (std::size_t d = 0; d < 3; ++d) size_[d] = std::max(size_[d], node.place[d] / 2 + 1);
        at_.assign(std::size_t(size_[0]) * size_[1] * size_[2], none);
    }

    // The number at a place, which is set to `next` if there is none yet.
    std::uint32_t first(const Place& place, std::uint32_t next) {
        std::uint32_t& found = at_[index(place)];
        if (found == none) found = next;
        return found;
    }
    std::uint32_t at(const Place& place) const {
        for (std::size_t d = 0; d < 3; ++d)
            if (place[d] < 0 || place[d] >= size_[d]) return none;
        return at_[index(place)];
    }

private:
    std::size_t index(const Place& place) const {
        return std::size_t(place[0]) + std::size_t(size_[0]) * (place[1] + std::size_t(size_[1]) * place[2]);
    }

    Place size_{1, 1, 1};
    std::vector<std::uint32_t> at_;
};

Place plus(const Place& a, const Place& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Place minus(const Place& a, const Place& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double distance(const Node& a, const Node& b) {
    return std::hypot(a.rest[0] - b.rest[0], a.rest[1] - b.rest[1], a.rest[2] - b.rest[2]);
}

Place halved(const Place& place) {
    return {place[0] / 2, place[1] / 2, place[2] / 2};
}

// Sets the weights of the nodes in their blocks, which know whether they move.
void weigh(std::vector<Node>& nodes, const std::vector<Node>& blocks) {
    std::vector<double> sums(blocks.size(), 0);
    for (Node& node : nodes) {
        if (blocks[node.parent].inverseMass == 0)
            node.weight = node.inverseMass == 0 ? 1 : 0;
        else
            node.weight = (node.isOfSurface ? surfaceWeight : 1) / node.inverseMass;
        sums[node.parent] += node.weight;
    }
    for (Node& node : nodes) node.weight /= sums[node.parent];
}

// The blocks of a level's nodes, whose parents and weights are set; `places`: those of these nodes.
std::vector<Node> blocksOf(std::vector<Node>& nodes, Places& places) {
    std::vector<Node> blocks;
    for (Node& node : nodes) {
        const std::uint32_t block =
            places.first(halved(node.place), static_cast<std::uint32_t>(blocks.size()));
        if (block == blocks.size()) blocks.push_back({.place = halved(node.place), .inverseMass = 1});
        node.parent = block;
        if (node.inverseMass == 0) blocks[block].inverseMass = 0;
    }
    weigh(nodes, blocks);
    for (Node& block : blocks) block.inverseMass = 0;
    for (const Node& node : nodes) {
        Node& block = blocks[node.parent];
        block.inverseMass += node.weight * node.weight * node.inverseMass;
        for (std::size_t d = 0; d < 3; ++d) block.rest[d] += node.weight * node.rest[d];
    }
    return blocks;
}

// Energy of a unit strain, by direction and block: (k - k') L^2.
class Energies {
public:
    explicit Energies(std::size_t blocks) : blocks_(blocks) {}

    void add(const Place& step, std::uint32_t from, double energy) {
        std::size_t d = last_;
        if (steps_.empty() || steps_[d] != step) {
            d = static_cast<std::size_t>(std::ranges::find(steps_, step) - steps_.begin());
            if (d == steps_.size()) {
                steps_.push_back(step);
                sums_.emplace_back(blocks_, absent);
            }
            last_ = d;
        }
        double& sum = sums_[d][from];
        sum = std::max(sum, 0.0) + energy;
    }

    std::vector<Link> links(const std::vector<Node>& blocks, const Places& places) const {
        std::vector<Link> links;
        for (std::uint32_t a = 0; a < blocks.size(); ++a)
            for (std::size_t d = 0; d < steps_.size(); ++d) {
                if (sums_[d][a] == absent) continue;
                const std::uint32_t b = places.at(plus(blocks[a].place, steps_[d]));
                if (blocks[a].inverseMass + blocks[b].inverseMass == 0) continue;
                const double length = distance(blocks[a], blocks[b]);
                links.push_back({a, b, steps_[d], length, sums_[d][a] / (length * length), 0});
            }
        return links;
    }

private:
    static constexpr double absent = -1;
    std::size_t blocks_, last_ = 0;
    std::vector<Place> steps_;
    std::vector<std::vector<double>> sums_; // by direction, then by the block that a link comes from
};

// Sets the limits of all links: those of mass splitting (sim/stiffness/shares.hpp).
void clamp(Level& level, double omega, double h) {
    double inverseMasses = 0;
    std::size_t moving = 0;
    for (const Node& node : level.nodes) {
        inverseMasses += node.inverseMass;
        moving += node.inverseMass > 0 ? 1 : 0;
    }
    const double softening = moving > 0 ? 2 * inverseMasses / static_cast<double>(moving) * h * h : 0;
    const auto share = [&](const Link& link) { return link.stiffness / (1 + softening * link.stiffness); };
    std::vector<double> sums(level.nodes.size(), 0);
    for (const Link& link : level.links) {
        sums[link.a] += share(link);
        sums[link.b] += share(link);
    }
    const auto time = [&](std::uint32_t i) {
        const double w = level.nodes[i].inverseMass;
        if (w == 0) return std::numeric_limits<double>::infinity();
        return sums[i] > 0 ? omega / (2 * w * sums[i]) : 0; // links without stiffness
    };
    for (Link& link : level.links) link.most = share(link) * std::min(time(link.a), time(link.b));
}

// The stiffness of a link that a substep does not reach [N/m].
double missingOf(const Link& link, double h) {
    return std::max(link.stiffness - link.most / (h * h), 0.0);
}

// The blocks between which a link of this step stands: ahead of a, and behind b; none where there is no
// block.
struct Between {
    std::uint32_t ahead = none, behind = none;
    bool isEmpty() const { return ahead == none && behind == none; }
};

Between betweenOf(const std::vector<Node>& blocks, const Places& places, const Link& link,
                  const Place& step) {
    Between between{places.at(plus(blocks[link.a].place, step)),
                    places.at(minus(blocks[link.b].place, step))};
    if (between.ahead == link.b && between.behind == link.a) between.behind = none; // the same pair
    return between;
}

std::int32_t squareOf(const Place& step) {
    return step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
}

// The step without the axes along which neither block has a neighbour.
Place alongNeighbours(const std::vector<Node>& blocks, const Places& places, const Link& link) {
    Place step{};
    for (std::size_t d = 0; d < 3; ++d) {
        Place axis{};
        axis[d] = link.step[d];
        if (axis[d] != 0 && !betweenOf(blocks, places, link, axis).isEmpty()) step[d] = axis[d];
    }
    return step;
}

// The level above, without limits of its links.
Level above(Level& level, double h) {
    Level next;
    Places places(level.nodes);
    next.nodes = blocksOf(level.nodes, places);
    Energies energies(next.nodes.size());
    for (Link link : level.links) {
        double energy = missingOf(link, h) * link.length * link.length;
        link.a = level.nodes[link.a].parent;
        link.b = level.nodes[link.b].parent;
        Between between = betweenOf(next.nodes, places, link, link.step);
        if (between.isEmpty()) { // the strain along the rest of the step has this share of the energy
            const Place step = alongNeighbours(next.nodes, places, link);
            const double share = squareOf(step) / static_cast<double>(squareOf(link.step));
            energy *= share * share;
            link.step = step;
            if (share > 0) between = betweenOf(next.nodes, places, link, step);
        }
        if (between.ahead != none && between.behind != none) energy /= 2;
        if (between.ahead != none) energies.add(link.step, link.a, energy);
        if (between.behind != none) energies.add(link.step, between.behind, energy);
    }
    next.links = energies.links(next.nodes, places);
    return next;
}

// A link from its lower end in the order of places.
Link linkBetween(const std::vector<Node>& nodes, std::uint32_t a, std::uint32_t b) {
    const Place step = minus(nodes[b].place, nodes[a].place);
    const bool isUp = step[2] != 0 ? step[2] > 0 : step[1] != 0 ? step[1] > 0 : step[0] > 0;
    return isUp ? Link{.a = a, .b = b, .step = step} : Link{.a = b, .b = a, .step = minus({}, step)};
}

Level particlesOf(const Scene& scene, const Grid& grid, std::span<const float> inverseMass,
                  const stiffness::Shares& shares) {
    Level level;
    for (std::uint32_t i = 0; i < grid.node.size(); ++i) {
        const std::array<std::uint32_t, 3> at = lattice::coordinates(grid, grid.node[i]);
        Node& node = level.nodes.emplace_back();
        node.inverseMass = double{inverseMass[grid.firstParticle + i]};
        for (std::size_t d = 0; d < 3; ++d) {
            node.place[d] = static_cast<std::int32_t>(at[d]);
            node.rest[d] = double{grid.restLength[0]} * at[d]; // the scene may start deformed
        }
    }
    std::vector<std::uint32_t> counts(level.nodes.size(), 0);
    const std::size_t end = std::size_t{grid.firstDistance} + grid.distanceCount;
    for (std::size_t c = grid.firstDistance; c < end; ++c) {
        const DistanceConstraint& of = scene.distances[c];
        if (!constraints::distance::canMove(of, inverseMass)) continue;
        Link link = linkBetween(level.nodes, of.a - grid.firstParticle, of.b - grid.firstParticle);
        link.length = double{of.restLength};
        link.stiffness = double{stiffness::stiffnessOf(of.compliance)};
        link.most = double{shares.ofLinks[c]} * double{std::min(shares.times[of.a], shares.times[of.b])};
        level.links.push_back(link);
        ++counts[link.a];
        ++counts[link.b];
    }
    const std::uint32_t most = counts.empty() ? 0 : std::ranges::max(counts);
    for (std::size_t i = 0; i < counts.size(); ++i) level.nodes[i].isOfSurface = counts[i] < most;
    return level;
}

// A bound of terms that are no links: most |sum of factor x|^2 [kg] for a bend, and most x sum of |x -
// mean|^2 for a cell, whose gradients sum to 0.
struct Term {
    std::array<std::uint32_t, 8> nodes{};
    double most = 0; // [kg]
    bool isBend = false;
};

std::vector<Term> termsOf(const Scene& scene, const Settings& settings, std::uint32_t g,
                          std::span<const float> inverseMass, const stiffness::Shares& shares) {
    const Grid& grid = scene.grids[g];
    std::vector<Term> terms;
    if (hasCellVolumes(grid)) {
        const double share = double{shares.ofCells[g].volume} + double{shares.ofCells[g].recovery};
        lattice::forEachCell(grid, [&](const lattice::Cell& cell) {
            float time = shares.times[cell.corners[0]];
            for (const std::uint32_t corner : cell.corners) time = std::min(time, shares.times[corner]);
            Term& term = terms.emplace_back(Term{cell.corners, 2 * cell.fill * share * double{time}});
            for (std::uint32_t& corner : term.nodes) corner -= grid.firstParticle;
        });
    }
    std::vector<std::uint32_t> counts(scene.bends.empty() ? 0 : scene.particles.size(), 0);
    for (const BendConstraint& c : scene.bends)
        for (const std::uint32_t end : {c.a, c.b, c.c}) ++counts[end];
    const auto isOurs = [&](std::uint32_t i) { return i - grid.firstParticle < grid.node.size(); };
    for (const BendConstraint& c : scene.bends) {
        if (!isOurs(c.a) || !isOurs(c.b) || !isOurs(c.c)) continue;
        const auto part = [&](std::uint32_t i) { return counts[i] * double{inverseMass[i]}; };
        const double sum = part(c.a) + 4 * part(c.b) + part(c.c);
        const std::uint32_t first = grid.firstParticle;
        if (sum > 0)
            terms.push_back(
                {{c.a - first, c.b - first, c.c - first}, stiffness::omegaOfBends(settings) / sum, true});
    }
    return terms;
}

// Coordinates of the nodes of all levels, and the forces on them, for power iteration.
class Modes {
public:
    Modes(const std::vector<Level>& levels, std::span<const Term> terms) : levels_(levels), terms_(terms) {
        for (const Level& level : levels) {
            x_.emplace_back(level.nodes.size(), 0);
            forces_.emplace_back(level.nodes.size(), 0);
        }
        std::uint32_t number = 1; // a start with a part of every mode, the same for the same body
        for (double& x : x_[0]) {
            number = number * 1664525 + 1013904223;
            x = number / 4294967296.0 - 0.5;
        }
    }

    // Replaces x of the particles by h^2 M^-1 K x at length 1; returns the Rayleigh quotient of x before.
    double turn() {
        normalise();
        for (std::size_t l = 1; l < levels_.size(); ++l) {
            std::ranges::fill(x_[l], 0);
            const std::vector<Node>& below = levels_[l - 1].nodes;
            for (std::size_t i = 0; i < below.size(); ++i)
                x_[l][below[i].parent] += below[i].weight * x_[l - 1][i];
        }
        for (std::size_t l = levels_.size(); l-- > 0;) pull(l);
        double quotient = 0;
        for (std::size_t i = 0; i < x_[0].size(); ++i) {
            quotient += x_[0][i] * forces_[0][i];
            x_[0][i] = levels_[0].nodes[i].inverseMass * forces_[0][i];
        }
        return quotient;
    }

private:
    void normalise() {
        double sum = 0;
        for (std::size_t i = 0; i < x_[0].size(); ++i) {
            const double w = levels_[0].nodes[i].inverseMass;
            if (w > 0)
                sum += x_[0][i] * x_[0][i] / w;
            else
                x_[0][i] = 0;
        }
        for (double& x : x_[0]) x /= std::sqrt(std::max(sum, 1e-300));
    }

    // The forces on the nodes of a level, with those of the level above.
    void pull(std::size_t l) {
        std::vector<double>& forces = forces_[l];
        std::ranges::fill(forces, 0);
        for (const Link& link : levels_[l].links) {
            const double pull = link.most * (x_[l][link.a] - x_[l][link.b]);
            forces[link.a] += pull;
            forces[link.b] -= pull;
        }
        if (l == 0)
            for (const Term& term : terms_) pull(term);
        if (l + 1 == levels_.size()) return;
        for (std::size_t i = 0; i < forces.size(); ++i) {
            const Node& node = levels_[l].nodes[i];
            forces[i] += node.weight * forces_[l + 1][node.parent];
        }
    }

    void pull(const Term& term) {
        const auto [a, b, c, d, e, f, g, i] = term.nodes;
        std::vector<double>&x = x_[0], &forces = forces_[0];
        if (term.isBend) {
            const double pull = term.most * (x[a] - 2 * x[b] + x[c]);
            forces[a] += pull;
            forces[b] -= 2 * pull;
            forces[c] += pull;
            return;
        }
        const double mean = (x[a] + x[b] + x[c] + x[d] + x[e] + x[f] + x[g] + x[i]) / 8;
        for (const std::uint32_t corner : term.nodes) forces[corner] += term.most * (x[corner] - mean);
    }

    const std::vector<Level>& levels_;
    std::span<const Term> terms_;
    std::vector<std::vector<double>> x_, forces_; // by level
};

double largestEigenvalue(const std::vector<Level>& levels, std::span<const Term> terms) {
    constexpr int turns = 40;
    constexpr double found = 0.97; // estimate: so much of the eigenvalue, after so many turns
    Modes modes(levels, terms);
    double value = 0;
    for (int turn = 0; turn < turns; ++turn) value = modes.turn();
    return value / found;
}

// Takes from the links of coarse levels what stability does not allow. Their limits then hold for a substep
// of any length, as those of particles do.
void limit(std::vector<Level>& levels, std::span<const Term> terms, const Settings& settings, double h) {
    for (std::size_t l = 1; l < levels.size(); ++l)
        for (Link& link : levels[l].links) link.most = std::min(link.most, link.stiffness * h * h);
    const double most = mostEigenvalue * ranges::omegaBound(double{settings.theta});
    const double eigenvalue = largestEigenvalue(levels, terms);
    if (eigenvalue <= most) return;
    const double own = largestEigenvalue({levels.begin(), levels.begin() + 1}, terms);
    const double share = std::max((most - own) / (eigenvalue - own), 0.0);
    for (std::size_t l = 1; l < levels.size(); ++l)
        for (Link& link : levels[l].links) {
            link.most *= share;
            link.stiffness *= share;
        }
}

} // namespace

std::vector<Level> levelsOf(const Scene& scene, const Settings& settings, std::uint32_t grid,
                            std::span<const float> inverseMass, const stiffness::Shares& shares) {
    const double h = double{scene.dt} / settings.substeps;
    std::vector<Level> levels{particlesOf(scene, scene.grids[grid], inverseMass, shares)};
    const auto isSoft = [&](const Link& link) { return missingOf(link, h) > 0; };
    while (levels.size() <= settings.levels && std::ranges::any_of(levels.back().links, isSoft)) {
        Level next = above(levels.back(), h);
        if (next.links.empty()) break;
        clamp(next, levelOmega * double{settings.omega}, h);
        levels.push_back(std::move(next));
    }
    if (levels.size() > 1) limit(levels, termsOf(scene, settings, grid, inverseMass, shares), settings, h);
    return levels;
}

} // namespace sinew::sim::levels
