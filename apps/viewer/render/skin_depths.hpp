// How deep places in bodies that can be cut lie below their skins at the start, for the layers below a skin
// that a cut lays open. The picture's shaders read them (inside.glsl).
#pragma once

#include "sinew/scene.hpp"
#include "viewer/frame.h"

#include <array>
#include <vector>

namespace sinew::viewer {

struct SkinDepths {
    std::array<layout::SkinInside, SKIN_COLORS> skins{}; ///< of the scene's first skins
    std::vector<float> depths;                           ///< of all skins [m]
};

/// `isTissue`: for each skin whether layers are drawn below it. Others have a size alone, as have open skins
/// and those of bodies that cannot be cut. A grid has at most 33,000 nodes and takes up to a tenth of a
/// second.
SkinDepths skinDepths(const sim::Scene& scene, const std::vector<bool>& isTissue);

} // namespace sinew::viewer
