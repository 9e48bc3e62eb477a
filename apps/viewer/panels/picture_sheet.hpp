// Small pictures of scenes under each other, for panels to show.
#pragma once

#include "viewer/draw/png.hpp"

#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace sinew::viewer {

/// What a panel's draw command says in place of a texture (ImTextureID): glyphs are 0.
inline constexpr std::size_t sheetTexture = 1;

/// Texels as those of Picture, a word each; what is not there yet is black.
class PictureSheet {
public:
    static constexpr VkExtent2D extent{192, 120}; ///< of each [texels]
    static constexpr std::size_t most = 64;       ///< in a sheet: 6 MB

    explicit PictureSheet(std::size_t count) : has_(std::min(count, most)) {
        texels_.resize(has_.size() * wordsOfOne);
    }

    /// Whether each is there.
    const std::vector<bool>& has() const { return has_; }
    /// One of this extent; false where it is of another, or beyond the sheet.
    bool set(std::size_t i, const Picture& picture) {
        if (i >= has_.size() || picture.width != extent.width || picture.height != extent.height)
            return false;
        std::memcpy(&texels_[i * wordsOfOne], picture.pixels.data(), wordsOfOne * sizeof(std::uint32_t));
        return has_[i] = true;
    }
    const std::vector<std::uint32_t>& texels() const { return texels_; }
    /// Of one; of none beyond the sheet.
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
