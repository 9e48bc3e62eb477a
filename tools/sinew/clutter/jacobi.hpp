// The clutter scene as a tuned native program: averaged Jacobi over neighbour lists on two threads. It is the
// baseline for a software device, which computes on the same two cores.
#pragma once

#include "sinew/clutter/grid.hpp"

#include <barrier>
#include <thread>

namespace sinew::tools::clutter {

class Jacobi {
public:
    static constexpr std::uint32_t threads = 2;

    explicit Jacobi(Balls balls);
    ~Jacobi();
    Jacobi(const Jacobi&) = delete;
    Jacobi& operator=(const Jacobi&) = delete;

    void step(); ///< of the scene's length
    const Balls& balls() const { return balls_; }

private:
    struct Range {
        std::size_t first, end;
    };
    Range rangeOf(std::uint32_t thread) const;
    void work(std::uint32_t thread);
    void predict(Range range);
    void list(Range range);
    void sweep(Range range, const std::vector<Vec4>& from, std::vector<Vec4>& to) const;
    void finish(Range range);

    Balls balls_;
    std::vector<Vec4> before_, other_;
    std::vector<std::uint32_t> near_; ///< mostNear entries for each ball
    std::vector<std::uint32_t> nearCount_;
    Grid grid_;
    bool isEnding_ = false;
    std::barrier<> turn_{threads};
    std::jthread helper_; ///< last: uses the members above
};

} // namespace sinew::tools::clutter
