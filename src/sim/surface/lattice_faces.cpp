// A face of a tetrahedron on the side of a cell has three corners in ascending order: the cell's lowest, a
// middle one, and the highest.
#include "sim/surface/lattice_faces.hpp"

#include <algorithm>
#include <bit>
#include <set>

namespace sinew::sim::surface {

namespace {

using Node = std::array<std::uint32_t, 3>;

// The numbers of kuhn.glsl.
constexpr std::array<std::uint32_t, 6> secondCorner{1, 1, 2, 2, 4, 4}, thirdCorner{3, 5, 3, 6, 5, 6};

std::uint32_t tetrahedron(std::uint32_t second, std::uint32_t third) {
    std::uint32_t p = 0;
    while (secondCorner[p] != second || thirdCorner[p] != third) ++p;
    return p;
}

Node moved(Node node, std::uint32_t corner) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) node[axis] += corner >> axis & 1;
    return node;
}

class Faces {
public:
    Faces(const Grid& grid, const lattice::Box& box) : grid_(grid), box_(box) {}

    // The face of the triangle between three nodes; none if that is no outer face.
    std::optional<layout::SkinFace> face(std::array<Node, 3> nodes, std::uint32_t triangle) const {
        std::ranges::sort(nodes, {}, [](const Node& n) { return n[0] + n[1] + n[2]; });
        const auto middle = step(nodes[0], nodes[1]), high = step(nodes[0], nodes[2]);
        if (!middle || !high || std::popcount(*middle) != 1 || std::popcount(*high) != 2 ||
            (*middle & *high) == 0)
            return std::nullopt;
        const std::uint32_t across = 7 ^ *high;
        Node below = nodes[0];
        const auto axis = static_cast<std::size_t>(std::countr_zero(across));
        const bool hasBelow = below[axis]-- > 0 && isFilled(below), hasAbove = isFilled(nodes[0]);
        if (hasBelow == hasAbove) return std::nullopt;
        if (hasAbove) // the low face of the cell
            return layout::SkinFace{16 * slot(nodes[0]) + 2 * tetrahedron(*middle, *high) + 1, triangle,
                                    NO_WHOLE, 0};
        return layout::SkinFace{16 * slot(below) + 2 * tetrahedron(across, across | *middle), triangle,
                                NO_WHOLE, 0};
    }

    std::size_t outerFaces() const {
        std::size_t count = 0;
        const auto [nx, ny, nz] = grid_.nodes;
        for (std::uint32_t z = 0; z + 1 < nz; ++z)
            for (std::uint32_t y = 0; y + 1 < ny; ++y)
                for (std::uint32_t x = 0; x + 1 < nx; ++x)
                    if (isFilled({x, y, z})) count += outerFacesOf({x, y, z});
        return count;
    }

private:
    static std::optional<std::uint32_t> step(const Node& from, const Node& to) {
        std::uint32_t corner = 0;
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t way = to[axis] - from[axis];
            if (way > 1) return std::nullopt;
            corner |= way << axis;
        }
        return corner;
    }

    // Whether the cell above a node is filled.
    bool isFilled(const Node& node) const { return lattice::fillAround(grid_, node) >> 28 != 0; }

    std::size_t outerFacesOf(const Node& cell) const {
        std::size_t count = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Node below = cell;
            count += below[axis]-- == 0 || !isFilled(below) ? 1 : 0;
            count += isFilled(moved(cell, 1u << axis)) ? 0 : 1;
        }
        return count;
    }

    std::uint32_t slot(const Node& node) const { return box_.slot(node[0], node[1], node[2]); }

    const Grid& grid_;
    const lattice::Box& box_;
};

} // namespace

std::optional<std::vector<layout::SkinFace>>
latticeFaces(const Skin& skin, const Grid& grid, const lattice::Box& box, std::uint32_t firstTriangle) {
    if (skin.particles.empty() || lattice::isSheet(grid)) return std::nullopt;
    const Faces all(grid, box);
    std::vector<layout::SkinFace> faces;
    std::set<std::uint32_t> seen;
    for (const auto& triangle : skin.triangles) {
        std::array<Node, 3> nodes;
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t index = skin.particles[triangle[n]] - grid.firstParticle;
            if (index >= grid.node.size()) return std::nullopt;
            nodes[n] = lattice::coordinates(grid, grid.node[index]);
        }
        const auto face = all.face(nodes, firstTriangle + static_cast<std::uint32_t>(faces.size()));
        if (!face || !seen.insert(face->item).second) return std::nullopt;
        faces.push_back(*face);
    }
    if (faces.size() != 2 * all.outerFaces()) return std::nullopt;
    return faces;
}

} // namespace sinew::sim::surface
