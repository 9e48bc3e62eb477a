// Drivers of software devices compile what is used for the first time, then and there: a first cut took 13 s.
// Here that keeps nobody waiting. (Others compile pipelines when they are made.)
#pragma once

#include "viewer/prepared_show.hpp"

namespace sinew::viewer {

/// Plays and draws what hands may do to a scene, a cut above all, in pictures that nobody sees, and resets
/// it. `format` of the window's pictures. Waits. Throws vk::Error.
void warmUp(const vk::Device& device, PreparedShow& show, VkFormat format, const Camera& camera);

} // namespace sinew::viewer
