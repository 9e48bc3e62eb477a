// Consistent orientation of a mesh, so that winding numbers and normals are valid. Files often contain parts
// that were mirrored or modelled inside out.
#include "mesh/topology.hpp"
#include "mesh/triangle_mesh.hpp"
#include "mesh/vector3.hpp"

namespace sinew::mesh {
namespace {

/// The triangle across a manifold edge, and whether its orientation is opposite.
struct Neighbour {
    std::uint32_t triangle = 0;
    bool isFlipped = false;
};

/// At most one neighbour per side; none across boundary and non-manifold edges.
struct Neighbours {
    std::array<Neighbour, 3> list{};
    std::uint8_t count = 0;
    void add(Neighbour neighbour) { list[count++] = neighbour; }
};

bool areFlipped(std::span<const HalfEdge> sides) {
    return sides.size() == 2 && sides[0].isForward == sides[1].isForward;
}

/// Neighbours of all triangles; empty if no two neighbours have opposite orientations.
std::vector<Neighbours> findNeighbours(const TriangleMesh& mesh) {
    const std::vector<HalfEdge> all = sortedSides(mesh.triangles);
    bool isAnyFlipped = false;
    forEachEdge(all,
                [&](std::span<const HalfEdge> sides) { isAnyFlipped = isAnyFlipped || areFlipped(sides); });
    if (!isAnyFlipped) return {};
    std::vector<Neighbours> neighbours(mesh.triangles.size());
    forEachEdge(all, [&](std::span<const HalfEdge> sides) {
        if (sides.size() != 2) return;
        const bool isFlipped = areFlipped(sides);
        neighbours[sides[0].triangle].add({sides[1].triangle, isFlipped});
        neighbours[sides[1].triangle].add({sides[0].triangle, isFlipped});
    });
    return neighbours;
}

double areaOf(const TriangleMesh& mesh, std::uint32_t triangle) {
    const auto [a, b, c] = mesh.triangles[triangle];
    const Vector3 origin = toVector(mesh.positions[a]);
    return (toVector(mesh.positions[b]) - origin).cross(toVector(mesh.positions[c]) - origin).norm() / 2;
}

enum class Turn : std::uint8_t { unknown, keep, flip };

Turn opposite(Turn turn) {
    return turn == Turn::keep ? Turn::flip : Turn::keep;
}

/// Decides the orientation of the connected part around `seed`. If no consistent one exists (a Moebius strip)
/// the first decision stays.
void orientPart(const TriangleMesh& mesh, const std::vector<Neighbours>& neighbours, std::uint32_t seed,
                std::vector<Turn>& turns) {
    std::vector<std::uint32_t> part{seed};
    turns[seed] = Turn::keep;
    double keptArea = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const std::uint32_t triangle = part[i];
        keptArea += turns[triangle] == Turn::keep ? areaOf(mesh, triangle) : -areaOf(mesh, triangle);
        for (std::size_t side = 0; side < neighbours[triangle].count; ++side) {
            const Neighbour& neighbour = neighbours[triangle].list[side];
            if (turns[neighbour.triangle] != Turn::unknown) continue;
            turns[neighbour.triangle] = neighbour.isFlipped ? opposite(turns[triangle]) : turns[triangle];
            part.push_back(neighbour.triangle);
        }
    }
    if (keptArea < 0)
        for (const std::uint32_t triangle : part) turns[triangle] = opposite(turns[triangle]);
}

} // namespace

std::size_t orientNeighbours(TriangleMesh& mesh) {
    const std::vector<Neighbours> neighbours = findNeighbours(mesh);
    if (neighbours.empty()) return 0;
    std::vector<Turn> turns(mesh.triangles.size(), Turn::unknown);
    for (std::uint32_t triangle = 0; triangle < turns.size(); ++triangle)
        if (turns[triangle] == Turn::unknown) orientPart(mesh, neighbours, triangle, turns);
    for (std::size_t i = 0; i < turns.size(); ++i)
        if (turns[i] == Turn::flip) flip(mesh, i);
    return static_cast<std::size_t>(std::ranges::count(turns, Turn::flip));
}

TriangleMesh orient(TriangleMesh mesh) {
    orientNeighbours(mesh);
    if (measure(mesh).volume < 0)
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) flip(mesh, i);
    return mesh;
}

} // namespace sinew::mesh
