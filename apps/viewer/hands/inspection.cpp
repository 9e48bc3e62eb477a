// Makes the buffers layer by layer.
#include "viewer/hands/inspection.hpp"

#include "viewer/draw/stage.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

Inspection::Inspection(const vk::Device& device, const Stage& stage, std::uint32_t slots)
    : device_(device), stage_(stage), slots_(slots) {}

bool Inspection::has(const Watched& watched) const noexcept {
    const Layers& layers = watched.layers;
    return (layers.map == ColorMap::none || parts_.values) && (!layers.hasBalls || parts_.balls) &&
           (!layers.hasLinks || parts_.links) && (!layers.hasContacts || parts_.contacts) &&
           (!layers.hasCells || parts_.cells) && (!watched.isCounting || parts_.counter);
}

Inspection::Parts Inspection::make(const Watched& watched, const sim::Scene& scene) const {
    const Layers& layers = watched.layers;
    const sim::Settings& settings = stage_.settings();
    const sim::Simulation& simulation = stage_.simulation();
    const std::uint32_t all = slots_ + 1;
    Parts parts;
    if (layers.map != ColorMap::none && !parts_.values)
        parts.values = std::make_unique<const ValueMaps>(device_, scene, settings, simulation, all);
    if (layers.hasBalls && !parts_.balls)
        parts.balls = std::make_unique<const Balls>(device_, allBallsOf(scene));
    if (layers.hasLinks && !parts_.links)
        parts.links = std::make_unique<const LinkLines>(device_, scene, settings, simulation);
    if (layers.hasContacts && !parts_.contacts)
        parts.contacts = std::make_unique<const ContactMarks>(device_, scene, settings, simulation, all);
    if (layers.hasCells && !parts_.cells)
        parts.cells = std::make_unique<const HashCells>(device_, simulation, all);
    if (watched.isCounting && !parts_.counter)
        parts.counter = std::make_unique<const ContactMarks>(device_, scene, settings, simulation, all,
                                                             ContactMarks::Room::none);
    return parts;
}

void Inspection::add(Parts parts) noexcept {
    if (parts.values) parts_.values = std::move(parts.values);
    if (parts.balls) parts_.balls = std::move(parts.balls);
    if (parts.links) parts_.links = std::move(parts.links);
    if (parts.contacts) parts_.contacts = std::move(parts.contacts);
    if (parts.cells) parts_.cells = std::move(parts.cells);
    if (parts.counter) parts_.counter = std::move(parts.counter);
    before_ = {};
}

void Inspection::prepare(const Layers& layers) {
    add(make({layers}, stage_.scene()));
}

void Inspection::restart() noexcept {
    if (!parts_.areNone()) before_ = std::exchange(parts_, {});
}

void Inspection::Parts::recordRehearsal(VkCommandBuffer commands, std::uint32_t slot) const noexcept {
    if (values)
        for (const ColorMap map : {ColorMap::strain, ColorMap::speed, ColorMap::sleep})
            values->record(commands, map, slot);
    if (links) links->record(commands);
    if (contacts) contacts->record(commands, slot);
    if (cells) cells->record(commands, slot);
    if (counter) counter->record(commands, slot);
}

void Inspection::record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept {
    if (layers.map != ColorMap::none) parts_.values->record(commands, layers.map, slot);
    if (layers.hasLinks) parts_.links->record(commands);
    if (layers.hasContacts) parts_.contacts->record(commands, slot);
    if (layers.hasCells) parts_.cells->record(commands, slot);
}

LayerBuffers Inspection::buffers(const Layers& layers, float range, float cellRange) const noexcept {
    LayerBuffers buffers{.range = layers.map == ColorMap::sleep ? 1 : range, .cellRange = cellRange};
    if (layers.map != ColorMap::none) {
        buffers.particles = parts_.values->particles();
        buffers.skins = parts_.values->skins();
        buffers.cuts = parts_.values->cuts();
    }
    if (layers.hasBalls) buffers.balls = parts_.balls.get();
    if (layers.hasLinks) buffers.links = parts_.links.get();
    if (layers.hasContacts) buffers.contacts = parts_.contacts.get();
    if (layers.hasCells) buffers.cells = parts_.cells.get();
    return buffers;
}

float cellRangeOf(std::span<const GridFacts> grids) {
    std::uint32_t most = 0;
    for (const GridFacts& grid : grids) most = std::max(most, grid.most);
    return static_cast<float>(most);
}

void MapRange::read(const MapReading& reading) {
    newest_ = reading;
    const bool isBelow = reading.range < range_;
    below_ = isBelow ? std::max(below_, reading.range) : 0;
    count_ = isBelow ? count_ + 1 : 0;
    if (isBelow && count_ < patience) return;
    range_ = isBelow ? below_ : reading.range;
    below_ = 0;
    count_ = 0;
}

} // namespace sinew::viewer
