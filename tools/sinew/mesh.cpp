// `sinew mesh`: imports a mesh, fills it with voxels and says what is odd about it. Needs no device.
#include "app/guard.hpp"
#include "mesh/import.hpp"
#include "mesh/voxelise.hpp"
#include "sinew/commands.hpp"
#include "sinew/json.hpp"
#include "sinew/outputs.hpp"
#include "sinew/report.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace sinew::tools {

namespace {

struct MeshOptions {
    std::string file;
    float voxel = 0; // [m]; 0 = by resolution
    std::uint32_t resolution = 24;
    std::optional<std::string> json;
};

struct Findings {
    std::string file;
    mesh::TriangleMesh mesh;
    mesh::MeshReport surface;
    mesh::VoxelGrid voxels;
};

Findings inspect(const MeshOptions& options) {
    Findings found{.file = options.file};
    mesh::MeshDefects defects;
    found.mesh = mesh::importMesh(options.file, defects);
    found.surface = mesh::inspect(found.mesh);
    found.surface.defects = defects;
    try {
        found.voxels =
            mesh::voxelise(found.mesh, {.spacing = options.voxel, .resolution = options.resolution});
    } catch (const std::length_error& error) {
        throw app::Failure(app::badInput, "cannot fill mesh: " + options.file + ": " + error.what() +
                                              ": use a larger --voxel");
    }
    return found;
}

Json surfaceJson(const Findings& found) {
    const mesh::MeshDefects& defects = found.surface.defects;
    return {{"vertices", found.mesh.positions.size()},
            {"triangles", found.mesh.triangles.size()},
            {"closed", defects.isClosed()},
            {"boundary_edges", defects.boundaryEdges},
            {"non_manifold_edges", defects.nonManifoldEdges},
            {"flipped_edges", defects.flippedEdges},
            {"degenerate_triangles", defects.degenerateTriangles},
            {"duplicate_triangles", defects.duplicateTriangles},
            {"low", toJson(found.surface.low)},
            {"high", toJson(found.surface.high)},
            {"area", found.surface.area},
            {"volume", defects.isClosed() ? Json(found.surface.volume) : Json(nullptr)}};
}

std::string toJson(const Findings& found) {
    Json json{{"schema", reportSchema}, {"file", found.file}};
    json["surface"] = surfaceJson(found);
    json["voxels"] = {{"spacing", found.voxels.spacing},   {"cells", found.voxels.cells},
                      {"hull", found.voxels.hullCount},    {"core", found.voxels.coreCount},
                      {"doubtful", found.voxels.doubtful}, {"volume", found.voxels.filledVolume}};
    return dump(json);
}

std::string toText(const Findings& found) {
    const mesh::MeshReport& surface = found.surface;
    const mesh::MeshDefects& defects = surface.defects;
    const mesh::VoxelGrid& grid = found.voxels;
    std::string text = fmt::format("{}: {} vertices, {} triangles\n", found.file, found.mesh.positions.size(),
                                   found.mesh.triangles.size());
    text += fmt::format("  size      {:.4g} x {:.4g} x {:.4g} m, area {:.4g} m^2\n",
                        surface.high.x - surface.low.x, surface.high.y - surface.low.y,
                        surface.high.z - surface.low.z, surface.area);
    if (defects.isClosed())
        text += fmt::format("  surface   closed, volume {:.4g} m^3\n", surface.volume);
    else
        text += fmt::format("  surface   {} boundary edges, {} non-manifold edges\n", defects.boundaryEdges,
                            defects.nonManifoldEdges);
    text += fmt::format("  defects   {} flipped edges, {} degenerate and {} duplicate triangles dropped\n",
                        defects.flippedEdges, defects.degenerateTriangles, defects.duplicateTriangles);
    text += fmt::format("  voxels    {} hull + {} core of {} x {} x {}, edge {:.4g} m, {} doubtful\n",
                        grid.hullCount, grid.coreCount, grid.cells[0], grid.cells[1], grid.cells[2],
                        grid.spacing, grid.doubtful);
    return text + fmt::format("  filled    {:.4g} m^3\n", grid.filledVolume);
}

int report(const MeshOptions& options) {
    std::optional<TextOutput> json;
    if (options.json) json.emplace(*options.json);
    const Findings found = inspect(options);
    if (json) json->write(toJson(found));
    if (options.json != "-") TextOutput("-").write(toText(found));
    return 0;
}

} // namespace

void addMesh(CLI::App& app, Chosen& chosen) {
    CLI::App& command = *app.add_subcommand(
        "mesh", "import a mesh, fill it with voxels, report counts, volumes and defects; needs no device");
    const auto options = std::make_shared<MeshOptions>();
    command.add_option("FILE", options->file, "OBJ, STL, PLY, glTF or GLB; its content decides")->required();
    CLI::Option* voxel =
        command.add_option("--voxel", options->voxel, "edge of a voxel, in the units of the file");
    voxel->check(CLI::PositiveNumber);
    command.add_option("--resolution", options->resolution, "voxels along the longest side")
        ->check(CLI::Range(1, 512))
        ->capture_default_str()
        ->excludes(voxel);
    command.add_option("--json", options->json, "file for the report, or - for the standard output");
    command.callback([options, &chosen] { chosen = [options] { return report(*options); }; });
}

} // namespace sinew::tools
