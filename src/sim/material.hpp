// How stiff, how damped and how slippery a scene is, turned while it plays: the same scene with other
// numbers, for Simulation::prepareChange.
#pragma once

#include "sim/scene.hpp"

#include <optional>
#include <vector>

namespace sinew::sim {

/// What is turned; as it is made, nothing.
struct Material {
    /// Factor on Young's modulus, above 0: on the stiffness of links and bends, and on the pressures of
    /// cells. What is rigid stays so, and attachments are the host's.
    float stiffness = 1;
    std::vector<float> bodies{};    ///< further factors, by Scene::bodies; those left out are 1
    std::optional<float> damping{}; ///< in the place of Scene::damping [1/s]
    /// In the place of the friction of planes, colliders, particles and faces, static friction included;
    /// pokes keep their own.
    std::optional<float> friction{};
    bool operator==(const Material&) const = default;
};

/// `scene` so turned. A link between two bodies has the geometric mean of their factors. Stiffness stays
/// within what the device can hold; nothing else is checked (validate() does).
Scene withMaterial(Scene scene, const Material& material);

} // namespace sinew::sim
