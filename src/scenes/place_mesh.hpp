// Places a mesh by the keys `unit`, `scale`, `size`, `rotation`, `center` and `translation`.
#pragma once

#include "scenes/section.hpp"

#include "mesh/triangle_mesh.hpp"

namespace sinew::scenes {

/// A unit that coordinates of a file may have.
struct LengthUnit {
    std::string_view name, word; ///< "mm", "millimetres"
    double metres;               ///< length of one
};
std::span<const LengthUnit> lengthUnits();
/// Null where no unit has this name.
const LengthUnit* findUnit(std::string_view name);
/// "um, mm, cm, m, in, ft".
std::string unitNames();

/// Scales, turns and moves the mesh as the section says, in double, and returns where the middle of its
/// bounding box then is. It turns about that middle; with `translation` about the origin of the file, so that
/// several files of one patient keep their places to each other. Throws SceneError.
sim::Vec3 place(mesh::TriangleMesh& mesh, const Section& section, const std::array<double, 3>& origin);

/// How a cure names a setting: as a key of a scene, unit = "mm", or as an option, --unit mm.
enum class Words { scene, commandLine };
/// `value` as the scene has it, with quotes where it is text.
std::string setting(Words words, const std::string& key, const std::string& value);

/// Empty, or why float32 cannot hold a mesh `longest` metres long with coordinates up to `farthest` metres.
std::string unplaceable(double longest, double farthest);

/// Empty, or why a mesh `longest` metres long may have another unit than `unit` (not null).
std::string oddSize(double longest, const LengthUnit& unit, Words words = Words::scene);

} // namespace sinew::scenes
