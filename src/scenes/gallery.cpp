// Reads one table without the checks of a whole scene.
#include "scenes/gallery.hpp"

#include <toml++/toml.h>

namespace sinew::scenes {

Gallery galleryOf(std::string_view text) {
    try {
        const toml::table all = toml::parse(text);
        const auto of = all["gallery"];
        return {of["time"].value_or(0.0), of["study"].value_or(false), of["heavy"].value_or(false)};
    } catch (const toml::parse_error&) {
        return {};
    }
}

} // namespace sinew::scenes
