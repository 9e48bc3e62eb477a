// The sphere of the pointer: while its button is down it stays at the depth of the surface under the press
// and pushes bodies aside. The device finds that surface, so the sphere appears one or two frames after the
// press.
#pragma once

#include "sinew/simulation.hpp"
#include "viewer/hands/pick.hpp"

#include <cmath>

namespace sinew::viewer {

class PokeTool {
public:
    /// `size` is that of the box of the bodies [m]; the first radius is a part of it. The sphere stays on the
    /// inner side of `planes`.
    PokeTool(float size, std::vector<sim::Plane> planes);

    bool isOn() const { return isOn_; }
    void toggle();

    void press(const Camera& camera, const Vector2& pointer);
    void move(const Camera& camera, const Vector2& pointer);
    /// Lifts the sphere.
    void release();
    bool isDown() const { return isDown_; }

    /// The ray of a press that is not answered yet.
    const std::optional<Ray>& question() const { return question_; }
    /// Answers the question; on a miss the sphere is as far away as the camera's target. Ignored if the press
    /// is over.
    void answer(const std::optional<Pick>& pick);

    float radius() const { return radius_; } ///< [m]
    /// Clamped to a sensible range.
    void setRadius(float radius);
    /// Changes the radius by wheel notches; forwards is larger.
    void grow(float notches) { setRadius(radius_ * std::pow(1.1f, notches)); }
    /// Restores the first radius and turns the tool off.
    void putAway();

    /// For sim::Step::hostColliders; empty while the sphere is lifted.
    std::optional<sim::HostCollider> poke() const;

private:
    float size_, radius_;
    std::vector<sim::Plane> planes_;
    bool isOn_ = false, isDown_ = false;
    std::optional<Ray> question_;
    Vector3 planePoint_ = Vector3::Zero(), planeNormal_ = Vector3::Zero();
    std::optional<Vector3> center_; // [m]
};

} // namespace sinew::viewer
