// How lists show a scene: the table [gallery] of its file.
#pragma once

#include <cstdint>
#include <string_view>

namespace sinew::scenes {

struct Gallery {
    double time = 0;      ///< moment of its picture [s]
    bool isStudy = false; ///< listed apart
    bool isHeavy = false; ///< slower than real time on a CPU
    /// Place among the first ones, from 1 on; 0 = after all of them, by name.
    std::uint32_t order = 0;
    bool isFirst() const { return order > 0 && !isStudy; }
    bool operator==(const Gallery&) const = default;
};

/// Reads only this table; defaults for a text that is no scene, which opening it reports.
Gallery galleryOf(std::string_view text);

} // namespace sinew::scenes
