// The sequential row: Gauss-Seidel over the pairs that a hash grid lists, in the order of the scene, on one
// thread. Lists have the margin and the rule of remaking of the device's (contacts: 2), so that it pays no
// more for finding pairs than it must.
#pragma once

#include "sinew/clutter/grid.hpp"

namespace sinew::tools::clutter {

class Sequential {
public:
    explicit Sequential(Balls balls);

    void step(); ///< of the scene's length
    const Balls& balls() const { return balls_; }

private:
    void predict();
    void list();
    void sweep();
    void finish();

    Balls balls_;
    std::vector<Vec4> before_, predicted_, listed_;
    std::vector<std::array<std::uint32_t, 2>> pairs_;
    Grid grid_;
    float margin_;
};

} // namespace sinew::tools::clutter
