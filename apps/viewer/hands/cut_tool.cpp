// Moves shorter than a pixel or two wait for more; a stroke that steps cannot keep up with is cut by longer
// pieces.
#include "viewer/hands/cut_tool.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr float shortest = 0.003f;      // move of the pointer that makes an edge [window heights]
constexpr std::size_t mostWaiting = 16; // sweeps
constexpr float drawnAt = 0.3f;         // of the way from the eye to the stage

sim::Vec3 toVec3(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

} // namespace

CutTool::CutTool(const Box& stage)
    : center_(stage.center()), radius_(0.75f * std::max(stage.diagonal().norm(), 1e-3f)) {}

void CutTool::toggle() {
    isOn_ = !isOn_;
    if (!isOn_) drop();
}

// Where the ray passes the ball around the stage; beside it there is nothing to cut.
std::optional<CutTool::Edge> CutTool::edgeAt(const Camera& camera, const Vector2& pointer) const {
    const Ray ray = rayThrough(camera, pointer);
    const float middle = (center_ - ray.origin).dot(ray.direction);
    const float apart = (ray.origin + middle * ray.direction - center_).norm();
    const float half = std::sqrt(std::max(radius_ * radius_ - apart * apart, 0.01f * radius_ * radius_));
    const float first = std::max(middle - half, 0.02f * camera.distance);
    if (apart > 2 * radius_ || middle + half <= first) return std::nullopt;
    const auto at = [&](float distance) -> Vector3 { return ray.origin + distance * ray.direction; };
    return Edge{at(first), at(middle + half), at(drawnAt * camera.distance)};
}

void CutTool::press(const Camera& camera, const Vector2& pointer) {
    if (!isOn_) return;
    isDown_ = isFirst_ = true;
    pointer_ = pointer;
    last_ = edgeAt(camera, pointer);
    path_.clear();
    if (last_) path_ = {last_->drawn};
}

void CutTool::move(const Camera& camera, const Vector2& pointer) {
    if (!isDown_ || (pointer - pointer_).norm() < shortest) return;
    pointer_ = pointer;
    const std::optional<Edge> edge = edgeAt(camera, pointer);
    if (!edge || !last_) { // beside the stage: another stroke where it comes back
        last_ = edge;
        isFirst_ = true;
        return;
    }
    if (sweeps_.size() >= mostWaiting && !isFirst_) { // the last piece goes on to here
        sweeps_.back().to = {toVec3(edge->near), toVec3(edge->far)};
    } else {
        sweeps_.push_back({{toVec3(last_->near), toVec3(last_->far)},
                           {toVec3(edge->near), toVec3(edge->far)},
                           !std::exchange(isFirst_, false)});
    }
    last_ = edge;
    if (path_.size() == mostStrokePoints) path_.erase(path_.begin());
    path_.push_back(edge->drawn);
}

void CutTool::release() {
    isDown_ = false;
    last_.reset();
}

void CutTool::drop() {
    release();
    sweeps_.clear();
    path_.clear();
}

std::optional<Sweep> CutTool::next() {
    if (sweeps_.empty()) return std::nullopt;
    const Sweep sweep = sweeps_.front();
    sweeps_.pop_front();
    if (sweeps_.empty() && !isDown_) path_.clear();
    return sweep;
}

void CutTool::putBack(std::span<const Sweep> sweeps) {
    sweeps_.insert(sweeps_.begin(), sweeps.begin(), sweeps.end());
}

} // namespace sinew::viewer
