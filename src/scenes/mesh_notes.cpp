// Texts alone; what they say is measured elsewhere.
#include "scenes/mesh_notes.hpp"

#include "scenes/place_mesh.hpp"
#include "sim/core/counted.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sinew::scenes {

namespace {

std::string text(const char* format, double value) {
    char buffer[48];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

} // namespace

std::string lengthWithUnit(double metres) {
    if (metres < 0.1) return text("%.3g mm", 1000 * metres);
    return text(metres < 1000 ? "%.3g m" : "%.0f m", metres);
}

std::string massText(double kilograms) {
    return text(kilograms < 1000 ? "%.3g kg" : "%.0f kg", kilograms);
}

std::string voxelText(const mesh::VoxelGrid& grid) {
    return std::to_string(grid.cells[0]) + " x " + std::to_string(grid.cells[1]) + " x " +
           std::to_string(grid.cells[2]) + " voxels of " + lengthWithUnit(double{grid.spacing});
}

std::string calledIn(const LoadedScene& loaded, const Section& section, const std::string& kind,
                     const std::string& file) {
    if (section.has("name")) return kind + " \"" + section.text("name") + "\" (" + file + ")";
    if (std::ranges::any_of(loaded.meshes, [&](const MeshSummary& other) {
            return other.file == file || other.file.starts_with(file + ", \"");
        }))
        return section.label() + " (" + file + ")";
    return kind + " " + file;
}

std::string oddSizeOf(const Section& section, const mesh::MeshReport& surface) {
    if (section.has("size") || !section.has("file")) return {}; // in metres, as the scene says
    const auto along = [&](float sim::Vec3::*axis) {
        return double{surface.high.*axis} - double{surface.low.*axis};
    };
    return oddSize(std::max({along(&sim::Vec3::x), along(&sim::Vec3::y), along(&sim::Vec3::z)}),
                   *findUnit(section.text("unit")));
}

void noteSize(LoadedScene& loaded, const std::string& name, const Section& section,
              const mesh::MeshReport& surface, const std::string& more) {
    const auto along = [&](float sim::Vec3::*axis) {
        return text("%.3g", double{surface.high.*axis} - double{surface.low.*axis});
    };
    loaded.notes.push_back(name + ": " + along(&sim::Vec3::x) + " x " + along(&sim::Vec3::y) + " x " +
                           along(&sim::Vec3::z) + " m" + more);
    const std::string odd = oddSizeOf(section, surface);
    if (!odd.empty()) loaded.warnings.push_back(name + " " + odd);
}

std::string scaledText(double given, double metres) {
    return "is scaled to " + lengthWithUnit(metres) + ", from " + text("%.3g", given) +
           " in units of the file: a scene file with unit in the place of size keeps its own";
}

void noteComponents(LoadedScene& loaded, const std::string& name,
                    const std::vector<mesh::Component>& components) {
    constexpr std::size_t mostLines = 10;
    if (components.size() < 2) return;
    loaded.notes.push_back(name + " has " + std::to_string(components.size()) + " components");
    for (std::size_t i = 0; i < components.size() && i < mostLines; ++i)
        loaded.notes.push_back(name + ", " + describe(components[i]));
    if (components.size() > mostLines)
        loaded.notes.push_back(name + ", and " +
                               sim::counted(components.size() - mostLines, "smaller component"));
}

std::string bridgesText(const mesh::Bridges& bridges, double voxel) {
    if (bridges.components == 0) return {};
    return "has " + std::to_string(bridges.components) + " components, " + lengthWithUnit(bridges.gap) +
           " apart at the nearest (\"" + bridges.nearest[0] + "\" and \"" + bridges.nearest[1] +
           "\"), that voxels of " + lengthWithUnit(voxel) + " join";
}

std::vector<std::string> overlapTexts(const mesh::Bridges& bridges) {
    constexpr std::size_t mostLines = 10;
    std::vector<std::string> texts;
    for (const auto& [one, other] : bridges.overlaps) {
        if (texts.size() == mostLines) break;
        texts.push_back("\"" + one + "\" and \"" + other + "\" touch or overlap");
    }
    if (bridges.overlaps.size() > mostLines)
        texts.push_back(sim::counted(bridges.overlaps.size() - mostLines, "more pair touches or overlaps",
                                     "more pairs touch or overlap"));
    return texts;
}

std::string inwardText(const std::vector<mesh::Component>& components, mesh::Repair how, Words words) {
    constexpr std::size_t mostNamed = 10;
    std::string names;
    std::size_t count = 0;
    for (const mesh::Component& component : components)
        if (component.isInward && ++count <= mostNamed)
            names += (count == 1 ? "\"" : ", \"") + component.name + "\"";
    if (count == 0 || components.size() < 2) return {};
    if (count > mostNamed) names += " and " + sim::counted(count - mostNamed, "other");
    return "has " + sim::counted(count, "component") + " inside out, " + names +
           ": where it lies in another one, it is left out of the volume; reverse its triangles" +
           (how == mesh::Repair::close ? ""
                                       : " (" + setting(words, "repair", "\"close\"") +
                                             " reverses closed parts that lie in no other)") +
           ", or close what is around it if it is a cavity";
}

std::string thinText(double thickness, double longest, double voxel, bool saysVoxel, Words words) {
    constexpr double finest = 512;               // cells along the longest side
    if (!(thickness < 1.999 * voxel)) return {}; // two, but for rounding
    if (thickness < 1e-6 * longest)
        return "has no thickness at the thinnest 5 % of its surface: give it a wall in a mesh editor";
    const double resolution = std::ceil(2 * longest / thickness + 0.04); // as place_grid.cpp leaves free
    const double digit = std::pow(10, std::floor(std::log10(thickness / 2)) - 1);
    const double edge = std::floor(thickness / 2 / digit + 1e-3) * digit; // two digits, rounded down
    std::string cure = (saysVoxel ? setting(words, "voxel", text("%.3g", edge))
                                  : setting(words, "resolution", text("%.0f", resolution))) +
                       " gives two";
    if (resolution > finest)
        cure = "two would be " + text("%.0f", resolution) + " along its longest side, more than the " +
               text("%.0f", finest) + " that are possible";
    return "is " + lengthWithUnit(thickness) +
           " thin at the thinnest 5 % of its surface, less than 2 voxels of " + lengthWithUnit(voxel) + ": " +
           cure;
}

void noteRepairs(LoadedScene& loaded, const std::string& name, const mesh::Repairs& repairs) {
    for (const std::string& sentence : mesh::sentencesOf(repairs))
        loaded.notes.push_back(name + ": " + sentence);
}

std::string seamText(const mesh::Repairs& repairs, bool hasParts, Words words) {
    if (repairs.seam.weld == 0) return {};
    return "has a seam that is wider than the tolerance of " + text("%.2g", repairs.tolerance) +
           " (units of the file): " + setting(words, "weld", text("%.4g", repairs.seam.weld)) + " joins " +
           std::to_string(repairs.seam.edges) + " of its open edges" +
           (hasParts ? ", and may give its parts other numbers" : "");
}

void warnOfSeam(LoadedScene& loaded, const std::string& name, const mesh::Repairs& repairs, bool hasParts) {
    const std::string seam = seamText(repairs, hasParts);
    if (!seam.empty()) loaded.warnings.push_back(name + " " + seam);
}

std::string vainWeldText(const mesh::Repairs& repairs, double weld, Words words) {
    if (weld == 0 || repairs.joinedVertices + repairs.splitEdges > 0) return {};
    return "has no open edges that " + setting(words, "weld", text("%.4g", weld)) + " joins";
}

std::string choiceText(const mesh::TriangleMesh& chosen) {
    const mesh::MeshReport report = mesh::measure(chosen);
    const auto along = [&](float sim::Vec3::*axis) {
        return text("%.3g", double{report.high.*axis} - double{report.low.*axis});
    };
    const auto middle = [&](float sim::Vec3::*axis) {
        return text("%.3g", (double{report.high.*axis} + double{report.low.*axis}) / 2);
    };
    return "object takes " + sim::counted(chosen.triangles.size(), "triangle") + ", " + along(&sim::Vec3::x) +
           " x " + along(&sim::Vec3::y) + " x " + along(&sim::Vec3::z) + " around (" + middle(&sim::Vec3::x) +
           ", " + middle(&sim::Vec3::y) + ", " + middle(&sim::Vec3::z) + ") in units of the file";
}

void warnOfDefects(const MeshSummary& summary, std::vector<std::string>& warnings) {
    const mesh::MeshDefects& defects = summary.surface.defects;
    const std::string& name = summary.called;
    if (defects.boundaryEdges > 0)
        warnings.push_back(name + " is open: " +
                           (summary.repairs.openEdges == defects.boundaryEdges
                                ? mesh::openText(summary.repairs)
                                : sim::counted(defects.boundaryEdges, "boundary edge")) +
                           "; winding numbers decided what is inside" +
                           (summary.repairs.how == mesh::Repair::close
                                ? ""
                                : ", and repair = \"close\" closes small holes"));
    if (defects.nonManifoldEdges > 0)
        warnings.push_back(name + " is not manifold: " + sim::counted(defects.nonManifoldEdges, "edge") +
                           " with three or more triangles; its volume may be wrong");
    if (summary.voxels.doubtful > 0)
        warnings.push_back(name + ": " + std::to_string(summary.voxels.doubtful) + " of " +
                           std::to_string(summary.voxels.voxels.size()) +
                           " cells of its grid are doubtful: winding numbers decided");
    const std::string why = defects.boundaryEdges > 0 ? " stays open"
                            : defects.nonManifoldEdges > 0
                                ? " has edges with three or more triangles"
                                : " passes through itself or is too thin for its voxels";
    if (summary.shown == mesh::Shown::wrapped)
        warnings.push_back(
            name + why +
            ": a closed surface half a voxel fine is shown in its place, so that cuts show the "
            "inside; finer voxels follow the mesh more closely");
    if (summary.shown == mesh::Shown::voxels)
        warnings.push_back(name + why +
                           ": the faces of its voxels are shown in its place, so that cuts show the inside; "
                           "finer voxels may do without, and cuttable = false shows the mesh");
}

} // namespace sinew::scenes
