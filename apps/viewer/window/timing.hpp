// For whoever wants to know (--timing): how long the first picture took to come, and when hands had to wait.
#pragma once

#include <chrono>

namespace sinew::viewer {

/// Prints on stdout, a line each, with the processor time in it: of all threads, or of the one that waits for
/// input. Where it is off it does nothing.
class Timing {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds tooLong{100};

    /// `start` of the program.
    Timing(bool isOn, Clock::time_point start) : isOn_(isOn), start_(start), since_(start) {}

    /// Whether the first picture is to be waited for.
    bool awaitsPicture() const { return isOn_ && !hasPicture_; }
    /// That picture is there.
    void firstPicture();

    /// Input is taken now: says so where the last time was long ago.
    void beforeInput();
    void afterInput();

private:
    bool isOn_, hasPicture_ = false;
    Clock::time_point start_, since_;
    double workedSince_ = 0; ///< [ms]
};

} // namespace sinew::viewer
