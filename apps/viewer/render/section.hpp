// A section: a plane that hides what lies in front of it in the picture, so that one sees into bodies. The
// simulation is not affected.
#pragma once

#include "viewer/render/camera.hpp"

#include <vector>

namespace sinew::viewer {

struct Section {
    Vector3 normal = Vector3::UnitZ(); ///< unit length, towards the hidden side
    float offset = 0;                  ///< distance of the plane from the origin along the normal [m]
    bool operator==(const Section&) const = default;
};

/// A section through the target of the camera: along the axis nearest to the view, or perpendicular to the
/// view.
Section sectionAcross(const Camera& camera);
Section sectionFacing(const Camera& camera);
/// The section through `point` along the next axis of the cycle +x, +y, +z, -x, -y, -z.
Section turned(const Section& section, const Vector3& point);
/// Moves the section along its normal by `notches`, 50 of them across `bounds`; clamped to `bounds`.
Section moved(Section section, float notches, const Box& bounds);
/// The lowest and highest offset at which the plane meets `bounds` [m].
struct Reach {
    float low = 0, high = 0;
};
Reach reachOf(const Section& section, const Box& bounds);

bool isCutAway(const Section& section, const Vector3& point);

/// Whether each skin is closed at the start: at every edge as many triangles run one way as the other. Open
/// skins (cloth, meshes with holes) have no inside to show.
std::vector<bool> closedSkins(const sim::Scene& scene);

/// Whether the triangles of each closed skin face outwards: its signed volume is more than 0.
std::vector<bool> outwardSkins(const sim::Scene& scene);

} // namespace sinew::viewer
