// Prints.
#include "viewer/window/timing.hpp"

#include <cstdio>
#include <ctime>

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
    afterInput(); // nobody waits for anything else before it
    std::printf("first picture: %.0f ms after the start, %.0f ms of processor time\n",
                milliseconds(since_ - start_), processorMilliseconds(CLOCK_PROCESS_CPUTIME_ID));
    std::fflush(stdout);
}

void Timing::afterInput() {
    since_ = Clock::now();
    workedSince_ = processorMilliseconds(CLOCK_THREAD_CPUTIME_ID);
}

void Timing::beforeInput() {
    const auto passed = Clock::now() - since_;
    if (!isOn_ || !hasPicture_ || passed <= tooLong) return;
    std::printf("hands waited %.0f ms, %.0f ms of processor time\n", milliseconds(passed),
                processorMilliseconds(CLOCK_THREAD_CPUTIME_ID) - workedSince_);
    std::fflush(stdout);
}

} // namespace sinew::viewer
