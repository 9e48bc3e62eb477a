// Fields for numbers that are typed. A number is taken by Enter, and by a press elsewhere.
#pragma once

#include "viewer/ui/panels.hpp"

#include <imgui.h>

namespace sinew::viewer::parts {

struct Range {
    float low = 0, high = 1;
    ImGuiSliderFlags flags = ImGuiSliderFlags_None;
    const char* highest = nullptr; // what the upper end is called
};

/// How a number is written; numbers that are typed are in `unit`.
struct Format {
    const char* text;
    const char* unit;
};

/// A number that is typed after a click: red as long as it cannot be read. True if the value has changed.
/// The caller pushes an ID of its own.
bool number(TypedNumber& typed, float& value, const Range& range, const Format& format);

/// A number of substeps with two buttons, `width` pixels wide. True if the value has changed.
bool substeps(TypedNumber& typed, int& value, float width);

} // namespace sinew::viewer::parts
