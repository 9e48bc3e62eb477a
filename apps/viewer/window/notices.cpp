// A queue of texts.
#include "viewer/window/notices.hpp"

#include <utility>

namespace sinew::viewer {

void Notices::show(Notice notice, Clock::time_point now) {
    until_ = now + (notice.isBad ? warningStays : notePasses);
    shown_ = std::move(notice);
    hasChanged_ = true;
}

void Notices::announce(const std::vector<std::string>& texts, Clock::time_point now) {
    waiting_.assign(texts.begin(), texts.end());
    if (waiting_.empty()) return;
    show({waiting_.front()}, now);
    waiting_.pop_front();
}

void Notices::pass(Clock::time_point now) {
    if (shown_.text.empty() || now < until_) return;
    if (waiting_.empty()) {
        shown_ = {};
        hasChanged_ = true;
        return;
    }
    show({waiting_.front()}, now);
    waiting_.pop_front();
}

bool Notices::hasChanged() {
    return std::exchange(hasChanged_, false);
}

} // namespace sinew::viewer
