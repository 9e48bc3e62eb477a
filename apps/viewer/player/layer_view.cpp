// A picture whose colors turn out to have another range is drawn once more.
#include "viewer/player/layer_view.hpp"

#include "sinew/vk/check.hpp"

#include <utility>

namespace sinew::viewer {

bool LayerView::act(Action action) {
    Layers& layers = player_.session.layers();
    if (const std::optional<std::size_t> layer = layerOf(action)) {
        if (layerTable()[*layer] == &layer::wires && !drawsEdges(player_.device))
            player_.session.warn("this device cannot draw the edges of triangles");
        else
            layers.turn(*layer);
        if (layerTable()[*layer] == &layer::colors) mapRange_ = {};
        return true;
    }
    if (action != Action::section && action != Action::turnSection && action != Action::faceSection)
        return false;
    actOnSection(action);
    return true;
}

// A section that is turned while there is none begins across the camera.
void LayerView::actOnSection(Action action) {
    std::optional<Section>& section = player_.session.layers().section;
    const Camera& camera = player_.controller.camera;
    if (action == Action::section)
        section = section ? std::nullopt : std::optional(sectionAcross(camera));
    else if (action == Action::faceSection)
        section = sectionFacing(camera);
    else
        section = section ? turned(*section, camera.target) : sectionAcross(camera);
}

void LayerView::moveSectionTo(float offset) {
    if (std::optional<Section>& section = player_.session.layers().section) section->offset = offset;
}

void LayerView::slideSection(float slide) {
    if (std::optional<Section>& section = player_.session.layers().section; section && slide != 0)
        section = moved(*section, slide, player_.opening.light.bounds);
}

bool LayerView::tend() {
    try {
        if (layerLoader_.goOn()) player_.redraw();
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        player_.session.layers() = {};
        player_.session.warn(error.what());
        return false;
    }
    return true;
}

void LayerView::prepare(bool isCounting) {
    const WantedLayers before =
        std::exchange(drawn_, layerLoader_.ready({player_.session.layers(), isCounting}));
    if (drawn_.layers.looks != before.layers.looks) hasNewLegend_ = true;
}

Overlay LayerView::record(const Presenter::Frame& frame) {
    Overlay overlay = player_.tools.overlay();
    const Layers& layers = overlay.layers = drawn_.layers;
    if (!layers.needsBuffers()) return overlay;
    const Inspection& inspection = layerLoader_.inspection();
    inspection.record(frame.commands, layers, frame.slot);
    pending_[frame.slot] = layers;
    overlay.buffers = inspection.buffers(layers, ranges());
    return overlay;
}

LayerRanges LayerView::ranges() const {
    LayerRanges all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = readings_[i].values.range;
    all[indexOf(layer::colors)] = mapRange_.range();
    return all;
}

void LayerView::settle(std::uint32_t slot) {
    const Layers pending = std::exchange(pending_[slot], {});
    const LayerRanges before = ranges();
    for (std::size_t i = 0; i < layerTable().size(); ++i) {
        const auto isStill = [&](const Layers& layers) { return layers.looks[i] == pending.looks[i]; };
        if (pending.looks[i] == 0 || !layerTable()[i]->make) continue;
        if (!isStill(drawn_.layers) || !isStill(player_.session.layers())) continue;
        const std::size_t lines = readings_[i].legend.size();
        readings_[i] = layerLoader_.inspection().reading(i, slot);
        if (readings_[i].legend.size() != lines) hasNewLegend_ = true;
        if (layerTable()[i] == &layer::colors) mapRange_.read(readings_[i].values);
    }
    if (ranges() == before) return;
    hasNewLegend_ = true;
    player_.redraw();
}

void LayerView::restart() {
    layerLoader_.forget();
    drawn_ = {};
    hasNewLegend_ = true;
    for (auto& reading : readings_) reading.legend.clear(); // of the simulation before
}

void LayerView::addTo(Facts& facts) const {
    const Layers& layers = player_.session.layers();
    facts.layers = layers;
    if (layers.section) {
        const Reach reach = reachOf(*layers.section, player_.opening.light.bounds);
        facts.sectionReach = {reach.low, reach.high};
    }
    facts.map = mapRange_.newest();
    facts.mapRange = mapRange_.range();
    for (std::size_t i = 0; i < mostLayers; ++i)
        if (drawn_.layers.looks[i] > 0) facts.legends[i] = readings_[i].legend;
    facts.isPreparing = drawn_.layers != layers;
}

} // namespace sinew::viewer
