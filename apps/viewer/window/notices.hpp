// What the window says for a while: one text at a time, and others that wait for it to go.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <vector>

namespace sinew::viewer {

struct Notice {
    std::string text{};
    bool isBad = false;
};

/// One thread.
class Notices {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds warningStays{12}, notePasses{4};

    /// Shows it at once, in place of what is shown.
    void show(Notice notice, Clock::time_point now);
    /// Shows notes one after the other, the first at once, in place of those that still wait.
    void announce(const std::vector<std::string>& texts, Clock::time_point now);
    /// Takes away what was shown long enough, and shows the next.
    void pass(Clock::time_point now);
    /// True once after the text has changed.
    bool hasChanged();
    /// To be drawn anew whatever it is.
    void touch() { hasChanged_ = true; }
    /// An empty text where there is nothing to say.
    const Notice& shown() const { return shown_; }

private:
    Notice shown_;
    std::deque<std::string> waiting_;
    Clock::time_point until_{};
    bool hasChanged_ = false;
};

} // namespace sinew::viewer
