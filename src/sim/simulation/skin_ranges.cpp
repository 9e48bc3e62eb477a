// Ranges of skins as running sums of index counts.
#include "sim/simulation/skin_ranges.hpp"

namespace sinew::sim {

std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins, Triangles which) {
    std::vector<SkinRange> ranges;
    std::uint32_t first = 0;
    for (const Skin& skin : skins) {
        const bool isWhole = which == Triangles::whole && !skin.wholeTriangles.empty();
        const auto count =
            static_cast<std::uint32_t>(3 * (isWhole ? skin.wholeTriangles : skin.triangles).size());
        ranges.push_back({skin.name, skin.color, first, count});
        first += count;
    }
    return ranges;
}

} // namespace sinew::sim
