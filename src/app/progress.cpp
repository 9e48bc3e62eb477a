// Formatting is pure; the class only decides when to write.
#include "app/progress.hpp"

#include <algorithm>
#include <utility>

#include <unistd.h>

namespace sinew::app {

namespace {

constexpr std::size_t barWidth = 20;
constexpr std::chrono::milliseconds terminalInterval{100};
constexpr std::chrono::seconds pipeInterval{5};

std::string format(const char* pattern, double value) {
    char text[48];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

} // namespace

std::string progressLine(std::uint64_t done, std::uint64_t total, double seconds, const char* unit) {
    std::string line = std::to_string(done) + " of " + std::to_string(total) + " " + unit;
    if (done == 0 || !(seconds > 0)) return line;
    const double rate = static_cast<double>(done) / seconds;
    line += ", " + format(rate < 10 ? "%.2f/s" : "%.0f/s", rate);
    if (done >= total) return line + ", " + format("%.1f s", seconds);
    return line + ", " + format("%.1f s left", static_cast<double>(total - done) / rate);
}

std::string progressBar(std::uint64_t done, std::uint64_t total, double seconds, const char* unit) {
    const double share =
        total == 0 ? 1 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const auto filled = static_cast<std::size_t>(share * barWidth);
    std::string bar(barWidth, '.');
    std::fill_n(bar.begin(), filled, '#');
    return "[" + bar + "] " + format("%3.0f %%  ", 100 * share) + progressLine(done, total, seconds, unit);
}

Progress::Progress(std::uint64_t total, std::FILE* stream, const char* unit)
    : total_(total), stream_(stream), unit_(unit), isTerminal_(isatty(fileno(stream)) == 1),
      start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
    if (isTerminal_ && !isFinished_ && done_ > 0) std::fputc('\n', stream_);
}

void Progress::update(std::uint64_t done) {
    done_ = done;
    const Clock::time_point now = Clock::now();
    if (now - last_ < (isTerminal_ ? Clock::duration(terminalInterval) : Clock::duration(pipeInterval)))
        return;
    last_ = now;
    write();
}

void Progress::finish() {
    if (std::exchange(isFinished_, true)) return;
    write();
    if (isTerminal_) std::fputc('\n', stream_);
}

void Progress::write() {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string text = isTerminal_ ? progressBar(done_, total_, seconds, unit_)
                                   : progressLine(done_, total_, seconds, unit_);
    // \033[K clears what a longer line left behind.
    text = isTerminal_ ? "\r" + text + "\033[K" : text + "\n";
    std::fputs(text.c_str(), stream_);
    std::fflush(stream_);
}

} // namespace sinew::app
