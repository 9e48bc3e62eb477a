// Texts that the window shows for a while: one at a time, the others wait for it to go.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <vector>

namespace sinew::viewer {

struct Notice {
    std::string text{};
    bool isBad = false;       ///< a warning
    bool isAnnounced = false; ///< about the scene
};

/// One thread.
class Notices {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds warningStays{12}, notePasses{4};

    /// Shows it at once, and after it again a warning or something announced that it replaces. A warning
    /// waits for another warning to go. Nothing is shown that is shown or waits already.
    void show(Notice notice, Clock::time_point now);
    /// Shows notes one after the other, the first at once, in place of those announced before.
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
    void start(Notice notice, Clock::time_point now);
    void next(Clock::time_point now);

    Notice shown_;
    std::deque<Notice> waiting_; // warnings first
    Clock::time_point until_{};
    bool hasChanged_ = false;
};

} // namespace sinew::viewer
