// Converts plots to PNG if a converter is installed.
#pragma once

#include <filesystem>

namespace sinew::tools::study {

/// Converts with rsvg-convert (Debian: librsvg2-bin) at twice the drawing's size; the PNG gets its name only
/// when complete. False if the program is missing or failed; removes the old PNG, which would show another
/// study.
bool convertToPng(const std::filesystem::path& svg, const std::filesystem::path& png);

} // namespace sinew::tools::study
