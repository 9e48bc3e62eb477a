// States of a poke: pressed, asked, answered, released.
#include "viewer/tools/poke_tool.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr float ofSize = 0.12f, smallest = 0.01f, largest = 1; // radius over size
constexpr float mostSpeed = 10, ofSizeInASecond = 8;           // [m/s], [1/s]

Vector3 toVector(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

} // namespace

constinit const Tool tool::poke{.name = "poke",
                                .title = "poke",
                                .key = 'O',
                                .help = "poke: left drag pushes with a sphere",
                                .button = "Poke",
                                .icon = Icon::poke,
                                .letGo = "put the sphere away",
                                .addHints =
                                    [](HintLine& line, const std::optional<float>&) {
                                        line.add("left drag pushes");
                                        line.add("changes its size", {Action::toolSize});
                                        line.add("puts the sphere away", {Action::drop});
                                    },
                                .setting = "radius",
                                .settingHelp = "radius of the sphere",
                                .among = Among::moving,
                                .make = [](const ToolContext& of) -> std::unique_ptr<ToolState> {
                                    return std::make_unique<PokeTool>(of.light.radius(), of.scene.planes);
                                }};

PokeTool::PokeTool(float size, std::vector<sim::Plane> planes)
    : size_(std::max(size, 1e-3f)), radius_(ofSize * size_), planes_(std::move(planes)) {}

void PokeTool::toggle() {
    isOn_ = !isOn_;
    release();
}

void PokeTool::press(const Camera& camera, const Vector2& pointer) {
    if (!isOn_) return;
    release();
    isDown_ = true;
    question_ = rayThrough(camera, pointer);
    planePoint_ = camera.target;
    planeNormal_ = (camera.target - eye(camera)).normalized();
}

void PokeTool::move(const Camera& camera, const Vector2& pointer) {
    if (!isDown_ || question_) return;
    if (const auto at = meet(rayThrough(camera, pointer), planePoint_, planeNormal_)) center_ = *at;
}

void PokeTool::release() {
    isDown_ = false;
    question_.reset();
    center_.reset();
}

void PokeTool::answer(const std::optional<Pick>& pick, float) {
    if (!question_) return;
    const Ray ray = *std::exchange(question_, std::nullopt);
    if (pick) planePoint_ = pick->point;
    center_ = meet(ray, planePoint_, planeNormal_);
}

void PokeTool::setRadius(float radius) {
    radius_ = std::clamp(radius, smallest * size_, largest * size_);
}

void PokeTool::putAway() {
    isOn_ = false;
    release();
    radius_ = ofSize * size_;
}

// Moves the sphere off the planes: a particle pushed by both would be placed wrongly.
std::optional<sim::HostCollider> PokeTool::poke() const {
    if (!center_) return std::nullopt;
    Vector3 at = *center_;
    for (const sim::Plane& plane : planes_) {
        const Vector3 normal = toVector(plane.normal);
        at += std::max(plane.offset + radius_ - normal.dot(at), 0.0f) * normal;
    }
    return sim::HostCollider{.radius = radius_,
                             .pose = {.position = {at.x(), at.y(), at.z()}},
                             .maxSpeed = std::min(mostSpeed, ofSizeInASecond * size_)};
}

} // namespace sinew::viewer
