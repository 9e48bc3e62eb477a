// Voxel lattices, assembled per cell: an 18-neighbour central-force lattice whose links have the stiffness of
// the cells that contain them. Constants that are uniform instead of per cell would make a one-cell plate up
// to 6 times too stiff.
//
// A link in direction d lies in every cell beside it: 4 cells for an edge, 2 for a face diagonal. A full cell
// gives k1/4 to each of its edges and k2/2 to each of its face diagonals, so in both cases a link's stiffness
// is k x (mean fill of the cells that can contain it), with k1 = k2 = 0.4 E a (isotropic, Poisson ratio 1/4).
//
// With volumes of cells lambda = mu + lambda_v. Then E = mu (3 lambda + 2 mu) / (lambda + mu) = 2 mu (1 + nu)
// is the requested modulus if k1 = k2 = mu a with mu = E / (2 (1 + nu)).
#include "sinew/bodies.hpp"

#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace sinew::sim {
namespace {

using Index3 = std::array<std::int32_t, 3>;

constexpr std::uint8_t fullCell = 15, smallestFill = 2; // in 1/15
constexpr double leastShare = 0.125;                    // of a cell's mass, given to its corners

/// One of each pair of opposite directions, the one that leads to the higher grid index: 3 edges, 6 face
/// diagonals, 4 body diagonals.
constexpr std::array<Index3, 13> directions{{{1, 0, 0},
                                             {0, 1, 0},
                                             {0, 0, 1},
                                             {1, 1, 0},
                                             {-1, 1, 0},
                                             {1, 0, 1},
                                             {-1, 0, 1},
                                             {0, 1, 1},
                                             {0, -1, 1},
                                             {1, 1, 1},
                                             {-1, 1, 1},
                                             {1, -1, 1},
                                             {-1, -1, 1}}};

/// 0 along an edge, 1 along a face diagonal, 2 along a body diagonal.
std::size_t kindOf(Index3 direction) {
    return static_cast<std::size_t>(std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]) -
                                    1);
}

/// Fill of every cell in 1/15.
std::vector<std::uint8_t> quantisedFill(const Lattice& lattice) {
    if (lattice.fill.empty())
        return std::vector<std::uint8_t>(std::size_t{lattice.cells[0]} * lattice.cells[1] * lattice.cells[2],
                                         fullCell);
    std::vector<std::uint8_t> result;
    for (const float fill : lattice.fill) {
        const auto steps = static_cast<std::uint8_t>(std::lround(fullCell * fill));
        result.push_back(fill > 0 ? std::max(steps, smallestFill) : std::uint8_t{0});
    }
    return result;
}

/// Read access to the cells of a lattice, with clamped fill, and empty outside the grid.
class Cells {
public:
    explicit Cells(const Lattice& lattice) : lattice_(lattice), fill_(quantisedFill(lattice)) {}

    std::array<std::uint32_t, 3> size() const { return lattice_.cells; }

    const std::vector<std::uint8_t>& all() const { return fill_; }
    int fill(Index3 cell) const {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (cell[axis] < 0 || cell[axis] >= static_cast<std::int64_t>(size()[axis])) return 0;
        return fill_[indexOf(cell)];
    }

    /// Mean over the eight cells around `corner` of the fill as given, with a floor of leastShare for filled
    /// cells: stiffness has such a floor too, and a lighter node would need shorter substeps.
    double massShare(Index3 corner) const {
        double sum = 0;
        for (int side = 0; side < 8; ++side) {
            const Index3 cell{corner[0] - (side & 1), corner[1] - (side >> 1 & 1), corner[2] - (side >> 2)};
            if (fill(cell) == 0) continue;
            const double given = lattice_.fill.empty() ? 1 : double{lattice_.fill[indexOf(cell)]};
            sum += std::max(given, leastShare);
        }
        return sum / 8;
    }

    /// Mean fill of the cells that contain the link from `corner` in `direction`.
    double meanFill(Index3 corner, Index3 direction) const {
        int sum = 0, count = 0;
        for (int side = 0; side < 8; ++side) {
            Index3 cell = corner;
            bool holdsLink = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const bool isBelow = (side >> axis & 1) != 0;
                holdsLink =
                    holdsLink && !(direction[axis] > 0 && isBelow) && !(direction[axis] < 0 && !isBelow);
                cell[axis] -= isBelow ? 1 : 0;
            }
            if (holdsLink) {
                sum += fill(cell);
                ++count;
            }
        }
        return static_cast<double>(sum) / (fullCell * count);
    }

private:
    std::size_t indexOf(Index3 cell) const {
        return cell[0] + size()[0] * (cell[1] + std::size_t{size()[1]} * cell[2]);
    }
    const Lattice& lattice_;
    std::vector<std::uint8_t> fill_;
};

std::size_t cellCount(const Lattice& lattice) {
    return std::size_t{lattice.cells[0]} * lattice.cells[1] * lattice.cells[2];
}

void check(const Lattice& lattice) {
    const std::string head = "lattice \"" + lattice.name + "\": ";
    if (!(lattice.spacing > 0) || !(lattice.youngModulus > 0) || !(lattice.density > 0))
        throw std::invalid_argument(head + "spacing, youngModulus and density must be positive");
    if (!(lattice.radius >= 0 && lattice.radius <= lattice.spacing / 2))
        throw std::invalid_argument(head + "radius must be from 0 to half of the spacing");
    if (!ranges::poissonRatio.holds(double{lattice.poissonRatio}))
        throw std::invalid_argument(head + "poissonRatio must be " + toText(ranges::poissonRatio));
    if (!ranges::recovery.holds(double{lattice.recovery}))
        throw std::invalid_argument(head + "recovery must be " + toText(ranges::recovery));
    double corners = 1;
    for (const std::uint32_t cells : lattice.cells) corners *= static_cast<double>(cells) + 1;
    if (corners > std::numeric_limits<std::int32_t>::max())
        throw std::length_error(head + "too many grid corners");
    if (!lattice.fill.empty() && lattice.fill.size() != cellCount(lattice))
        throw std::invalid_argument(head + "fill must hold one value for each cell");
    const bool isFilled = lattice.fill.empty()
                              ? cellCount(lattice) > 0
                              : std::ranges::any_of(lattice.fill, [](float fill) { return fill > 0; });
    if (!isFilled) throw std::invalid_argument(head + "no cell is filled");
    if (!std::ranges::all_of(lattice.fill, [](float fill) { return fill >= 0 && fill <= 1; }))
        throw std::invalid_argument(head + "fill must lie in [0, 1]");
}

/// Calls visit(corner) for every grid corner, in the order of LatticeCorners::particle.
template <typename Visit> void forEachCorner(std::array<std::uint32_t, 3> cells, const Visit& visit) {
    const Index3 last{static_cast<std::int32_t>(cells[0]), static_cast<std::int32_t>(cells[1]),
                      static_cast<std::int32_t>(cells[2])};
    for (std::int32_t k = 0; k <= last[2]; ++k)
        for (std::int32_t j = 0; j <= last[1]; ++j)
            for (std::int32_t i = 0; i <= last[0]; ++i) visit(Index3{i, j, k});
}

float along(float origin, float spacing, std::int32_t index) {
    return static_cast<float>(double{origin} + double{spacing} * index);
}

/// Volume of the body at rest [m^3].
double volumeOf(const Lattice& lattice) {
    if (lattice.restVolume > 0) return double{lattice.restVolume};
    double cells = lattice.fill.empty() ? static_cast<double>(cellCount(lattice)) : 0;
    for (const float fill : lattice.fill) cells += double{fill};
    return cells * std::pow(double{lattice.spacing}, 3);
}

/// Mass of every corner [kg], 0 if no cell around it is filled: a share of density times volume of the body.
/// The shares are normalised, because fills are samples and shares have a floor.
std::vector<double> cornerMasses(const Lattice& lattice, const Cells& cells) {
    std::vector<double> masses;
    double shares = 0;
    forEachCorner(lattice.cells, [&](Index3 corner) {
        masses.push_back(cells.massShare(corner));
        shares += masses.back();
    });
    const double unit = double{lattice.density} * (volumeOf(lattice) / shares);
    for (double& mass : masses) mass *= unit;
    return masses;
}

std::vector<std::uint32_t> addParticles(Scene& scene, const Lattice& lattice, const Cells& cells) {
    const std::vector<double> masses = cornerMasses(lattice, cells);
    std::vector<std::uint32_t> particle;
    forEachCorner(lattice.cells, [&](Index3 corner) {
        const double mass = masses[particle.size()];
        particle.push_back(mass > 0 ? static_cast<std::uint32_t>(scene.particles.size())
                                    : LatticeCorners::noParticle);
        if (mass > 0)
            scene.particles.push_back({.position = {along(lattice.origin.x, lattice.spacing, corner[0]),
                                                    along(lattice.origin.y, lattice.spacing, corner[1]),
                                                    along(lattice.origin.z, lattice.spacing, corner[2])},
                                       .velocity = {},
                                       .inverseMass = static_cast<float>(1 / mass),
                                       .contactOffset = 0,
                                       .radius = lattice.radius});
    });
    return particle;
}

/// Stiffness and length of links between full cells, by kind.
struct LinkKinds {
    std::uint32_t count = 0;
    std::array<double, 3> stiffness{}; ///< [N/m]
    std::array<float, 3> restLength{}; ///< [m]
};

/// mu = E / (2 (1 + nu)), C44 of the lattice [Pa]. Volumes of cells do not contribute to it.
double shearModulus(const Lattice& lattice) {
    return double{lattice.youngModulus} / (2 * (1 + double{lattice.poissonRatio}));
}

/// lambda = 2 mu nu / (1 - 2 nu), minus the share of the links, mu [Pa].
double volumeStiffness(const Lattice& lattice) {
    const double nu = double{lattice.poissonRatio};
    return shearModulus(lattice) * (2 * nu / (1 - 2 * nu) - 1);
}

LinkKinds linkKinds(const Lattice& lattice) {
    // Young's modulus of the body with Poisson ratio 1/4 and the same shear modulus; exactly E at 1/4.
    const double scale =
        double{lattice.youngModulus} * (1.25 / (1 + double{lattice.poissonRatio})) * lattice.spacing;
    LinkKinds kinds;
    kinds.count = lattice.hasBodyDiagonals ? 3 : 2;
    kinds.stiffness = lattice.hasBodyDiagonals
                          ? std::array{22.0 / 35 * scale, 6.0 / 35 * scale, 6.0 / 35 * scale}
                          : std::array{0.4 * scale, 0.4 * scale, 0.0};
    for (std::size_t kind = 0; kind < 3; ++kind)
        kinds.restLength[kind] =
            static_cast<float>(std::sqrt(static_cast<double>(kind + 1)) * lattice.spacing);
    return kinds;
}

double distanceBetween(const Scene& scene, std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = scene.particles[a].position, &q = scene.particles[b].position;
    return std::hypot(double{q.x} - p.x, double{q.y} - p.y, double{q.z} - p.z);
}

/// Rest lengths are the spacing and its diagonals, so that a whole body has two or three values and its links
/// pack well. If the body is so far from the origin that rounding to float32 would stress it (strain above
/// 1e-4), the distances of the stored positions are used. Returns whether all rest lengths are nominal.
bool addLinks(Scene& scene, const Lattice& lattice, const Cells& cells, const LatticeCorners& corners,
              const LinkKinds& kinds) {
    bool isRegular = true;
    forEachCorner(lattice.cells, [&](Index3 corner) {
        for (const Index3& direction : directions) {
            const std::size_t kind = kindOf(direction);
            const double share = kind < kinds.count ? cells.meanFill(corner, direction) : 0;
            if (share == 0) continue; // also if the link would leave the grid
            const std::uint32_t a = corners.at(corner[0], corner[1], corner[2]);
            const std::uint32_t b =
                corners.at(corner[0] + direction[0], corner[1] + direction[1], corner[2] + direction[2]);
            const double stored = distanceBetween(scene, a, b), nominal = double{kinds.restLength[kind]};
            const bool isNominal = std::abs(stored - nominal) < 1e-4 * nominal;
            isRegular = isRegular && isNominal;
            scene.distances.push_back({a, b, isNominal ? kinds.restLength[kind] : static_cast<float>(stored),
                                       static_cast<float>(1 / (kinds.stiffness[kind] * share))});
        }
    });
    return isRegular;
}

void addGrid(Scene& scene, const Lattice& lattice, const Cells& cells, const LatticeCorners& corners,
             const LinkKinds& kinds, std::size_t firstParticle, std::size_t firstDistance) {
    Grid grid{.name = lattice.name,
              .nodes = {lattice.cells[0] + 1, lattice.cells[1] + 1, lattice.cells[2] + 1},
              .firstParticle = static_cast<std::uint32_t>(firstParticle),
              .firstDistance = static_cast<std::uint32_t>(firstDistance),
              .distanceCount = static_cast<std::uint32_t>(scene.distances.size() - firstDistance),
              .fill = cells.all(),
              .kinds = kinds.count,
              .restLength = kinds.restLength,
              .volumeStiffness = static_cast<float>(volumeStiffness(lattice)),
              .recoveryPressure = static_cast<float>(double{lattice.recovery} * shearModulus(lattice)),
              .isCuttable = lattice.isCuttable,
              .tearStrain = lattice.tearStrain,
              .tearsPerStep = lattice.tearsPerStep,
              .toughness = lattice.toughness};
    for (std::size_t kind = 0; kind < kinds.count; ++kind)
        grid.compliance[kind] = static_cast<float>(1 / kinds.stiffness[kind]);
    for (std::uint32_t node = 0; node < corners.particle.size(); ++node)
        if (corners.particle[node] != LatticeCorners::noParticle) grid.node.push_back(node);
    scene.grids.push_back(std::move(grid));
}

/// Corners of the face of `cell` on the side `isHigh` of `axis`, counter-clockwise seen from outside.
std::array<Index3, 4> faceCorners(Index3 cell, std::size_t axis, bool isHigh) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    cell[axis] += isHigh ? 1 : 0;
    std::array<Index3, 4> corners{cell, cell, cell, cell};
    ++corners[1][u];
    ++corners[2][u], ++corners[2][v];
    ++corners[3][v];
    if (!isHigh) std::swap(corners[1], corners[3]);
    return corners;
}

} // namespace

LatticeCorners addLattice(Scene& scene, const Lattice& lattice) {
    check(lattice);
    const Cells cells(lattice);
    const auto first = static_cast<std::uint32_t>(scene.particles.size());
    const LatticeCorners corners{lattice.cells, addParticles(scene, lattice, cells)};
    const LinkKinds kinds = linkKinds(lattice);
    const std::size_t firstDistance = scene.distances.size();
    if (addLinks(scene, lattice, cells, corners, kinds))
        addGrid(scene, lattice, cells, corners, kinds, first, firstDistance);
    else if (lattice.poissonRatio > 0.25f || lattice.recovery > 0 || lattice.isCuttable)
        throw std::domain_error("lattice \"" + lattice.name +
                                "\" is so far from the origin that rounding distorts its cells");
    scene.bodies.push_back({lattice.name, first, static_cast<std::uint32_t>(scene.particles.size()) - first,
                            static_cast<float>(volumeOf(lattice))});
    return corners;
}

void addLatticeSkin(Scene& scene, const Lattice& lattice, const LatticeCorners& corners, Vec3 color) {
    const Cells cells(lattice);
    Skin skin{.name = lattice.name, .color = color};
    // One vertex per particle and face direction: neighbours in a plane share normals, edges stay sharp.
    std::array<std::unordered_map<std::uint32_t, std::uint32_t>, 6> vertices;
    forEachCorner(lattice.cells, [&](Index3 cell) {
        for (std::size_t side = 0; side < 6 && cells.fill(cell) > 0; ++side) {
            const std::size_t axis = side / 2;
            const bool isHigh = side % 2 == 1;
            Index3 neighbour = cell;
            neighbour[axis] += isHigh ? 1 : -1;
            if (cells.fill(neighbour) > 0) continue;
            std::array<std::uint32_t, 4> quad{};
            std::ranges::transform(faceCorners(cell, axis, isHigh), quad.begin(), [&](Index3 corner) {
                const std::uint32_t particle = corners.at(corner[0], corner[1], corner[2]);
                const auto next = static_cast<std::uint32_t>(skin.particles.size());
                const auto [entry, isNew] = vertices[side].try_emplace(particle, next);
                if (isNew) skin.particles.push_back(particle);
                return entry->second;
            });
            skin.triangles.push_back({quad[0], quad[1], quad[2]});
            skin.triangles.push_back({quad[0], quad[2], quad[3]});
        }
    });
    scene.skins.push_back(std::move(skin));
}

} // namespace sinew::sim
