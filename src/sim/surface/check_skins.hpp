// The part of validate() for skins.
#pragma once

#include "sim/core/complaints.hpp"

namespace sinew::sim::surface {

/// `particles` is their number in the scene.
void checkSkin(const Skin& skin, const std::string& name, std::size_t particles, Complaints& complaints);

} // namespace sinew::sim::surface
