// A loaded scene: the scene, its first view and its light, for a window or a headless run.
#pragma once

#include "app/state_file.hpp"
#include "sinew/vk/device.hpp"
#include "viewer/input/input_log.hpp"
#include "viewer/input/tool.hpp"
#include "viewer/jobs/options.hpp"
#include "viewer/render/png.hpp"
#include "viewer/render/scene_light.hpp"
#include "viewer/ui/facts.hpp"

#include <atomic>
#include <memory>

namespace sinew::viewer {

struct WindowOutput;
struct PreparedPlayer;

/// Parameters of a reload: another simulation of the scene on show is to take over from it, because a setting
/// changed that needs one.
struct ReloadRequest {
    sim::Material material; ///< of the new simulation
    sim::Settings settings; ///< with the present capacities
};

struct OpenedScene {
    OpenedScene();
    OpenedScene(OpenedScene&&) noexcept;
    ~OpenedScene();

    scenes::LoadedScene loaded;
    Camera camera;
    bool isFirstView = true; ///< the camera is firstView() for some picture; else it was chosen by a person
    SceneLight light;
    std::optional<float> bladeDepth; ///< initial depth (see CutTool::setDepth)
    std::optional<ReloadRequest> reload;
    std::optional<InputFile> input;   ///< log to play
    std::optional<app::SavedRun> run; ///< state to start from

    std::unique_ptr<vk::Device> device; ///< for a window; the next two use it
    std::unique_ptr<WindowOutput> output;
    std::unique_ptr<PreparedPlayer> prepared;
};

/// Loads the scene, or that of a saved state, and prints its notes and warnings to stderr. The camera is that
/// of the file or the state, or has every body in a picture of aspect ratio `aspect`. Throws as scenes::load
/// and app::readRun.
OpenedScene open(const Options& options, float aspect);

/// Like open(), without output to stderr.
OpenedScene look(const Options& options, float aspect);

/// The camera of the file, moved back for a narrow picture, or one that frames all bodies.
Camera firstView(const scenes::LoadedScene& loaded, float aspect);

/// The initial material: that of the reload or of the saved state, if there is one.
sim::Material firstMaterial(const OpenedScene& opening);

/// Requests a device that can draw, with validation if the options ask for it. Each message goes to stderr
/// and is counted in `messages`, which must outlive the device; any thread increments it.
vk::DeviceRequest deviceRequest(const Options& options, std::atomic<std::size_t>& messages);

/// "organ: 4,211 particles, solver split with 32 substeps, on llvmpipe (software)".
std::string headline(const OpenedScene& opening, const vk::Device& device);

/// The text chunks of every picture file.
PictureText pictureText(const OpenedScene& opening, const vk::Device& device, std::uint64_t step);

/// For the tools of the scene; refers to `opening`.
ToolContext toolContext(const OpenedScene& opening);

} // namespace sinew::viewer
