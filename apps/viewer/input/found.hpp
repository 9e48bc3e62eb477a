// Properties of the particle under the pointer: plain data for the panels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace sinew::viewer {

/// Strain of links, (length - rest length) / rest length: root mean square, and largest.
struct Strain {
    double rms = 0, largest = 0;
};

struct Found {
    std::string body;
    std::uint32_t particle = 0;      ///< nearest to the seen point
    std::array<float, 3> position{}; ///< of the particle [m]
    bool isFixed = false, isAsleep = false;
    std::string hold = {};                 ///< name of the scene's [[hold]] that holds it; empty = none
    std::optional<float> speed;            ///< [m/s]; empty if the simulation has no velocities
    std::size_t links = 0;                 ///< live links
    std::optional<Strain> strain;          ///< strain of the live links; empty without any
    std::optional<std::uint32_t> contacts; ///< number of contacts; empty = not counted yet
};

/// "held by ligament", "fixed", "asleep" or a speed: "0.12 m/s".
std::string stateText(const Found& found);

} // namespace sinew::viewer
