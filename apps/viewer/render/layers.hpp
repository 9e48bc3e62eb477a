// The layers of a picture: what is drawn of bodies besides their lit skins, or instead of them. Chosen by the
// user. Each layer is a record (render/layer.hpp) in one table.
#pragma once

#include "sinew/vk/buffer.hpp"
#include "viewer/render/section.hpp"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::viewer {

class Balls;
class LayerPart;
struct Layer;

enum class SkinLook { solid, glass, hidden };

/// The quantity of particles that colours show.
enum class ColorMap {
    none,
    strain, ///< of the live links of a particle, (length - rest) / rest: root mean square
    speed,  ///< [m/s]
    sleep   ///< 1 = awake, 0 = asleep
};

/// All layers, in the order of buttons and legends; those without a depth test are drawn last. At most
/// mostLayers.
std::span<const Layer* const> layerTable();
constexpr std::size_t mostLayers = 16;
/// Index into layerTable().
std::size_t indexOf(const Layer& layer);

namespace layer {
/// Layers that change how the renderer draws bodies; the others draw something of their own.
extern const Layer skin, wires, particles, colors;
} // namespace layer

/// The layers that are on.
struct Layers {
    /// The look of each layer of the table: 0 = off, else 1 + index into Layer::looks.
    std::array<std::uint8_t, mostLayers> looks{};
    std::optional<Section> section; ///< plane that opens bodies

    bool operator==(const Layers&) const = default;
    bool has(const Layer& layer) const { return looks[indexOf(layer)] > 0; }
    SkinLook skin() const { return static_cast<SkinLook>(looks[indexOf(layer::skin)]); }
    ColorMap map() const { return static_cast<ColorMap>(looks[indexOf(layer::colors)]); }
    /// Whether a layer needs buffers of its own (Inspection).
    bool needsBuffers() const;
    /// Turns a layer to its next look, cyclically; after the last one it is off.
    void turn(std::size_t layer);
};

/// Names of layers on the command line, a name for each look: "glass", "hidden", "wires", "particles", ...
std::vector<std::string> layerNames();
/// Adds the layer of this name; false if the name is unknown.
bool addLayer(std::string_view name, Layers& layers);
/// The layers of these names, which must be known.
Layers shown(std::initializer_list<std::string_view> names, const std::optional<Section>& section = {});

/// Colours of a map from its lowest value to its highest, linear RGB. Equal steps look equally far apart and
/// get evenly lighter, so that colour-blind users can read them: a straight path up in lightness, half-way
/// around in hue, at constant chroma in OKLCh [Ottosson 2020].
constexpr std::size_t mapColorCount = 17;
std::array<std::array<float, 3>, mapColorCount> mapColors();

/// Linear RGB of a class of links, in the order in which classes are solved; consecutive classes differ
/// clearly.
std::array<float, 3> classColor(std::size_t index);

/// Distribution of a layer's values.
struct MapReading {
    float range = 0;   ///< value of the last colour; 0 = no values
    float largest = 0; ///< largest value
    float beyond = 0;  ///< share of values above `range`
};

/// Values of the last colours of layers, by index into layerTable(); 0 = not known yet.
using LayerRanges = std::array<float, mostLayers>;
/// Only the range of the map.
LayerRanges mapRange(float range);

/// Buffers that layers are drawn from, made by Inspection. Those of layers that are off are empty.
struct LayerBuffers {
    vk::BufferView particles; ///< float per particle: the map's value; negative = no value
    vk::BufferView skins;     ///< float per vertex of skins
    vk::BufferView cuts;      ///< float per vertex of the surface of cuts
    float range = 0;          ///< value of the last colour of the map
    const Balls* balls = nullptr;
    std::array<const LayerPart*, mostLayers> parts{}; ///< of all layers that are on, by index
    LayerRanges ranges{};
};

} // namespace sinew::viewer
