// Queue of messages that the window shows for a while, one at a time.
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

    /// Shows a message at once, and then again a warning or announced message that it replaces. A warning
    /// waits until another warning has been shown. Ignores a message that is shown or waiting.
    void show(Notice notice, Clock::time_point now);
    /// Shows the texts one after the other, the first at once; replaces those announced before.
    void announce(const std::vector<std::string>& texts, Clock::time_point now);
    /// Removes a message that was shown long enough, and shows the next.
    void pass(Clock::time_point now);
    /// True once after the text has changed.
    bool hasChanged();
    /// Has the message drawn again in any case.
    void touch() { hasChanged_ = true; }
    /// The present message; an empty text if there is none.
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
