// What actions do to the camera and to time, without a window.
#pragma once

#include "viewer/draw/camera.hpp"
#include "viewer/hands/bindings.hpp"

#include <algorithm>
#include <cstdint>

namespace sinew::viewer {

/// What to do before the next picture.
struct Plan {
    bool isReset = false;
    std::uint32_t steps = 0;
};

/// Turns real time into steps of `dt` [s]. Time the machine cannot keep up with is dropped, not made up for.
class Playback {
public:
    static constexpr std::uint32_t maxSteps = 2; ///< before one picture

    explicit Playback(double dt) : dt_(dt) {}

    /// `elapsed` is the time since the last call [s]. `undone` steps had been taken and are to be taken
    /// again: while paused the plan has them before single steps, and a reset drops them.
    Plan plan(double elapsed, std::uint32_t mostSteps = maxSteps, std::uint64_t undone = 0);
    /// So many steps were recorded that were not taken before. Single steps stay in plans until then, because
    /// a plan may come to nothing.
    void taken(std::uint32_t steps) { singleSteps_ -= std::min(singleSteps_, steps); }
    /// No single step is taken after all.
    void dropSingleSteps() { singleSteps_ = 0; }

    /// Seconds of the scene in a second of the clock, from now on.
    void setPace(double pace) { pace_ = pace; }
    double pace() const { return pace_; }
    /// A half, a quarter, an eighth, and then full pace again.
    void slowDown() { pace_ = pace_ > 0.2 ? pace_ / 2 : 1; }

    void pause() {
        isPaused_ = true;
        singleSteps_ = 0;
    }
    void toggle();
    void step();
    void reset() { wantsReset_ = true; }
    bool isPaused() const { return isPaused_; }

private:
    double dt_, owed_ = 0, pace_ = 1; // [s]; pace: 1 = real time
    std::uint32_t singleSteps_ = 0;
    bool isPaused_ = false, wantsReset_ = false;
};

class Controller {
public:
    Controller(const Camera& start, double dt) : camera(start), playback(dt) {}

    /// Does what concerns time; false for an action that belongs, or belongs as well, to somebody else.
    bool act(Action action);

    /// An orbit or a pan by (x, y) picture heights, y down.
    void drag(Action action, const Vector2& heights);

    /// Wheel notches towards the viewer are negative. `pointer` as zoomed() takes it.
    void wheel(float notches, const Vector2& pointer);

    Camera camera;
    Playback playback;
};

} // namespace sinew::viewer
