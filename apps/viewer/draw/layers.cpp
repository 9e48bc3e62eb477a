// Names and colours of layers.
#include "viewer/draw/layers.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

struct Name {
    std::string_view name;
    void (*add)(Layers&);
};

constexpr std::array names{Name{"glass", [](Layers& layers) { layers.skin = SkinLook::glass; }},
                           Name{"hidden", [](Layers& layers) { layers.skin = SkinLook::hidden; }},
                           Name{"strain", [](Layers& layers) { layers.map = ColorMap::strain; }},
                           Name{"speed", [](Layers& layers) { layers.map = ColorMap::speed; }},
                           Name{"sleep", [](Layers& layers) { layers.map = ColorMap::sleep; }},
                           Name{"wires", [](Layers& layers) { layers.hasWires = true; }},
                           Name{"particles", [](Layers& layers) { layers.hasBalls = true; }},
                           Name{"links", [](Layers& layers) { layers.hasLinks = true; }},
                           Name{"contacts", [](Layers& layers) { layers.hasContacts = true; }},
                           Name{"cells", [](Layers& layers) { layers.hasCells = true; }}};

// Linear sRGB of an OKLab colour: lightness 0 to 1, and two axes that are 0 for grey.
std::array<float, 3> fromLab(double lightness, double a, double b) {
    const auto cube = [](double root) { return root * root * root; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b),
                 m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b),
                 s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return {static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

} // namespace

SkinLook next(SkinLook look) {
    return static_cast<SkinLook>((static_cast<int>(look) + 1) % 3);
}

ColorMap next(ColorMap map) {
    return static_cast<ColorMap>((static_cast<int>(map) + 1) % 4);
}

std::vector<std::string> layerNames() {
    std::vector<std::string> all;
    for (const Name& one : names) all.emplace_back(one.name);
    return all;
}

bool addLayer(const std::string& name, Layers& layers) {
    const auto* found = std::ranges::find(names, name, &Name::name);
    if (found != names.end()) found->add(layers);
    return found != names.end();
}

std::array<std::array<float, 3>, mapColorCount> mapColors() {
    constexpr double dark = 0.30, light = 0.92, chroma = 0.09; // chroma: the largest that stays within sRGB
    constexpr double from = 4.887, to = 1.745;                 // hues: blue, and the long way to yellow [rad]
    std::array<std::array<float, 3>, mapColorCount> colors{};
    for (std::size_t i = 0; i < mapColorCount; ++i) {
        const double t = static_cast<double>(i) / (mapColorCount - 1), hue = from + (to - from) * t;
        colors[i] = fromLab(dark + (light - dark) * t, chroma * std::cos(hue), chroma * std::sin(hue));
    }
    return colors;
}

std::array<float, 3> classColor(std::size_t index) {
    constexpr double goldenAngle = 2.39996, first = 0.6; // [rad]
    constexpr std::array lightness{0.45, 0.72, 0.58};
    const double hue = first + goldenAngle * static_cast<double>(index), chroma = 0.14;
    std::array<float, 3> color =
        fromLab(lightness[index % lightness.size()], chroma * std::cos(hue), chroma * std::sin(hue));
    for (float& part : color) part = std::clamp(part, 0.0f, 1.0f);
    return color;
}

} // namespace sinew::viewer
