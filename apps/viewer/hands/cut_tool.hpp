// The scalpel of the pointer: while its button is down the blade lies along the ray under it, from before the
// bodies to behind them, and cuts what it sweeps, a piece of the stroke a step.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/hand_mesh.hpp"

#include <array>
#include <deque>

namespace sinew::viewer {

/// One step's piece of a stroke, for sim::Blade.
struct Sweep {
    std::array<sim::Vec3, 2> from, to; ///< the blade's edge: before the bodies, behind them [m]
    bool isCarried = false;            ///< not the first of its stroke
};

class CutTool {
public:
    /// `stage` is where bodies may be; the blade reaches from one side of the ball around it to the other.
    explicit CutTool(const Box& stage);

    bool isOn() const { return isOn_; }
    void toggle();

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
    bool isCutting() const { return isDown_ || !sweeps_.empty(); }

    /// The stroke as drawn so far, near the eye [m]: what was and what will be cut.
    std::span<const Vector3> path() const { return path_; }

private:
    struct Edge {
        Vector3 near = Vector3::Zero(), far = Vector3::Zero(), drawn = Vector3::Zero();
    };
    std::optional<Edge> edgeAt(const Camera& camera, const Vector2& pointer) const;

    Vector3 center_;
    float radius_;
    bool isOn_ = false, isDown_ = false, isFirst_ = true;
    Vector2 pointer_ = Vector2::Zero(); // of the last edge
    std::optional<Edge> last_;
    std::deque<Sweep> sweeps_;
    std::vector<Vector3> path_;
};

} // namespace sinew::viewer
