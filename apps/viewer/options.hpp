// The command line of sinew-viewer.
#pragma once

#include "scenes/load.hpp"
#include "viewer/draw/layers.hpp"

#include <vulkan/vulkan_core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

struct Options {
    std::string scene;             ///< file; empty = the built-in one
    std::string builtIn = "organ"; ///< as scenes::loadBuiltIn
    scenes::Overrides overrides;
    std::string device; ///< as vk::DeviceRequest::device
    bool hasValidation = false;
    VkExtent2D size{1280, 720};
    bool hasSize = false;                        ///< asked for: a window does not begin as it was left
    std::optional<bool> isVsync, arePanelsShown; ///< instead of what was chosen in the window
    std::optional<float> scale;                  ///< of texts, likewise
    bool isFullScreen = false;
    std::optional<float> bladeDepth; ///< as CutTool::setDepth
    Layers layers;
    std::string beside;   ///< as parseBeside; empty = none
    bool isTimed = false; ///< Timing
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now(); ///< of the program

    std::filesystem::path replay; ///< a log of input; empty = none

    bool isHeadless = false;
    std::uint64_t frames = 240;          ///< steps to take without a window
    bool hasFrames = false;              ///< asked for: else all of a replay
    std::filesystem::path folder;        ///< for frame_0000.png ...; empty = no pictures
    std::filesystem::path video;         ///< MP4; empty = none
    std::uint64_t every = 1;             ///< a picture of each so many frames, frame 0 included
    std::vector<std::uint64_t> pictured; ///< or of these frames only; sorted

    bool wantsPicture(std::uint64_t frame) const;
};

/// Empty where help or version was asked for and printed. Throws app::Failure (wrongUsage).
std::optional<Options> parseOptions(int argc, const char* const* argv);

} // namespace sinew::viewer
