// The sphere of the pointer: while its button is down it is at the depth of what lay under the press, and
// pushes what is in its way. What lies there is asked of the device, so it comes a frame or two after the
// press.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/hands/pick.hpp"

#include <cmath>

namespace sinew::viewer {

class PokeTool {
public:
    /// `size` of where bodies may be [m]: the sphere begins with a part of it. It stays on this side of
    /// `planes`.
    PokeTool(float size, std::vector<sim::Plane> planes);

    bool isOn() const { return isOn_; }
    void toggle();

    void press(const Camera& camera, const Vector2& pointer);
    void move(const Camera& camera, const Vector2& pointer);
    /// Lifts it.
    void release();
    bool isDown() const { return isDown_; }

    /// The ray of a press that is still to be answered.
    const std::optional<Ray>& question() const { return question_; }
    /// What it meets; beside all bodies the sphere is as far away as what the camera looks at. Of a press
    /// that is over by now, nothing comes.
    void answer(const std::optional<Pick>& pick);

    float radius() const { return radius_; } ///< [m]
    /// Within what makes sense.
    void setRadius(float radius);
    /// By so many notches of the wheel, forwards larger.
    void grow(float notches) { setRadius(radius_ * std::pow(1.1f, notches)); }
    /// As it was at first.
    void putAway();

    /// For sim::Step::pokes; nothing while it is lifted.
    std::optional<sim::Poke> poke() const;

private:
    float size_, radius_;
    std::vector<sim::Plane> planes_;
    bool isOn_ = false, isDown_ = false;
    std::optional<Ray> question_;
    Vector3 planePoint_ = Vector3::Zero(), planeNormal_ = Vector3::Zero();
    std::optional<Vector3> center_; // [m]
};

} // namespace sinew::viewer
