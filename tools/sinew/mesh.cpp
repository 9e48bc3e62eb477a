// `sinew mesh`: imports a mesh, fills it with voxels and warns of oddities. Uses a GPU if there is one but
// needs no device: the voxels are equal, and the host is faster than a software device.
#include "app/guard.hpp"
#include "mesh/components.hpp"
#include "mesh/gpu/voxelise.hpp"
#include "mesh/import.hpp"
#include "mesh/voxelise.hpp"
#include "mesh/walls.hpp"
#include "scenes/mesh_choice.hpp"
#include "scenes/mesh_notes.hpp"
#include "scenes/place_mesh.hpp"
#include "sim/core/counted.hpp"
#include "sinew/commands.hpp"
#include "sinew/json.hpp"
#include "sinew/outputs.hpp"
#include "sinew/report.hpp"
#include "sinew/session.hpp"
#include "sinew/vk/check.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace sinew::tools {

namespace {

constexpr std::size_t mostListed = 10; // components

struct MeshOptions {
    std::string file;
    std::string unit = "m";
    float scale = 1;
    std::vector<std::string> objects; // empty = all
    float voxel = 0;                  // [m]; 0 = by resolution
    std::uint32_t resolution = 24;
    std::optional<std::uint32_t> particles; // upper limit; instead of the two above
    std::string repair = "close";
    double weld = 0; // [units of the file]; 0 = by the file's size
    DeviceOptions device;
    std::optional<std::string> json;
};

struct Findings {
    std::string file;
    mesh::TriangleMesh mesh;
    mesh::MeshReport surface;
    mesh::Repairs repairs;
    std::vector<mesh::Component> components;
    mesh::VoxelGrid voxels;
    mesh::Bridges bridges;
    std::string vainWeld; // a sentence if --weld joins nothing
    std::string filledBy; // name of a device, or "host"
    std::vector<std::string> validationMessages;
    std::size_t bytes() const {
        return voxels.voxels.size() * (sizeof(mesh::Voxel) + sizeof(float)) + voxels.workBytes;
    }
};

bool isGpuThere() {
    try {
        const vk::Loader loader;
        for (const vk::DeviceDescription& device : vk::listDevices(loader.getInstanceProcAddr(), {}))
            if (device.isChosen) return device.type != "software";
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::noDevice) throw;
    }
    return false;
}

mesh::VoxelGrid fill(const MeshOptions& options, const mesh::TriangleMesh& mesh,
                     const mesh::Voxelise& voxelise) {
    const mesh::VoxelRequest request{.spacing = options.voxel, .resolution = options.resolution};
    return options.particles ? mesh::voxeliseWithin(*options.particles, mesh, request, voxelise)
                             : voxelise(mesh, request);
}

// False if the device has too little memory.
bool fillOnDevice(const MeshOptions& options, Findings& found) {
    Session session(options.device);
    mesh::gpu::Voxeliser voxelise(session.device, session.queue);
    found.filledBy = session.device.description().name;
    try {
        found.voxels = fill(options, found.mesh, std::ref(voxelise));
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        return false;
    }
    found.validationMessages = session.device.validationMessages();
    return true;
}

void fill(const MeshOptions& options, Findings& found) {
    const bool wantsDevice = !options.device.device.empty() || isGpuThere();
    if (wantsDevice && fillOnDevice(options, found)) return;
    found.filledBy = "host";
    found.voxels = fill(options, found.mesh, mesh::voxelise);
}

void chooseObjects(const MeshOptions& options, Findings& found, mesh::MeshDefects& defects) {
    if (options.objects.empty()) return;
    std::string unknown;
    std::optional<mesh::TriangleMesh> chosen = mesh::choose(found.mesh, options.objects, unknown);
    if (!chosen) {
        const auto [why, whatToDo] = scenes::unknownObject(found.mesh, options.file, unknown);
        throw app::Failure(app::badInput, "cannot choose from mesh: --object " + why + ": " + whatToDo);
    }
    if (chosen->triangles.empty())
        throw app::Failure(app::badInput, "cannot choose from mesh: --object has no triangles in " +
                                              options.file + ": name another");
    found.mesh = std::move(*chosen);
    found.repairs = mesh::repairsOf(found.mesh, found.repairs);
    defects = mesh::inspect(found.mesh).defects;
}

// `surface` is in the units of the file; `factor` converts them to metres.
void checkScale(const MeshOptions& options, const mesh::MeshReport& surface, double factor) {
    double longest = 0, farthest = 0;
    for (float mesh::Vec3::*axis : {&mesh::Vec3::x, &mesh::Vec3::y, &mesh::Vec3::z}) {
        const double low = double{surface.low.*axis}, high = double{surface.high.*axis};
        longest = std::max(longest, high - low);
        farthest = std::max(farthest, std::abs(low + high) / 2);
    }
    const std::string why = scenes::unplaceable(longest * factor, farthest * factor);
    if (!why.empty())
        throw app::Failure(app::badInput,
                           fmt::format("cannot scale mesh: {}: --unit {} with --scale {:g} {}: give another",
                                       options.file, options.unit, options.scale, why));
}

Findings inspect(const MeshOptions& options) {
    Findings found{.file = options.file};
    mesh::MeshDefects defects;
    found.mesh = mesh::importMesh(options.file, defects, {}, *mesh::findRepair(options.repair),
                                  &found.repairs, options.weld);
    found.vainWeld = scenes::vainWeldText(found.repairs, options.weld, scenes::Words::commandLine);
    chooseObjects(options, found, defects);
    const double factor = scenes::findUnit(options.unit)->metres * double{options.scale};
    checkScale(options, mesh::measure(found.mesh), factor);
    for (mesh::Vec3& position : found.mesh.positions)
        for (float mesh::Vec3::*axis : {&mesh::Vec3::x, &mesh::Vec3::y, &mesh::Vec3::z})
            position.*axis = static_cast<float>(factor * double{position.*axis});
    found.surface = mesh::measure(found.mesh);
    found.surface.defects = defects;
    found.components = mesh::components(found.mesh);
    try {
        fill(options, found);
    } catch (const std::length_error& error) {
        throw app::Failure(app::badInput, "cannot fill mesh: " + options.file + ": " + error.what() +
                                              ": use a larger --voxel");
    }
    found.bridges = mesh::findBridges(found.mesh, found.components, found.voxels);
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

Json componentsJson(const std::vector<mesh::Component>& components) {
    Json largest = Json::array();
    for (std::size_t i = 0; i < components.size() && i < mostListed; ++i)
        largest.push_back({{"name", components[i].name},
                           {"triangles", components[i].triangles.size()},
                           {"volume", components[i].isClosed ? Json(components[i].volume) : Json(nullptr)},
                           {"cavities", components[i].cavities},
                           {"inside_out", components[i].isInward}});
    return {{"count", components.size()}, {"largest", largest}};
}

std::string componentsText(const std::vector<mesh::Component>& components) {
    std::string text = fmt::format("  components {}\n", components.size());
    for (std::size_t i = 0; i < components.size() && i < mostListed; ++i)
        text += "    " + describe(components[i]) + "\n";
    if (components.size() > mostListed)
        text += fmt::format("    and {}\n", sim::counted(components.size() - mostListed, "smaller one"));
    return text;
}

std::string toJson(const Findings& found) {
    Json json{{"schema", reportSchema}, {"file", found.file}};
    json["surface"] = surfaceJson(found);
    json["repair"] = tools::toJson(found.repairs);
    json["components"] = componentsJson(found.components);
    json["voxels"] = {{"spacing", found.voxels.spacing},
                      {"cells", found.voxels.cells},
                      {"hull", found.voxels.hullCount},
                      {"core", found.voxels.coreCount},
                      {"doubtful", found.voxels.doubtful},
                      {"volume", found.voxels.filledVolume},
                      {"particles", mesh::particleCount(found.voxels)},
                      {"filled_by", found.filledBy},
                      {"bytes", found.bytes()}};
    return dump(json);
}

std::string toText(const Findings& found) {
    const mesh::MeshReport& surface = found.surface;
    const mesh::MeshDefects& defects = surface.defects;
    const mesh::VoxelGrid& grid = found.voxels;
    std::string text = fmt::format("{}: {}, {}\n", found.file,
                                   sim::counted(found.mesh.positions.size(), "vertex", "vertices"),
                                   sim::counted(found.mesh.triangles.size(), "triangle"));
    text += fmt::format(
        "  size      {:.4g} x {:.4g} x {:.4g} m around ({:.4g}, {:.4g}, {:.4g}), area {:.4g} m^2\n",
        surface.high.x - surface.low.x, surface.high.y - surface.low.y, surface.high.z - surface.low.z,
        (surface.high.x + surface.low.x) / 2, (surface.high.y + surface.low.y) / 2,
        (surface.high.z + surface.low.z) / 2, surface.area);
    if (defects.isClosed())
        text += fmt::format("  surface   closed, volume {:.4g} m^3{}\n", surface.volume,
                            surface.volume < 0 ? ": it is inside out" : "");
    else
        text += fmt::format("  surface   {}, {}\n", sim::counted(defects.boundaryEdges, "boundary edge"),
                            sim::counted(defects.nonManifoldEdges, "non-manifold edge"));
    text += fmt::format("  defects   {}, {} degenerate and {} duplicate triangles dropped\n",
                        sim::counted(defects.flippedEdges, "flipped edge"), defects.degenerateTriangles,
                        defects.duplicateTriangles);
    for (const std::string& sentence : mesh::sentencesOf(found.repairs))
        text += fmt::format("  repaired  {}\n", sentence);
    if (defects.boundaryEdges > 0)
        text +=
            fmt::format("  open      {}: {} if the mesh is to have an inside\n",
                        found.repairs.openEdges == defects.boundaryEdges
                            ? mesh::openText(found.repairs)
                            : sim::counted(defects.boundaryEdges, "boundary edge"),
                        found.repairs.how == mesh::Repair::close ? "close it in a mesh editor"
                                                                 : "try --repair close, or a mesh editor,");
    text += componentsText(found.components);
    for (const std::string& sentence : scenes::overlapTexts(found.bridges))
        text += fmt::format("  overlap   {}\n", sentence);
    text +=
        fmt::format("  voxels    {} hull + {} core of {} x {} x {}, edge {:.4g} m, {} of {} cells doubtful\n",
                    grid.hullCount, grid.coreCount, grid.cells[0], grid.cells[1], grid.cells[2], grid.spacing,
                    grid.doubtful, grid.voxels.size());
    text += fmt::format("  filled    {:.4g} m^3, {}\n", grid.filledVolume,
                        sim::counted(mesh::particleCount(grid), "particle"));
    return text + fmt::format("  filled by {}, {:.1f} MiB: {:.0f} bytes a cell\n", found.filledBy,
                              static_cast<double>(found.bytes()) / (1 << 20),
                              static_cast<double>(found.bytes()) / static_cast<double>(grid.voxels.size()));
}

// Warns of likely mistakes: a wrong unit, components that voxels join, and walls that are too thin for the
// voxels.
std::vector<std::string> surprises(const MeshOptions& options, const Findings& found) {
    const mesh::MeshReport& surface = found.surface;
    const double longest = std::max({double{surface.high.x} - double{surface.low.x},
                                     double{surface.high.y} - double{surface.low.y},
                                     double{surface.high.z} - double{surface.low.z}}),
                 voxel = double{found.voxels.spacing};
    std::vector<std::string> sentences{
        scenes::oddSize(longest, *scenes::findUnit(options.unit), scenes::Words::commandLine),
        scenes::seamText(found.repairs, !options.objects.empty() || found.components.size() > 1,
                         scenes::Words::commandLine),
        found.vainWeld,
        scenes::bridgesText(found.bridges, voxel),
        scenes::inwardText(found.components, found.repairs.how, scenes::Words::commandLine),
        scenes::thinText(mesh::wallThickness(found.mesh, scenes::thinnestShare), longest, voxel,
                         options.voxel > 0 || options.particles, scenes::Words::commandLine)};
    std::erase(sentences, "");
    return sentences;
}

int report(const MeshOptions& options) {
    std::optional<TextOutput> json;
    if (options.json) json.emplace(*options.json);
    const Findings found = inspect(options);
    for (const std::string& message : found.validationMessages)
        std::fprintf(stderr, "validation: %s\n", message.c_str());
    for (const std::string& sentence : surprises(options, found))
        std::fprintf(stderr, "warning: %s %s\n", options.file.c_str(), sentence.c_str());
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
    command
        .add_option(
            "--object", options->objects,
            "an object of the file, or a component (\"part 1\" is the largest), by name; may be given "
            "several times, all without it")
        ->allow_extra_args(false);
    command
        .add_option("--unit", options->unit, "unit of the coordinates in the file: " + scenes::unitNames())
        ->check([](const std::string& name) {
            return scenes::findUnit(name) ? "" : name + " is not a unit: possible are " + scenes::unitNames();
        })
        ->capture_default_str();
    command.add_option("--scale", options->scale, "factor on the coordinates, in addition to --unit")
        ->check(checkPositive)
        ->capture_default_str();
    CLI::Option* voxel = command.add_option("--voxel", options->voxel, "edge of a voxel [m]");
    voxel->check(checkPositive);
    command.add_option("--resolution", options->resolution, "voxels along the longest side")
        ->check(CLI::Range(1, 512))
        ->capture_default_str()
        ->excludes(voxel);
    command
        .add_option("--particles", options->particles,
                    "limit of particles: takes the finest voxels within it")
        ->check(CLI::Range(8, 2'000'000))
        ->excludes(voxel)
        ->excludes("--resolution");
    command
        .add_option(
            "--repair", options->repair,
            "none, weld (join near vertices, split T-junctions), or close (also close small holes, turn "
            "flipped triangles and parts)")
        ->check(CLI::IsMember({"none", "weld", "close"}))
        ->capture_default_str();
    command
        .add_option("--weld", options->weld,
                    "distance below which open edges are joined, in units of the file; default: a "
                    "hundred-thousandth of its size")
        ->check(checkPositive);
    addDeviceOptions(command, options->device);
    command.add_option("--json", options->json, "file for the report, or - for the standard output");
    command.callback([options, &chosen] {
        if (options->weld > 0 && options->repair == mesh::nameOf(mesh::Repair::none))
            throw CLI::ValidationError("--weld",
                                       "is given, but --repair none joins nothing: remove one of them");
        chosen = [options] { return report(*options); };
    });
}

} // namespace sinew::tools
