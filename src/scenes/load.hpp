// Scene files: TOML with the schema of docs/scene-files.md becomes a sim::Scene and its Settings.
#pragma once

#include "mesh/import.hpp"
#include "mesh/to_scene.hpp"
#include "sinew/holds.hpp"
#include "sinew/substeps.hpp"

#include <filesystem>
#include <optional>

namespace sinew::scenes {

/// "cannot read scene: <file:line>: <why>: <what to do>". Exit code 3, as for every file that cannot be read.
class SceneError : public mesh::ImportError {
public:
    using mesh::ImportError::ImportError;
};

/// Where a picture is taken from, when the file says so.
struct Camera {
    sim::Vec3 eye{1.2f, 0.8f, 1.6f}, target{0, 0.2f, 0}; ///< [m]
    float fieldOfView = 40;                              ///< vertical [degrees]
};

/// What a mesh body became, for reports.
struct MeshSummary {
    std::string body, file;
    std::string called;       ///< in sentences: `mesh liver.obj`, `mesh "left" (liver.obj)`
    mesh::MeshReport surface; ///< after repairs
    mesh::Repairs repairs;    ///< of the whole file
    mesh::VoxelGrid voxels;
    mesh::Shown shown = mesh::Shown::mesh;
    std::string odd; ///< "is 190 m long: if the file is in millimetres ..."; empty where its size is usual
};

/// The edge of a blade, a poly-line, at certain times; in between it moves straight.
struct BladeMotion {
    std::string name;
    std::vector<double> times;                 ///< [s] since the start, at least two, ascending
    std::vector<std::vector<sim::Vec3>> edges; ///< one a time, of equally many points [m]
};

/// Properties that bodies have by default, though the scene does not ask for them. A solver without a form
/// for it does without.
struct Defaults {
    std::vector<std::uint32_t> recovery; ///< indices of Scene::grids: Grid::recoveryPressure
    std::vector<std::uint32_t>
        contacts; ///< indices of Scene::bodies: Particle::radius of all their particles
};

struct LoadedScene {
    sim::Scene scene;
    sim::Settings settings;      ///< substeps and levels are numbers
    sim::SubstepChoice substeps; ///< where it comes from
    /// Where the scene's (0, 0, 0) is in the coordinates of the file [m]; 0 but for scenes farther than 16 m
    /// away.
    std::array<double, 3> origin{};
    std::optional<Camera> camera;
    std::optional<float> bladeDepth; ///< with which the viewer's blade begins [m]; empty = through
    std::vector<MeshSummary> meshes;
    std::vector<sim::NamedHold> holds; ///< those with a path first
    std::vector<BladeMotion> blades;   ///< no two of them in one step; ScriptedBlades plays them
    Defaults defaults;
    /// [contacts] rest_contact, for bodies that do not say it (Particle::keepsRest).
    bool keepsRest = false;
    std::vector<std::string> warnings; ///< sentences, such as "mesh bunny.obj is open: 72 boundary edges ..."
    /// Lines that ask for nothing, such as the size and mass of each mesh.
    std::vector<std::string> notes;
};

/// What the command line says over the file.
struct Overrides {
    /// One that has no form for cuts leaves whole what the scene offers for cutting, with a warning; a scene
    /// that cuts or tears by itself is refused.
    std::optional<std::string> solver;
    std::optional<std::uint32_t> substeps; ///< 0 = chosen
    std::optional<std::uint32_t> iterations;
    std::optional<std::uint32_t> levels; ///< coarse levels of `split`; sim::autoLevels = chosen
    std::optional<bool> hasSharpClamp;   ///< Settings::hasSharpClamp
    bool isSharpByDefault = true;        ///< the same, where neither that nor the file says it
    std::optional<float> dt;
    std::optional<float> voxel; ///< cell edge of mesh bodies [m]
    bool isReversed = false;

    /// Takes the clamp of a saved run, unless another one is asked for. Empty: the run is from before the
    /// sharp clamp was the default of scenes.
    void takeClamp(std::optional<bool> isSharp) {
        if (!hasSharpClamp) hasSharpClamp = isSharp;
        isSharpByDefault = isSharp.has_value();
    }
};

/// `argument` is a scene file (TOML) or a mesh file (anything importMesh reads), which is dropped by the
/// scene drop_mesh.toml. Throws SceneError or mesh::ImportError. The result has passed sim::validate.
LoadedScene load(const std::filesystem::path& argument, const Overrides& overrides = {});

/// Warnings that the scene would have had if it had been loaded with `settings`, of which substeps is a
/// number, and does not have.
std::vector<std::string> newWarnings(const LoadedScene& loaded, const sim::Settings& settings);

/// The text of a scene file, which messages call `name`. Files that it names are found from the working
/// folder.
LoadedScene loadText(const std::string& text, const std::string& name, const Overrides& overrides = {});

/// A shipped scene by the name of its file (cloth, cube, organ), from the text built into the program.
LoadedScene loadBuiltIn(const std::string& name, const Overrides& overrides = {});

} // namespace sinew::scenes
