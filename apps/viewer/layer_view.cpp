// A picture whose colors turn out to have another range is drawn once more.
#include "viewer/layer_view.hpp"

#include "sinew/vk/check.hpp"

#include <utility>

namespace sinew::viewer {

bool LayerView::act(Action action) {
    Layers& layers = show_.screen.layers();
    switch (action) {
    case Action::section:
    case Action::turnSection:
    case Action::faceSection:
        actOnSection(action);
        return true;
    case Action::skinLook:
        layers.skin = next(layers.skin);
        return true;
    case Action::wires:
        toggleWires();
        return true;
    case Action::balls:
        layers.hasBalls = !layers.hasBalls;
        return true;
    case Action::links:
        layers.hasLinks = !layers.hasLinks;
        return true;
    case Action::contacts:
        layers.hasContacts = !layers.hasContacts;
        return true;
    case Action::cells:
        layers.hasCells = !layers.hasCells;
        return true;
    case Action::colorMap:
        layers.map = next(layers.map);
        mapRange_ = {};
        return true;
    default:
        return false;
    }
}

// A section that is turned while there is none begins across the camera.
void LayerView::actOnSection(Action action) {
    std::optional<Section>& section = show_.screen.layers().section;
    const Camera& camera = show_.controller.camera;
    if (action == Action::section)
        section = section ? std::nullopt : std::optional(sectionAcross(camera));
    else if (action == Action::faceSection)
        section = sectionFacing(camera);
    else
        section = section ? turned(*section, camera.target) : sectionAcross(camera);
}

void LayerView::toggleWires() {
    if (!drawsEdges(show_.device)) return show_.screen.warn("this device cannot draw the edges of triangles");
    show_.screen.layers().hasWires = !show_.screen.layers().hasWires;
}

void LayerView::moveSectionTo(float offset) {
    if (std::optional<Section>& section = show_.screen.layers().section) section->offset = offset;
}

void LayerView::slideSection(float slide) {
    if (std::optional<Section>& section = show_.screen.layers().section; section && slide != 0)
        section = moved(*section, slide, show_.opening.light.bounds);
}

std::optional<Opened> LayerView::opened() const {
    const std::optional<Section>& section = show_.screen.layers().section;
    if (!section) return std::nullopt;
    return Opened{*section, show_.opening.light.isClosed};
}

bool LayerView::tend() {
    try {
        if (backstage_.goOn()) show_.redraw();
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        show_.screen.layers() = {};
        show_.screen.warn(error.what());
        return false;
    }
    return true;
}

void LayerView::prepare(bool isCounting) {
    drawn_ = backstage_.ready({show_.screen.layers(), isCounting});
}

Overlay LayerView::record(const Presenter::Frame& frame) {
    Overlay overlay = show_.tools.overlay();
    const Layers& layers = overlay.layers = drawn_.layers;
    if (!layers.needsBuffers()) return overlay;
    const Inspection& inspection = backstage_.inspection();
    inspection.record(frame.commands, layers, frame.slot);
    pending_[frame.slot] = {layers.map, layers.hasContacts, layers.hasCells};
    overlay.buffers = inspection.buffers(layers, mapRange_.range(), cellRangeOf(grids_));
    return overlay;
}

void LayerView::settle(std::uint32_t slot) {
    const Pending pending = std::exchange(pending_[slot], {});
    const Inspection& inspection = backstage_.inspection();
    const float range = mapRange_.range(), cellRange = cellRangeOf(grids_);
    if (pending.map != ColorMap::none && pending.map == show_.screen.layers().map)
        mapRange_.read(inspection.reading(slot));
    if (pending.hasContacts && drawn_.layers.hasContacts) contactsFound_ = inspection.contacts(slot);
    if (pending.hasCells && drawn_.layers.hasCells) grids_ = inspection.grids(slot);
    if (mapRange_.range() != range || cellRangeOf(grids_) != cellRange) show_.redraw();
}

void LayerView::restart() {
    backstage_.forget();
    drawn_ = {};
}

void LayerView::addTo(Facts& facts) const {
    const Layers& layers = show_.screen.layers();
    facts.layers = layers;
    if (layers.section) {
        const Reach reach = reachOf(*layers.section, show_.opening.light.bounds);
        facts.sectionReach = {reach.low, reach.high};
    }
    facts.map = mapRange_.newest();
    facts.mapRange = mapRange_.range();
    facts.contactsFound = contactsFound_;
    if (drawn_.layers.hasCells) facts.grids = grids_;
    if (drawn_.layers.hasLinks) facts.links = backstage_.inspection().links();
    facts.isPreparing = drawn_.layers != layers;
}

} // namespace sinew::viewer
