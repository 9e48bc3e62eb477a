// Keyframes.
#include "scenes/path.hpp"

#include "scenes/origin.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

namespace sinew::scenes {

namespace {

// Rotations are mixed the shorter way: a keyframe must not be half a turn from the one before.
void requireShortTurns(const Section& section, const std::vector<Section>& keyframes) {
    const auto degrees = [&](const Section& keyframe) {
        return (keyframe.has("rotation") ? keyframe : section).point("rotation");
    };
    for (std::size_t k = 1; k < keyframes.size(); ++k) {
        const auto from = degrees(keyframes[k - 1]), to = degrees(keyframes[k]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (std::abs(to[axis] - from[axis]) > 170)
                keyframes[k].fail("rotation", "is more than 170 degrees from the keyframe before",
                                  "give a keyframe in between");
    }
}

} // namespace

sim::Quaternion rotationOf(const Section& section) {
    const auto degrees = section.point("rotation");
    const auto about = [&](std::size_t axis) {
        return Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180,
                                 Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis)));
    };
    const Eigen::Quaterniond q = (about(2) * about(1) * about(0)).normalized();
    return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()),
            static_cast<float>(q.w())};
}

Path readPath(const Section& section, const std::array<double, 3>& origin, const sim::Pose& pose) {
    const std::vector<Section> keyframes = section.list("keyframe");
    requireShortTurns(section, keyframes);
    Path path;
    for (const Section& keyframe : keyframes) {
        sim::Keyframe& key = path.keyframes.emplace_back();
        key.time = keyframe.number("time");
        key.pose = pose;
        if (keyframe.has("center")) key.pose.position = localPoint(keyframe, "center", origin);
        if (keyframe.has("rotation")) key.pose.rotation = rotationOf(keyframe);
    }
    const std::string end = section.text("path_end");
    if (end != "hold" && end != "loop")
        section.fail("path_end", "is \"" + end.substr(0, 64) + "\"", "possible are hold, loop");
    path.end = end == "loop" ? sim::PathEnd::loop : sim::PathEnd::hold;
    return path;
}

} // namespace sinew::scenes
