// One layer's buffers after the other.
#include "viewer/hands/inspection.hpp"

#include "viewer/draw/stage.hpp"

#include <algorithm>

namespace sinew::viewer {

Inspection::Inspection(const vk::Device& device, const Stage& stage, std::uint32_t slots)
    : device_(device), stage_(stage), slots_(slots) {}

void Inspection::prepare(const Layers& layers) {
    if (layers.map != ColorMap::none && !values_)
        values_.emplace(device_, stage_.scene(), stage_.settings(), stage_.simulation(), slots_);
    if (layers.hasBalls && !balls_)
        balls_ = std::make_unique<const Balls>(device_, allBallsOf(stage_.scene()));
    if (layers.hasLinks && !links_)
        links_ = std::make_unique<const LinkLines>(device_, stage_.scene(), stage_.settings(),
                                                   stage_.simulation());
    if (layers.hasContacts && !contacts_)
        contacts_ = std::make_unique<const ContactMarks>(device_, stage_.scene(), stage_.settings(),
                                                         stage_.simulation(), slots_);
}

void Inspection::record(VkCommandBuffer commands, const Layers& layers, std::uint32_t slot) const noexcept {
    if (layers.map != ColorMap::none) values_->record(commands, layers.map, slot);
    if (layers.hasLinks) links_->record(commands);
    if (layers.hasContacts) contacts_->record(commands, slot);
}

LayerBuffers Inspection::buffers(const Layers& layers, float range) const noexcept {
    LayerBuffers buffers{.range = layers.map == ColorMap::sleep ? 1 : range};
    if (layers.map != ColorMap::none) {
        buffers.particles = values_->particles();
        buffers.skins = values_->skins();
        buffers.cuts = values_->cuts();
    }
    if (layers.hasBalls) buffers.balls = balls_.get();
    if (layers.hasLinks) buffers.links = links_.get();
    if (layers.hasContacts) buffers.contacts = contacts_.get();
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
