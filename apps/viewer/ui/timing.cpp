// Measures and prints.
#include "viewer/ui/timing.hpp"

#include <cstdio>
#include <ctime>
#include <utility>

namespace sinew::viewer {

namespace {

double milliseconds(Timing::Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
}

double processorMilliseconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

} // namespace

void Timing::firstPicture() {
    hasPicture_ = true;
    afterInput(false, 0); // later input is not delayed by it
    std::printf("first picture: %.0f ms after the start, %.0f ms of processor time\n",
                milliseconds(since_ - start_), processorMilliseconds(CLOCK_PROCESS_CPUTIME_ID));
    std::fflush(stdout);
    times_.clear();
    lastPicture_.reset();
}

void Timing::beforeInput(bool isIdle) {
    const auto passed = Clock::now() - since_;
    const double worked = processorMilliseconds(CLOCK_THREAD_CPUTIME_ID) - workedSince_;
    if (lastPicture_) times_.add(FrameTimes::Kind::thread, worked);
    if (isIdle) lastPicture_.reset();
    if (!isOn_ || !hasPicture_ || passed <= tooLong) return;
    std::printf("input waited %.0f ms, %.0f ms of processor time\n", milliseconds(passed), worked);
    std::fflush(stdout);
}

// An event may have come any time since the last poll, unless it woke a sleeping thread.
void Timing::afterInput(bool isAny, std::size_t onTheirWay) {
    before_ = std::exchange(since_, Clock::now());
    workedSince_ = processorMilliseconds(CLOCK_THREAD_CPUTIME_ID);
    if (isAny && !event_) event_ = {lastPicture_ ? before_ : since_, onTheirWay};
}

void Timing::pictureSubmitted(std::size_t slot, bool isOfCut) {
    const auto now = Clock::now();
    if (lastPicture_) times_.addFrame(milliseconds(now - *lastPicture_), isOfCut);
    lastPicture_ = now;
    shown_[slot] = std::exchange(event_, std::nullopt);
}

void Timing::pictureFinished(std::size_t slot) {
    const std::optional<Event> event = std::exchange(shown_[slot], std::nullopt);
    if (!event) return;
    times_.add(FrameTimes::Kind::inputToPicture, milliseconds(Clock::now() - event->earliest));
    times_.add(FrameTimes::Kind::picturesBefore, static_cast<double>(event->picturesBefore));
}

void Timing::printTable() {
    std::fputs(times_.table().c_str(), stdout);
    std::fflush(stdout);
    times_.clear();
}

} // namespace sinew::viewer
