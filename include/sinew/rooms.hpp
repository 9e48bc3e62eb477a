// Capacities of a simulation that its steps may find too small: candidates of contacts and the surface of
// cuts. Says how much its successor gets and keeps the counts for reports. Touches no device.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <cstdint>
#include <optional>

namespace sinew::sim {

/// Capacity of the lists of contact candidates (Settings::contactRoom).
struct SINEW_API ContactRoom {
    std::uint32_t room = 0;   ///< candidates a particle, face or edge, on average
    std::uint32_t needed = 0; ///< largest Status::contactRoom so far; 0 = the room was always enough
    std::uint32_t grown = 0;  ///< number of successors with more
};

/// Capacity for the surface of cuts (Settings::cutSurfaceRoom).
struct SINEW_API SurfaceRoom {
    std::uint32_t room = 0;   ///< triangles and vertices; 0 = the default of the scene
    std::uint32_t needed = 0; ///< largest Status::cutSurfaceMissing so far; 0 = the room was always enough
    std::uint32_t grown = 0;  ///< number of successors with more
    bool isShort = false;     ///< no successor can have enough: the surface is drawn as far as it fits
};

class SINEW_API Rooms {
public:
    explicit Rooms(const Settings& settings);

    /// Settings of a successor for a step whose Status::contactRoom is `needed` (> 0): half as much again,
    /// since each growth makes all pipelines anew. Nothing above ranges::mostContactRoom.
    std::optional<Settings> forContacts(Settings settings, std::uint32_t needed);

    /// True if `needed`, the Status::cutSurfaceMissing of a step, calls for a successor.
    bool lackSurface(std::uint32_t needed) const noexcept { return needed > 0 && !surface_.isShort; }
    /// Settings of that successor: half as much again. Nothing above ranges::mostCutSurfaceRoom.
    std::optional<Settings> forSurface(Settings settings, std::uint32_t needed);
    /// Notes that the device has no memory for what forSurface() returned.
    void refuseSurface() noexcept { surface_.isShort = true; }

    /// Notes that a successor with these settings has taken over.
    void adopt(const Settings& settings) noexcept;
    /// Continues the counts of `other` in a simulation with `settings`, whose device may have more memory.
    void continueFrom(const Rooms& other, const Settings& settings) noexcept;

    const ContactRoom& contacts() const noexcept { return contacts_; }
    const SurfaceRoom& surface() const noexcept { return surface_; }

private:
    ContactRoom contacts_;
    SurfaceRoom surface_;
};

/// `settings` with both rooms at least those of `other`.
SINEW_API Settings withRoomsOf(Settings settings, const Settings& other) noexcept;
/// True if both rooms of `settings` are at least those of `other`.
SINEW_API bool haveRoomsOf(const Settings& settings, const Settings& other) noexcept;

} // namespace sinew::sim
