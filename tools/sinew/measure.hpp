// Evaluation of a state: the error figures of a report, and a hash to compare runs.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace sinew::tools {

/// State as on the device: positions [m] and velocities [m/s], w = inverse mass [1/kg].
struct State {
    std::vector<std::array<float, 4>> positions, velocities;
    std::vector<bool> isAsleep = {}; ///< by particle; empty if nothing can sleep
    /// By particle: in a removed fragment (sim::Scene::debris) or an absent body; empty if nothing can be
    /// either. Figures exclude these particles, but momentum includes removed fragments.
    std::vector<bool> isRemoved = {};
    /// By distance constraint of the scene; empty if nothing can be cut.
    std::vector<bool> isCut = {};
    bool has(std::size_t particle) const { return isRemoved.empty() || !isRemoved[particle]; }
    /// Whether a particle stands where those of absent bodies do.
    bool isAway(std::size_t particle) const;
    /// Whether a distance constraint is live.
    bool holds(std::size_t distance) const { return isCut.empty() || !isCut[distance]; }
};

/// Error figures; empty ones have no meaning for the scene.
struct Errors {
    std::optional<double> strainRms,
        strainMax; ///< (length - restLength) / restLength over distance constraints that are not cut
    std::optional<double> volume; ///< largest relative change of a closed skin, signed
    std::optional<double>
        momentum; ///< change perpendicular to gravity / sum m |v|; only if no particle is held
    std::optional<double> penetrationMax; ///< deepest particle behind a plane or in another [m]
    std::optional<double> penetrationRms; ///< over overlapping particles, by pairs [m]
    std::optional<std::size_t> crossings; ///< edges through faces (crossings.hpp)
};

/// Measures `state` after `frames` steps; `skins` are the present meshes of the scene's skins, in order, or
/// empty if not requested.
Errors measure(const sim::Scene& scene, const State& state, std::span<const mesh::TriangleMesh> skins,
               std::uint64_t frames);

/// Computes only penetrationMax and penetrationRms.
Errors measurePenetration(const sim::Scene& scene, const State& state, std::uint64_t frames);

/// The largest (length - restLength) / restLength of rigid live distance constraints; 0 if none is too long.
double rigidStretch(const sim::Scene& scene, const State& state);

/// Kinetic energy of all movable particles [J], from the device's velocities.
double kineticEnergy(const State& state);

/// Energy of all movable particles in the scene's gravity [J]; 0 with all of them at the origin.
double potentialEnergy(const sim::Scene& scene, const State& state);

/// FNV-1a (64 bits) of the bytes of positions, then velocities.
std::uint64_t stateHash(const State& state);

} // namespace sinew::tools
