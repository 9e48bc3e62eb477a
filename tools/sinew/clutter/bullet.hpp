// The clutter scene as rigid spheres of Bullet 3, for `sinew bench --scene clutter --peers`.
#pragma once

#include "sinew/clutter/balls.hpp"

#include <memory>

namespace sinew::tools::clutter {

class Bullet {
public:
    /// One sphere per ball, a static slab or plane per plane, Bullet's default world and solver except
    /// `iterations` per substep. The spheres rotate; our particles cannot.
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
