// The table of tools.
#include "viewer/input/tool.hpp"

#include <algorithm>
#include <array>

namespace sinew::viewer {

namespace tool {
extern const Tool blade, poke, hand, pins;
} // namespace tool

// In the order of keys and buttons.
std::span<const Tool* const> toolTable() {
    static constexpr std::array all{&tool::blade, &tool::poke, &tool::hand, &tool::pins};
    static_assert(all.size() <= mostTools);
    return all;
}

std::size_t indexOf(const Tool& tool) {
    return static_cast<std::size_t>(std::ranges::find(toolTable(), &tool) - toolTable().begin());
}

} // namespace sinew::viewer
