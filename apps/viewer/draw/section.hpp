// A plane through the scene: what lies before it is cut away from the picture, so that one sees into bodies.
// The bodies themselves know nothing of it.
#pragma once

#include "viewer/draw/camera.hpp"

#include <vector>

namespace sinew::viewer {

struct Section {
    Vector3 normal = Vector3::UnitZ(); ///< unit length, towards what is cut away
    float offset = 0;                  ///< of the plane along it [m]
    bool operator==(const Section&) const = default;
};

/// Through what the camera turns around, facing it: along the axis nearest to it, or just as it looks.
Section sectionAcross(const Camera& camera);
Section sectionFacing(const Camera& camera);
/// Along the next axis, of +x, +y, +z, -x, -y, -z, through `point`.
Section turned(const Section& section, const Vector3& point);
/// Along its normal by so many notches, 50 across `bounds`; it stays at them.
Section moved(Section section, float notches, const Box& bounds);
/// The lowest and the highest offset with which it passes through `bounds` [m].
struct Reach {
    float low = 0, high = 0;
};
Reach reachOf(const Section& section, const Box& bounds);

bool isCutAway(const Section& section, const Vector3& point);

/// Which skins enclose something as the scene begins: at every edge as many triangles end as begin. Others
/// (cloth, meshes with holes) have no inside that could be shown.
std::vector<bool> closedSkins(const sim::Scene& scene);

/// Which of those show their fronts to who stands outside: their volume is more than 0.
std::vector<bool> outwardSkins(const sim::Scene& scene);

} // namespace sinew::viewer
