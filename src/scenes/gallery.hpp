// How lists show a scene: the table [gallery] of its file.
#pragma once

#include <string_view>

namespace sinew::scenes {

struct Gallery {
    double time = 0;      ///< moment of its picture [s]
    bool isStudy = false; ///< listed apart
    bool isHeavy = false; ///< slower than real time on a CPU
    bool operator==(const Gallery&) const = default;
};

/// Reads only this table; defaults for a text that is no scene, which opening it reports.
Gallery galleryOf(std::string_view text);

} // namespace sinew::scenes
