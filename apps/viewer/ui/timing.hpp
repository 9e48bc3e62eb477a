// Timing report for --timing and a key: time to the first picture, delays of input, and the cost of each
// picture.
#pragma once

#include "viewer/ui/frame_times.hpp"

#include <array>
#include <chrono>
#include <optional>

namespace sinew::viewer {

/// Prints lines on stdout, with processor time: of all threads, or of the input thread. If off, it prints
/// only a requested table.
class Timing {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::milliseconds tooLong{100};
    static constexpr std::size_t slots = 2; ///< most pictures in flight

    /// `start` of the program.
    Timing(bool isOn, Clock::time_point start) : isOn_(isOn), start_(start), since_(start), before_(start) {}

    bool isOn() const { return isOn_; }
    /// Whether the first picture is still awaited.
    bool awaitsPicture() const { return isOn_ && !hasPicture_; }
    /// Call when the first picture has finished.
    void firstPicture();

    /// Call before input is polled: reports a long time since the last poll. `isIdle`: the thread may sleep
    /// until there is input.
    void beforeInput(bool isIdle);
    /// Call after the poll. `isAny`: there was input; `onTheirWay`: pictures in flight.
    void afterInput(bool isAny, std::size_t onTheirWay);

    /// Call after a picture with all input so far was submitted. `isOfCut`: a step before it cuts.
    void pictureSubmitted(std::size_t slot, bool isOfCut);
    /// Call when that picture has finished.
    void pictureFinished(std::size_t slot);

    FrameTimes& times() { return times_; }
    /// Prints the table and starts new statistics.
    void printTable();

private:
    struct Event {
        Clock::time_point earliest;
        std::size_t picturesBefore = 0;
    };
    bool isOn_, hasPicture_ = false;
    Clock::time_point start_, since_, before_; // since_ and before_: the last polls
    double workedSince_ = 0;                   // [ms]
    FrameTimes times_;
    std::optional<Clock::time_point> lastPicture_;  // empty: no picture was due next
    std::optional<Event> event_;                    // not in a picture yet
    std::array<std::optional<Event>, slots> shown_; // in pictures in flight
};

} // namespace sinew::viewer
