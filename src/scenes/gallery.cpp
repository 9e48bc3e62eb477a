// Reads one table without the checks of a whole scene.
#include "scenes/gallery.hpp"

#include <toml++/toml.h>

#include <algorithm>

namespace sinew::scenes {

Gallery galleryOf(std::string_view text) {
    try {
        const toml::table all = toml::parse(text);
        const auto of = all["gallery"];
        const auto order = of["order"].value_or(std::int64_t{0});
        return {of["time"].value_or(0.0), of["study"].value_or(false), of["heavy"].value_or(false),
                static_cast<std::uint32_t>(std::clamp<std::int64_t>(order, 0, 1000))};
    } catch (const toml::parse_error&) {
        return {};
    }
}

} // namespace sinew::scenes
