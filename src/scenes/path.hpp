// Where what moves along keyframes of a file is: [[collider.keyframe]], [[mesh_collider.keyframe]].
#pragma once

#include "scenes/load.hpp"
#include "scenes/section.hpp"

namespace sinew::scenes {

/// `rotation` of a table: about x, then y, then z.
sim::Quaternion rotationOf(const Section& section);

struct Path {
    std::vector<sim::Keyframe> keyframes; ///< empty = stands still
    sim::PathEnd end = sim::PathEnd::hold;
};

/// `keyframe` and `path_end` of a table that puts its thing at `pose`, which counts where a keyframe says
/// nothing. Warns of keyframes that are less than a step apart.
Path readPath(LoadedScene& loaded, const Section& section, const sim::Pose& pose);

} // namespace sinew::scenes
