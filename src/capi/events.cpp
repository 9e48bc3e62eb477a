// Events of steps.
#include "sinew/sinew_events.h"

#include "capi/convert.hpp"
#include "capi/objects.hpp"

#include <algorithm>

namespace sinew::capi {

namespace {

static_assert(static_cast<int>(sim::EventKind::lacksRoom) == SINEW_EVENT_LACKS_ROOM &&
              static_cast<int>(sim::EventKind::fragments) == SINEW_EVENT_FRAGMENTS &&
              static_cast<int>(sim::EventPartner::collider) == SINEW_PARTNER_COLLIDER &&
              sim::allEvents == SINEW_ALL_EVENTS);

SinewEvent fromEvent(std::uint64_t frame, const sim::Event& event) {
    return {.frame = frame,
            .kind = static_cast<std::uint32_t>(event.kind),
            .body = event.body,
            .partner = static_cast<std::uint32_t>(event.partner),
            .other = event.other,
            .count = event.count,
            .reserved = 0};
}

void requireRoom(const std::uint32_t* count, const SinewEvent* events) {
    requireNotNull(count, "count");
    requireArray(events, *count, "events");
}

SinewResult give(std::uint64_t frame, const sim::Events& found, std::uint32_t& count, SinewEvent* events,
                 std::uint32_t* lost) {
    if (!found.isFinished) return SINEW_NOT_READY;
    const std::size_t fitting = std::min<std::size_t>(count, found.list.size());
    std::transform(found.list.begin(), found.list.begin() + static_cast<std::ptrdiff_t>(fitting), events,
                   [&](const sim::Event& event) { return fromEvent(frame, event); });
    count = static_cast<std::uint32_t>(found.list.size());
    if (lost != nullptr) *lost = found.lost;
    return SINEW_OK;
}

} // namespace

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewGetEvents(SinewSimulation simulation, uint64_t frame, uint32_t* count, SinewEvent* events,
                           uint32_t* lost) {
    return call(__func__, [&] {
        requireRoom(count, events);
        const Use<SimulationObject> object(simulation.id, Access::write);
        return give(frame, object->simulation->events(frame), *count, events, lost);
    });
}

SinewResult sinewGetWorldEvents(SinewWorld world, uint64_t frame, uint32_t* count, SinewEvent* events,
                                uint32_t* lost) {
    return call(__func__, [&] {
        requireRoom(count, events);
        const UseOfWorld use(world.id);
        return give(frame, use->world.events(frame), *count, events, lost);
    });
}

SinewResult sinewGetStepEvents(SinewSimulation simulation, uint32_t* count, SinewEvent* events,
                               uint32_t* lost) {
    return call(__func__, [&] {
        requireRoom(count, events);
        const Use<SimulationObject> object(simulation.id, Access::write);
        const StepEvents& kept = object->stepEvents;
        const std::size_t fitting = std::min<std::size_t>(*count, kept.list.size());
        std::transform(kept.list.begin(), kept.list.begin() + static_cast<std::ptrdiff_t>(fitting), events,
                       [](const auto& timed) { return fromEvent(timed.first, timed.second); });
        *count = static_cast<std::uint32_t>(kept.list.size());
        if (lost != nullptr) *lost = kept.lost;
    });
}

} // extern "C"
