// Legends as plain data: what the panel shows below the buttons of layers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::viewer {

/// A line of a legend.
struct LegendLine {
    /// text: `name` alone. row: `name` on the left, `value` on the right. bar: all colors of a map. swatch: a
    /// square of the first color, then a row. squares: one for each color, with a tooltip.
    enum class Kind { text, row, bar, swatch, squares } kind = Kind::text;
    std::string name, value;
    std::vector<std::array<float, 3>> colors; ///< linear RGB
    std::vector<std::string> tips;            ///< of squares
    bool operator==(const LegendLine&) const = default;
};

/// A number with separators: "12,345".
std::string grouped(std::uint64_t number);

/// sim::counted() with separators: "1 link", "4,211 links".
std::string countText(std::uint64_t number, std::string_view one, std::string_view many = {});

} // namespace sinew::viewer
