// In double until the end: files may have their origin far away.
#include "scenes/place_mesh.hpp"

#include "scenes/mesh_notes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numbers>

namespace sinew::scenes {

namespace {

constexpr LengthUnit units[] = {{"um", "micrometres", 1e-6}, {"mm", "millimetres", 1e-3},
                                {"cm", "centimetres", 1e-2}, {"m", "metres", 1},
                                {"in", "inches", 0.0254},    {"ft", "feet", 0.3048}};

constexpr double longestUsual = 10, shortestUsual = 1e-3; // [m]

Eigen::Vector3d toEigen(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

Eigen::Matrix3d turnOf(const Section& section) {
    const sim::Vec3 degrees = section.vector("rotation");
    const Eigen::Vector3d angles =
        Eigen::Vector3d(double{degrees.x}, double{degrees.y}, double{degrees.z}) * (std::numbers::pi / 180);
    return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

void checkKeys(const Section& section) {
    for (const char* key : {"unit", "scale"})
        if (section.has("size") && section.has(key))
            section.fail(key, "is given beside size", "give size, or unit and scale");
    if (section.has("translation") && section.has("center"))
        section.fail("translation", "is given beside center", "give one of them");
    if (section.has("unit") && !section.has("file"))
        section.fail("unit", "is given, but a generated shape has none", "remove it, or give scale");
    const std::string unit = section.text("unit");
    if (!findUnit(unit))
        section.fail("unit", "is no unit: \"" + unit.substr(0, 64) + "\"", "possible are " + unitNames());
}

} // namespace

std::span<const LengthUnit> lengthUnits() {
    return units;
}

const LengthUnit* findUnit(std::string_view name) {
    const auto found = std::ranges::find(units, name, &LengthUnit::name);
    return found == std::end(units) ? nullptr : &*found;
}

std::string unitNames() {
    std::string names;
    for (const LengthUnit& unit : units) names += (names.empty() ? "" : ", ") + std::string(unit.name);
    return names;
}

sim::Vec3 place(mesh::TriangleMesh& mesh, const Section& section, const std::array<double, 3>& origin) {
    checkKeys(section);
    const mesh::MeshReport report = mesh::measure(mesh);
    const auto toDouble = [](const sim::Vec3& v) {
        return Eigen::Vector3d(double{v.x}, double{v.y}, double{v.z});
    };
    const Eigen::Vector3d low = toDouble(report.low), high = toDouble(report.high), middle = (low + high) / 2;
    const double longest = (high - low).maxCoeff();
    if (!(longest > 0))
        section.fail(section.has("file") ? "file" : "generate", "has no extent", "check the mesh");
    const bool isSized = section.has("size");
    const double scale = isSized ? double{section.number("size")} / longest
                                 : findUnit(section.text("unit"))->metres * section.value("scale");
    const char* scaledBy = isSized ? "size" : section.has("unit") ? "unit" : "scale";
    const Eigen::Matrix3d turn = turnOf(section);
    Eigen::Vector3d center = isSized ? middle : Eigen::Vector3d(middle * scale);
    if (section.has("center")) center = toEigen(section.point("center"));
    if (section.has("translation")) center = turn * middle * scale + toEigen(section.point("translation"));
    center -= toEigen(origin);
    const std::string why = unplaceable(longest * scale, center.cwiseAbs().maxCoeff());
    if (!why.empty())
        section.fail(scaledBy, why, "check unit and scale, or move the mesh nearer to the first body");
    for (sim::Vec3& position : mesh.positions) {
        const Eigen::Vector3d placed = turn * (toDouble(position) - middle) * scale + center;
        position = {static_cast<float>(placed.x()), static_cast<float>(placed.y()),
                    static_cast<float>(placed.z())};
    }
    return {static_cast<float>(center.x()), static_cast<float>(center.y()), static_cast<float>(center.z())};
}

std::string setting(Words words, const std::string& key, const std::string& value) {
    if (words == Words::scene) return key + " = " + value;
    return "--" + key + " " + (value.starts_with('"') ? value.substr(1, value.size() - 2) : value);
}

std::string unplaceable(double longest, double farthest) {
    constexpr double least = 1e-9, most = 1e9; // [m]
    constexpr double steps = 4; // of the coordinates, along the longest side; fewer leave no triangles
    const auto metres = [](double length) {
        char text[32];
        std::snprintf(text, sizeof text, "%.3g m", length);
        return std::string(text);
    };
    const std::string makes = "makes the mesh " + metres(longest) + " long";
    if (!(longest >= least && longest <= most)) return makes + ", and 1e-9 to 1e9 m are possible";
    if (longest > steps * farthest * double{std::numeric_limits<float>::epsilon()}) return {};
    return makes + ", too small for float32 coordinates that are " + metres(farthest) + " from 0";
}

std::string oddSize(double longest, const LengthUnit& unit, Words words) {
    if (longest <= longestUsual && longest >= shortestUsual) return {};
    for (const char* name : {"mm", longest > longestUsual ? "cm" : "m", "um"}) {
        const LengthUnit& other = *findUnit(name);
        const double then = longest * other.metres / unit.metres;
        if (&other != &unit && then <= longestUsual && then >= shortestUsual)
            return "is " + lengthWithUnit(longest) + " long: if the file is in " + std::string(other.word) +
                   ", say " + setting(words, "unit", "\"" + std::string(name) + "\"");
    }
    return "is " + lengthWithUnit(longest) + " long: check its unit and scale";
}

} // namespace sinew::scenes
