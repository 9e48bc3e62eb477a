// `sinew bench --scene clutter`: loose balls that fall into a box and come to rest, on the device,
// sequentially, on two native threads, and as rigid spheres of Bullet.
#pragma once

#include "sinew/json.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// Rows for 1,000 and 8,000 balls, all in turns in one process; with Bullet where `hasPeers`, which needs
/// requirePeers(). `seconds` is the least to measure a size; every program takes 240 steps at least unless
/// interrupted.
Json measureClutter(Session& session, double seconds, bool hasPeers);

/// For a terminal.
std::string clutterTable(const Json& rows);

} // namespace sinew::tools
