// Asks for the first point of a stroke, and then for the newest one. If that one misses, bisection finds
// where the stroke has left or met a body. A body crossed entirely between two such points is missed.
#include "viewer/tools/waiting_stroke.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

void WaitingStroke::add(const Place& place) {
    if (waiting_.empty() && place.isFirst) isStarted_ = false;
    isEnded_ = false;
    waiting_.push_back(place);
    ask();
}

void WaitingStroke::end() {
    isEnded_ = true;
    ask();
}

std::deque<WaitingStroke::Place> WaitingStroke::takeUnsettled() {
    std::deque<Place> places = std::exchange(waiting_, {});
    clear();
    return places;
}

// Number of waiting points of the oldest stroke.
std::size_t WaitingStroke::length() const {
    std::size_t count = waiting_.empty() ? 0 : 1;
    while (count < waiting_.size() && !waiting_[count].isFirst) ++count;
    return count;
}

bool WaitingStroke::isOver() const {
    return isEnded_ || length() < waiting_.size();
}

void WaitingStroke::ask() {
    while (!question_ && !waiting_.empty()) {
        if (waiting_.front().isFirst && !std::exchange(isStarted_, true)) {
            surface_.reset();
            beside_ = low_ = high_ = 0;
            askAt(0);
        } else if (low_ < high_) {
            askAt(low_ + (high_ - low_) / 2);
        } else if (beside_ > 0 && surface_) {
            settle(beside_, *surface_);
        } else if (beside_ > 1) { // points before the first hit
            drop(beside_ - 1);
            waiting_.front().isFirst = true;
        } else if (length() > beside_) {
            askAt(length() - 1);
        } else if (isOver()) {
            drop(length());
            isStarted_ = false;
        } else {
            return;
        }
    }
}

void WaitingStroke::askAt(std::size_t place) {
    asked_ = place;
    question_ = waiting_[place].ray;
}

void WaitingStroke::answer(const std::optional<float>& surface) {
    if (!question_) return;
    question_.reset();
    if (surface) {
        settle(asked_ + 1, *surface);
    } else if (asked_ >= beside_) {
        low_ = beside_;
        high_ = asked_;
        beside_ = asked_ + 1;
    } else {
        high_ = asked_;
    }
    ask();
}

// Interpolates linearly from the last settled point; points before the first hit get its distance.
void WaitingStroke::settle(std::size_t count, float to) {
    const float from = surface_.value_or(to);
    for (std::size_t i = 0; i < count; ++i) {
        const float part = static_cast<float>(i + 1) / static_cast<float>(count);
        settled_.push_back({waiting_[i], from + part * (to - from)});
    }
    surface_ = to;
    drop(count);
}

void WaitingStroke::drop(std::size_t count) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t* place : {&beside_, &low_, &high_}) *place -= std::min(*place, count);
    if (!waiting_.empty() && waiting_.front().isFirst) isStarted_ = false;
}

std::optional<WaitingStroke::Settled> WaitingStroke::take() {
    if (settled_.empty()) return std::nullopt;
    const Settled oldest = settled_.front();
    settled_.pop_front();
    return oldest;
}

} // namespace sinew::viewer
