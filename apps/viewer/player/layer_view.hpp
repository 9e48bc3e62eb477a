// The layers of a scene on show: which are on, which are there to be drawn, what they say.
#pragma once

#include "viewer/jobs/layer_loader.hpp"
#include "viewer/player/player_context.hpp"

#include <utility>

namespace sinew::viewer {

/// Main thread only.
class LayerView {
public:
    /// `layer loader` must outlive it.
    LayerView(const PlayerContext& player, LayerLoader& layerLoader)
        : player_(player), layerLoader_(layerLoader) {}

    /// Does an action about layers or their section; false for any other.
    bool act(Action action);
    /// Moves the section, if there is one: to an offset of its plane [m], or as Input::slide.
    void moveSectionTo(float offset);
    void slideSection(float slide);
    /// The section that opens the scene to rays, if there is one.
    const std::optional<Section>& section() const { return player_.session.layers().section; }

    /// Takes layers that have been made, and rehearses. Without memory no layer is on any more: false then.
    bool tend();
    /// Begins to make what is on and not there. Call it before record(). `isCounting`: contacts of a particle
    /// are counted.
    void prepare(bool isCounting);
    /// Counts the contacts of a particle; null while it is not there.
    const ContactMarks* counter() const noexcept { return layerLoader_.inspection().counter(); }
    /// Records the kernels of the layers that are on and there, and returns what the picture draws.
    Overlay record(const Presenter::Frame& frame);
    /// Takes the results of a slot that has finished.
    void settle(std::uint32_t slot);
    /// Forgets the layers: the document has another simulation.
    void restart();

    void addTo(Facts& facts) const;
    /// Whether the legend has other colors or lines than at the last call: panels that show it are due.
    bool takeNewLegend() { return std::exchange(hasNewLegend_, false); }

private:
    void actOnSection(Action action);
    LayerRanges ranges() const;

    const PlayerContext& player_;
    LayerLoader& layerLoader_;
    WantedLayers drawn_;
    MapRange mapRange_;
    bool hasNewLegend_ = false;
    std::array<LayerReading, mostLayers> readings_; // of the newest picture with each layer
    std::array<Layers, Presenter::framesInFlight> pending_;
};

} // namespace sinew::viewer
