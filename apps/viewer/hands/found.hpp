// What lies under the pointer, in numbers: plain data, for the panels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace sinew::viewer {

/// Of links, (length - rest length) / rest length: root of the mean square, and largest.
struct Strain {
    double rms = 0, largest = 0;
};

struct Found {
    std::string body;
    std::uint32_t particle = 0;      ///< the nearest one to what is seen
    std::array<float, 3> position{}; ///< of it [m]
    bool isFixed = false, isAsleep = false;
    std::string hold = {};                 ///< name of the scene's [[hold]] that has it; empty where none has
    std::optional<float> speed;            ///< [m/s]; nothing where the simulation has no velocities
    std::size_t links = 0;                 ///< that hold
    std::optional<Strain> strain;          ///< of those; nothing where none does
    std::optional<std::uint32_t> contacts; ///< how many things it touches; nothing = not counted yet
};

/// "held by ligament", "fixed", "asleep" or its speed: "0.12 m/s".
std::string stateText(const Found& found);

} // namespace sinew::viewer
