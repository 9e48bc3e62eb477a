// Previews of scenes in one image, one below the other, for panels to show.
#pragma once

#include "viewer/render/png.hpp"

#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace sinew::viewer {

/// Texture id of the sheet in draw commands (ImTextureID); 0 is the glyphs.
inline constexpr std::size_t sheetTexture = 1;

/// Texels like those of Picture, one word each; missing pictures are black.
class PictureSheet {
public:
    static constexpr VkExtent2D extent{240, 135}; ///< of each picture [texels]
    static constexpr std::size_t most = 64;       ///< pictures in a sheet: 8 MB

    explicit PictureSheet(std::size_t count) : has_(std::min(count, most)) {
        texels_.resize(has_.size() * wordsOfOne);
    }

    /// Whether each picture has been set.
    const std::vector<bool>& has() const { return has_; }
    /// Sets picture `i`; false if its extent differs or `i` is beyond the sheet.
    bool set(std::size_t i, const Picture& picture) {
        if (i >= has_.size() || picture.width != extent.width || picture.height != extent.height)
            return false;
        std::memcpy(&texels_[i * wordsOfOne], picture.pixels.data(), wordsOfOne * sizeof(std::uint32_t));
        return has_[i] = true;
    }
    const std::vector<std::uint32_t>& texels() const { return texels_; }
    /// Texels of one picture; empty beyond the sheet.
    std::span<const std::uint32_t> texelsOf(std::size_t i) const {
        return i < has_.size() ? std::span(texels_).subspan(i * wordsOfOne, wordsOfOne)
                               : std::span<const std::uint32_t>();
    }

private:
    static constexpr std::size_t wordsOfOne = std::size_t{extent.width} * extent.height;
    std::vector<bool> has_;
    std::vector<std::uint32_t> texels_;
};

} // namespace sinew::viewer
