// `sinew bench --scene clutter`: loose balls fall into a box and come to rest, on the device, sequentially,
// on two native threads, and as rigid spheres of Bullet.
#pragma once

#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// Rows for 1,000 and 8,000 balls; all programs take turns in one process. Includes Bullet if `hasPeers`,
/// which requires requirePeers(). `seconds` is the least time to measure a size; every program takes at least
/// 240 steps unless interrupted.
Json measureClutter(Session& session, double seconds, bool hasPeers);

/// The rows as text for a terminal.
std::string clutterTable(const Json& rows);

} // namespace sinew::tools
