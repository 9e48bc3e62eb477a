// The key `recovery` of a mesh: its default gives way where it cannot be had.
#pragma once

#include "scenes/load.hpp"
#include "scenes/section.hpp"

namespace sinew::scenes {

/// As sim::Lattice::recovery has it. The default is 0 where the scene or its solver has no form for it, which
/// is noted; what the section itself says is left to sim::validate.
float recoveryOf(LoadedScene& loaded, const Section& section, const std::string& name);

/// `scene` as it can be played with `settings`, which may be others than it was loaded with: grids of
/// `defaults` do without recovery where the scene cannot recover, and bodies without contacts in another
/// solver than split.
sim::Scene withoutDefaults(sim::Scene scene, const Defaults& defaults, const sim::Settings& settings);

/// Makes bodies that may be cut whole where the solver is not split, unless one of them tears by itself.
/// Returns whether any was. `scene` must have no blades of its own.
bool leaveWhole(sim::Scene& scene, const sim::Settings& settings);

/// Notes on the bodies of `loaded` that recover as it was loaded, but not with `settings`.
std::vector<std::string> recoveryLeftOut(const LoadedScene& loaded, const sim::Settings& settings);

/// mesh::addMesh, but a body so far from the origin that it gets no grid goes without the default.
mesh::AddedMesh addWithRecovery(LoadedScene& loaded, const Section& section, const mesh::TriangleMesh& mesh,
                                mesh::MeshBody body);

} // namespace sinew::scenes
