// What is drawn of bodies beside their lit skins, or instead of them: chosen by hands or on the command line.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/section.hpp"
#include "vk/buffer.hpp"

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

/// A number of each particle that colors stand for.
enum class ColorMap {
    none,
    strain, ///< of its live links, (length - rest) / rest: root of the mean square
    speed,  ///< [m/s]
    sleep   ///< 1 = awake, 0 = asleep
};

struct Layers {
    SkinLook skin = SkinLook::solid;
    ColorMap map = ColorMap::none;
    bool hasWires = false; ///< edges of all triangles of skins
    bool hasBalls = false; ///< particles of bodies with a skin, too
    bool hasLinks = false; ///< in the colors of their classes
    bool hasContacts = false;
    bool hasCells = false;          ///< of hash grids, that hold something
    std::optional<Section> section; ///< opens bodies
    bool operator==(const Layers&) const = default;
    /// Whether something of it comes from buffers that are made for it (Inspection).
    bool needsBuffers() const {
        return map != ColorMap::none || hasBalls || hasLinks || hasContacts || hasCells;
    }
    /// What skins are made for (Stage::recordSkin): some layers draw no triangle in two forms.
    sim::Overlap overlap() const {
        return skin == SkinLook::glass || hasWires || section ? sim::Overlap::none : sim::Overlap::some;
    }
};

/// The one after it, round and round: solid, glass, hidden.
SkinLook next(SkinLook look);
/// none, strain, speed, sleep.
ColorMap next(ColorMap map);

/// How the command line calls layers: "glass", "hidden", "strain", "speed", "sleep", "wires", "particles",
/// "links", "contacts", "cells".
std::vector<std::string> layerNames();
/// One of them on top of others; false for a name that is none.
bool addLayer(const std::string& name, Layers& layers);

/// Colors of a map from its lowest value to its highest, linear RGB. Equal steps look equally far apart and
/// get evenly lighter, which everybody can tell: in OKLCh [Ottosson 2020] a straight way up, half-way around,
/// at one chroma.
constexpr std::size_t mapColorCount = 17;
std::array<std::array<float, 3>, mapColorCount> mapColors();

/// Linear RGB of a class, in the order in which classes are solved: neighbours in it stay apart.
std::array<float, 3> classColor(std::size_t index);

/// Links by how the solver corrects them.
struct LinkFacts {
    std::vector<std::uint32_t> classes; ///< how many links each has
    std::size_t fixed = 0;              ///< links between particles that never move, of no class
    std::string note;                   ///< what the solver does with them
};

/// How the values of a map spread over the particles.
struct MapReading {
    float range = 0; ///< 1, 2 or 5 times a power of ten: at most 1 % of all have more; 0 = nobody has a value
    float largest = 0; ///< of all
    float beyond = 0;  ///< share of those with more than `range`
};

/// A hash grid, as it was built last.
struct GridFacts {
    std::string name;         ///< of what is in it
    float edge = 0;           ///< of a cell [m]
    std::uint32_t cells = 0;  ///< that hold something
    std::uint32_t shared = 0; ///< of them, in whose slot of the table there are others, too
    std::uint32_t most = 0;   ///< in a cell
    std::uint32_t held = 0;   ///< in all of them
    std::uint32_t slots = 0;  ///< of the table
};

/// Where layers are drawn from, as Inspection makes it. Views of what is not on are empty.
struct LayerBuffers {
    vk::BufferView particles; ///< float a particle: the map's value, below 0 where there is none
    vk::BufferView skins;     ///< likewise a vertex of skins
    vk::BufferView cuts;      ///< likewise a vertex of the surface of cuts
    float range = 0;          ///< of the map's colors
    const Balls* balls = nullptr;
    const LinkLines* links = nullptr;
    const ContactMarks* contacts = nullptr;
    const HashCells* cells = nullptr;
    float cellRange = 0; ///< how many in a cell have the last color; 0 = not known yet
};

} // namespace sinew::viewer
