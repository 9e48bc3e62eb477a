// The grab of the pointer: pressed on a body it pulls the body, pressed elsewhere it orbits the camera. The
// device finds the particle under the pointer, so the answer comes one or two frames after the press.
#pragma once

#include "viewer/input/tool.hpp"

namespace sinew::viewer {

namespace tool {
extern const Tool hand;
} // namespace tool

class GrabTool final : public ToolState {
public:
    std::unique_ptr<ToolState> clone() const override { return std::make_unique<GrabTool>(*this); }
    /// The button was pressed at `pointer` (see Input::pointer).
    void press(const Camera& camera, const Vector2& pointer) override;
    /// The button was released, or the held particle is gone.
    void release() override;

    /// The ray of a press that is not answered yet.
    const std::optional<Ray>& question() const override { return question_; }
    /// Answers the question. `radius`: see holdRadius(). Ignored if the press is over.
    void answer(const std::optional<Pick>& pick, float radius) override;

    /// Moves the pointer. The held point keeps its depth from the press.
    void move(const Camera& camera, const Vector2& pointer) override;
    bool followsPointer() const override { return isHolding(); }
    /// Part of a drag, in (x, y) window heights, that orbits the camera: everything since the press if
    /// nothing is held, else zero.
    Vector2 drag(const Vector2& heights) override;

    /// Radius of the grab, as passed to answer() [m].
    float radius() const { return grabs_.empty() ? 0 : grabs_[0].radius; }

    bool isDown() const override { return isDown_; }
    bool isHolding() const { return !grabs_.empty(); }
    /// For sim::Step::grabs.
    std::span<const sim::Grab> grabs() const { return grabs_; }
    /// The hand to draw.
    std::optional<Hand> hand() const;
    std::optional<Held> held() const override;
    void addTo(StepHands& hands) override;
    void addTo(Overlay& overlay) const override { overlay.hand = hand(); }

private:
    bool isDown_ = false, isMiss_ = false;
    std::optional<Ray> question_;
    Vector2 waiting_ = Vector2::Zero(); // drag since the press
    Vector3 planePoint_ = Vector3::Zero(), planeNormal_ = Vector3::Zero(), offset_ = Vector3::Zero();
    std::vector<sim::Grab> grabs_; // none or one element
};

} // namespace sinew::viewer
