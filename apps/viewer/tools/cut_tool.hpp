// The scalpel of the pointer. While its button is down the blade lies along the ray under the pointer, from
// in front of the bodies to behind them or to a depth below the surface, and cuts what it sweeps, one piece
// of the stroke per step. The device finds the surface, so a stroke of limited depth cuts a few pictures
// later.
#pragma once

#include "viewer/input/tool.hpp"
#include "viewer/tools/waiting_stroke.hpp"

#include <array>
#include <deque>

namespace sinew::viewer {

namespace tool {
extern const Tool blade;
} // namespace tool

class CutTool final : public ToolState {
public:
    /// `scene` is the box of the bodies; the blade spans the ball around it.
    explicit CutTool(const Box& scene);

    std::unique_ptr<ToolState> clone() const override { return std::make_unique<CutTool>(*this); }
    bool isOn() const override { return isOn_; }
    /// Turning it off ends the stroke; swept pieces are still cut in the next steps.
    void toggle() override;

    /// Limits of the depth of a blade that does not go through [m].
    struct Depths {
        float least, most;
    };
    Depths depths() const;
    /// Sets the depth below the surface, along the ray of the pointer [m]; empty = through. Clamped to
    /// depths().
    void setDepth(const std::optional<float>& depth);
    const std::optional<float>& depth() const { return depth_; }
    /// Changes the depth by wheel notches: forwards is deeper, and in the end through.
    void deepen(float notches);
    std::optional<float> setting() const override { return depth_; }
    void set(const std::optional<float>& depth) override { setDepth(depth); }
    std::array<float, 2> settingRange() const override { return {depths().least, depths().most}; }
    void turnWheel(float notches) override { deepen(notches); }

    void press(const Camera& camera, const Vector2& pointer) override;
    void move(const Camera& camera, const Vector2& pointer) override;
    void release() override;
    bool followsPointer() const override { return isOn_; }
    /// Ends the stroke and drops its pieces that are not cut yet.
    void drop() override;
    /// The same, turns the tool off and lets the blade go through.
    void putAway() override;

    /// Takes the next piece; empty if there is none.
    std::optional<Sweep> next();
    /// Puts pieces of undone steps back in front, in their order.
    void putBack(std::span<const Sweep> sweeps) override;
    /// Whether the piece that next() returns begins a stroke.
    bool beginsStroke() const override { return !sweeps_.empty() && !sweeps_.front().isCarried; }
    bool isDown() const override { return isDown_; }
    bool isCutting() const { return isDown_ || !sweeps_.empty() || !waiting_.isEmpty(); }

    /// A ray of the stroke whose hit is needed; the cut waits for the answer.
    const std::optional<Ray>& question() const override { return waiting_.question(); }
    void answer(const std::optional<Pick>& pick, float radiusOfGrab = 0) override;
    /// The ray for the depth gauge, which is drawn only.
    const std::optional<Ray>& preview() const override { return preview_; }
    void answerPreview(const std::optional<Pick>& pick) override;
    /// The surface under the pointer may have moved.
    void stepTaken();
    void addTo(StepHands& hands) override;
    void addTo(Overlay& overlay) const override;

    /// The stroke as drawn, near the eye [m]: pieces cut and pieces still to be cut.
    std::span<const Vector3> path() const { return path_; }
    /// Line for the depth of the blade: from the pointer downwards on the picture, as long as the depth looks
    /// at the surface under the pointer, near the eye [m]. Empty for a blade that goes through, or while no
    /// surface was under the pointer yet.
    std::span<const Vector3> gauge() const { return gauge_; }

private:
    using Place = WaitingStroke::Place;
    struct Edge {
        Vector3 near = Vector3::Zero(), far = Vector3::Zero();
    };
    std::optional<Place> placeAt(const Ray& ray, float nearest) const;
    void add(const Camera& camera, Place place);
    void cut(const Place& place, float far);
    void cutSettled();
    void hover(const Camera& camera, const Vector2& pointer);
    void showDepth();

    Vector3 center_;
    float radius_;
    bool isOn_ = false, isDown_ = false, isFirst_ = true, isBeside_ = true;
    Vector2 pointer_ = Vector2::Zero(); // at the newest place
    std::optional<float> depth_;
    WaitingStroke waiting_;
    std::optional<Edge> last_;
    std::deque<Sweep> sweeps_;
    std::vector<Vector3> path_;

    Camera camera_; // of the newest place
    Ray hovered_;
    std::optional<Ray> preview_, previewed_; // asked; last answered
    std::optional<float> surface_;           // distance under the pointer, along the ray [m]
    std::uint32_t stepsSince_ = 0;
    std::vector<Vector3> gauge_;
};

} // namespace sinew::viewer
