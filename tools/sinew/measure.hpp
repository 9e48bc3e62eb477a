// What a state is worth: the error figures of a report, and a hash that says whether two runs ended alike.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace sinew::tools {

/// As the device has them: positions [m] and velocities [m/s], w = inverse mass [1/kg].
struct State {
    std::vector<std::array<float, 4>> positions, velocities;
    std::vector<bool> isAsleep = {}; ///< by particle; empty where nothing can sleep
    /// Likewise: of a crumb (sim::Scene::crumbs); empty where nothing can be cut. Figures leave them out, but
    /// for momentum.
    std::vector<bool> isRemoved = {};
    /// By distance constraint of the scene; empty where nothing can be cut.
    std::vector<bool> isCut = {};
    bool has(std::size_t particle) const { return isRemoved.empty() || !isRemoved[particle]; }
    /// Whether a distance constraint still holds its two particles.
    bool holds(std::size_t distance) const { return isCut.empty() || !isCut[distance]; }
};

/// Empty where a figure has no meaning for the scene.
struct Errors {
    std::optional<double> strainRms,
        strainMax; ///< (length - restLength) / restLength over distance constraints that are not cut
    std::optional<double> volume; ///< relative change of the closed skin that changed most, with its sign
    std::optional<double>
        momentum; ///< change across gravity over sum m |v|; only where nothing holds a particle
    std::optional<double> penetrationMax; ///< deepest particle behind a plane or in another [m]
    std::optional<double> penetrationRms; ///< over particles that are in each other, by pairs [m]
    std::optional<std::size_t> crossings; ///< edges through faces (crossings.hpp)
};

/// `frames` steps led to `state`; `skins` are the meshes of the scene's skins now, in order, or empty where
/// nobody asked for them.
Errors measure(const sim::Scene& scene, const State& state, std::span<const mesh::TriangleMesh> skins,
               std::uint64_t frames);

/// Of the same figures penetrationMax and penetrationRms alone.
Errors measurePenetration(const sim::Scene& scene, const State& state, std::uint64_t frames);

/// The largest (length - restLength) / restLength of rigid distance constraints that are not cut; 0 where
/// none is too long.
double rigidStretch(const sim::Scene& scene, const State& state);

/// Of everything that moves [J], from the velocities that the device publishes.
double kineticEnergy(const State& state);

/// FNV-1a (64 bits) of the bytes of positions, then velocities.
std::uint64_t stateHash(const State& state);

} // namespace sinew::tools
