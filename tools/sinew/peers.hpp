// `sinew bench --peers`: other engines on the same motions, compared at equal error, since engines define a
// step differently. Needs Bullet's soft bodies at build time (SINEW_BENCH_PEERS).
#pragma once

#include "sinew/clutter/entrant.hpp"
#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// Throws app::Failure (wrongUsage) if this program was built without peers.
void requirePeers();

/// A list of one object per scene: every program's curve of wall-clock time over error, and the times to 10,
/// 1 and 0.1 %. `scene` is "cloth", "cube" or "all". Prints progress on stderr; stops early when interrupted.
Json comparePeers(const std::string& scene, Session& session);

/// Bullet's rigid spheres instead of a scene's loose particles. `scene` must outlive the result.
ClutterEntrant bulletClutter(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations);

/// The times to equal errors, as text for a terminal.
std::string peersTable(const Json& comparisons);

} // namespace sinew::tools
