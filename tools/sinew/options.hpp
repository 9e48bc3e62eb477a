// Options that several commands share.
#pragma once

#include "app/state_file.hpp"
#include "scenes/load.hpp"
#include "sinew/scene.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sinew::tools {

/// Kernel forms requested by the user; empty ones are chosen by defaults or tune().
struct FormOptions {
    std::optional<bool> usesTexels, usesGrids;
    std::optional<std::uint32_t> columns, chunk, residentBytes;

    /// Whether any is that tune() chooses.
    bool isGiven() const { return usesTexels || usesGrids || columns || chunk || residentBytes; }
    /// `forms` with the requested values.
    sim::Forms in(sim::Forms forms) const;
};

/// Adds --forms.
void addFormOptions(CLI::App& command, FormOptions& options);

struct SceneOptions {
    std::string file;
    scenes::Overrides overrides;
    FormOptions forms;
};

/// Adds SCENE|MESH, --solver, --substeps, --iterations, --voxel, --reversed, --forms.
void addSceneOptions(CLI::App& command, SceneOptions& options);

/// A scene to simulate and its initial state.
struct Start {
    scenes::LoadedScene loaded;
    std::string scene;                ///< absolute path, or the name of a built-in scene
    std::optional<app::SavedRun> run; ///< empty: the scene's own state
};

/// Like loadScene(); `options.file` may also be a saved state. The scene is then that of the state, with the
/// state's material and gravity, and with its solver and substeps unless `options` sets others. Throws
/// app::Failure (badInput) if there is no such state.
Start loadStart(const SceneOptions& options);

struct DeviceOptions {
    std::string device;
    bool hasValidation = false;
};

/// Adds --device and --validation.
void addDeviceOptions(CLI::App& command, DeviceOptions& options);

/// Checks that an option is a number above 0 and at most 1e6. CLI11's own check accepts nan and inf.
std::string checkPositive(const std::string& text);

/// Loads the scene and prints its notes and warnings to stderr.
scenes::LoadedScene loadScene(const SceneOptions& options);

} // namespace sinew::tools
