// The same clutter as rigid spheres of Bullet 3: what `sinew bench --scene clutter --peers` compares with.
#pragma once

#include "sinew/clutter/balls.hpp"

#include <memory>

namespace sinew::tools::clutter {

class Bullet {
public:
    /// A sphere a ball, a static slab or plane each plane, Bullet's default world and solver but for
    /// `iterations` of a substep. Spheres may turn, as ours cannot.
    explicit Bullet(const Balls& balls);
    ~Bullet();
    Bullet(const Bullet&) = delete;
    Bullet& operator=(const Bullet&) = delete;

    void step(); ///< of the scene's length
    Balls balls() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sinew::tools::clutter
