// Units by the size of the length.
#include "viewer/render/length_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sinew::viewer {

namespace {

struct Unit {
    float from, factor;
    const char* name;
};
constexpr std::array<Unit, 5> units{
    {{1000, 1e-3f, "km"}, {1, 1, "m"}, {0.01f, 100, "cm"}, {1e-3f, 1000, "mm"}, {1e-6f, 1e6f, "\u00b5m"}}};

// The unit of a length; null for one that is too short for all of them.
const Unit* unitOf(float meters) {
    for (const Unit& unit : units)
        if (std::abs(meters) >= 0.9995f * unit.from) return &unit; // 0.9996 cm is shown as 1 cm
    return nullptr;
}

// At most three digits, those of `largest`, and no minus before a zero.
std::string digitsOf(float value, float largest) {
    const double step = std::pow(10.0, std::floor(std::log10(double{std::abs(largest)})) - 2);
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", std::round(double{value} / step) * step + 0.0);
    return text;
}

} // namespace

std::string lengthText(float meters) {
    const Unit* unit = unitOf(meters);
    if (unit == nullptr) return "0 cm";
    char text[40];
    std::snprintf(text, sizeof text, "%.3g %s", double{unit->factor * meters}, unit->name);
    return text;
}

std::string pointText(const std::array<float, 3>& meters) {
    float largest = 0;
    for (const float one : meters) largest = std::max(largest, std::abs(one));
    const Unit* unit = unitOf(largest);
    if (unit == nullptr) return "0, 0, 0 cm";
    std::string text;
    for (const float one : meters)
        text += (text.empty() ? "" : ", ") + digitsOf(unit->factor * one, unit->factor * largest);
    return text + " " + unit->name;
}

float roundLength(float most) {
    if (!(most > 0) || !std::isfinite(most)) return 0;
    const float power = std::pow(10.0f, std::floor(std::log10(most)));
    for (const float step : {10.0f, 5.0f, 2.0f})
        if (step * power <= 1.0001f * most) return step * power;
    return power;
}

} // namespace sinew::viewer
