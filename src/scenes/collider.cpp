// [[collider]] and its [[collider.keyframe]].
#include "scenes/bodies.hpp"
#include "scenes/origin.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

namespace sinew::scenes {

namespace {

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

void require(const Section& section, const char* name, const std::string& shape) {
    if (!section.has(name)) section.fail(name, "is missing", "a " + shape + " needs it");
}

void refuse(const Section& section, const char* name, const std::string& shape) {
    if (section.has(name)) section.fail(name, "is given", "a " + shape + " has none: remove it");
}

void readShape(const Section& section, sim::Collider& collider) {
    const std::string shape = section.text("shape");
    const bool isSphere = shape == "sphere", isCapsule = shape == "capsule", isBox = shape == "box";
    if (!isSphere && !isCapsule && !isBox)
        section.fail("shape", "is \"" + shape.substr(0, 64) + "\"", "possible are sphere, capsule, box");
    (isBox ? refuse : require)(section, "radius", shape);
    (isCapsule ? require : refuse)(section, "length", shape);
    (isBox ? require : refuse)(section, "size", shape);
    collider.shape = isSphere    ? sim::ColliderShape::sphere
                     : isCapsule ? sim::ColliderShape::capsule
                                 : sim::ColliderShape::box;
    if (!isBox) collider.radius = section.number("radius");
    if (isCapsule) collider.halfLength = section.number("length") / 2;
    if (!isBox) return;
    const sim::Vec3 size = section.vector("size");
    collider.halfExtents = {size.x / 2, size.y / 2, size.z / 2};
}

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

void readPath(const Section& section, LoadedScene& loaded, sim::Collider& collider) {
    const std::vector<Section> keyframes = section.list("keyframe");
    requireShortTurns(section, keyframes);
    for (const Section& keyframe : keyframes) {
        sim::Keyframe& key = collider.path.emplace_back();
        key.time = keyframe.number("time");
        key.pose = collider.pose;
        if (keyframe.has("center")) key.pose.position = localPoint(keyframe, "center", loaded.origin);
        if (keyframe.has("rotation")) key.pose.rotation = rotationOf(keyframe);
    }
    const std::string end = section.text("path_end");
    if (end != "hold" && end != "loop")
        section.fail("path_end", "is \"" + end.substr(0, 64) + "\"", "possible are hold, loop");
    collider.pathEnd = end == "loop" ? sim::PathEnd::loop : sim::PathEnd::hold;
}

} // namespace

void addCollider(LoadedScene& loaded, const Section& section) {
    sim::Collider collider{
        .margin = section.number("margin"),
        .friction = section.number("friction"),
        .staticFriction = section.has("static_friction") ? section.number("static_friction") : 0,
        .restitution = section.number("restitution"),
        .pose = {.position = localPoint(section, "center", loaded.origin), .rotation = rotationOf(section)},
        .path = {},
        .color = section.vector("color")};
    readShape(section, collider);
    readPath(section, loaded, collider);
    loaded.scene.colliders.push_back(std::move(collider));
}

} // namespace sinew::scenes
