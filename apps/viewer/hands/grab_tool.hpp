// The hand of the pointer: pressed on a body it holds and pulls it, pressed beside one it turns the camera.
// What lies under it is asked of the device, so for a frame or two after a press the tool does not know yet.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/hand_mesh.hpp"
#include "viewer/hands/pick.hpp"

namespace sinew::viewer {

class GrabTool {
public:
    /// The button went down with `pointer` (as Input::pointer) there.
    void press(const Camera& camera, const Vector2& pointer);
    /// It went up, or what was held is no more.
    void release();

    /// The ray of a press that is still to be answered.
    const std::optional<Ray>& question() const { return question_; }
    /// What it meets. `radius` as holdRadius(). Of a press that is over by now, nothing comes.
    void answer(const std::optional<Pick>& pick, float radius);

    /// Where the pointer is now. What is held keeps the depth at which it was taken.
    void move(const Camera& camera, const Vector2& pointer);
    /// How far (x, y) of window heights the camera is to be turned by a drag: all since the press where
    /// nothing is held, nothing otherwise.
    Vector2 drag(const Vector2& heights);

    /// How far around its particle it holds, as answer() was told [m].
    float radius() const { return grabs_.empty() ? 0 : grabs_[0].radius; }

    bool isDown() const { return isDown_; }
    bool isHolding() const { return !grabs_.empty(); }
    /// For sim::Step::grabs.
    std::span<const sim::Grab> grabs() const { return grabs_; }
    /// To be drawn.
    std::optional<Hand> hand() const;

private:
    bool isDown_ = false, isMiss_ = false;
    std::optional<Ray> question_;
    Vector2 waiting_ = Vector2::Zero(); // drag since the press
    Vector3 planePoint_ = Vector3::Zero(), planeNormal_ = Vector3::Zero(), offset_ = Vector3::Zero();
    std::vector<sim::Grab> grabs_; // one or none
};

} // namespace sinew::viewer
