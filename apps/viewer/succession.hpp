// Replaces the simulation of a scene on show by the one that its stage has made: with more room, or with
// another solver, number of substeps or material.
#pragma once

#include "viewer/adjustments.hpp"
#include "viewer/journal.hpp"
#include "viewer/observer.hpp"
#include "viewer/picture_times.hpp"

namespace sinew::viewer {

/// Main thread only. All references must outlive it.
class Succession {
public:
    /// Parts of a show that refer to the simulation.
    struct Parts {
        Backstage& backstage;
        LayerView& layers;
        Observer& observer;
        PictureTimes& times;
        Gauges& gauges;
        Adjustments& adjustments;
        Journal& journal;
    };
    Succession(const ShowContext& show, const Parts& parts) : show_(show), parts_(parts) {}

    /// Notes Status::cutSurfaceMissing of the newest step that has finished.
    void surfaceMissing(std::uint32_t triangles) noexcept { surfaceMissing_ = triangles; }
    /// Begins to make room for that. Steps go on: only the picture lacks something.
    void beginSurfaceRoom();
    /// Takes a simulation with more room, if it is made. A rehearsal in Backstage records the take-over.
    void takeRoom();
    /// Takes the simulation that a replay wants, if it is made.
    void takeShape();
    /// The stage has another simulation: parts that refer to the one before begin anew.
    void restartParts();

private:
    void end();
    void reshape();
    void warnOfSurface();

    const ShowContext& show_;
    Parts parts_;
    std::uint32_t surfaceMissing_ = 0; // Status::cutSurfaceMissing
    bool isSurfaceShort_ = false;      // there is no room for it, and that was said
};

} // namespace sinew::viewer
