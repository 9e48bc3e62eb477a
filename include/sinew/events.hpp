// Events: what happened to the bodies of a scene in a step (Settings::events, Simulation::events).
#pragma once

#include "sinew/export.hpp"

#include <cstdint>
#include <vector>

namespace sinew::sim {

/// Kinds of events, in the order in which a step lists them.
enum class EventKind : std::uint8_t {
    contactBegins, ///< a body touches another body, plane or collider that it did not touch before
    contactEnds,   ///< they have not touched for two steps
    cut,           ///< a blade or a ray has cut links of a body
    tear,          ///< links of a body have torn
    pieces,        ///< the number of pieces of a body has changed by a cut or a tear
    sleeps,        ///< the last awake particle of a body has fallen asleep
    wakes,         ///< particles of a body that slept have woken
    lacksRoom,     ///< the step is undone for lack of Settings::contactRoom
    fragments,     ///< a cut or a tear has left fragments of a body that were removed (Scene::debris)
};

/// Bits of Settings::events.
constexpr std::uint32_t bitOf(EventKind kind) {
    return 1u << static_cast<std::uint32_t>(kind);
}
inline constexpr std::uint32_t contactEvents =
    bitOf(EventKind::contactBegins) | bitOf(EventKind::contactEnds);
inline constexpr std::uint32_t cutEvents =
    bitOf(EventKind::cut) | bitOf(EventKind::tear) | bitOf(EventKind::pieces) | bitOf(EventKind::fragments);
inline constexpr std::uint32_t sleepEvents = bitOf(EventKind::sleeps) | bitOf(EventKind::wakes);
inline constexpr std::uint32_t allEvents =
    contactEvents | cutEvents | sleepEvents | bitOf(EventKind::lacksRoom);

/// Kinds of things that a body touches.
enum class EventPartner : std::uint8_t { none, body, plane, hostCollider, collider };

/// An event. Particles that belong to none of Scene::bodies cause none, and a body does not touch itself.
struct SINEW_API Event {
    static constexpr std::uint32_t noBody = 0xffffffffu;

    EventKind kind = EventKind::contactBegins;
    EventPartner partner = EventPartner::none; ///< of a contact
    std::uint32_t body = noBody;               ///< index into Scene::bodies; noBody: lacksRoom
    /// Index of the partner: into Scene::bodies (always larger than `body`), Scene::planes,
    /// Step::hostColliders or Scene::colliders.
    std::uint32_t other = 0;
    /// contactBegins: the number of touching pairs of particles, of particles and faces, and of edges, or of
    /// particles at a plane or collider: the mean of the substeps of the step, rounded up. cut, tear: links,
    /// as in Status::linksCut. pieces: their number now. fragments: removed in this step. lacksRoom:
    /// Status::contactRoom. Else 0.
    std::uint32_t count = 0;
    bool operator==(const Event&) const = default;
};

/// The events of a step, by kind, body, kind of partner and partner. None if the step was undone, except
/// lacksRoom. A take-over by another solver, or with other planes, colliders or host colliders, begins
/// contacts anew: they are told once more. Contacts of a part that leaves a World end untold, with its
/// indices.
struct SINEW_API Events {
    bool isFinished = false; ///< as Status::isFinished; if false the list is empty
    std::vector<Event> list;
    std::uint32_t lost = 0; ///< those behind the last that Settings::eventRoom had room for
};

} // namespace sinew::sim
