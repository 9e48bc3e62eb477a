// Warm-up in the background, because drivers of software devices compile shaders at their first use: without
// it a first cut took 13 s. (Other drivers compile when pipelines are made.)
#pragma once

#include "viewer/jobs/prepared_player.hpp"

namespace sinew::viewer {

/// Plays and draws possible input to a scene, above all a cut, off-screen, and resets the scene. `format` is
/// that of the window's pictures. Waits. Throws vk::Error.
void warmUp(const vk::Device& device, PreparedPlayer& player, VkFormat format, const Camera& camera);

} // namespace sinew::viewer
