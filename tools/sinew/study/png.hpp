// Plots as PNG, by a converter that is there or not.
#pragma once

#include <filesystem>

namespace sinew::tools::study {

/// Converts with rsvg-convert (Debian: librsvg2-bin), twice the drawing's size; the PNG has its name only
/// once it is complete. False where there is no such program or it failed; the old PNG, which would show
/// another study, is gone then.
bool convertToPng(const std::filesystem::path& svg, const std::filesystem::path& png);

} // namespace sinew::tools::study
