// Which voxel bodies of a scene file touch others by faces, too.
#pragma once

#include "scenes/section.hpp"

namespace sinew::scenes {

/// Remembers bodies of which the file does not say so, until all others are known.
class FaceChoices {
public:
    /// The grids from `first` on are of `body`.
    void add(LoadedScene& loaded, const Section& body, std::size_t first);
    /// After the last body: faces for those that have holes for some other.
    void settle(LoadedScene& loaded) const;

private:
    std::vector<std::uint32_t> open_;
};

} // namespace sinew::scenes
