// Moves shorter than a pixel or two are collected; if steps cannot keep up with a stroke, its pieces get
// longer.
#include "viewer/tools/cut_tool.hpp"

#include "viewer/render/length_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr float shortest = 0.003f;      // move of the pointer that adds an edge [window heights]
constexpr std::size_t mostWaiting = 16; // sweeps
constexpr float drawnAt = 0.3f;         // share of the distance from the eye to the scene
constexpr float leastDepth = 0.01f, mostDepth = 0.5f, deeper = 1.15f; // of the scene's radius; notch factor
constexpr std::uint32_t stepsUnseen = 6; // until the surface under the pointer is queried again

sim::Vec3 toVec3(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

// "0.012 m deep", "through".
std::string depthText(const std::optional<float>& depth) {
    if (!depth) return "through";
    return lengthText(*depth) + " deep";
}

} // namespace

constinit const Tool tool::blade{
    .name = "blade",
    .title = "blade",
    .key = 'C',
    .help = "blade: left drag cuts, through or to the set depth",
    .button = "Blade",
    .icon = Icon::cut,
    .letGo = "put the blade away",
    .offer = "hold Ctrl and drag to cut",
    .addHints =
        [](HintLine& line, const std::optional<float>& depth) {
            line.add("left drag cuts " + depthText(depth));
            line.add("undoes the cut", {Action::undo});
            line.add("changes its depth", {Action::toolSize});
            line.add("puts the blade away", {Action::drop});
        },
    .setting = "depth",
    .settingHelp = "depth of the blade",
    .isSettingOptional = true,
    .settingNote = [](const std::optional<float>& depth) { return "the blade goes " + depthText(depth); },
    .isLent = true,
    .asksMuch = true,
    .fits = [](const sim::Scene& scene) { return std::ranges::any_of(scene.grids, &sim::Grid::isCuttable); },
    .refusal = "Nothing in this scene can be cut. Add `cuttable = true` to a body in the scene file.",
    .make = [](const ToolContext& of) -> std::unique_ptr<ToolState> {
        auto state = std::make_unique<CutTool>(of.light.bounds);
        state->setDepth(of.bladeDepth);
        return state;
    }};

CutTool::CutTool(const Box& scene)
    : center_(scene.center()), radius_(0.75f * std::max(scene.diagonal().norm(), 1e-3f)) {}

void CutTool::toggle() {
    isOn_ = !isOn_;
    if (isOn_) return;
    release();
    preview_.reset();
    previewed_.reset();
    surface_.reset();
    showDepth();
}

CutTool::Depths CutTool::depths() const {
    return {leastDepth * radius_, mostDepth * radius_};
}

// Points that still wait for the old depth are cut with the new one.
void CutTool::setDepth(const std::optional<float>& depth) {
    const auto [least, most] = depths();
    depth_ = depth ? std::optional(std::clamp(*depth, least, most)) : std::nullopt;
    if (!depth_) {
        cutSettled();
        for (const Place& place : waiting_.takeUnsettled()) cut(place, place.far);
    }
    preview_.reset();
    previewed_.reset();
    showDepth();
}

void CutTool::deepen(float notches) {
    const auto [least, most] = depths();
    if (!depth_) {
        if (notches < 0) setDepth(most);
        return;
    }
    const float depth = *depth_ * std::pow(deeper, notches);
    setDepth(depth > 1.001f * most ? std::nullopt : std::optional(depth));
}

// The part of the ray inside the ball around the scene; empty if it misses the ball.
std::optional<CutTool::Place> CutTool::placeAt(const Ray& ray, float nearest) const {
    const float middle = (center_ - ray.origin).dot(ray.direction);
    const float apart = (ray.origin + middle * ray.direction - center_).norm();
    const float half = std::sqrt(std::max(radius_ * radius_ - apart * apart, 0.01f * radius_ * radius_));
    const float first = std::max(middle - half, nearest);
    if (apart > 2 * radius_ || middle + half <= first) return std::nullopt;
    return Place{ray, first, middle + half};
}

void CutTool::press(const Camera& camera, const Vector2& pointer) {
    if (!isOn_) return;
    hover(camera, pointer);
    isDown_ = isBeside_ = true;
    pointer_ = pointer;
    path_.clear();
    if (const auto place = placeAt(hovered_, 0.02f * camera.distance)) add(camera, *place);
}

void CutTool::move(const Camera& camera, const Vector2& pointer) {
    if (isOn_) hover(camera, pointer);
    if (!isDown_ || (pointer - pointer_).norm() < shortest) return;
    pointer_ = pointer;
    if (const auto place = placeAt(hovered_, 0.02f * camera.distance))
        add(camera, *place);
    else
        isBeside_ = true; // a new stroke starts if the pointer returns
}

void CutTool::add(const Camera& camera, Place place) {
    place.isFirst = std::exchange(isBeside_, false);
    if (path_.size() == mostStrokePoints) path_.erase(path_.begin());
    path_.emplace_back(place.ray.origin + drawnAt * camera.distance * place.ray.direction);
    if (!depth_) return cut(place, place.far);
    waiting_.add(place);
    cutSettled();
}

void CutTool::cut(const Place& place, float far) {
    const auto at = [&](float distance) -> Vector3 {
        return place.ray.origin + distance * place.ray.direction;
    };
    const Edge edge{at(place.near), at(far)};
    if (place.isFirst || !last_) {
        isFirst_ = true;
    } else if (sweeps_.size() >= mostWaiting && !isFirst_) { // the last piece is extended to here
        sweeps_.back().to = {toVec3(edge.near), toVec3(edge.far)};
    } else {
        sweeps_.push_back({{toVec3(last_->near), toVec3(last_->far)},
                           {toVec3(edge.near), toVec3(edge.far)},
                           !std::exchange(isFirst_, false)});
    }
    last_ = edge;
}

void CutTool::cutSettled() {
    while (const auto settled = waiting_.take()) {
        const Place& place = settled->place;
        const float far = settled->surface + depth_.value_or(place.far);
        if (far > place.near)
            cut(place, std::min(far, place.far));
        else
            last_.reset(); // the surface is too near the eye
    }
}

void CutTool::answer(const std::optional<Pick>& pick, float) {
    if (!waiting_.question()) return;
    const Ray ray = *waiting_.question();
    std::optional<float> surface;
    if (pick) surface_ = surface = (pick->point - ray.origin).dot(ray.direction);
    waiting_.answer(surface);
    cutSettled();
    showDepth();
}

// Asks for one preview at a time, of the newest point.
void CutTool::hover(const Camera& camera, const Vector2& pointer) {
    camera_ = camera;
    hovered_ = rayThrough(camera, pointer);
    if (depth_ && !isDown_ && !preview_ && previewed_ != hovered_) preview_ = hovered_;
    showDepth();
}

void CutTool::answerPreview(const std::optional<Pick>& pick) {
    if (!preview_) return;
    const Ray ray = *(previewed_ = std::exchange(preview_, std::nullopt));
    if (pick) surface_ = (pick->point - ray.origin).dot(ray.direction);
    stepsSince_ = 0;
    showDepth();
}

void CutTool::stepTaken() {
    if (++stepsSince_ > stepsUnseen) previewed_.reset();
}

// Draws the gauge downwards on the picture: along the ray itself it would have no length.
void CutTool::showDepth() {
    gauge_.clear();
    if (!isOn_ || !depth_ || !surface_ || !(*surface_ > 0)) return;
    const float drawn = drawnAt * camera_.distance;
    const Vector3 down = -viewMatrix(camera_).block<1, 3>(1, 0).transpose();
    const Vector3 from = hovered_.origin + drawn * hovered_.direction;
    gauge_ = {from, from + *depth_ * drawn / *surface_ * down};
}

void CutTool::release() {
    isDown_ = false;
    isBeside_ = true;
    waiting_.end();
}

void CutTool::drop() {
    release();
    waiting_.clear();
    sweeps_.clear();
    path_.clear();
}

void CutTool::putAway() {
    if (isOn_) toggle();
    drop();
    setDepth(std::nullopt);
}

void CutTool::addTo(StepHands& hands) {
    stepTaken();
    if (const std::optional<Sweep> one = next()) hands.sweep = one;
}

void CutTool::addTo(Overlay& overlay) const {
    overlay.stroke = path_;
    overlay.gauge = gauge_;
}

std::optional<Sweep> CutTool::next() {
    std::optional<Sweep> sweep;
    if (!sweeps_.empty()) {
        sweep = sweeps_.front();
        sweeps_.pop_front();
    }
    if (!isCutting()) path_.clear();
    return sweep;
}

void CutTool::putBack(std::span<const Sweep> sweeps) {
    sweeps_.insert(sweeps_.begin(), sweeps.begin(), sweeps.end());
}

} // namespace sinew::viewer
