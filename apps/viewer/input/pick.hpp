// Picks: the particle nearest to the point where a ray meets a skin or a ball, and questions for them.
#pragma once

#include "common/layout.h"
#include "viewer/render/balls.hpp"
#include "viewer/render/camera.hpp"
#include "viewer/render/section.hpp"

namespace sinew::viewer {

struct Pick {
    std::uint32_t particle = 0;       ///< nearest to the point
    Vector3 point = Vector3::Zero();  ///< where the ray meets a skin, ball or cut [m]
    Vector3 offset = Vector3::Zero(); ///< from the particle to the point [m]
    float distance = 0;               ///< along the ray [m]
    bool operator==(const Pick&) const = default;
};

/// Whether fixed particles may be picked.
enum class Among { moving, all };

/// A pick that a tool asks for.
struct Question {
    std::size_t tool = 0; ///< index into toolTable()
    Ray ray;
    Among among = Among::all;
    bool isPreview = false; ///< its answer is only drawn
    bool operator==(const Question&) const = default;
};

/// Whether the particle is part of a removed fragment, which is not drawn.
bool isRemoved(std::span<const std::uint32_t> pieces, std::uint32_t particle);

/// The body that holds a particle; a body without particles if none does.
sim::Body bodyOf(const sim::Scene& scene, std::uint32_t particle);

/// Radius of a grab around a picked particle [m]: an eighth of the size of its body at the start, but more
/// than the distance to its next neighbours.
float holdRadius(const sim::Scene& scene, std::uint32_t particle);

} // namespace sinew::viewer
