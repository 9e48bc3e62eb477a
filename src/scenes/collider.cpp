// [[collider]].
#include "scenes/bodies.hpp"
#include "scenes/origin.hpp"
#include "scenes/path.hpp"
#include "scenes/surface.hpp"

#include <string>

namespace sinew::scenes {

namespace {

void require(const Section& section, const char* name, const std::string& shape) {
    if (!section.has(name)) section.fail(name, "is missing", "a " + shape + " needs it");
}

void refuse(const Section& section, const char* name, const std::string& shape) {
    if (section.has(name)) section.fail(name, "is given", "a " + shape + " has none: remove it");
}

} // namespace

void readShape(const Section& section, sim::Collider& collider, const std::string& others) {
    const std::string shape = section.text("shape");
    const bool isSphere = shape == "sphere", isCapsule = shape == "capsule", isBox = shape == "box";
    if (!isSphere && !isCapsule && !isBox)
        section.fail("shape", "is \"" + shape.substr(0, 64) + "\"",
                     "possible are sphere, capsule, box" + others);
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

void addCollider(LoadedScene& loaded, const Section& section) {
    sim::Collider collider{
        .margin = section.number("margin"),
        .friction = section.number("friction"),
        .staticFriction = staticFrictionOf(section),
        .restitution = section.number("restitution"),
        .pose = {.position = localPoint(section, "center", loaded.origin), .rotation = rotationOf(section)},
        .path = {},
        .color = section.vector("color")};
    readShape(section, collider);
    Path path = readPath(loaded, section, collider.pose);
    collider.path = std::move(path.keyframes);
    collider.pathEnd = path.end;
    loaded.scene.colliders.push_back(std::move(collider));
}

} // namespace sinew::scenes
