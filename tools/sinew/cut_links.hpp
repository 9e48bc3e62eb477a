// The links of a scene that a cut has parted, read from the device's link masks.
#pragma once

#include "sim/scene.hpp"

#include <span>
#include <vector>

namespace sinew::tools {

/// By distance constraint of the scene. `slot` is sim::StateLayout::slot; `links` are the words of live links
/// by slot (sim::CuttingBuffers::links).
std::vector<bool> cutLinks(const sim::Scene& scene, std::span<const std::uint32_t> slot,
                           std::span<const std::uint32_t> links);

} // namespace sinew::tools
