// The state that actions change.
#include "viewer/input/controller.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew::viewer {

Plan Playback::plan(double elapsed, std::uint32_t mostSteps, std::uint64_t undone) {
    Plan plan{.isReset = std::exchange(wantsReset_, false)};
    if (isPaused_ || plan.isReset) {
        owed_ = 0;
        const std::uint64_t wanted = singleSteps_ + (plan.isReset ? 0 : undone);
        if (isPaused_) plan.steps = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, mostSteps));
        return plan;
    }
    owed_ += pace_ * elapsed;
    const double due = std::floor(owed_ / dt_);
    plan.steps = static_cast<std::uint32_t>(std::min(due, static_cast<double>(mostSteps)));
    owed_ = std::min(owed_ - plan.steps * dt_, dt_);
    return plan;
}

void Playback::toggle() {
    isPaused_ = !isPaused_;
    singleSteps_ = 0;
}

void Playback::step() {
    isPaused_ = true;
    ++singleSteps_;
}

bool Controller::act(Action action) {
    switch (action) {
    case Action::pause:
        playback.toggle();
        return true;
    case Action::step:
        playback.step();
        return true;
    case Action::stepBack:
        playback.pause();
        return false; // handled elsewhere
    case Action::slowMotion:
        playback.slowDown();
        return true;
    case Action::reset:
        playback.reset();
        return true;
    default:
        return false;
    }
}

void Controller::drag(Action action, const Vector2& heights) {
    camera = action == Action::pan ? panned(camera, heights) : orbited(camera, heights);
}

void Controller::wheel(float notches, const Vector2& pointer) {
    camera = zoomed(camera, std::pow(0.88f, notches), pointer);
}

} // namespace sinew::viewer
