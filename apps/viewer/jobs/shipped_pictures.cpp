// Finds a scene by its text, and makes its picture smaller.
#include "viewer/jobs/shipped_pictures.hpp"

#include "scenes/built_in.hpp"
#include "viewer/ui/picture_sheet.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace sinew::viewer {

extern const std::span<const EmbeddedFile> shippedPictures; // generated

namespace {

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

// Means of whole squares of pixels.
Picture smaller(const Picture& picture, std::uint32_t by) {
    Picture small{.width = picture.width / by, .height = picture.height / by, .pixels = {}};
    for (std::uint32_t y = 0; y < small.height; ++y)
        for (std::uint32_t x = 0; x < 4 * small.width; ++x) {
            std::uint32_t sum = 0;
            for (std::uint32_t part = 0; part < by * by; ++part) {
                const std::uint32_t row = y * by + part / by, column = x / 4 * by + part % by;
                sum += picture.pixels[4 * (std::size_t{row} * picture.width + column) + x % 4];
            }
            small.pixels.push_back(static_cast<std::uint8_t>((sum + by * by / 2) / (by * by)));
        }
    return small;
}

} // namespace

std::optional<Picture> shippedPicture(const Options& scene) {
    const std::filesystem::path file = scene.scene;
    const std::string name = scene.scene.empty() ? scene.builtIn : file.stem().string();
    const auto found = std::ranges::find(shippedPictures, name, &EmbeddedFile::name);
    if (found == shippedPictures.end()) return std::nullopt;
    if (!scene.scene.empty() && textOf(file) != scenes::builtInText(name)) return std::nullopt;
    const Picture picture = decodePng(found->bytes);
    constexpr VkExtent2D extent = PictureSheet::extent;
    const std::uint32_t by = picture.width / extent.width;
    if (by == 0 || picture.width != by * extent.width || picture.height != by * extent.height)
        return std::nullopt;
    return smaller(picture, by);
}

} // namespace sinew::viewer
