// The tools' part in steps, and undo of steps.
#include "viewer/tools/tools.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

void recordStep(VkCommandBuffer commands, Document& document, const StepHands& hands,
                vk::Timestamps* timestamps) noexcept {
    recordStep(std::span(&commands, 1), document, hands, timestamps);
}

void recordStep(std::span<const VkCommandBuffer> parts, Document& document, const StepHands& hands,
                vk::Timestamps* timestamps) noexcept {
    sim::Blade blade;
    if (hands.sweep)
        blade = {.from = hands.sweep->from, .to = hands.sweep->to, .isCarried = hands.sweep->isCarried};
    const std::span<const sim::HostCollider> hostColliders =
        hands.collider ? std::span(&*hands.collider, 1) : std::span<const sim::HostCollider>();
    document.recordStep(parts, timestamps, hands.grabs, blade, hostColliders);
}

// Undoes steps and releases all grabs, like undo of cuts; drops cuts of a later time.
bool Tools::goBack(VkCommandBuffer commands, Document& document) {
    const std::uint32_t wanted = std::exchange(stepsBack_, 0);
    steps_.limit(keptSteps_); // as many as without repeated steps
    if (steps_.undos() == 0) {
        note_ = "there is no earlier step to go back to";
        return false;
    }
    log_.goBack();
    clear();
    for (std::uint32_t step = 0; step < wanted && steps_.recordBack(commands, document); ++step) {
    }
    history_.forgetFrom(document.played());
    return true;
}

bool Tools::recordHistory(VkCommandBuffer commands, Document& document) {
    if (stepsBack_ > 0) return goBack(commands, document);
    const bool isUndo = std::exchange(wantsUndo_, false), isRedo = std::exchange(wantsRedo_, false);
    if (!isUndo && !isRedo) return false;
    if ((isUndo ? history_.undos() : history_.redos()) == 0) return false; // grabs and pins stay
    log_.goBack();
    clear();
    steps_.recycle(); // they belong to another past
    return isUndo ? history_.recordUndo(commands, document) : history_.recordRedo(commands, document);
}

// Saves a state before a cut; without memory the cut happens all the same.
void Tools::remember(VkCommandBuffer commands, const Document& document) {
    try {
        history_.recordBefore(commands, document);
    } catch (const vk::Error& error) {
        if (!std::exchange(isForgetful_, true))
            say(std::string("warning: this cut cannot be undone: ") + error.what());
    }
}

// Saves a state before a step, unless states are so large that few fit.
void Tools::rememberStep(VkCommandBuffer commands, const Document& document) {
    constexpr std::size_t worthIt = 8;
    if (isForgetfulOfSteps_ || steps_.room(document) < worthIt) return;
    keptSteps_ = steps_.room(document);
    try {
        steps_.recordBefore(commands, document, document.repeats() ? mostTakenBack : 0);
    } catch (const vk::Error&) { // no memory: the present ones stay
        isForgetfulOfSteps_ = true;
    }
}

StepHands Tools::takeStep(VkCommandBuffer commands, const Document& document) {
    log_.step();
    rememberStep(commands, document);
    if (std::ranges::any_of(states_, [](const auto& one) { return one->beginsStroke(); }))
        remember(commands, document);
    StepHands hands;
    for (const auto& state : states_) state->addTo(hands);
    return hands;
}

void Tools::moveOn() {
    log_.forget({.areOfSteps = !isLost_});
    reshaped();
}

void Tools::restart(const Document& document, std::span<const Sweep> undone, std::uint64_t steps) {
    log_.takeBack(steps);
    moveOn();
    forgetUndone(document, undone);
    for (const auto& state : states_) state->putBack(undone);
}

void Tools::takeBack(const Document& document, std::span<const Sweep> undone, std::uint64_t steps) {
    log_.takeBack(steps);
    steps_.forgetFrom(document.played());
    forgetUndone(document, undone);
    for (const auto& state : states_) state->putBack(undone);
}

void Tools::forgetUndone(const Document& document, std::span<const Sweep> undone) {
    const auto begins = std::ranges::count(undone, false, &Sweep::isCarried);
    history_.forgetFrom(document.played(), static_cast<std::size_t>(begins));
}

} // namespace sinew::viewer
