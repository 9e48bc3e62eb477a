// Reduces inversions around pulled particles. Pulling to the nearest point of a skin inverts tetrahedra and
// prisms beside notches and around thin parts, and a cut through these is covered several times. Each such
// particle is tried below the parts of the skin that follow it, and is placed where the inverted volume is
// smallest.
#include "sim/surface/unfold_anchors.hpp"

#include "sim/surface/kuhn.hpp"
#include "sim/surface/point.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace sinew::sim::surface {

namespace {

// Six times the signed volume of a tetrahedron.
double volumeOf(const Point& origin, const Point& p, const Point& q, const Point& r) {
    const Point a = p - origin, b = q - origin, c = r - origin;
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

constexpr int rounds = 4;
constexpr std::size_t mostTried = 24; // vertices of the skin, of those that follow a particle
constexpr std::array<double, 3> depths{0.04, 0.12, 0.24}; // [cells]
constexpr double farthest = 0.5;                          // distance from its pulled position [cells]
constexpr double little = 0.06; // tolerated inverted volume of a particle, times 6 [cells^3]
constexpr double gain = 0.98;   // largest remaining share of the inverted volume after a move

class Unfolder {
public:
    Unfolder(const Scene& scene, const Grid& grid, const lattice::Box& box, const SkinComplex& complex,
             Pulled& pulled)
        : box_(box), complex_(complex), pulled_(pulled), places_(box.end - box.origin),
          of_(box.end - box.origin, none), spacing_(double{grid.restLength[0]}) {
        for (std::uint32_t i = 0; i < grid.node.size(); ++i) {
            const auto node = lattice::coordinates(grid, grid.node[i]);
            placeOf(box.slot(node[0], node[1], node[2])) =
                pointOf(scene.particles[grid.firstParticle + i].position);
        }
        for (std::uint32_t p = 0; p < pulled.size(); ++p) {
            placeOf(pulled[p].first) = pointOf(pulled[p].second);
            of_[pulled[p].first - box.origin] = p;
        }
        parts_.resize(pulled.size());
        vertices_.resize(pulled.size());
        addTetrahedra(grid);
        addPrisms();
    }

    void run() {
        for (int round = 0; round < rounds; ++round) {
            bool isMoved = false;
            for (std::uint32_t p = 0; p < pulled_.size(); ++p) isMoved = improve(p) || isMoved;
            if (!isMoved) break;
        }
        for (auto& [slot, x] : pulled_) x = toVec3(placeOf(slot));
    }

private:
    static constexpr std::uint32_t none = ~0u;
    // Corners: slots, or `ofSkin` and a vertex of the complex; right-handed if not inverted.
    using Tetrahedron = std::array<std::uint32_t, 4>;
    static constexpr std::uint32_t ofSkin = 1u << 31;

    Point& placeOf(std::uint32_t slot) { return places_[slot - box_.origin]; }
    const layout::HungVertex& vertexOf(std::uint32_t vertex) const {
        return complex_.vertices[vertex - complex_.firstHung];
    }
    Point at(std::uint32_t corner) const {
        return (corner & ofSkin) != 0 ? pointOf(vertexOf(corner ^ ofSkin).rest)
                                      : places_[corner - box_.origin];
    }

    void add(const Tetrahedron& tetrahedron) {
        const auto index = static_cast<std::uint32_t>(tetrahedra_.size());
        bool isUsed = false;
        for (const std::uint32_t corner : tetrahedron) {
            if ((corner & ofSkin) != 0 || of_[corner - box_.origin] == none) continue;
            std::vector<std::uint32_t>& parts = parts_[of_[corner - box_.origin]];
            if (parts.empty() || parts.back() != index) parts.push_back(index);
            isUsed = true;
        }
        if (isUsed) tetrahedra_.push_back(tetrahedron);
    }

    void addTetrahedra(const Grid& grid) {
        for (const std::uint32_t index : grid.node) {
            const auto node = lattice::coordinates(grid, index);
            const std::uint32_t slot = box_.slot(node[0], node[1], node[2]),
                                word = complex_.words[slot - box_.origin];
            const auto corner = [&](std::uint32_t k) {
                return slot + (k & 1) + (k >> 1 & 1) * box_.rowStride + (k >> 2) * box_.sliceStride;
            };
            for (std::uint32_t p = 0; p < kuhn::tetrahedra; ++p) {
                if ((word >> p & 1) == 0) continue;
                const std::uint32_t second = corner(kuhn::secondCorner[p]),
                                    third = corner(kuhn::thirdCorner[p]);
                const bool isEven = kuhn::isEven[p];
                add({slot, isEven ? second : third, isEven ? third : second, corner(7)});
            }
        }
    }

    void addPrisms() {
        for (const layout::SkinPrism& prism : complex_.prisms) {
            const auto& w = prism.anchors;
            std::array<std::uint32_t, 3> v{};
            for (std::size_t n = 0; n < 3; ++n) {
                v[n] = ofSkin | prism.vertices[n];
                if (const std::uint32_t p = of_[w[n] - box_.origin]; p != none)
                    vertices_[p].push_back(prism.vertices[n]);
            }
            add({w[0], v[0], v[1], v[2]}); // the two others are flat if particles are equal
            if (w[0] != w[1]) add({w[0], v[1], w[1], v[2]});
            if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) add({w[0], w[1], w[2], v[2]});
        }
        for (std::vector<std::uint32_t>& vertices : vertices_) {
            std::ranges::sort(vertices);
            vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        }
    }

    // Six times the inverted volume of all tetrahedra with the particle as a corner, and the part of prisms
    // that sticks out of the skin.
    struct Turned {
        double all = 0, ofPrisms = 0;
    };
    Turned turned(std::uint32_t p) const {
        Turned sum;
        for (const std::uint32_t part : parts_[p]) {
            const Tetrahedron& t = tetrahedra_[part];
            const double volume = std::max(0.0, -volumeOf(at(t[0]), at(t[1]), at(t[2]), at(t[3])));
            sum.all += volume;
            if ((t[3] & ofSkin) != 0) sum.ofPrisms += volume; // with a corner on the skin
        }
        return sum;
    }

    bool isFar(const Point& place, std::uint32_t p) const {
        const Point way = place - pointOf(pulled_[p].second);
        return way.x * way.x + way.y * way.y + way.z * way.z > farthest * farthest * spacing_ * spacing_;
    }

    bool improve(std::uint32_t p) {
        Point& place = placeOf(pulled_[p].first);
        const double cell = spacing_ * spacing_ * spacing_;
        const Turned first = turned(p);
        if (first.all < little * cell) return false;
        double least = gain * first.all;
        const double before = least;
        Point best = place;
        const std::size_t stride = vertices_[p].size() / mostTried + 1;
        for (std::size_t v = 0; v < vertices_[p].size(); v += stride) {
            const layout::HungVertex& vertex = vertexOf(vertices_[p][v]);
            const Point x = pointOf(vertex.rest), n = pointOf(vertex.normal);
            for (const double depth : depths) {
                const double down = depth * spacing_;
                place = {x.x - down * n.x, x.y - down * n.y, x.z - down * n.z};
                if (isFar(place, p)) continue;
                const Turned now = turned(p);
                if (now.all >= least || now.ofPrisms > first.ofPrisms) continue;
                least = now.all;
                best = place;
            }
        }
        place = best;
        return least < before;
    }

    const lattice::Box& box_;
    const SkinComplex& complex_;
    Pulled& pulled_;
    std::vector<Point> places_;     // by slot
    std::vector<std::uint32_t> of_; // by slot: index into pulled_
    const double spacing_;
    std::vector<Tetrahedron> tetrahedra_;
    std::vector<std::vector<std::uint32_t>> parts_, vertices_; // by pulled particle; of the skin
};

} // namespace

void unfoldAnchors(const Scene& scene, const Grid& grid, const lattice::Box& box, const SkinComplex& complex,
                   Pulled& pulled) {
    if (!pulled.empty()) Unfolder(scene, grid, box, complex, pulled).run();
}

} // namespace sinew::sim::surface
