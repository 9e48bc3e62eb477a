// The facts of a scene that several features need, derived once for a program and passed on: masses, linked
// bodies, radii, computed grids, and the order of the particles in the state.
#pragma once

#include "sim/lattice/placement.hpp"
#include "sim/model/state.hpp"

#include <optional>
#include <vector>

namespace sinew::sim {

/// Facts that follow from a valid scene and its settings alone. Those that few scenes need are derived when
/// they are first asked for. One thread at a time.
class SceneModel {
public:
    /// Refers to both, which must outlive it. `settings` has a number of substeps and all forms.
    SceneModel(const Scene& scene, const Settings& settings);
    SceneModel(const SceneModel&) = delete;
    SceneModel& operator=(const SceneModel&) = delete;

    const Scene& scene;
    const Settings& settings;
    const std::vector<float> inverseMass;   ///< by particle, after fixed constraints [1/kg]; 0 = never moves
    const std::vector<std::uint32_t> grids; ///< those whose neighbours are computed, ascending; `split` only
    const std::vector<lattice::Box> boxes;  ///< of these
    const StateLayout layout;               ///< of the solver's state

    bool isComputed(std::uint32_t grid) const; ///< whether it is one of `grids`
    bool moves(std::uint32_t particle) const { return inverseMass[particle] > 0; }
    /// linkedComponents() and linkedBodies() of components.hpp.
    const std::vector<std::uint32_t>& components() const;
    const std::vector<std::uint32_t>& linkedBodies() const;
    /// looseRadii() of touching.hpp.
    const std::vector<float>& looseRadii() const;
    /// particlesTouch() and facesTouch() of touching.hpp.
    bool particlesTouch() const;
    bool facesTouch() const;
    /// Tethers of moving particles, sorted by particle: the order on the device.
    const std::vector<Tether>& tethers() const;

private:
    mutable std::optional<std::vector<std::uint32_t>> components_, bodies_;
    mutable std::optional<std::vector<float>> looseRadii_;
    mutable std::optional<std::vector<Tether>> tethers_;
    mutable std::optional<bool> particlesTouch_, facesTouch_;
};

} // namespace sinew::sim
