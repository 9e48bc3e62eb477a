// Controller of camera and time, without a window.
#pragma once

#include "viewer/input/bindings.hpp"
#include "viewer/render/camera.hpp"

#include <algorithm>
#include <cstdint>

namespace sinew::viewer {

/// Work to do before the next picture.
struct Plan {
    bool isReset = false;
    std::uint32_t steps = 0;
};

/// Turns real time into steps of `dt` [s]. Drops time that the machine cannot keep up with.
class Playback {
public:
    static constexpr std::uint32_t maxSteps = 2; ///< before one picture

    explicit Playback(double dt) : dt_(dt) {}

    /// `elapsed` is the time since the last call [s]. `undone` steps are to be repeated: while paused the
    /// plan has them before single steps, and a reset drops them.
    Plan plan(double elapsed, std::uint32_t mostSteps = maxSteps, std::uint64_t undone = 0);
    /// Call after `steps` new steps were recorded. Single steps stay in plans until then, because a plan may
    /// not be carried out.
    void taken(std::uint32_t steps) { singleSteps_ -= std::min(singleSteps_, steps); }
    /// Cancels pending single steps.
    void dropSingleSteps() { singleSteps_ = 0; }

    /// Sets the seconds of the scene per second of the clock, from now on.
    void setPace(double pace) { pace_ = pace; }
    double pace() const { return pace_; }
    /// Halves the pace: 1/2, 1/4, 1/8, then 1 again.
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
    double dt_, owed_ = 0, pace_ = 1; // [s], [s], 1 = real time
    std::uint32_t singleSteps_ = 0;
    bool isPaused_ = false, wantsReset_ = false;
};

class Controller {
public:
    Controller(const Camera& start, double dt) : camera(start), playback(dt) {}

    /// Performs actions on time; false for an action that others also or only handle.
    bool act(Action action);

    /// Orbits or pans by (x, y) picture heights, y down.
    void drag(Action action, const Vector2& heights);

    /// Zooms; wheel notches towards the user are negative. `pointer`: see zoomed().
    void wheel(float notches, const Vector2& pointer);

    Camera camera;
    Playback playback;
};

} // namespace sinew::viewer
