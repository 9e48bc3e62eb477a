// Computes boxes of triangles, joins near ones, and splits overlapping ones.
#include "viewer/ui/panel_cover.hpp"

#include "viewer/render/geometry.hpp"

#include <imgui.h>

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

// From the upper left corner [pixels]; empty unless `low` is below `high`.
struct Part {
    Vector2 low = Vector2::Constant(1e9f), high = Vector2::Constant(-1e9f);

    void take(const Part& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    bool isBeside(const Part& other, float apart) const {
        return (low.array() > other.high.array() + apart).any() ||
               (other.low.array() > high.array() + apart).any();
    }
    bool isEmpty() const { return (low.array() >= high.array()).any(); }
};

// Joins parts closer than `apart` until none are left.
void join(std::vector<Part>& parts, float apart) {
    for (bool isJoined = true; std::exchange(isJoined, false);)
        for (std::size_t a = 0; a < parts.size(); ++a)
            for (std::size_t b = parts.size(); b-- > a + 1;)
                if (!parts[a].isBeside(parts[b], apart)) {
                    parts[a].take(parts[b]);
                    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(b));
                    isJoined = true;
                }
}

// The box of `count` indices from `first` on.
Part partOf(const ImDrawList& list, const ImDrawCmd& command, unsigned first, unsigned count) {
    Part part;
    for (unsigned n = first; n < first + count; ++n) {
        const ImVec2& at = list.VtxBuffer[static_cast<int>(command.VtxOffset) +
                                          list.IdxBuffer[static_cast<int>(command.IdxOffset + n)]]
                               .pos;
        part.take({{at.x, at.y}, {at.x, at.y}});
    }
    part.low = part.low.cwiseMax(Vector2(command.ClipRect.x, command.ClipRect.y));
    part.high = part.high.cwiseMin(Vector2(command.ClipRect.z, command.ClipRect.w));
    return part;
}

// Calls `visit(command, part)` for every `count` indices whose box is not empty.
template <typename Visit> void eachPart(const ImDrawData& drawn, unsigned count, const Visit& visit) {
    for (int i = 0; i < drawn.CmdListsCount; ++i)
        for (const ImDrawCmd& command : drawn.CmdLists[i]->CmdBuffer)
            for (unsigned n = 0; n + count <= command.ElemCount; n += count) {
                const Part part = partOf(*drawn.CmdLists[i], command, n, count);
                if (!part.isEmpty()) visit(command, part);
            }
}

// Boxes of the triangles. Consecutive triangles mostly belong to one panel.
std::vector<Part> partsOf(const ImDrawData& drawn, float apart) {
    std::vector<Part> parts;
    eachPart(drawn, 3, [&](const ImDrawCmd&, const Part& part) {
        const auto near =
            std::ranges::find_if(parts, [&](const Part& one) { return !one.isBeside(part, apart); });
        if (near == parts.end())
            parts.push_back(part);
        else
            near->take(part);
    });
    join(parts, apart);
    return parts;
}

// Rounds to whole pixels: inwards or outwards.
Part rounded(const Part& part, bool isInner) {
    if (isInner) return {part.low.array().ceil(), part.high.array().floor()};
    return {part.low.array().floor(), part.high.array().ceil()};
}

// Subtracts an area from `parts`: the rests above, below, left and right of it.
std::vector<Part> without(const std::vector<Part>& parts, const Part& area) {
    std::vector<Part> left;
    for (const Part& part : parts) {
        const Part hidden{part.low.cwiseMax(area.low), part.high.cwiseMin(area.high)};
        if (hidden.isEmpty()) {
            left.push_back(part);
            continue;
        }
        for (const Part& beside : {Part{part.low, {part.high.x(), hidden.low.y()}},
                                   Part{{part.low.x(), hidden.high.y()}, part.high},
                                   Part{{part.low.x(), hidden.low.y()}, {hidden.low.x(), hidden.high.y()}},
                                   Part{{hidden.high.x(), hidden.low.y()}, {part.high.x(), hidden.high.y()}}})
            if (!beside.isEmpty()) left.push_back(beside);
    }
    return left;
}

std::vector<VkRect2D> within(const std::vector<Part>& parts, VkExtent2D extent) {
    std::vector<VkRect2D> rectangles;
    for (const Part& part : parts) {
        const Vector2 low = part.low.cwiseMax(Vector2::Zero());
        const Vector2 high =
            part.high.cwiseMin(Vector2(static_cast<float>(extent.width), static_cast<float>(extent.height)));
        if (Part{low, high}.isEmpty()) continue;
        const Vector2 size = high - low;
        rectangles.push_back({{static_cast<std::int32_t>(low.x()), static_cast<std::int32_t>(low.y())},
                              {static_cast<std::uint32_t>(size.x()), static_cast<std::uint32_t>(size.y())}});
    }
    return rectangles;
}

} // namespace

// An area consists of two triangles, so it is their box.
PanelCover coverOf(const ImDrawData& drawn, VkExtent2D extent) {
    constexpr float apart = 8; // [pixels]: closer parts are joined
    std::vector<Part> areas, parts = partsOf(drawn, apart);
    for (Part& part : parts) part = rounded(part, false);
    join(parts, 0);
    eachPart(drawn, 6, [&](const ImDrawCmd& command, const Part& area) {
        if (reinterpret_cast<std::size_t>(command.TextureId) != areaTexture) return;
        std::vector<Part> own{rounded(area, true)};
        for (const Part& other : areas) own = without(own, other);
        areas.insert(areas.end(), own.begin(), own.end());
    });
    for (const Part& area : areas) parts = without(parts, area);
    return {within(areas, extent), within(parts, extent)};
}

} // namespace sinew::viewer
