// The [[mesh]] and [[mesh_collider]] tables: finds the mesh (a file in the scene's folder, the command
// line's, or a generated shape), places it, fills it with voxels and says what is odd about it.
#include "scenes/bodies.hpp"

#include "mesh/generate.hpp"
#include "mesh/import.hpp"
#include "scenes/mesh_notes.hpp"
#include "scenes/path.hpp"
#include "scenes/place_mesh.hpp"
#include "scenes/surface.hpp"
#include "sim/bodies.hpp"

#include <algorithm>

namespace sinew::scenes {

namespace {

namespace fs = std::filesystem;

struct Found {
    mesh::TriangleMesh mesh;
    mesh::MeshDefects defects;
    std::string file; // as reports show it
};

/// Resolves links first, so that none leads out of the folder.
fs::path insideFolder(const Section& section, const Source& source) {
    const fs::path wanted = section.text("file");
    std::error_code error;
    const fs::path folder =
        fs::weakly_canonical(source.folder.empty() ? fs::path(".") : source.folder, error);
    const fs::path file = fs::weakly_canonical(folder / wanted, error);
    const auto [folderEnd, fileEnd] = std::ranges::mismatch(folder, file);
    if (error || wanted.is_absolute() || folderEnd != folder.end())
        section.fail("file", "leaves the scene's folder", "put the mesh beside the scene");
    return file;
}

Found import(const Section& section, const Source& source) {
    const bool isArgument = section.text("file") == "argument";
    if (isArgument && !source.meshArgument)
        section.fail("file", "is the mesh of the command line, but the scene was given",
                     "give a mesh file instead of this scene");
    const fs::path file = isArgument ? *source.meshArgument : insideFolder(section, source);
    std::error_code error;
    if (!isArgument && !fs::is_regular_file(file, error))
        section.fail("file", "names no regular file", "check the path");
    Found found;
    found.file = file.filename().string();
    found.mesh = mesh::importMesh(file, found.defects);
    return found;
}

std::string shapeNames() {
    std::string names;
    for (const mesh::Shape& shape : mesh::shapes())
        names += (names.empty() ? "" : ", ") + std::string(shape.name);
    return names;
}

Found generate(const Section& section) {
    const std::string name = section.text("generate");
    if (std::ranges::find(mesh::shapes(), name, &mesh::Shape::name) == mesh::shapes().end())
        section.fail("generate", "names no shape: \"" + name.substr(0, 64) + "\"",
                     "possible are " + shapeNames());
    Found found;
    found.file = name;
    found.mesh = mesh::generate(name, section.count("detail"));
    found.defects = mesh::inspect(found.mesh).defects;
    return found;
}

} // namespace

void addMesh(LoadedScene& loaded, const Section& section, const Source& source, std::optional<float> voxel,
             FaceChoices& faces) {
    section.requireOneOf("file", "generate");
    if (section.has("voxel") && section.has("resolution"))
        section.fail("resolution", "is given beside voxel", "give one of them");
    if (section.has("particles") && (section.has("voxel") || section.has("resolution")))
        section.fail("particles",
                     section.has("voxel") ? "is given beside voxel" : "is given beside resolution",
                     "give one of them");
    Found found = section.has("file") ? import(section, source) : generate(section);
    if (found.mesh.triangles.empty()) section.fail("file", "has no triangles", "check the mesh");
    place(found.mesh, section, loaded.origin);

    MeshSummary summary{.body =
                            section.has("name") ? section.text("name") : fs::path(found.file).stem().string(),
                        .file = found.file};
    summary.surface = mesh::inspect(found.mesh);
    summary.surface.defects = found.defects;
    mesh::MeshBody body{.name = summary.body,
                        .youngModulus = section.number("young_modulus"),
                        .poissonRatio = section.number("poisson_ratio"),
                        .recovery = section.number("recovery"),
                        .density = section.number("density"),
                        .touchesParticles = section.flag("collides"),
                        .isCuttable = section.flag("cuttable"),
                        .tearStrain = tearStrainOf(section),
                        .tearsPerStep = section.count("tears_per_step"),
                        .color = section.vector("color")};
    body.voxels.resolution = section.count("resolution");
    if (section.has("voxel")) body.voxels.spacing = section.number("voxel");
    if (voxel) body.voxels.spacing = *voxel;
    body.voxels.maxCells = mostParticles - loaded.scene.particles.size();
    if (section.has("particles") && !voxel)
        body.mostParticles = std::min<std::size_t>(section.count("particles"), body.voxels.maxCells);
    const std::size_t first = loaded.scene.particles.size(), firstGrid = loaded.scene.grids.size();
    try {
        mesh::AddedMesh added = mesh::addMesh(loaded.scene, found.mesh, body);
        summary.voxels = std::move(added.voxels);
        summary.shown = added.shown;
    } catch (const std::length_error& error) {
        section.fail("voxel", std::string("is too small for this mesh (") + error.what() + ")",
                     "give larger voxels");
    } catch (const std::domain_error& error) {
        section.fail(body.isCuttable             ? "cuttable"
                     : body.poissonRatio > 0.25f ? "poisson_ratio"
                                                 : "recovery",
                     std::string("cannot be had: ") + error.what(), "move the body nearer to the origin");
    }
    addSurface(loaded, section, first);
    faces.add(loaded, section, firstGrid);
    const double mass = double{body.density} * double{loaded.scene.bodies.back().restVolume};
    noteSize(loaded, "mesh " + found.file, section, summary.surface,
             ", " + massText(mass) + ", " + voxelText(summary.voxels));
    warnOfDefects(summary, loaded.warnings);
    loaded.meshes.push_back(std::move(summary));
}

PlacedMesh placedMesh(const Section& section, const Source& source, const std::array<double, 3>& origin) {
    Found found = section.has("file") ? import(section, source) : generate(section);
    if (found.mesh.triangles.empty()) section.fail("file", "has no triangles", "check the mesh");
    const sim::Vec3 middle = place(found.mesh, section, origin);
    return {std::move(found.mesh), middle, found.file};
}

void addMeshCollider(LoadedScene& loaded, const Section& section, const Source& source) {
    section.requireOneOf("file", "generate");
    const PlacedMesh found = placedMesh(section, source, loaded.origin);
    if (loaded.scene.particles.size() + found.mesh.positions.size() > mostParticles)
        section.fail(section.has("file") ? "file" : "detail",
                     "makes more than " + std::to_string(mostParticles) + " particles",
                     "take a coarser mesh");
    noteSize(loaded, "mesh collider " + found.file, section, mesh::inspect(found.mesh),
             ", " + std::to_string(found.mesh.triangles.size()) + " triangles");
    const sim::Pose pose{found.middle, rotationOf(section)};
    Path path = readPath(section, loaded.origin, pose);
    const std::size_t first = loaded.scene.particles.size();
    sim::addMeshCollider(loaded.scene, {.name = section.has("name") ? section.text("name")
                                                                    : fs::path(found.file).stem().string(),
                                        .vertices = found.mesh.positions,
                                        .triangles = found.mesh.triangles,
                                        .thickness = section.number("thickness"),
                                        .pose = pose,
                                        .path = std::move(path.keyframes),
                                        .pathEnd = path.end,
                                        .color = section.vector("color")});
    addSurface(loaded, section, first);
}

} // namespace sinew::scenes
