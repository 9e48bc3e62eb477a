// Options that several commands share.
#pragma once

#include "app/state_file.hpp"
#include "scenes/load.hpp"
#include "sim/scene.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sinew::tools {

/// The forms of kernels that the user asks for, each nothing where not: then defaults or tune() choose.
struct FormOptions {
    std::optional<bool> usesTexels, usesGrids;
    std::optional<std::uint32_t> columns, chunk, residentBytes;

    bool isGiven() const { return usesTexels || usesGrids || columns || chunk || residentBytes; }
    /// `forms` with what is asked for.
    sim::Forms in(sim::Forms forms) const;
};

/// --forms.
void addFormOptions(CLI::App& command, FormOptions& options);

/// The words of --forms.
std::string toText(const sim::Forms& forms);

struct SceneOptions {
    std::string file;
    scenes::Overrides overrides;
    FormOptions forms;
};

/// SCENE|MESH, --solver, --substeps, --iterations, --voxel, --reversed, --forms.
void addSceneOptions(CLI::App& command, SceneOptions& options);

/// A scene to simulate, and the state that it begins in.
struct Start {
    scenes::LoadedScene loaded;
    std::string scene;                ///< absolute path, or the name of a built-in scene
    std::optional<app::SavedRun> run; ///< nothing: the scene's own state
};

/// As loadScene; `options.file` may also be a saved state. The scene is then the one that the state was saved
/// of, with the material and gravity that it had, and its solver and substeps where `options` asks for no
/// others. Throws app::Failure (badInput) where there is no such state.
Start loadStart(const SceneOptions& options);

struct DeviceOptions {
    std::string device;
    bool hasValidation = false;
};

/// --device, --validation.
void addDeviceOptions(CLI::App& command, DeviceOptions& options);

/// Check of an option: a number above 0 and at most 1e6. CLI11's own lets nan through, and inf.
std::string checkPositive(const std::string& text);

/// Loads the scene and prints its notes and warnings to stderr.
scenes::LoadedScene loadScene(const SceneOptions& options);

} // namespace sinew::tools
