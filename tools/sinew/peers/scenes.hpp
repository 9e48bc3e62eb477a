// The scenes of `sinew bench --peers`, and their true motion.
#pragma once

#include "sinew/study/truth.hpp"

namespace sinew::tools::peers {

struct PeerScene {
    const char* group; ///< of --scene
    sim::Scene (*make)();
    std::uint32_t frames; ///< of 1/60 s; fewer if one takes long
    double share;         ///< of PeerOptions::seconds: the time for search and timing
};

/// Elastic and without contacts, so that they have a true motion that every program approaches.
std::span<const PeerScene> peerScenes();

/// The motion by velocity Verlet in double on all processors (native/verlet.hpp), with steps halved until the
/// motion changes by less than 1e-4 of it. Throws app::Failure (badInput) if three halvings do not suffice.
study::Truth truthOf(const sim::Scene& scene, std::uint32_t frames);

} // namespace sinew::tools::peers
