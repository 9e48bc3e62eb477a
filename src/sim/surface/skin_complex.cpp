// The anchors of the skin's triangles form a closed surface of faces of tetrahedra. The winding number of a
// tetrahedron follows from that of the previous one and the triangles on the face between them.
#include "sim/surface/skin_complex.hpp"

#include "sim/lattice/link_masks.hpp"
#include "sim/surface/kuhn.hpp"
#include "sim/surface/rest_normals.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sinew::sim::surface {

namespace {

using Node = std::array<std::uint32_t, 3>;

// The corner of a cell that leads from a node to one that is at least as high along all axes; none for
// another node.
std::optional<std::uint32_t> step(const Node& from, const Node& to) {
    std::uint32_t corner = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t way = to[axis] - from[axis];
        if (way > 1) return std::nullopt;
        corner |= way << axis;
    }
    return corner;
}

class Hanger {
public:
    Hanger(const Scene& scene, const Grid& grid, const lattice::Box& box, const SkinPlace& place)
        : scene_(scene), grid_(grid), box_(box), place_(place), skin_(scene.skins[place.index]) {}

    std::optional<SkinComplex> run(std::uint32_t firstPrism, std::uint32_t firstHung) {
        if (skin_.anchors.empty() || !findNodes()) return std::nullopt;
        complex_.skin = place_.index;
        complex_.firstHung = firstHung;
        complex_.words.resize(box_.end - box_.origin);
        counts_.resize(std::size_t{12} * grid_.nodes[0] * grid_.nodes[1] * grid_.nodes[2]);
        if (!addVertices()) return std::nullopt;
        for (const auto& triangle : skin_.triangles)
            if (!addPrism(triangle, firstHung)) return std::nullopt;
        if (!linkPrisms(firstPrism) || !addTetrahedra()) return std::nullopt;
        return std::move(complex_);
    }

private:
    std::optional<Node> nodeOf(std::uint32_t particle) const {
        const std::uint32_t index = particle - grid_.firstParticle;
        if (particle < grid_.firstParticle || index >= grid_.node.size()) return std::nullopt;
        return lattice::coordinates(grid_, grid_.node[index]);
    }

    bool findNodes() {
        for (const std::uint32_t anchor : skin_.anchors) {
            const auto node = nodeOf(anchor);
            if (!node) return false;
            nodes_.push_back(*node);
        }
        return true;
    }

    std::uint32_t slot(const Node& node) const { return box_.slot(node[0], node[1], node[2]); }
    std::uint32_t& wordOf(const Node& node) { return complex_.words[slot(node) - box_.origin]; }
    std::int16_t& countOf(const Node& node, std::uint32_t q) {
        return counts_[12 * (node[0] + grid_.nodes[0] * (node[1] + std::size_t{grid_.nodes[1]} * node[2])) +
                       q];
    }

    bool addVertices() {
        for (std::uint32_t v = 0; v < skin_.cells.size(); ++v) {
            const CellEmbedding& embedding = skin_.cells[v];
            const auto cell = nodeOf(embedding.particles[0]);
            const auto corner = cell ? step(*cell, nodes_[v]) : std::nullopt;
            if (!corner) return false;
            layout::HungVertex& vertex = complex_.vertices.emplace_back();
            const Vec3& w = embedding.weights;
            for (std::uint32_t k = 0; k < 8; ++k) {
                const float share = ((k & 1) != 0 ? w.x : 1 - w.x) * ((k & 2) != 0 ? w.y : 1 - w.y) *
                                    ((k & 4) != 0 ? w.z : 1 - w.z);
                const Vec3& x = scene_.particles[embedding.particles[k]].position;
                vertex.rest.x += share * x.x;
                vertex.rest.y += share * x.y;
                vertex.rest.z += share * x.z;
            }
            vertex.rest.w = static_cast<float>(place_.index);
            vertex.weights = {w.x, w.y, w.z, 0};
            vertex.vertex = place_.firstVertex + v;
            vertex.cell = slot(*cell);
            vertex.anchor = slot(nodes_[v]);
            vertex.corner = *corner;
        }
        addNormals();
        return true;
    }

    void addNormals() {
        std::vector<Point> rest;
        for (const layout::HungVertex& vertex : complex_.vertices) rest.push_back(pointOf(vertex.rest));
        complex_.parts = partVertices(skin_, rest);
        const std::vector<Point> flat = restNormals(skin_.triangles, rest),
                                 lit = litNormals(skin_, complex_.parts, rest);
        for (std::size_t v = 0; v < rest.size(); ++v) {
            const Vec3 across = toVec3(flat[v]), normal = toVec3(lit[v]);
            complex_.planes.push_back({across.x, across.y, across.z, 0});
            complex_.vertices[v].normal = {normal.x, normal.y, normal.z, grid_.restLength[0]};
        }
    }

    bool addPrism(const std::array<std::uint32_t, 3>& corners, std::uint32_t firstHung) {
        layout::SkinPrism prism{.face = NO_PARTICLE};
        std::array<std::optional<std::uint32_t>, 3> up, down; // steps to the next corner, and back
        std::uint32_t thin = 0;                               // edges whose ends have one particle
        for (std::size_t n = 0; n < 3; ++n) {
            const Node &from = nodes_[corners[n]], &to = nodes_[corners[(n + 1) % 3]];
            up[n] = step(from, to);
            down[n] = step(to, from);
            if (!up[n] && !down[n]) return false;
            prism.vertices[n] = firstHung + corners[n];
            prism.anchors[n] = slot(from);
            const std::uint32_t way = up[n] ? *up[n] : 8 | *down[n];
            prism.links |= way << 4 * n;
            thin += way == 0 ? 1 : 0;
        }
        complex_.prisms.push_back(prism);
        if (thin == 3) return true;
        return thin == 1 ? addThin(corners) : thin == 0 && addFace(corners);
    }

    // Marks an edge that a prism stands on.
    bool addThin(const std::array<std::uint32_t, 3>& corners) {
        for (std::size_t n = 0; n < 3; ++n) {
            const Node &from = nodes_[corners[n]], &to = nodes_[corners[(n + 1) % 3]];
            if (from == to) continue;
            const auto up = step(from, to);
            const std::uint32_t way = up ? *up : *step(to, from);
            wordOf(up ? from : to) |= 1u << (COMPLEX_EDGES + way - 1) | COMPLEX_HAS_PRISMS;
        }
        return true;
    }

    bool addFace(const std::array<std::uint32_t, 3>& corners) {
        std::array<std::uint32_t, 3> order{0, 1, 2}; // by height
        const auto node = [&](std::size_t n) { return nodes_[corners[order[n]]]; };
        std::ranges::sort(order, {}, [&](std::uint32_t n) {
            const Node& at = nodes_[corners[n]];
            return at[0] + at[1] + at[2];
        });
        const auto middle = step(node(0), node(1)), high = step(node(0), node(2));
        if (!middle || !high || !step(node(1), node(2))) return false;
        const std::uint32_t q = kuhn::faceOf(*middle, *high);
        const bool isTurned = order[1] != (order[0] + 1) % 3;
        countOf(node(0), q) = static_cast<std::int16_t>(countOf(node(0), q) + (isTurned ? -1 : 1));
        wordOf(node(0)) |= 1u << (COMPLEX_FACES + q) | COMPLEX_HAS_PRISMS;
        wordOf(node(1)) |= COMPLEX_HAS_PRISMS; // owns the edge to the highest
        layout::SkinPrism& prism = complex_.prisms.back();
        prism.face = slot(node(0));
        prism.places = q;
        for (std::uint32_t place = 0; place < 3; ++place) prism.places |= place << (4 + 2 * order[place]);
        return true;
    }

    // Links prisms at the edges of triangles. Every edge has two sides; if more meet, any two with opposite
    // directions are paired.
    bool linkPrisms(std::uint32_t firstPrism) {
        struct Side {
            std::uint32_t low, high, prism, edge;
            bool isForward;
        };
        std::vector<Side> sides;
        for (std::uint32_t t = 0; t < skin_.triangles.size(); ++t)
            for (std::uint32_t n = 0; n < 3; ++n) {
                const std::uint32_t a = skin_.triangles[t][n], b = skin_.triangles[t][(n + 1) % 3];
                if (a == b) return false;
                sides.push_back({std::min(a, b), std::max(a, b), t, n, a < b});
            }
        std::ranges::sort(sides, {}, [](const Side& side) {
            return std::tuple{side.low, side.high, side.isForward, side.prism};
        });
        const auto link = [&](const Side& side, const Side& other) {
            complex_.prisms[side.prism].beyond[side.edge] = 4 * (firstPrism + other.prism) + other.edge;
        };
        for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
            while (end < sides.size() && sides[end].low == sides[first].low &&
                   sides[end].high == sides[first].high)
                ++end;
            const std::size_t half = (end - first) / 2;
            if ((end - first) % 2 != 0 || sides[first + half - 1].isForward || !sides[first + half].isForward)
                return false;
            for (std::size_t s = first; s < first + half; ++s) {
                link(sides[s], sides[s + half]);
                link(sides[s + half], sides[s]);
            }
        }
        return true;
    }

    bool addTetrahedra() {
        const auto [nx, ny, nz] = grid_.nodes;
        windings_.resize(std::size_t{6} * nx * ny * nz);
        for (std::uint32_t z = 0; z < nz; ++z)
            for (std::uint32_t y = 0; y < ny; ++y)
                for (std::uint32_t x = 0; x < nx; ++x)
                    if (!addCell({x, y, z})) return false;
        return true;
    }

    std::int16_t& windingOf(const Node& cell, std::uint32_t p) {
        return windings_[6 * (cell[0] + grid_.nodes[0] * (cell[1] + std::size_t{grid_.nodes[1]} * cell[2])) +
                         p];
    }

    // Computes the winding numbers of the cell above a node. There is no cell beyond the last nodes, where
    // nothing may be inside.
    bool addCell(const Node& cell) {
        for (std::uint32_t p = 0; p < kuhn::tetrahedra; ++p) {
            const std::uint32_t axis = kuhn::lastAxis[p];
            Node before = cell;
            const int from = before[axis]-- > 0 ? windingOf(before, kuhn::beyondLast[p]) : 0;
            windingOf(cell, p) =
                static_cast<std::int16_t>(from + (kuhn::isEven[p] ? -1 : 1) * countOf(cell, p));
        }
        const bool isCell = lattice::fillAround(grid_, cell) >> 28 != 0;
        std::uint32_t& word = wordOf(cell);
        if (isCell) word |= COMPLEX_IS_CELL;
        for (std::uint32_t p = 0; p < kuhn::tetrahedra; ++p) {
            const int winding = windingOf(cell, p);
            if (winding < 0 || winding > (isCell ? 1 : 0)) return false;
            word |= static_cast<std::uint32_t>(winding) << p;
            // seen from p the corners of the face opposite to 1 are right-handed where those of p are not
            const int second = (kuhn::isEven[p] ? -1 : 1) * countOf(cell, kuhn::secondPair[p]),
                      third = (kuhn::isEven[p] ? 1 : -1) * countOf(cell, kuhn::thirdPair[p]);
            if (winding - windingOf(cell, kuhn::beyondSecond[p]) != second ||
                winding - windingOf(cell, kuhn::beyondThird[p]) != third)
                return false;
        }
        return true;
    }

    const Scene& scene_;
    const Grid& grid_;
    const lattice::Box& box_;
    const SkinPlace place_;
    const Skin& skin_;
    std::vector<Node> nodes_; // of anchors
    std::vector<std::int16_t> counts_, windings_;
    SkinComplex complex_;
};

} // namespace

std::optional<SkinComplex> hangSkin(const Scene& scene, const Grid& grid, const lattice::Box& box,
                                    const SkinPlace& skin, std::uint32_t firstPrism,
                                    std::uint32_t firstHung) {
    if (lattice::isSheet(grid)) return std::nullopt;
    return Hanger(scene, grid, box, skin).run(firstPrism, firstHung);
}

} // namespace sinew::sim::surface
