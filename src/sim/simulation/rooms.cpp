// Growth by half as much again.
#include "sinew/rooms.hpp"

#include "sinew/ranges.hpp"

#include <algorithm>

namespace sinew::sim {

namespace {

constexpr std::uint32_t granule = 8; // candidates

// In 64 bits: a scene may report any number.
std::uint64_t halfAsMuchAgain(std::uint32_t needed) {
    return std::uint64_t{needed} + needed / 2;
}

} // namespace

Rooms::Rooms(const Settings& settings)
    : contacts_{.room = settings.contactRoom}, surface_{.room = settings.cutSurfaceRoom} {}

std::optional<Settings> Rooms::forContacts(Settings settings, std::uint32_t needed) {
    contacts_.needed = std::max(contacts_.needed, needed);
    if (needed > ranges::mostContactRoom) return std::nullopt;
    const std::uint64_t rounded = (halfAsMuchAgain(needed) + granule - 1) / granule * granule;
    settings.contactRoom =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(rounded, ranges::mostContactRoom));
    return settings;
}

std::optional<Settings> Rooms::forSurface(Settings settings, std::uint32_t needed) {
    surface_.needed = std::max(surface_.needed, needed);
    surface_.isShort = needed > ranges::mostCutSurfaceRoom;
    if (surface_.isShort) return std::nullopt;
    settings.cutSurfaceRoom = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(halfAsMuchAgain(needed), ranges::mostCutSurfaceRoom));
    return settings;
}

void Rooms::adopt(const Settings& settings) noexcept {
    contacts_.grown += settings.contactRoom > contacts_.room ? 1 : 0;
    surface_.grown += settings.cutSurfaceRoom > surface_.room ? 1 : 0;
    contacts_.room = settings.contactRoom;
    surface_.room = settings.cutSurfaceRoom;
}

void Rooms::continueFrom(const Rooms& other, const Settings& settings) noexcept {
    *this = other;
    contacts_.room = settings.contactRoom;
    surface_.room = settings.cutSurfaceRoom;
    surface_.isShort = false;
}

Settings withRoomsOf(Settings settings, const Settings& other) noexcept {
    settings.contactRoom = std::max(settings.contactRoom, other.contactRoom);
    settings.cutSurfaceRoom = std::max(settings.cutSurfaceRoom, other.cutSurfaceRoom);
    return settings;
}

bool haveRoomsOf(const Settings& settings, const Settings& other) noexcept {
    return settings.contactRoom >= other.contactRoom && settings.cutSurfaceRoom >= other.cutSurfaceRoom;
}

} // namespace sinew::sim
