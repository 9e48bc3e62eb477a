// Units by the size of the length.
#include "viewer/render/length_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace sinew::viewer {

std::string lengthText(float meters) {
    struct Unit {
        float from, factor;
        const char* name;
    };
    constexpr std::array<Unit, 5> units{{{1000, 1e-3f, "km"},
                                         {1, 1, "m"},
                                         {0.01f, 100, "cm"},
                                         {1e-3f, 1000, "mm"},
                                         {1e-6f, 1e6f, "\u00b5m"}}};
    const float size = std::abs(meters);
    for (const Unit& unit : units) {
        if (size < 0.9995f * unit.from) continue; // 0.9996 cm is shown as 1 cm
        char text[40];
        std::snprintf(text, sizeof text, "%.3g %s", double{unit.factor * meters}, unit.name);
        return text;
    }
    return "0 cm";
}

float roundLength(float most) {
    if (!(most > 0) || !std::isfinite(most)) return 0;
    const float power = std::pow(10.0f, std::floor(std::log10(most)));
    for (const float step : {10.0f, 5.0f, 2.0f})
        if (step * power <= 1.0001f * most) return step * power;
    return power;
}

} // namespace sinew::viewer
