// Replaces the simulation of a scene on show by the one that its document has made: with more room, or with
// another solver, number of substeps or material.
#pragma once

#include "viewer/player/adjustments.hpp"
#include "viewer/player/journal.hpp"
#include "viewer/player/observer.hpp"
#include "viewer/player/picture_times.hpp"

namespace sinew::viewer {

/// Main thread only. All references must outlive it.
class Succession {
public:
    /// Parts of a show that refer to the simulation.
    struct Parts {
        LayerLoader& layerLoader;
        LayerView& layers;
        Observer& observer;
        PictureTimes& times;
        Gauges& gauges;
        Adjustments& adjustments;
        Journal& journal;
    };
    Succession(const PlayerContext& player, const Parts& parts) : player_(player), parts_(parts) {}

    /// Notes Status::cutSurfaceMissing of the newest step that has finished.
    void surfaceMissing(std::uint32_t triangles) noexcept { surfaceMissing_ = triangles; }
    /// Begins to make room for that. Steps go on: only the picture lacks something.
    void beginSurfaceRoom();
    /// Takes a simulation with more room, if it is made. A rehearsal in LayerLoader records the take-over.
    void takeRoom();
    /// Takes the simulation that a replay wants, if it is made.
    void takeShape();
    /// The document has another simulation: parts that refer to the one before begin anew.
    void restartParts();

private:
    void end();
    void reshape();
    void warnOfSurface();

    const PlayerContext& player_;
    Parts parts_;
    std::uint32_t surfaceMissing_ = 0; // Status::cutSurfaceMissing
    bool isSurfaceShort_ = false;      // there is no room for it, and that was said
};

} // namespace sinew::viewer
