// Keyframes.
#include "scenes/path.hpp"

#include "scenes/origin.hpp"
#include "scenes/sentences.hpp"

#include "sim/core/complaints.hpp"
#include "sim/rigid/check_colliders.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
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

void requireOrder(const Section& section, const std::vector<Section>& keyframes, const Path& path) {
    const std::vector<sim::Keyframe>& keys = path.keyframes;
    for (std::size_t k = 1; k < keys.size(); ++k)
        if (keys[k].time <= keys[k - 1].time)
            keyframes[k].fail("time",
                              "is " + sim::number(keys[k].time) + " s, which is not later than the " +
                                  sim::number(keys[k - 1].time) + " s of the keyframe before",
                              "give a later time");
    if (path.end == sim::PathEnd::loop && keys.size() > 1 &&
        !sim::rigid::isSame(keys.front().pose, keys.back().pose))
        section.fail("path_end", "is \"loop\", but the last keyframe is not where the first one is",
                     "give it the same center and rotation, or say \"hold\"");
}

/// `hold[1] "grip"`.
std::string pathOwner(const Section& section) {
    return section.label() + (section.has("name") ? " \"" + section.text("name") + "\"" : "");
}

/// A path is followed from step to step: between the ends of one it is a straight way.
void warnAboutShortPath(LoadedScene& loaded, const Section& section, std::span<const sim::Keyframe> path) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < path.size(); ++k)
        shortest = std::min(shortest, double{path[k].time} - double{path[k - 1].time});
    if (shortest >= (1 - 1e-4) * double{loaded.scene.dt}) return;
    loaded.warnings.push_back(
        "the path of " + pathOwner(section) + " has keyframes " + sim::thousandths(shortest) +
        " ms apart, which is less than a step of " + sim::thousandths(double{loaded.scene.dt}) +
        " ms: within a step it goes straight from its beginning to its end, " +
        (shortest < sim::ranges::dt.low ? "put them farther apart"
                                        : "give dt = " + atMost(shortest) + " or keyframes farther apart"));
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

Path readPath(LoadedScene& loaded, const Section& section, const sim::Pose& pose) {
    const std::vector<Section> keyframes = section.list("keyframe");
    requireShortTurns(section, keyframes);
    Path path;
    for (const Section& keyframe : keyframes) {
        sim::Keyframe& key = path.keyframes.emplace_back();
        key.time = keyframe.number("time");
        key.pose = pose;
        if (keyframe.has("center")) key.pose.position = localPoint(keyframe, "center", loaded.origin);
        if (keyframe.has("rotation")) key.pose.rotation = rotationOf(keyframe);
    }
    const std::string end = section.text("path_end");
    if (end != "hold" && end != "loop")
        section.fail("path_end", "is \"" + end.substr(0, 64) + "\"", "possible are hold, loop");
    path.end = end == "loop" ? sim::PathEnd::loop : sim::PathEnd::hold;
    requireOrder(section, keyframes, path);
    warnAboutShortPath(loaded, section, path.keyframes);
    return path;
}

} // namespace sinew::scenes
