// Blocks in maps by place.
#include "sim/reference/levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace sinew::sim::reference {

namespace {

using Node = Levels::Node;
using Bond = Levels::Bond;
using Level = Levels::Level;
using Place = std::array<std::int64_t, 3>;
using Positions = std::vector<Eigen::Vector3d>;

Place sum(Place a, const Place& b, std::int64_t sign) {
    for (std::size_t d = 0; d < 3; ++d) a[d] += sign * b[d];
    return a;
}

std::vector<Node> particlesOf(const Grid& grid, const Problem& problem) {
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < grid.node.size(); ++i) {
        const std::uint32_t n = grid.node[i], x = n % grid.nodes[0], yz = n / grid.nodes[0];
        const std::uint32_t y = yz % grid.nodes[1], z = yz / grid.nodes[1];
        nodes.push_back({.place = {x, y, z},
                         .rest = double{grid.restLength[0]} * Eigen::Vector3d(x, y, z),
                         .inverseMass = problem.inverseMass[grid.firstParticle + i]});
    }
    return nodes;
}

// Bonds of the particles: the links of the grid. And which of these particles are at the surface.
void addLinks(Level& level, const Grid& grid, const Problem& problem, const std::vector<ClampedLink>& links) {
    std::vector<int> counts(level.nodes.size(), 0);
    for (std::size_t k = 0; k < links.size(); ++k) {
        const Link& link = problem.links[k];
        if (link.constraint - grid.firstDistance >= grid.distanceCount) continue;
        const std::size_t a = link.a - grid.firstParticle, b = link.b - grid.firstParticle;
        const Place step = sum(level.nodes[b].place, level.nodes[a].place, -1);
        level.bonds.push_back({a, b, step, link.restLength, links[k].stiffness, links[k].most});
        ++counts[a];
        ++counts[b];
    }
    for (std::size_t i = 0; i < counts.size(); ++i)
        level.nodes[i].importance = counts[i] < std::ranges::max(counts) ? 2 : 1;
}

// The stiffness of a bond that a substep does not reach [N/m].
double missingOf(const Bond& bond, double h) {
    return std::max(bond.stiffness - bond.most / (h * h), 0.0);
}

// Groups the nodes; `at`: the blocks by place.
std::vector<Node> blocksOf(std::vector<Node>& nodes, std::map<Place, std::size_t>& at) {
    std::vector<Node> blocks;
    std::vector<bool> isFixed;
    for (Node& node : nodes) {
        const Place place{node.place[0] / 2, node.place[1] / 2, node.place[2] / 2};
        const auto [found, isNew] = at.try_emplace(place, blocks.size());
        if (isNew) {
            blocks.push_back({.place = place});
            isFixed.push_back(false);
        }
        node.parent = found->second;
        if (node.inverseMass == 0) isFixed[node.parent] = true;
    }
    std::vector<double> sums(blocks.size(), 0);
    for (Node& node : nodes) {
        const bool isHeld = isFixed[node.parent];
        node.weight = !isHeld ? node.importance / node.inverseMass : node.inverseMass == 0 ? 1 : 0;
        sums[node.parent] += node.weight;
    }
    for (Node& node : nodes) {
        node.weight /= sums[node.parent];
        blocks[node.parent].rest += node.weight * node.rest;
        blocks[node.parent].inverseMass += node.weight * node.weight * node.inverseMass;
    }
    return blocks;
}

void clamp(Level& level, double omega, double h) {
    double inverseMasses = 0, moving = 0;
    for (const Node& node : level.nodes) {
        inverseMasses += node.inverseMass;
        moving += node.inverseMass > 0 ? 1 : 0;
    }
    std::vector<double> shares, sums(level.nodes.size(), 0);
    for (const Bond& bond : level.bonds) {
        shares.push_back(bond.stiffness / (1 + 2 * inverseMasses / moving * h * h * bond.stiffness));
        sums[bond.a] += shares.back();
        sums[bond.b] += shares.back();
    }
    for (std::size_t k = 0; k < level.bonds.size(); ++k) {
        double time = std::numeric_limits<double>::infinity();
        for (const std::size_t end : {level.bonds[k].a, level.bonds[k].b})
            if (level.nodes[end].inverseMass > 0 && sums[end] > 0)
                time = std::min(time, omega / (2 * level.nodes[end].inverseMass * sums[end]));
        if (shares[k] == 0) time = 0;
        level.bonds[k].most = shares[k] * time;
    }
}

using Pairs = std::vector<std::array<std::size_t, 2>>;

// The pairs of blocks in this direction around a bond between the blocks a and b.
Pairs pairsOf(const std::map<Place, std::size_t>& at, const std::vector<Node>& blocks, std::size_t a,
              std::size_t b, const Place& step) {
    Pairs pairs;
    if (const auto ahead = at.find(sum(blocks[a].place, step, 1)); ahead != at.end())
        pairs.push_back({a, ahead->second});
    if (const auto behind = at.find(sum(blocks[b].place, step, -1)); behind != at.end())
        if (pairs.empty() || pairs[0] != std::array{behind->second, b}) pairs.push_back({behind->second, b});
    return pairs;
}

double squareOf(const Place& step) {
    return static_cast<double>(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
}

Level above(Level& below, double omega, double h) {
    Level level;
    std::map<Place, std::size_t> at;
    level.nodes = blocksOf(below.nodes, at);
    std::map<std::array<std::size_t, 2>, Bond> bonds;
    for (const Bond& bond : below.bonds) {
        const std::size_t a = below.nodes[bond.a].parent, b = below.nodes[bond.b].parent;
        double energy = missingOf(bond, h) * bond.length * bond.length; // of a uniform strain
        Place step = bond.step;
        Pairs pairs = pairsOf(at, level.nodes, a, b, step);
        if (pairs.empty()) {
            step = {0, 0, 0};
            for (std::size_t d = 0; d < 3; ++d) {
                Place axis{0, 0, 0};
                axis[d] = bond.step[d];
                if (axis[d] != 0 && !pairsOf(at, level.nodes, a, b, axis).empty()) step[d] = axis[d];
            }
            if (squareOf(step) == 0) continue;
            energy *= std::pow(squareOf(step) / squareOf(bond.step), 2);
            pairs = pairsOf(at, level.nodes, a, b, step);
        }
        for (const auto& [from, to] : pairs) {
            const double length = (level.nodes[to].rest - level.nodes[from].rest).norm();
            Bond& of = bonds.try_emplace({from, to}, Bond{from, to, step, length, 0, 0}).first->second;
            of.stiffness += energy / static_cast<double>(pairs.size()) / (length * length);
        }
    }
    for (const auto& [pair, bond] : bonds)
        if (level.nodes[bond.a].inverseMass + level.nodes[bond.b].inverseMass > 0)
            level.bonds.push_back(bond);
    clamp(level, omega, h);
    return level;
}

Positions placesOf(const std::vector<Node>& nodes, const Positions& x, std::size_t blocks) {
    Positions places(blocks, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < nodes.size(); ++i) places[nodes[i].parent] += nodes[i].weight * x[i];
    return places;
}

Positions toChildren(const std::vector<Node>& nodes, const Positions& forces) {
    Positions below;
    for (const Node& node : nodes) below.push_back(node.weight * forces[node.parent]);
    return below;
}

// An estimate of the largest eigenvalue of h^2 M^-1 K of all levels if bonds had no direction, by 40 turns of
// power iteration from the start of sim/levels/blocks.cpp. Leaves out cells and bends, which count there.
double largestEigenvalue(const std::vector<Level>& levels) {
    Positions x(levels[0].nodes.size(), Eigen::Vector3d::Zero());
    std::uint32_t number = 1;
    for (Eigen::Vector3d& v : x) {
        number = number * 1664525 + 1013904223;
        v.x() = number / 4294967296.0 - 0.5;
    }
    double value = 0;
    for (int turn = 0; turn < 40; ++turn) {
        double length = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const double w = levels[0].nodes[i].inverseMass;
            if (w == 0) x[i].setZero();
            length += w > 0 ? x[i].squaredNorm() / w : 0;
        }
        for (Eigen::Vector3d& v : x) v /= std::sqrt(std::max(length, 1e-300));
        std::vector<Positions> places{x};
        for (std::size_t l = 1; l < levels.size(); ++l)
            places.push_back(placesOf(levels[l - 1].nodes, places.back(), levels[l].nodes.size()));
        Positions forces;
        for (std::size_t l = levels.size(); l-- > 0;) {
            forces = l + 1 < levels.size() ? toChildren(levels[l].nodes, forces)
                                           : Positions(levels[l].nodes.size(), Eigen::Vector3d::Zero());
            for (const Bond& bond : levels[l].bonds) {
                const Eigen::Vector3d pull = bond.most * (places[l][bond.a] - places[l][bond.b]);
                forces[bond.a] += pull;
                forces[bond.b] -= pull;
            }
        }
        value = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            value += x[i].dot(forces[i]);
            x[i] = levels[0].nodes[i].inverseMass * forces[i];
        }
    }
    return value / 0.97;
}

void limit(std::vector<Level>& levels, const Settings& settings, double h) {
    for (std::size_t l = 1; l < levels.size(); ++l)
        for (Bond& bond : levels[l].bonds) bond.most = std::min(bond.most, bond.stiffness * h * h);
    const double most = 0.95 * 4 / (1 + 2 * double{settings.theta}), eigenvalue = largestEigenvalue(levels);
    if (eigenvalue <= most) return;
    const double own = largestEigenvalue({levels[0]}),
                 share = std::max((most - own) / (eigenvalue - own), 0.0);
    for (std::size_t l = 1; l < levels.size(); ++l)
        for (Bond& bond : levels[l].bonds) {
            bond.stiffness *= share;
            bond.most *= share;
        }
}

} // namespace

Levels::Levels(const Scene& scene, const Settings& settings, const Problem& problem,
               const std::vector<ClampedLink>& links, double h) {
    if (settings.levels == 0) return;
    for (const Grid& grid : scene.grids) {
        std::vector<Level> levels(1);
        levels[0].nodes = particlesOf(grid, problem);
        addLinks(levels[0], grid, problem, links);
        const auto isSoft = [&](const Bond& bond) { return missingOf(bond, h) > 0; };
        while (levels.size() <= settings.levels && std::ranges::any_of(levels.back().bonds, isSoft)) {
            Level next = above(levels.back(), 0.95 * double{settings.omega}, h);
            if (next.bonds.empty()) break;
            levels.push_back(std::move(next));
        }
        if (levels.size() == 1) continue;
        limit(levels, settings, h);
        bodies_.push_back({grid.firstParticle, std::move(levels)});
    }
}

void Levels::addForces(double h, const Positions& y, Positions& force) const {
    for (const Body& body : bodies_) {
        const std::vector<Level>& levels = body.levels;
        const auto first = y.begin() + static_cast<std::ptrdiff_t>(body.first);
        std::vector<Positions> places{{first, first + static_cast<std::ptrdiff_t>(levels[0].nodes.size())}};
        for (std::size_t l = 1; l < levels.size(); ++l)
            places.push_back(placesOf(levels[l - 1].nodes, places.back(), levels[l].nodes.size()));
        Positions forces(levels.back().nodes.size(), Eigen::Vector3d::Zero());
        for (std::size_t l = levels.size() - 1; l > 0; --l) {
            for (const Bond& bond : levels[l].bonds) {
                const Eigen::Vector3d d = places[l][bond.b] - places[l][bond.a];
                const double length = d.norm();
                if (length == 0) continue; // no direction, no force
                const Eigen::Vector3d pull =
                    std::min(bond.stiffness, bond.most / (h * h)) * (1 - bond.length / length) * d;
                forces[bond.a] += pull;
                forces[bond.b] -= pull;
            }
            forces = toChildren(levels[l - 1].nodes, forces);
        }
        for (std::size_t i = 0; i < forces.size(); ++i) force[body.first + i] += forces[i];
    }
}

} // namespace sinew::sim::reference
