// The sphere of the pointer: while its button is down it stays at the depth of the surface under the press
// and pushes bodies aside. The device finds that surface, so the sphere appears one or two frames after the
// press.
#pragma once

#include "viewer/input/tool.hpp"

#include <cmath>

namespace sinew::viewer {

namespace tool {
extern const Tool poke;
} // namespace tool

class PokeTool final : public ToolState {
public:
    /// `size` is that of the box of the bodies [m]; the first radius is a part of it. The sphere stays on the
    /// inner side of `planes`.
    PokeTool(float size, std::vector<sim::Plane> planes);

    std::unique_ptr<ToolState> clone() const override { return std::make_unique<PokeTool>(*this); }
    bool isOn() const override { return isOn_; }
    void toggle() override;

    void press(const Camera& camera, const Vector2& pointer) override;
    void move(const Camera& camera, const Vector2& pointer) override;
    /// Lifts the sphere.
    void release() override;
    bool isDown() const override { return isDown_; }
    bool followsPointer() const override { return isDown_; }

    /// The ray of a press that is not answered yet.
    const std::optional<Ray>& question() const override { return question_; }
    /// Answers the question; on a miss the sphere is as far away as the camera's target. Ignored if the press
    /// is over.
    void answer(const std::optional<Pick>& pick, float radiusOfGrab = 0) override;

    float radius() const { return radius_; } ///< [m]
    /// Clamped to a sensible range.
    void setRadius(float radius);
    /// Changes the radius by wheel notches; forwards is larger.
    void grow(float notches) { setRadius(radius_ * std::pow(1.1f, notches)); }
    std::optional<float> setting() const override { return radius_; }
    void set(const std::optional<float>& radius) override { setRadius(radius.value_or(radius_)); }
    void turnWheel(float notches) override { grow(notches); }
    /// Restores the first radius and turns the tool off.
    void putAway() override;

    /// For sim::Step::hostColliders; empty while the sphere is lifted.
    std::optional<sim::HostCollider> poke() const;
    void addTo(StepHands& hands) override {
        if (const auto one = poke()) hands.collider = one;
    }
    void addTo(Overlay&) const override {} // the renderer draws colliders where the simulation has them

private:
    float size_, radius_;
    std::vector<sim::Plane> planes_;
    bool isOn_ = false, isDown_ = false;
    std::optional<Ray> question_;
    Vector3 planePoint_ = Vector3::Zero(), planeNormal_ = Vector3::Zero();
    std::optional<Vector3> center_; // [m]
};

} // namespace sinew::viewer
