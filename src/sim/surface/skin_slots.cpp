#include "sim/surface/skin_slots.hpp"

#include <algorithm>
#include <map>

namespace sinew::sim::surface {

void addSkinSlots(CutBodies& bodies, const SkinComplex& complex, HungRange& range) {
    struct Hanging {
        std::vector<std::uint32_t> corners, vertices;
    };
    std::map<std::uint32_t, Hanging> slots;
    for (std::uint32_t p = 0; p < complex.prisms.size(); ++p) {
        const auto& anchors = complex.prisms[p].anchors;
        for (std::uint32_t n = 0; n < 3; ++n)
            if (std::find(anchors, anchors + n, anchors[n]) == anchors + n)
                slots[anchors[n]].corners.push_back(4 * (range.prisms.first + p) + n);
    }
    for (std::uint32_t v = 0; v < complex.vertices.size(); ++v)
        slots[complex.vertices[v].anchor].vertices.push_back(range.vertices.first + v);
    range.slots = {.first = static_cast<std::uint32_t>(bodies.slots.size()),
                   .count = static_cast<std::uint32_t>(slots.size()),
                   .prisms = range.prisms.first,
                   .vertices = range.vertices.first,
                   .spacing = range.prisms.spacing,
                   .run = range.prisms.run};
    for (const auto& [slot, hanging] : slots) {
        bodies.slots.push_back({slot, static_cast<std::uint32_t>(bodies.hanging.size()),
                                static_cast<std::uint32_t>(hanging.corners.size()),
                                static_cast<std::uint32_t>(hanging.vertices.size())});
        bodies.hanging.insert(bodies.hanging.end(), hanging.corners.begin(), hanging.corners.end());
        bodies.hanging.insert(bodies.hanging.end(), hanging.vertices.begin(), hanging.vertices.end());
    }
}

} // namespace sinew::sim::surface
