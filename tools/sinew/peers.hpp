// Other engines on the same motions: `sinew bench --peers`. Compared at equal error, for engines do not agree
// on what a step is. Compiled against Bullet's soft bodies where they are installed (SINEW_BENCH_PEERS).
#pragma once

#include "sinew/clutter/entrant.hpp"
#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// Throws app::Failure (wrongUsage) where this program was built without peers.
void requirePeers();

/// A list of one object per scene: every program's curve of wall-clock time over error, and the times to 10,
/// 1 and 0.1 %. `scene` is "cloth", "cube" or "all". Says on stderr how far it is; stops early when
/// interrupted.
Json comparePeers(const std::string& scene, Session& session);

/// Bullet's rigid spheres in the place of the loose particles of a scene. `scene` must outlive the result.
ClutterEntrant bulletClutter(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations);

/// The times to equal errors, for a terminal.
std::string peersTable(const Json& comparisons);

} // namespace sinew::tools
