// Sizes, poses and paths of colliders and driven bodies.
#include "sim/rigid/check_colliders.hpp"

#include "sinew/colliders.hpp"

namespace sinew::sim::rigid {

namespace {

bool isUnit(const Quaternion& q) {
    return ranges::normalLength.holds(std::sqrt(double{q.x} * double{q.x} + double{q.y} * double{q.y} +
                                                double{q.z} * double{q.z} + double{q.w} * double{q.w}));
}

void checkPose(const Pose& pose, const std::string& name, Complaints& complaints) {
    complaints.checkFinite(pose.position, [&] { return name + ".position"; });
    if (!isUnit(pose.rotation)) complaints.add(name + ".rotation", "is no unit quaternion");
}

void checkPath(const std::vector<Keyframe>& path, PathEnd end, const std::string& name,
               Complaints& complaints) {
    for (std::size_t k = 0; k < path.size(); ++k) {
        const std::string key = name + element(".path", k);
        checkPose(path[k].pose, key, complaints);
        complaints.check(double{path[k].time}, ranges::pathTime, [&] { return key + ".time"; });
        if (k > 0 && path[k].time <= path[k - 1].time)
            complaints.add(key + ".time", "is " + number(path[k].time) + ", must be above " +
                                              number(path[k - 1].time) + ", that of the keyframe before");
    }
    if (end == PathEnd::loop && path.size() > 1 && !isSame(path.front().pose, path.back().pose))
        complaints.add(name + ".path", "loops, but its last keyframe is not where its first one is");
}

void checkSize(const Collider& collider, const std::string& name, Complaints& complaints) {
    const Vec3& e = collider.halfExtents;
    switch (collider.shape) {
    case ColliderShape::capsule:
        complaints.check(double{collider.halfLength}, ranges::colliderLength,
                         [&] { return name + ".halfLength"; });
        [[fallthrough]];
    case ColliderShape::sphere:
        complaints.check(double{collider.radius}, ranges::colliderSize, [&] { return name + ".radius"; });
        return;
    case ColliderShape::box:
        for (const float extent : {e.x, e.y, e.z})
            complaints.check(double{extent}, ranges::colliderSize, [&] { return name + ".halfExtents"; });
        return;
    }
    complaints.add(name + ".shape", "is " + number(static_cast<int>(collider.shape)) + ", which is no shape");
}

} // namespace

void checkColliders(std::span<const Collider> colliders, Complaints& complaints) {
    if (colliders.size() > ranges::mostColliders)
        complaints.add("colliders", "are " + number(colliders.size()) + ", at most " +
                                        number(ranges::mostColliders) + " are possible");
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider& collider = colliders[i];
        const std::string name = element("collider", i);
        checkSize(collider, name, complaints);
        checkPose(collider.pose, name + ".pose", complaints);
        complaints.check(double{collider.margin}, ranges::margin, [&] { return name + ".margin"; });
        complaints.check(double{collider.friction}, ranges::friction, [&] { return name + ".friction"; });
        complaints.check(double{collider.staticFriction}, ranges::friction,
                         [&] { return name + ".staticFriction"; });
        complaints.check(double{collider.restitution}, ranges::restitution,
                         [&] { return name + ".restitution"; });
        for (const float channel : {collider.color.x, collider.color.y, collider.color.z})
            complaints.check(double{channel}, ranges::color, [&] { return name + ".color"; });
        checkPath(collider.path, collider.pathEnd, name, complaints);
    }
}

void checkDriven(const Scene& scene, const std::vector<bool>& isHeld, Complaints& complaints) {
    if (scene.driven.size() > ranges::mostDriven)
        complaints.add("driven", "are " + number(scene.driven.size()) + ", at most " +
                                     number(ranges::mostDriven) + " are possible");
    std::vector<bool> isDriven(isHeld.size(), false);
    for (std::size_t b = 0; b < scene.driven.size(); ++b) {
        const DrivenBody& body = scene.driven[b];
        const std::string name = element("driven", b);
        checkPath(body.path, body.pathEnd, name, complaints);
        const std::uint64_t end = std::uint64_t{body.firstParticle} + body.particleCount;
        if (end > isHeld.size()) {
            complaints.add(name, "ends with particle " + number(end) + " of " + number(isHeld.size()));
            continue;
        }
        for (const std::uint32_t i : particlesOf(body)) {
            if (i >= isHeld.size()) {
                complaints.add(name, "has particle " + number(i) + " of " + number(isHeld.size()));
                break;
            }
            if (isHeld[i] && !isDriven[i]) {
                isDriven[i] = true;
                continue;
            }
            complaints.add(name, "has particle " + number(i) +
                                     (isHeld[i] ? ", which another has too: leave it to one of them"
                                                : ", which is not held: fix it or leave it out"));
            break;
        }
    }
    for (std::size_t t = 0; t < scene.tethers.size(); ++t)
        if (scene.tethers[t].anchor < isDriven.size() && isDriven[scene.tethers[t].anchor])
            complaints.add(element("tether", t) + ".anchor",
                           "is particle " + number(scene.tethers[t].anchor) +
                               ", which is driven: take one that never moves");
}

} // namespace sinew::sim::rigid
