// `sinew bench --peers`: other programs on the same motions, compared at equal error, since programs define a
// step differently. Needs Bullet's soft bodies at build time (SINEW_BENCH_PEERS).
#pragma once

#include "sinew/clutter/entrant.hpp"
#include "sinew/json.hpp"
#include "sinew/session.hpp"
#include "sinew/study/report.hpp"

namespace sinew::tools {

/// Throws app::Failure (wrongUsage) if this program was built without peers.
void requirePeers();

struct PeerOptions {
    std::string scene = "all"; ///< or "cloth", "cube", "beam" or "chain"
    double seconds = 10; ///< a scene takes 1 to 12 times as long by its size, its true motion not counted
    study::Scale scale = study::Scale::body; ///< of the errors to reach
    DeviceOptions device;                    ///< as for `session`
};

/// A list of one object per scene (docs/report.md): for each program, with one thread and with all, the
/// cheapest settings that reach an error of 10, 1 and 0.1 %, and their wall-clock times of a frame. Prints
/// progress on stderr; stops early when interrupted.
Json comparePeers(const PeerOptions& options, Session& session);

/// Bullet's rigid spheres instead of a scene's loose particles. `scene` must outlive the result.
ClutterEntrant bulletClutter(const sim::Scene& scene, std::uint32_t substeps, std::uint32_t iterations);

/// The times to equal errors, as text for a terminal.
std::string peersTable(const Json& comparisons);

} // namespace sinew::tools
