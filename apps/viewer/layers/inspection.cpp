// Makes the buffers layer by layer.
#include "viewer/layers/inspection.hpp"

#include "viewer/document/document.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

Inspection::Inspection(const vk::Device& device, const Document& document, std::uint32_t slots)
    : device_(device), document_(document), slots_(slots) {}

bool Inspection::has(const WantedLayers& watched) const noexcept {
    for (std::size_t i = 0; i < layerTable().size(); ++i)
        if (watched.layers.looks[i] > 0 && layerTable()[i]->make && !parts_.of[i]) return false;
    return !watched.isCounting || parts_.counter;
}

Inspection::Parts Inspection::make(const WantedLayers& watched, const sim::Scene& scene) const {
    const LayerContext of{device_, scene, document_.settings(), document_.simulation(), slots_ + 1};
    Parts parts;
    for (std::size_t i = 0; i < layerTable().size(); ++i)
        if (watched.layers.looks[i] > 0 && layerTable()[i]->make && !parts_.of[i])
            parts.of[i] = layerTable()[i]->make(of);
    if (watched.isCounting && !parts_.counter)
        parts.counter = std::make_unique<const ContactMarks>(device_, scene, of.settings, of.simulation,
                                                             of.slots, ContactMarks::Room::none);
    return parts;
}

void Inspection::add(Parts parts) noexcept {
    for (std::size_t i = 0; i < mostLayers; ++i)
        if (parts.of[i]) parts_.of[i] = std::move(parts.of[i]);
    if (parts.counter) parts_.counter = std::move(parts.counter);
    before_ = {};
}

void Inspection::prepare(const Layers& layers) {
    add(make({layers}, document_.scene()));
}

void Inspection::restart() noexcept {
    if (!parts_.areNone()) before_ = std::exchange(parts_, {});
}

bool Inspection::Parts::areNone() const {
    return !counter && std::ranges::none_of(of, [](const auto& part) { return part != nullptr; });
}

void Inspection::Parts::recordRehearsal(VkCommandBuffer commands, std::uint32_t slot) const noexcept {
    for (std::size_t i = 0; i < layerTable().size(); ++i)
        for (std::size_t look = 0; of[i] && look < layerTable()[i]->looks.size(); ++look)
            of[i]->record(commands, look, slot);
    if (counter) counter->record(commands, 0, slot);
}

void Inspection::record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept {
    for (std::size_t i = 0; i < mostLayers; ++i)
        if (layers.looks[i] > 0 && parts_.of[i]) parts_.of[i]->record(commands, layers.looks[i] - 1u, slot);
}

LayerBuffers Inspection::buffers(const Layers& layers, const LayerRanges& ranges) const noexcept {
    LayerBuffers buffers{.ranges = ranges};
    for (std::size_t i = 0; i < mostLayers; ++i) {
        if (layers.looks[i] == 0 || !parts_.of[i]) continue;
        buffers.parts[i] = parts_.of[i].get();
        parts_.of[i]->addTo(buffers, layers.looks[i] - 1u);
    }
    return buffers;
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
