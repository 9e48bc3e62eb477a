// The queue of messages.
#include "viewer/ui/notices.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

void Notices::show(Notice notice, Clock::time_point now) {
    const bool isUp = !shown_.text.empty() && now < until_;
    const auto isSame = [&](const Notice& other) { return other.text == notice.text; };
    if ((isUp && isSame(shown_)) || std::ranges::any_of(waiting_, isSame)) return;
    const auto afterWarnings = [&] { return std::ranges::find(waiting_, false, &Notice::isBad); };
    if (isUp && notice.isBad && shown_.isBad) {
        waiting_.insert(afterWarnings(), std::move(notice));
        return;
    }
    if (isUp && shown_.isBad)
        waiting_.push_front(std::move(shown_));
    else if (isUp && shown_.isAnnounced)
        waiting_.insert(afterWarnings(), std::move(shown_));
    start(std::move(notice), now);
}

void Notices::announce(const std::vector<std::string>& texts, Clock::time_point now) {
    std::erase_if(waiting_, &Notice::isAnnounced);
    for (const std::string& text : texts) waiting_.push_back({.text = text, .isAnnounced = true});
    const bool isFree = shown_.text.empty() || shown_.isAnnounced || now >= until_;
    if (isFree ? !shown_.text.empty() || !waiting_.empty() : !shown_.isBad && !texts.empty()) next(now);
}

void Notices::pass(Clock::time_point now) {
    if (!shown_.text.empty() && now >= until_) next(now);
}

void Notices::start(Notice notice, Clock::time_point now) {
    until_ = now + (notice.isBad ? warningStays : notePasses);
    shown_ = std::move(notice);
    hasChanged_ = true;
}

void Notices::next(Clock::time_point now) {
    Notice notice;
    if (!waiting_.empty()) {
        notice = std::move(waiting_.front());
        waiting_.pop_front();
    }
    start(std::move(notice), now);
}

bool Notices::hasChanged() {
    return std::exchange(hasChanged_, false);
}

} // namespace sinew::viewer
