// Kuhn's tetrahedra of a cell for the host, with the numbers of shaders/glsl/lattice/kuhn.glsl and
// cut_points.glsl.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace sinew::sim::surface::kuhn {

inline constexpr std::uint32_t tetrahedra = 6;
inline constexpr std::array<std::uint32_t, 6> secondCorner{1, 1, 2, 2, 4, 4}, thirdCorner{3, 5, 3, 6, 5, 6};
inline constexpr std::array<std::uint32_t, 6> beyondSecond{2, 4, 0, 5, 1, 3}, beyondThird{1, 0, 3, 2, 5, 4},
    beyondLast{4, 2, 5, 0, 3, 1}, lastAxis{2, 1, 2, 0, 1, 0};
inline constexpr std::array<bool, 6> isEven{true, false, false, true, true, false};
/// Faces opposite to corners 1 and 2, by number.
inline constexpr std::array<std::uint32_t, 6> secondPair{6, 7, 6, 8, 7, 8}, thirdPair{9, 9, 10, 10, 11, 11};

/// The tetrahedron with these second and third corners.
constexpr std::uint32_t tetrahedron(std::uint32_t second, std::uint32_t third) {
    std::uint32_t p = 0;
    while (secondCorner[p] != second || thirdCorner[p] != third) ++p;
    return p;
}

/// The number, among the faces that a node's slot owns, of the face between the node and two higher nodes in
/// ascending order, given as corners of the node's cell.
constexpr std::uint32_t faceOf(std::uint32_t middle, std::uint32_t high) {
    if (std::popcount(high) == 2) return tetrahedron(middle, high);
    std::uint32_t p = 0;
    const auto& corners = std::popcount(middle) == 2 ? thirdCorner : secondCorner;
    while (corners[p] != middle) ++p;
    return std::popcount(middle) == 2 ? secondPair[p] : thirdPair[p];
}

} // namespace sinew::sim::surface::kuhn
