// The fastest form of a scene on the session's device.
#pragma once

#include "sim/scene.hpp"
#include "sinew/session.hpp"

namespace sinew::tools {

/// `settings` with the forms that ran fastest just now. Waits for the device; the session must be idle.
sim::Settings tuned(Session& session, const sim::Scene& scene, sim::Settings settings);

} // namespace sinew::tools
