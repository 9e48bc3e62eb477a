// How many pieces cuts have left, as reports and the viewer show them.
#pragma once

#include <cstddef>
#include <string>

namespace sinew::app {

/// Pieces of bodies that may be cut.
struct PieceCount {
    std::size_t pieces = 0;    ///< with a surface
    std::size_t fragments = 0; ///< without one: particles outside the body's skin
    bool isCounted = true;     ///< false: there was no memory to count, and the numbers say nothing
    bool operator==(const PieceCount&) const = default;
};
/// "2 pieces and 6 fragments without a surface"; "pieces were not counted".
std::string toText(const PieceCount& count);

} // namespace sinew::app
