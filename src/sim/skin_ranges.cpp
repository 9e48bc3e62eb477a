// Ranges of skins as running sums of index counts.
#include "sim/skin_ranges.hpp"

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

std::vector<SkinRange> rangesOf(const std::vector<Skin>& skins,
                                const std::vector<StepProgram::IndexRange>& ranges) {
    std::vector<SkinRange> named;
    for (std::size_t s = 0; s < ranges.size(); ++s)
        named.push_back({skins[s].name, skins[s].color, ranges[s].first, ranges[s].count});
    return named;
}

} // namespace sinew::sim
