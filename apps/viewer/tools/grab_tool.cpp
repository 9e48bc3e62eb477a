// States of a grab: pressed, asked, answered, released.
#include "viewer/tools/grab_tool.hpp"

#include <utility>

namespace sinew::viewer {

constinit const Tool tool::hand{
    .name = "hand",
    .title = "holding",
    .icon = Icon::grab,
    .letGo = "release the body",
    .offer = "drag to pull",
    .addHints =
        [](HintLine& line, const std::optional<float>&) {
            line.add("pull");
            line.add("release to drop");
        },
    .among = Among::moving,
    .make = [](const ToolContext&) -> std::unique_ptr<ToolState> { return std::make_unique<GrabTool>(); }};

void GrabTool::press(const Camera& camera, const Vector2& pointer) {
    release();
    isDown_ = true;
    question_ = rayThrough(camera, pointer);
    planeNormal_ = (camera.target - eye(camera)).normalized();
}

void GrabTool::release() {
    isDown_ = isMiss_ = false;
    question_.reset();
    waiting_.setZero();
    grabs_.clear();
}

void GrabTool::answer(const std::optional<Pick>& pick, float radius) {
    if (!question_) return;
    question_.reset();
    isMiss_ = !pick;
    if (!pick) return;
    planePoint_ = pick->point;
    offset_ = pick->offset;
    const Vector3& at = pick->point;
    grabs_ = {{.particle = pick->particle, .radius = radius, .target = {at.x(), at.y(), at.z()}}};
}

void GrabTool::move(const Camera& camera, const Vector2& pointer) {
    if (grabs_.empty()) return;
    const std::optional<Vector3> at = meet(rayThrough(camera, pointer), planePoint_, planeNormal_);
    if (at) grabs_[0].target = {at->x(), at->y(), at->z()};
}

Vector2 GrabTool::drag(const Vector2& heights) {
    if (!isDown_ || isHolding()) return Vector2::Zero();
    waiting_ += heights;
    return isMiss_ ? std::exchange(waiting_, Vector2::Zero()) : Vector2::Zero();
}

std::optional<Hand> GrabTool::hand() const {
    if (grabs_.empty()) return std::nullopt;
    const sim::Vec3& target = grabs_[0].target;
    return Hand{grabs_[0].particle, offset_, {target.x, target.y, target.z}};
}

std::optional<Held> GrabTool::held() const {
    const std::optional<Hand> held = hand();
    return held ? std::optional(Held{*held, radius()}) : std::nullopt;
}

void GrabTool::addTo(StepHands& hands) {
    if (isHolding()) hands.grabs[0] = grabs_[0];
}

} // namespace sinew::viewer
