// Material overrides of a scene while it runs, in stiffness, damping and friction: the same scene with other
// numbers, for Simulation::prepareChange.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <optional>
#include <vector>

namespace sinew::sim {

/// Material overrides; the default changes nothing.
struct SINEW_API Material {
    /// Factor on Young's modulus, above 0: on the stiffness of links and bends, and on the pressures of
    /// cells. Rigid constraints stay rigid, and attachments keep their compliance.
    float stiffness = 1;
    std::vector<float> bodies{};    ///< further factors, by Scene::bodies; missing ones are 1
    std::optional<float> damping{}; ///< replaces Scene::damping [1/s]
    /// Replaces the friction of planes, colliders, particles and faces, static friction included; host
    /// colliders keep their own.
    std::optional<float> friction{};
    bool operator==(const Material&) const = default;
};

/// Returns `scene` with the overrides. A link between two bodies has the geometric mean of their factors.
/// Stiffness is limited to the range of the device; nothing else is checked (validate() does).
SINEW_API Scene withMaterial(Scene scene, const Material& material);

} // namespace sinew::sim
