// PNG files of pictures, with a description of their origin in text chunks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sinew::viewer {

/// 8-bit sRGB, rows from the top, four bytes a pixel; alpha is 255.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> pixels;
};

/// Keyword and text of tEXt chunks, Latin-1: {"Software", "Sinew"}, {"Scene", "organ"} ...
using PictureText = std::vector<std::pair<std::string, std::string>>;

/// Reads a PNG file in memory. Throws std::runtime_error for any other bytes.
Picture decodePng(std::span<const unsigned char> bytes);

/// Encodes a PNG file without alpha. Takes about a tenth of a second for a million pixels.
std::vector<std::uint8_t> encodePng(const Picture& picture, const PictureText& text);

/// Writes the whole file or none (see mesh::writeWhole). Throws mesh::ExportError.
void writePng(const std::filesystem::path& file, const Picture& picture, const PictureText& text);

} // namespace sinew::viewer
