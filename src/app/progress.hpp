// How far a long run is: a bar with rate and remaining time on a terminal, plain lines now and then in a
// pipe.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace sinew::app {

/// "[#####...............]  25 %  60 of 240 steps, 312/s, 0.6 s left", fit for a terminal's line.
std::string progressBar(std::uint64_t done, std::uint64_t total, double seconds, const char* unit = "steps");
/// "60 of 240 steps, 312/s, 0.6 s left".
std::string progressLine(std::uint64_t done, std::uint64_t total, double seconds, const char* unit = "steps");

/// Writes to `stream`, which it does not own. On a terminal the bar is drawn over itself ten times a second;
/// otherwise a line is written every five seconds and at the end.
class Progress {
public:
    /// `unit` is what is counted, in the plural; not owned.
    Progress(std::uint64_t total, std::FILE* stream, const char* unit = "steps");
    ~Progress(); ///< leaves the terminal's cursor on a line of its own
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(std::uint64_t done);
    void finish(); ///< writes the last state

private:
    using Clock = std::chrono::steady_clock;
    void write();

    std::uint64_t total_, done_ = 0;
    std::FILE* stream_;
    const char* unit_;
    bool isTerminal_, isFinished_ = false;
    Clock::time_point start_, last_;
};

} // namespace sinew::app
