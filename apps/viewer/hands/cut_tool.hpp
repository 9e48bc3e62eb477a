// The scalpel of the pointer: while its button is down the blade lies along the ray under it, from before the
// bodies to behind them or to a depth below the surface, and cuts what it sweeps, a piece of the stroke a
// step. Where the surface is, is asked of the device, so a stroke of some depth cuts a few pictures later.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/hand_mesh.hpp"
#include "viewer/hands/pick.hpp"
#include "viewer/hands/waiting_stroke.hpp"

#include <array>
#include <deque>

namespace sinew::viewer {

/// One step's piece of a stroke, for sim::Blade.
struct Sweep {
    std::array<sim::Vec3, 2> from, to; ///< the blade's edge: before the bodies, behind them or in them [m]
    bool isCarried = false;            ///< not the first of its stroke
};

class CutTool {
public:
    /// `stage` is where bodies may be; the blade reaches from one side of the ball around it to the other.
    explicit CutTool(const Box& stage);

    bool isOn() const { return isOn_; }
    /// Putting it away ends the stroke; what has been swept is cut all the same, in the next steps.
    void toggle();

    /// Of blades that do not go through [m].
    struct Depths {
        float least, most;
    };
    Depths depths() const;
    /// Below the surface, along the ray of the pointer [m]; nothing = through. From now on; within what makes
    /// sense.
    void setDepth(const std::optional<float>& depth);
    const std::optional<float>& depth() const { return depth_; }
    /// By so many notches of the wheel, forwards deeper and in the end through.
    void deepen(float notches);

    void press(const Camera& camera, const Vector2& pointer);
    void move(const Camera& camera, const Vector2& pointer);
    void release();
    /// Ends the stroke where it has come to: what is still to be cut is not.
    void drop();

    /// The next piece, taken; nothing where no stroke has one.
    std::optional<Sweep> next();
    /// Of steps that were undone, to be cut again first; in their order.
    void putBack(std::span<const Sweep> sweeps);
    /// Whether the piece that next() returns begins a stroke.
    bool beginsStroke() const { return !sweeps_.empty() && !sweeps_.front().isCarried; }
    bool isDown() const { return isDown_; }
    bool isCutting() const { return isDown_ || !sweeps_.empty() || !waiting_.isEmpty(); }

    /// A ray of the stroke that is still to be answered: cuts wait for it.
    const std::optional<Ray>& question() const { return waiting_.question(); }
    void answer(const std::optional<Pick>& pick);
    /// Likewise of where the blade could begin to cut, for what is drawn alone.
    const std::optional<Ray>& preview() const { return preview_; }
    void answerPreview(const std::optional<Pick>& pick);
    /// What lies there may have moved.
    void stepTaken();

    /// The stroke as drawn so far, near the eye [m]: what was and what will be cut.
    std::span<const Vector3> path() const { return path_; }
    /// How deep it goes, from the pointer downwards on the picture, as long as it would look at the surface
    /// under the pointer, near the eye [m]; empty where it goes through, or nothing was under the pointer
    /// yet.
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
    Vector2 pointer_ = Vector2::Zero(); // of the last place
    std::optional<float> depth_;
    WaitingStroke waiting_;
    std::optional<Edge> last_;
    std::deque<Sweep> sweeps_;
    std::vector<Vector3> path_;

    Camera camera_; // through which it was pointed last
    Ray hovered_;
    std::optional<Ray> preview_, previewed_; // asked; answered last
    std::optional<float> surface_;           // under the pointer, along the ray [m]
    std::uint32_t stepsSince_ = 0;
    std::vector<Vector3> gauge_;
};

} // namespace sinew::viewer
