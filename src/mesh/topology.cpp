// Sorts the sides of triangles by their lower vertex: a counting sort, then a small sort for each vertex.
#include "mesh/topology.hpp"

namespace sinew::mesh {
namespace {

/// Index of each vertex's first side among all sides, and one more entry for the end.
std::vector<std::uint32_t> firstSides(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::uint32_t last = 0;
    for (const auto& triangle : triangles) last = std::max(last, *std::ranges::max_element(triangle));
    std::vector<std::uint32_t> firsts(std::size_t{last} + 2);
    for (const auto& [a, b, c] : triangles)
        for (const std::uint32_t low : {std::min(a, b), std::min(b, c), std::min(c, a)}) ++firsts[low + 1];
    for (std::size_t i = 1; i < firsts.size(); ++i) firsts[i] += firsts[i - 1];
    return firsts;
}

} // namespace

std::vector<HalfEdge> sortedSides(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<std::uint32_t> ends = firstSides(triangles); // start as the first sides, grow to the ends
    std::vector<HalfEdge> sides(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = triangles[i][corner], to = triangles[i][(corner + 1) % 3];
            const std::uint32_t low = std::min(from, to);
            sides[ends[low]++] = {low, std::max(from, to), i, from < to};
        }
    std::uint32_t first = 0;
    for (const std::uint32_t end : ends) {
        const auto begin = sides.begin();
        std::sort(begin + first, begin + end, [](const HalfEdge& one, const HalfEdge& other) {
            return one.high != other.high ? one.high < other.high : one.triangle < other.triangle;
        });
        first = end;
    }
    return sides;
}

} // namespace sinew::mesh
