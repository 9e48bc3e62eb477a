// Options that several commands share.
#pragma once

#include "scenes/load.hpp"

#include <string>

namespace CLI {
class App;
}

namespace sinew::tools {

struct SceneOptions {
    std::string file;
    scenes::Overrides overrides;
};

/// SCENE|MESH, --solver, --substeps, --iterations, --voxel, --reversed.
void addSceneOptions(CLI::App& command, SceneOptions& options);

struct DeviceOptions {
    std::string device;
    bool hasValidation = false;
};

/// --device, --validation.
void addDeviceOptions(CLI::App& command, DeviceOptions& options);

/// Loads the scene and prints its warnings to stderr.
scenes::LoadedScene loadScene(const SceneOptions& options);

} // namespace sinew::tools
