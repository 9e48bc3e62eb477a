// The [[mesh]] and [[mesh_collider]] tables: finds the mesh (a file in the scene's folder, the command
// line's, or a generated shape), places it, fills it with voxels and says what is odd about it.
#include "scenes/bodies.hpp"

#include "mesh/generate.hpp"
#include "mesh/import.hpp"
#include "mesh/walls.hpp"
#include "scenes/mesh_choice.hpp"
#include "scenes/mesh_notes.hpp"
#include "scenes/path.hpp"
#include "scenes/place_mesh.hpp"
#include "scenes/recovery.hpp"
#include "scenes/surface.hpp"
#include "sim/core/counted.hpp"
#include "sinew/bodies.hpp"

#include <algorithm>

namespace sinew::scenes {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostApart = 256; ///< bodies of one mesh

struct Found {
    mesh::TriangleMesh mesh;
    mesh::MeshDefects defects;
    std::string file; // as reports show it
    mesh::Repairs repairs;
    std::vector<std::string> notes; // what follows the name of the mesh
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

mesh::Repair repairOf(const Section& section) {
    const std::string name = section.text("repair");
    const std::optional<mesh::Repair> repair = mesh::findRepair(name);
    if (!repair)
        section.fail("repair", "is no repair: \"" + name.substr(0, 64) + "\"",
                     "possible are \"none\", \"weld\" and \"close\"");
    if (section.has("weld") && *repair == mesh::Repair::none)
        section.fail("weld", "is given, but repair = \"none\" joins nothing", "remove one of them");
    return *repair;
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
    found.mesh = mesh::importMesh(file, found.defects, {}, repairOf(section), &found.repairs,
                                  section.has("weld") ? section.value("weld") : 0);
    const std::string vain =
        section.has("weld") ? vainWeldText(found.repairs, section.value("weld")) : std::string();
    if (!vain.empty()) found.notes.push_back(" " + vain);
    return found;
}

std::string shapeNames() {
    std::string names;
    for (const mesh::Shape& shape : mesh::shapes())
        names += (names.empty() ? "" : ", ") + std::string(shape.name);
    return names;
}

Found generate(const Section& section) {
    if (section.has("weld"))
        section.fail("weld", "is given, but a generated shape has no seams", "remove it");
    const std::string name = section.text("generate");
    if (std::ranges::find(mesh::shapes(), name, &mesh::Shape::name) == mesh::shapes().end())
        section.fail("generate", "names no shape: \"" + name.substr(0, 64) + "\"",
                     "possible are " + shapeNames());
    Found found;
    found.file = name;
    found.mesh = mesh::generate(name, section.count("detail"));
    found.defects = mesh::inspect(found.mesh).defects;
    found.repairs.how = mesh::Repair::close; // which has nothing to do
    return found;
}

/// The mesh of a section: all of its file or shape, or the objects that it names.
Found find(const Section& section, const Source& source) {
    Found found = section.has("file") ? import(section, source) : generate(section);
    if (found.mesh.triangles.empty()) section.fail("file", "has no triangles", "check the mesh");
    if (chooseObjects(found.mesh, section, found.file)) {
        found.defects = mesh::inspect(found.mesh).defects;
        found.repairs = mesh::repairsOf(found.mesh, found.repairs);
        found.notes.push_back(": " + choiceText(found.mesh));
    }
    return found;
}

/// Notes and warnings of what a table has from its file.
void sayFound(LoadedScene& loaded, const std::string& called, const mesh::Repairs& repairs,
              const std::vector<std::string>& notes, bool hasParts) {
    for (const std::string& note : notes) loaded.notes.push_back(called + note);
    noteRepairs(loaded, called, repairs);
    warnOfSeam(loaded, called, repairs, hasParts);
}

std::string nameOf(const Section& section, const Found& found) {
    return section.has("name") ? section.text("name") : fs::path(found.file).stem().string();
}

bool isApart(const Section& section) {
    const std::string parts = section.text("parts");
    if (parts != "joined" && parts != "apart")
        section.fail("parts", "is \"" + parts.substr(0, 64) + "\"", "possible are joined, apart");
    return parts == "apart";
}

void checkVoxelKeys(const Section& section) {
    if (section.has("voxel") && section.has("resolution"))
        section.fail("resolution", "is given beside voxel", "give one of them");
    if (!section.has("particles")) return;
    if (section.has("voxel") || section.has("resolution"))
        section.fail("particles",
                     section.has("voxel") ? "is given beside voxel" : "is given beside resolution",
                     "give one of them");
    if (isApart(section))
        section.fail("particles", "is given, but bodies apart have one size of voxels",
                     "give voxel or resolution");
}

mesh::MeshBody bodyOf(const LoadedScene& loaded, const Section& section, std::optional<float> voxel) {
    mesh::MeshBody body{.youngModulus = section.number("young_modulus"),
                        .poissonRatio = section.number("poisson_ratio"),
                        .density = section.number("density"),
                        .touchesParticles = isColliding(loaded, section),
                        .isCuttable = section.flag("cuttable"),
                        .tearStrain = tearStrainOf(section),
                        .tearsPerStep = section.count("tears_per_step"),
                        .toughness = toughnessOf(section),
                        .color = section.vector("color")};
    body.voxels.resolution = section.count("resolution");
    if (section.has("voxel")) body.voxels.spacing = section.number("voxel");
    if (section.has("particles") && !voxel) body.mostParticles = section.count("particles");
    if (voxel) body.voxels.spacing = *voxel;
    return body;
}

double longestSide(const mesh::MeshReport& surface) {
    return std::max({double{surface.high.x} - double{surface.low.x},
                     double{surface.high.y} - double{surface.low.y},
                     double{surface.high.z} - double{surface.low.z}});
}

/// A sentence "fact: cure" as those two; both empty where it is.
std::pair<std::string, std::string> splitAtColon(const std::string& sentence) {
    const std::size_t colon = sentence.find(": ");
    if (colon == std::string::npos) return {};
    return {sentence.substr(0, colon), sentence.substr(colon + 2)};
}

/// Fills a mesh with voxels. `summary` says how it is called. `longest` is the side that has as many voxels
/// as the section's resolution [m].
const MeshSummary& addBody(LoadedScene& loaded, const Section& section, const mesh::TriangleMesh& mesh,
                           mesh::MeshBody body, MeshSummary summary, double longest) {
    body.name = summary.body;
    body.recovery = recoveryOf(loaded, section, body.name);
    body.voxels.maxCells = mostParticles - loaded.scene.particles.size();
    body.mostParticles = std::min(body.mostParticles, body.voxels.maxCells);
    const mesh::MeshDefects defects = summary.surface.defects;
    summary.surface = mesh::measure(mesh);
    summary.surface.defects = defects;
    try {
        mesh::AddedMesh added = addWithRecovery(loaded, section, mesh, body);
        summary.voxels = std::move(added.voxels);
        summary.shown = added.shown;
    } catch (const std::length_error& error) {
        // a mesh in millimetres that is taken for metres asks for other words than a fine voxel
        const auto [extent, cure] = splitAtColon(oddSizeOf(section, summary.surface));
        section.fail("voxel",
                     std::string("is too small for this mesh (") + error.what() + ")" +
                         (extent.empty() ? "" : ", which " + extent),
                     cure.empty() ? "give larger voxels" : cure + ", or give larger voxels");
    } catch (const std::domain_error& error) {
        section.fail(body.isCuttable             ? "cuttable"
                     : body.poissonRatio > 0.25f ? "poisson_ratio"
                                                 : "recovery",
                     std::string("is not possible: ") + error.what(), "move the body nearer to the origin");
    }
    const double mass = double{body.density} * double{loaded.scene.bodies.back().restVolume};
    summary.odd = oddSizeOf(section, summary.surface);
    noteSize(loaded, summary.called, section, summary.surface,
             ", " + massText(mass) + ", " + voxelText(summary.voxels));
    warnOfDefects(summary, loaded.warnings);
    const double voxelEdge = double{summary.voxels.spacing};
    const std::string thin = thinText(mesh::wallThickness(mesh, thinnestShare), longest, voxelEdge,
                                      section.has("voxel") || section.has("particles"));
    if (!thin.empty()) loaded.warnings.push_back(summary.called + " " + thin);
    return loaded.meshes.emplace_back(std::move(summary));
}

/// A body for each component, all with the voxels that the whole mesh would have. `given` is the mesh before
/// it was placed.
void addApart(LoadedScene& loaded, const Section& section, const std::string& called, const Found& found,
              const mesh::TriangleMesh& given, const std::vector<mesh::Component>& components,
              mesh::MeshBody body) {
    if (components.size() > mostApart)
        section.fail("parts",
                     "makes " + std::to_string(components.size()) + " bodies of the components of " +
                         found.file + ", more than " + std::to_string(mostApart),
                     "choose some of them by object");
    body.voxels.spacing = mesh::cellEdge(found.mesh, body.voxels);
    const double longest = longestSide(mesh::measure(found.mesh));
    for (const mesh::Component& component : components) {
        const mesh::TriangleMesh part = mesh::extract(found.mesh, component);
        MeshSummary summary{.body = nameOf(section, found) + "." + component.name,
                            .file = found.file + ", \"" + component.name + "\"",
                            .called = called + ", \"" + component.name + "\"",
                            .repairs = mesh::repairsOf(mesh::extract(given, component), found.repairs)};
        summary.surface.defects = mesh::inspect(part).defects;
        addBody(loaded, section, part, body, std::move(summary), longest);
    }
}

void addJoined(LoadedScene& loaded, const Section& section, const std::string& called, const Found& found,
               const std::vector<mesh::Component>& components, const mesh::MeshBody& body) {
    MeshSummary summary{
        .body = nameOf(section, found), .file = found.file, .called = called, .repairs = found.repairs};
    summary.surface.defects = found.defects;
    const MeshSummary& added = addBody(loaded, section, found.mesh, body, std::move(summary),
                                       longestSide(mesh::measure(found.mesh)));
    noteComponents(loaded, called, components);
    const std::string inward = inwardText(components, found.repairs.how);
    if (!inward.empty()) loaded.warnings.push_back(called + " " + inward);
    if (section.has("parts")) return;
    const mesh::Bridges between = mesh::findBridges(found.mesh, components, added.voxels);
    for (const std::string& overlap : overlapTexts(between)) loaded.notes.push_back(called + ": " + overlap);
    const std::string bridges = bridgesText(between, double{added.voxels.spacing});
    if (!bridges.empty())
        loaded.warnings.push_back(
            called + " " + bridges +
            ": parts = \"apart\" keeps them apart, parts = \"joined\" says that it is meant");
}

} // namespace

void addMesh(LoadedScene& loaded, const Section& section, const Source& source, std::optional<float> voxel,
             FaceChoices& faces) {
    section.requireOneOf("file", "generate");
    checkVoxelKeys(section);
    Found found = find(section, source);
    const mesh::TriangleMesh given = isApart(section) ? found.mesh : mesh::TriangleMesh{};
    const bool isDropped = section.has("size") && section.has("file") && section.text("file") == "argument";
    const double longest = isDropped ? longestSide(mesh::measure(found.mesh)) : 0; // in units of the file
    place(found.mesh, section, loaded.origin);
    const std::vector<mesh::Component> components = mesh::components(found.mesh);
    const std::string called = calledIn(loaded, section, "mesh", found.file);
    if (isDropped) loaded.notes.push_back(called + " " + scaledText(longest, section.value("size")));
    sayFound(loaded, called, found.repairs, found.notes, section.has("object") || components.size() > 1);
    const mesh::MeshBody body = bodyOf(loaded, section, voxel);
    const std::size_t first = loaded.scene.particles.size(), firstGrid = loaded.scene.grids.size();
    const std::size_t firstBody = loaded.scene.bodies.size();
    if (isApart(section) && components.size() > 1)
        addApart(loaded, section, called, found, given, components, body);
    else
        addJoined(loaded, section, called, found, components, body);
    addSurface(loaded, section, first);
    noteDefaultContacts(loaded, section, firstBody);
    faces.add(loaded, section, firstGrid);
    letBeAbsent(loaded, section, firstBody);
}

PlacedMesh placedMesh(const Section& section, const Source& source, const std::array<double, 3>& origin) {
    Found found = find(section, source);
    const sim::Vec3 middle = place(found.mesh, section, origin);
    const std::string odd = oddSizeOf(section, mesh::measure(found.mesh));
    return {std::move(found.mesh), middle, found.file, found.repairs, std::move(found.notes), odd};
}

void addMeshCollider(LoadedScene& loaded, const Section& section, const Source& source) {
    section.requireOneOf("file", "generate");
    const PlacedMesh found = placedMesh(section, source, loaded.origin);
    if (loaded.scene.particles.size() + found.mesh.positions.size() > mostParticles)
        section.fail(section.has("file") ? "file" : "detail",
                     "makes more than " + std::to_string(mostParticles) + " particles",
                     "take a coarser mesh");
    const std::string called = calledIn(loaded, section, "mesh collider", found.file);
    noteSize(loaded, called, section, mesh::measure(found.mesh),
             ", " + sim::counted(found.mesh.triangles.size(), "triangle"));
    sayFound(loaded, called, found.repairs, found.notes, section.has("object"));
    const sim::Pose pose{found.middle, rotationOf(section)};
    Path path = readPath(loaded, section, pose);
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
