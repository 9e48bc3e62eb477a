// What a window and a headless run begin with: the scene, the first view of it, its light.
#pragma once

#include "app/state_file.hpp"
#include "viewer/draw/png.hpp"
#include "viewer/draw/stage_light.hpp"
#include "viewer/hands/input_log.hpp"
#include "viewer/options.hpp"
#include "viewer/panels/facts.hpp"
#include "vk/device.hpp"

#include <atomic>
#include <memory>

namespace sinew::viewer {

struct Place;
struct PreparedShow;

/// Of the simulation on show, which another one of its scene is to take over from because something was
/// turned that needs one.
struct Again {
    sim::Material material; ///< that the other one is to have
    sim::Settings settings; ///< with the room that there is
};

struct Opening {
    Opening();
    Opening(Opening&&) noexcept;
    ~Opening();

    scenes::LoadedScene loaded;
    Camera camera;
    StageLight light;
    std::optional<float> bladeDepth; ///< to begin with, as CutTool::setDepth
    std::optional<Again> again;
    std::optional<InputFile> input;   ///< to be played
    std::optional<app::SavedRun> run; ///< to go on from

    std::unique_ptr<vk::Device> device; ///< for a window; the next two are on it
    std::unique_ptr<Place> place;
    std::unique_ptr<PreparedShow> prepared;
};

/// Loads the scene, or that of a saved state, prints its notes and warnings to stderr and looks at it: from
/// where the file or the state says, or with every body in a picture `aspect` wide. Throws as scenes::load
/// and app::readRun.
Opening open(const Options& options, float aspect);

/// The same without a word on stderr.
Opening look(const Options& options, float aspect);

/// What the scene is to be of from the start: of what it goes on from.
sim::Material firstMaterial(const Opening& opening);

/// Asks for a device that draws, and for validation where the options do; each message goes to stderr and is
/// counted in `messages`, which must outlive the device and is counted up in any thread.
vk::DeviceRequest deviceRequest(const Options& options, std::atomic<std::size_t>& messages);

/// "organ: 4,211 particles, solver split with 32 substeps, on llvmpipe (software)".
std::string headline(const Opening& opening, const vk::Device& device);

/// What every picture file says about itself.
PictureText pictureText(const Opening& opening, const vk::Device& device, std::uint64_t step);

} // namespace sinew::viewer
