// The layers of a picture: what is drawn of bodies besides their lit skins, or instead of them. Chosen by the
// user.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/buffer.hpp"
#include "viewer/draw/section.hpp"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::viewer {

class Balls;
class ContactMarks;
class HashCells;
class LinkLines;

enum class SkinLook { solid, glass, hidden };

/// The quantity of particles that colours show.
enum class ColorMap {
    none,
    strain, ///< of the live links of a particle, (length - rest) / rest: root mean square
    speed,  ///< [m/s]
    sleep   ///< 1 = awake, 0 = asleep
};

struct Layers {
    SkinLook skin = SkinLook::solid;
    ColorMap map = ColorMap::none;
    bool hasWires = false; ///< edges of all triangles of skins
    bool hasBalls = false; ///< also particles of bodies with a skin
    bool hasLinks = false; ///< in the colours of their classes
    bool hasContacts = false;
    bool hasCells = false;          ///< cells of hash grids that are not empty
    std::optional<Section> section; ///< plane that opens bodies
    bool operator==(const Layers&) const = default;
    /// Whether a layer needs buffers of its own (Inspection).
    bool needsBuffers() const {
        return map != ColorMap::none || hasBalls || hasLinks || hasContacts || hasCells;
    }
};

/// The next look, cyclically: solid, glass, hidden.
SkinLook next(SkinLook look);
/// The next map, cyclically: none, strain, speed, sleep.
ColorMap next(ColorMap map);

/// Names of layers on the command line: "glass", "hidden", "strain", "speed", "sleep", "wires", "particles",
/// "links", "contacts", "cells".
std::vector<std::string> layerNames();
/// Adds the layer of this name; false if the name is unknown.
bool addLayer(const std::string& name, Layers& layers);

/// Colours of a map from its lowest value to its highest, linear RGB. Equal steps look equally far apart and
/// get evenly lighter, so that colour-blind users can read them: a straight path up in lightness, half-way
/// around in hue, at constant chroma in OKLCh [Ottosson 2020].
constexpr std::size_t mapColorCount = 17;
std::array<std::array<float, 3>, mapColorCount> mapColors();

/// Linear RGB of a class of links, in the order in which classes are solved; consecutive classes differ
/// clearly.
std::array<float, 3> classColor(std::size_t index);

/// Counts of links by the class in which the solver corrects them.
struct LinkFacts {
    std::vector<std::uint32_t> classes; ///< number of links of each class
    std::size_t fixed = 0;              ///< links between two fixed particles, in no class
    std::string note;                   ///< how the solver treats links
};

/// Distribution of a map's values over the particles.
struct MapReading {
    float range = 0;   ///< 1, 2 or 5 times a power of ten: at most 1 % of particles exceed it; 0 = no values
    float largest = 0; ///< largest value
    float beyond = 0;  ///< share of particles above `range`
};

/// Statistics of a hash grid at its last rebuild.
struct GridFacts {
    std::string name;         ///< its contents
    float edge = 0;           ///< side of a cell [m]
    std::uint32_t cells = 0;  ///< cells that are not empty
    std::uint32_t shared = 0; ///< cells that share their slot of the table with others
    std::uint32_t most = 0;   ///< largest number of items in a cell
    std::uint32_t held = 0;   ///< number of items in all cells
    std::uint32_t slots = 0;  ///< slots of the table
};

/// Buffers that layers are drawn from, made by Inspection. Views for layers that are off are empty.
struct LayerBuffers {
    vk::BufferView particles; ///< float per particle: the map's value; negative = no value
    vk::BufferView skins;     ///< float per vertex of skins
    vk::BufferView cuts;      ///< float per vertex of the surface of cuts
    float range = 0;          ///< value of the last colour of the map
    const Balls* balls = nullptr;
    const LinkLines* links = nullptr;
    const ContactMarks* contacts = nullptr;
    const HashCells* cells = nullptr;
    float cellRange = 0; ///< number of items in a cell that has the last colour; 0 = not known yet
};

} // namespace sinew::viewer
