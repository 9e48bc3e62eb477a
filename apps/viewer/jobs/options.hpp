// The command line of sinew-viewer.
#pragma once

#include "scenes/load.hpp"
#include "viewer/render/layers.hpp"

#include <vulkan/vulkan_core.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sinew::viewer {

struct Options {
    std::string scene;                    ///< file; empty = built-in scene
    std::string builtIn = "organ_draped"; ///< see scenes::loadBuiltIn
    scenes::Overrides overrides;
    std::string device; ///< see vk::DeviceRequest::device
    bool hasValidation = false;
    VkExtent2D size{1280, 720};
    bool hasSize = false;                        ///< requested: the window ignores its remembered size
    std::optional<bool> isVsync, arePanelsShown; ///< instead of the remembered choice
    std::optional<float> scale;                  ///< of texts, instead of the remembered one
    bool isFullScreen = false;
    std::optional<float> bladeDepth; ///< see CutTool::setDepth
    Layers layers;
    std::string beside;   ///< see parseBeside(); empty = none
    bool isTimed = false; ///< see Timing
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now(); ///< of the program

    std::filesystem::path replay; ///< input log; empty = none

    bool isHeadless = false;
    std::uint64_t frames = 240;          ///< steps without a window
    bool hasFrames = false;              ///< requested; otherwise the length of a replay
    std::filesystem::path folder;        ///< for frame_0000.png ...; empty = no pictures
    std::filesystem::path video;         ///< MP4; empty = none
    std::uint64_t every = 1;             ///< interval of pictures in frames, frame 0 included
    std::vector<std::uint64_t> pictured; ///< or only these frames; sorted

    bool wantsPicture(std::uint64_t frame) const;
};

/// Empty if help or version was requested and printed. Throws app::Failure (wrongUsage).
std::optional<Options> parseOptions(int argc, const char* const* argv);

} // namespace sinew::viewer
