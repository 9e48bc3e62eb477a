// Each pin has one entry of Step::grabs.
#include "viewer/tools/pins.hpp"

#include "sinew/inverse_masses.hpp"

#include <algorithm>
#include <limits>

namespace sinew::viewer {

constinit const Tool tool::pins{
    .name = "pin",
    .title = "pin",
    .key = 'N',
    .help = "pin the held body, or the one under the pointer; on a pin: remove it",
    .button = "Pin",
    .icon = Icon::pin,
    .offerHeld = "pins it there",
    .awaited = "click a body to pin it, or a pin to remove it",
    .isMomentary = true,
    .make = [](const ToolContext& of) -> std::unique_ptr<ToolState> {
        return std::make_unique<PinTool>(of.scene, of.holds, 0.04f * of.light.radius());
    }};

// Stiffer than the pointer's grab and critically damped: gravity moves the held point by a millimetre.
bool Pins::add(const Hand& hand, float radius) {
    const auto free = std::ranges::find_if(hands_, [](const std::optional<Hand>& one) { return !one; });
    if (free == hands_.end()) return false;
    *free = hand;
    const Vector3& at = hand.target;
    grabs_[static_cast<std::size_t>(free - hands_.begin())] = {.particle = hand.particle,
                                                               .radius = radius,
                                                               .target = {at.x(), at.y(), at.z()},
                                                               .stiffness = 10'000,
                                                               .damping = 200,
                                                               .maxAcceleration = 10'000};
    show();
    return true;
}

bool Pins::takeOut(const Ray& ray, float reach) {
    float nearest = std::numeric_limits<float>::infinity();
    std::size_t found = most;
    for (std::size_t i = 0; i < most; ++i) {
        if (!hands_[i]) continue;
        const Vector3 from = hands_[i]->target - ray.origin;
        const float along = from.dot(ray.direction);
        if (along <= 0 || along >= nearest || (from - along * ray.direction).norm() > reach) continue;
        nearest = along;
        found = i;
    }
    if (found == most) return false;
    hands_[found].reset();
    grabs_[found] = emptyHand();
    show();
    return true;
}

void Pins::clear() {
    hands_.fill(std::nullopt);
    grabs_.fill(emptyHand());
    show();
}

void Pins::show() {
    shown_.clear();
    for (const std::optional<Hand>& hand : hands_)
        if (hand) shown_.push_back(*hand);
}

PinTool::PinTool(const sim::Scene& scene, std::vector<sim::NamedHold> holds, float reach)
    : holds_(std::move(holds)), reach_(reach) {
    for (const float inverseMass : sim::inverseMasses(scene)) isFixed_.push_back(inverseMass == 0);
}

// Pins the held point, or asks for the point under the pointer.
bool PinTool::use(const Ray& ray, const std::optional<Held>& held) {
    if (held)
        pin(held->hand, held->radius);
    else if (!pins_.takeOut(ray, reach_))
        question_ = ray;
    return held.has_value();
}

void PinTool::answer(const std::optional<Pick>& pick, float radius) {
    if (!question_) return;
    question_.reset();
    if (!pick)
        note_ = "no body to pin under the pointer";
    else if (isFixed_[pick->particle])
        note_ = heldText(pick->particle);
    else
        pin({pick->particle, pick->offset, pick->point}, radius);
}

void PinTool::pin(const Hand& hand, float radius) {
    if (!pins_.add(hand, radius)) note_ = "at most " + std::to_string(Pins::most) + " pins are possible";
}

std::string PinTool::heldText(std::uint32_t particle) const {
    const sim::NamedHold* hold = sim::holdOf(holds_, particle);
    const std::string name = hold != nullptr ? " (\"" + hold->name + "\")" : "";
    return "The scene already holds this point" + name + ", so N can neither pin nor release it.";
}

void PinTool::clear() {
    pins_.clear();
    question_.reset();
}

void PinTool::addTo(StepHands& hands) {
    std::ranges::copy(pins_.grabs(), hands.grabs.begin() + 1);
}

} // namespace sinew::viewer
