// Sequential Gauss-Seidel for the clutter scene: pairs from a hash grid, in the order of the scene, on one
// thread. Its lists have the margin of the device's and are remade by the same rule (docs/contact-lists.md),
// so that finding pairs costs no more than necessary.
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
