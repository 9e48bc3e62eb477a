// Names and colours of layers; the table is in layers/table.cpp.
#include "viewer/render/layers.hpp"

#include "sim/core/counted.hpp"
#include "viewer/render/layer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sinew::viewer {

namespace {

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

std::size_t indexOf(const Layer& layer) {
    return static_cast<std::size_t>(std::ranges::find(layerTable(), &layer) - layerTable().begin());
}

bool Layers::needsBuffers() const {
    return std::ranges::any_of(layerTable(), [&](const Layer* layer) { return layer->make && has(*layer); });
}

void Layers::turn(std::size_t layer) {
    looks[layer] = static_cast<std::uint8_t>((looks[layer] + 1) % (layerTable()[layer]->looks.size() + 1));
}

std::vector<std::string> layerNames() {
    std::vector<std::string> all;
    for (const Layer* layer : layerTable())
        for (const Layer::Look& look : layer->looks) all.emplace_back(look.name);
    return all;
}

bool addLayer(std::string_view name, Layers& layers) {
    for (std::size_t i = 0; i < layerTable().size(); ++i) {
        const std::span<const Layer::Look> looks = layerTable()[i]->looks;
        const auto found = std::ranges::find(looks, name, &Layer::Look::name);
        if (found == looks.end()) continue;
        layers.looks[i] = static_cast<std::uint8_t>(found - looks.begin() + 1);
        return true;
    }
    return false;
}

Layers shown(std::initializer_list<std::string_view> names, const std::optional<Section>& section) {
    Layers layers{.section = section};
    for (const std::string_view name : names) {
        [[maybe_unused]] const bool isKnown = addLayer(name, layers);
        assert(isKnown);
    }
    return layers;
}

LayerRanges mapRange(float range) {
    LayerRanges all{};
    all[indexOf(layer::colors)] = range;
    return all;
}

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
    return digits;
}

std::string countText(std::uint64_t number, std::string_view one, std::string_view many) {
    return grouped(number) + " " + sim::nounFor(number, one, many);
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
