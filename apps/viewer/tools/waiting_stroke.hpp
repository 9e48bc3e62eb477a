// Points of a stroke that wait for the depth of the surface below them. The device answers for one point at a
// time, some pictures late; the depth of points between two answers is interpolated linearly.
#pragma once

#include "viewer/render/camera.hpp"

#include <deque>
#include <optional>

namespace sinew::viewer {

class WaitingStroke {
public:
    /// A point of the pointer's path.
    struct Place {
        Ray ray;
        float near = 0, far = 0; ///< where the ray enters and leaves the scene [m]
        bool isFirst = false;    ///< of its stroke
    };
    struct Settled {
        Place place;
        float surface = 0; ///< distance of the surface, along the ray [m]
    };

    void add(const Place& place);
    /// Ends the stroke; no more points are added.
    void end();
    void clear() { *this = {}; }
    /// Removes all waiting points and returns them in order.
    std::deque<Place> takeUnsettled();
    bool isEmpty() const { return waiting_.empty() && settled_.empty(); }

    /// The ray to cast next; it stays until it is answered.
    const std::optional<Ray>& question() const { return question_; }
    /// Answers with the distance of the surface; empty on a miss. Points that miss get the distance of the
    /// stroke's last hit, or of its first. A stroke without a hit is dropped.
    void answer(const std::optional<float>& surface);

    /// Removes and returns the oldest point whose surface is known.
    std::optional<Settled> take();

private:
    std::size_t length() const;
    bool isOver() const;
    void ask();
    void askAt(std::size_t place);
    void settle(std::size_t count, float to);
    void drop(std::size_t count);

    std::deque<Settled> settled_;
    std::deque<Place> waiting_;
    std::optional<Ray> question_;
    std::size_t asked_ = 0;          // point of the question
    std::optional<float> surface_;   // of the newest settled point of the stroke
    std::size_t beside_ = 0;         // number of points up to the newest known miss
    std::size_t low_ = 0, high_ = 0; // among those, points that may still hit
    bool isStarted_ = false, isEnded_ = true;
};

} // namespace sinew::viewer
