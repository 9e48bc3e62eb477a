// Places of a stroke that wait for what lies under them. The device says it of one place at a time, and some
// pictures late; between two that it has answered, how far away the surface is goes evenly from one to the
// other.
#pragma once

#include "viewer/draw/camera.hpp"

#include <deque>
#include <optional>

namespace sinew::viewer {

class WaitingStroke {
public:
    /// Where the pointer was.
    struct Place {
        Ray ray;
        float near = 0, far = 0; ///< where the ray comes to the stage, and leaves it [m]
        bool isFirst = false;    ///< of its stroke
    };
    struct Settled {
        Place place;
        float surface = 0; ///< how far away it is, along the ray [m]
    };

    void add(const Place& place);
    /// No more of this stroke comes.
    void end();
    void clear() { *this = {}; }
    /// All that wait, in their order; none waits any more.
    std::deque<Place> takeUnsettled();
    bool isEmpty() const { return waiting_.empty() && settled_.empty(); }

    /// It stays until it is answered.
    const std::optional<Ray>& question() const { return question_; }
    /// How far away the surface is; nothing beside all bodies. There it is as far away as where the stroke
    /// has met one last, or will first. Of a stroke that meets none nothing is left.
    void answer(const std::optional<float>& surface);

    /// The oldest place whose surface is known, once.
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
    std::size_t asked_ = 0;          // place of the question
    std::optional<float> surface_;   // of the newest place of the stroke that is settled
    std::size_t beside_ = 0;         // the newest place beside all bodies, and all before it
    std::size_t low_ = 0, high_ = 0; // of those, the places that may yet be on one
    bool isStarted_ = false, isEnded_ = true;
};

} // namespace sinew::viewer
