// For whoever wants to know (--timing, and a key): how long the first picture took to come, when hands had to
// wait, and what each picture cost.
#pragma once

#include "viewer/window/frame_times.hpp"

#include <array>
#include <chrono>
#include <optional>

namespace sinew::viewer {

/// Prints on stdout, a line each, with the processor time in it: of all threads, or of the one that waits for
/// input. Where it is off it prints nothing but the table that somebody asks for.
class Timing {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds tooLong{100};
    static constexpr std::size_t slots = 2; ///< of pictures in flight, at most

    /// `start` of the program.
    Timing(bool isOn, Clock::time_point start) : isOn_(isOn), start_(start), since_(start), before_(start) {}

    bool isOn() const { return isOn_; }
    /// Whether the first picture is to be waited for.
    bool awaitsPicture() const { return isOn_ && !hasPicture_; }
    /// That picture is there.
    void firstPicture();

    /// Input is taken now: says so where the last time was long ago. `isIdle` where the thread may sleep
    /// until there is some.
    void beforeInput(bool isIdle);
    /// `isAny` input came, while so many pictures were on their way.
    void afterInput(bool isAny, std::size_t onTheirWay);

    /// A picture with all input until now was submitted. `isOfCut` where a step before it cuts.
    void pictureSubmitted(std::size_t slot, bool isOfCut);
    /// It is there.
    void pictureFinished(std::size_t slot);

    FrameTimes& times() { return times_; }
    /// The table, and all begins anew.
    void printTable();

private:
    struct Event {
        Clock::time_point earliest;
        std::size_t picturesBefore = 0;
    };
    bool isOn_, hasPicture_ = false;
    Clock::time_point start_, since_, before_; // since_ and before_: the last looks at input
    double workedSince_ = 0;                   // [ms]
    FrameTimes times_;
    std::optional<Clock::time_point> lastPicture_;  // none: nobody was waiting for the next
    std::optional<Event> event_;                    // in no picture yet
    std::array<std::optional<Event>, slots> shown_; // by a picture on its way
};

} // namespace sinew::viewer
