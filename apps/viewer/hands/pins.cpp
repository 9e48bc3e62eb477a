// Each pin has one entry of Step::grabs.
#include "viewer/hands/pins.hpp"

#include <algorithm>
#include <limits>

namespace sinew::viewer {

// A grab with a NaN target holds nothing.
sim::Grab emptyHand() {
    constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
    return {.target = {nowhere, nowhere, nowhere}};
}

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

} // namespace sinew::viewer
