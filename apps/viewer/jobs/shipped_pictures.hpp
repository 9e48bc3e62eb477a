// Pictures of the shipped scenes, which tools/gallery.py has drawn; they are part of the program.
#pragma once

#include "viewer/jobs/options.hpp"
#include "viewer/render/png.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace sinew::viewer {

struct EmbeddedFile {
    std::string_view name; ///< without ending
    std::span<const unsigned char> bytes;
};

/// The picture of a scene in PictureSheet::extent; empty if it is none of the shipped ones, or if its file
/// was changed.
std::optional<Picture> shippedPicture(const Options& scene);

} // namespace sinew::viewer
