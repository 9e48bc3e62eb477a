// Matrices in Vulkan's conventions, and the boxes that camera and shadow map are fitted to.
#include "viewer/render/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

Vector3 toVector(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

// The box that a body can reach when it hangs from its fixed particles; empty without fixed particles.
Box swingBounds(const sim::Scene& scene, const sim::Body& body) {
    Box pins;
    for (const sim::FixedConstraint& fixed : scene.fixed)
        if (fixed.particle - body.firstParticle < body.particleCount)
            pins.extend(toVector(scene.particles[fixed.particle].position));
    if (pins.isEmpty()) return pins;
    const Vector3 pivot = pins.center();
    float reach = 0;
    for (std::uint32_t i = 0; i < body.particleCount; ++i)
        reach = std::max(reach, (toVector(scene.particles[body.firstParticle + i].position) - pivot).norm());
    return pins.extend(Vector3(pivot - Vector3(0, reach, 0)));
}

Box boundsOf(const sim::Collider& collider, const sim::Pose& pose) {
    const sim::Quaternion& q = pose.rotation;
    const sim::Vec3& e = collider.halfExtents;
    const Eigen::Matrix3f turn = Eigen::Quaternionf(q.w, q.x, q.y, q.z).toRotationMatrix().cwiseAbs();
    Vector3 reach = Vector3::Constant(collider.radius);
    if (collider.shape == sim::ColliderShape::capsule) reach += collider.halfLength * turn.col(1);
    if (collider.shape == sim::ColliderShape::box) reach = turn * Vector3(e.x, e.y, e.z);
    const Vector3 middle = toVector(pose.position);
    return Box(Vector3(middle - reach), Vector3(middle + reach));
}

// The box of a collider and its path, without places so far away that the bodies would look tiny.
Box boundsNear(const sim::Collider& collider, const Box& bodies) {
    const float far = 3 * std::max(bodies.diagonal().norm(), collider.radius);
    Box box;
    if (collider.path.empty()) return boundsOf(collider, collider.pose);
    for (const sim::Keyframe& keyframe : collider.path) {
        const Box there = boundsOf(collider, keyframe.pose);
        if (bodies.exteriorDistance(there) < far) box.extend(there);
    }
    return box;
}

} // namespace

Matrix4 lookAt(const Vector3& eye, const Vector3& target, const Vector3& up) {
    const Vector3 back = (eye - target).normalized();
    const Vector3 right = up.cross(back).normalized();
    Matrix4 view = Matrix4::Identity();
    view.block<1, 3>(0, 0) = right.transpose();
    view.block<1, 3>(1, 0) = back.cross(right).transpose();
    view.block<1, 3>(2, 0) = back.transpose();
    view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;
    return view;
}

Matrix4 perspective(float fieldOfView, float aspect, float near, float far) {
    const float scale = 1 / std::tan(fieldOfView / 2);
    Matrix4 clip = Matrix4::Zero();
    clip(0, 0) = scale / aspect;
    clip(1, 1) = -scale;
    clip(2, 2) = far / (near - far);
    clip(2, 3) = near * far / (near - far);
    clip(3, 2) = -1;
    return clip;
}

Matrix4 orthographic(const Box& box) {
    const Vector3 size = box.sizes(), center = box.center();
    Matrix4 clip = Matrix4::Identity();
    clip(0, 0) = 2 / size.x();
    clip(1, 1) = -2 / size.y();
    clip(2, 2) = -1 / size.z();
    clip(0, 3) = -center.x() * clip(0, 0);
    clip(1, 3) = -center.y() * clip(1, 1);
    clip(2, 3) = box.max().z() / size.z();
    return clip;
}

Box transformed(const Box& box, const Matrix4& transform) {
    return box.transformed(Eigen::Affine3f(transform));
}

Box particleBounds(const sim::Scene& scene) {
    Box box;
    for (const sim::Particle& particle : scene.particles) {
        const Vector3 reach = Vector3::Constant(particle.radius), middle = toVector(particle.position);
        box.extend(Box(middle - reach, middle + reach));
    }
    return box.isEmpty() ? Box(Vector3::Zero()) : box;
}

std::optional<float> groundHeight(const sim::Scene& scene) {
    std::optional<float> height;
    for (const sim::Plane& plane : scene.planes)
        if (plane.normal.y > 0.9999f) height = std::max(plane.offset, height.value_or(plane.offset));
    return height;
}

Box sceneBounds(const sim::Scene& scene) {
    Box box = particleBounds(scene);
    for (const sim::Body& body : scene.bodies) box.extend(swingBounds(scene, body));
    for (const sim::Collider& collider : scene.colliders)
        box.extend(boundsNear(collider, particleBounds(scene)));
    const std::optional<float> ground = groundHeight(scene);
    const float size = std::max(box.sizes().maxCoeff(), 1e-3f);
    // A body far above the ground is framed without it: otherwise the body would look tiny.
    if (ground && *ground < box.min().y() && box.min().y() - *ground < 6 * size)
        box.extend(Vector3(box.center().x(), *ground, box.center().z()));
    if (ground) // nothing hangs below it
        box.min().y() = std::max(box.min().y(), std::min(*ground, particleBounds(scene).min().y()));
    return box;
}

} // namespace sinew::viewer
