// Layers over or instead of the bodies: their draw calls, and pipelines that are made at the first use.
#include "viewer/draw/renderer.hpp"

#include "viewer/draw/contact_marks.hpp"
#include "viewer/draw/hash_cells.hpp"
#include "viewer/draw/link_lines.hpp"
#include "viewer_shaders.hpp"

namespace sinew::viewer {

namespace {

constexpr float markSize = 0.004f; // of the ball of a mark, in radii of the stage

} // namespace

// vk::Device::create enables the feature if the device has it.
bool drawsEdges(const vk::Device& device) {
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    device.instanceFunctions().vkGetPhysicalDeviceFeatures2(device.physical(), &features);
    return features.features.fillModeNonSolid == VK_TRUE;
}

std::span<const Renderer::Feature> Renderer::features() {
    static constexpr std::array all{
        Feature{[](const Layers& layers) { return layers.hasBalls; }, ballPipeline, &Renderer::makeBalls},
        Feature{[](const Layers& layers) { return layers.skin == SkinLook::glass; }, skinGlassPipeline,
                &Renderer::makeGlass},
        Feature{[](const Layers& layers) { return layers.map != ColorMap::none; }, skinValuesPipeline,
                &Renderer::makeValues},
        Feature{[](const Layers& layers) { return layers.hasWires; }, wiresPipeline, &Renderer::makeWires},
        Feature{[](const Layers& layers) { return layers.hasLinks; }, linkPipeline, &Renderer::makeLinks},
        Feature{[](const Layers& layers) { return layers.hasContacts; }, contactPipeline,
                &Renderer::makeContacts},
        Feature{[](const Layers& layers) { return layers.hasCells; }, cellPipeline, &Renderer::makeCells}};
    return all;
}

bool Renderer::isDrawn(const Feature& feature, const Layers& layers) const {
    return feature.isIn(layers) && (feature.first != wiresPipeline || drawsEdges_);
}

Renderer::Additions Renderer::make(const Layers& layers) const {
    Additions to;
    for (const Feature& feature : features())
        if (isDrawn(feature, layers) && !has(feature.first)) (this->*feature.make)(to);
    if (layers.section) makeSection(to); // last: it also needs the pipelines made above
    return to;
}

void Renderer::prepare(const Layers& layers, Canvas& canvas) {
    add(make(layers));
    prepareCanvas(layers, canvas);
}

void Renderer::prepareCanvas(const Layers& layers, Canvas& canvas) const {
    if (layers.section) canvas.addCounts(device_, *countsPass_, format_.samples);
}

// Draws in the colours of a map: solid skins, and all balls.
void Renderer::drawValues(VkCommandBuffer commands, const sim::Simulation& simulation,
                          const Overlay& overlay) const noexcept {
    const LayerBuffers& buffers = overlay.buffers;
    const Layers& layers = overlay.layers;
    if (!has(skinValuesPipeline)) return;
    if (buffers.particles.size > 0)
        drawBalls(commands, opened(ballValuesPipeline, layers), simulation, overlay);
    if (layers.skin != SkinLook::solid) return;
    if (buffers.skins.size > 0) drawSkins(commands, opened(skinValuesPipeline, layers), simulation, buffers);
    const std::size_t ofCuts = opened(cutValuesPipeline, layers);
    if (buffers.cuts.size > 0) drawCuts(commands, ofCuts, ofCuts, simulation, buffers);
}

void Renderer::drawLinks(VkCommandBuffer commands, const sim::Simulation& simulation,
                         const Overlay& overlay) const noexcept {
    const LinkLines& links = *overlay.buffers.links;
    bind(commands, opened(linkPipeline, overlay.layers));
    bindMesh(commands, simulation.positions(), links.indices());
    for (const LinkLines::Range& range : links.ranges()) {
        push(commands, {{range.color[0], range.color[1], range.color[2], 0}, {}, {}});
        device_.functions().vkCmdDrawIndexed(commands, range.indexCount, 1, range.firstIndex, 0, 0);
    }
}

// Draws layers over everything else.
void Renderer::recordLayers(VkCommandBuffer commands, const sim::Simulation& simulation,
                            const Overlay& overlay) const noexcept {
    const Layers& layers = overlay.layers;
    if (layers.skin == SkinLook::glass && has(skinGlassPipeline)) {
        drawSkins(commands, opened(skinGlassPipeline, layers), simulation);
        drawCuts(commands, opened(insideGlassPipeline, layers), opened(clippedGlassPipeline, layers),
                 simulation);
    }
    if (layers.hasWires && has(wiresPipeline)) {
        const std::size_t wires = opened(wiresPipeline, layers);
        drawSkins(commands, wires, simulation);
        drawCuts(commands, wires, wires, simulation);
    }
    if (overlay.buffers.links != nullptr && has(linkPipeline)) drawLinks(commands, simulation, overlay);
    if (overlay.buffers.cells != nullptr && has(cellPipeline)) {
        bind(commands, opened(cellPipeline, layers));
        push(commands, {{overlay.buffers.cellRange}, {}, {}});
        overlay.buffers.cells->draw(commands);
    }
    if (overlay.buffers.contacts != nullptr && has(contactPipeline)) {
        const ContactMarks& contacts = *overlay.buffers.contacts;
        bind(commands, opened(contactPipeline, layers));
        push(commands, {{}, {0, 0, 0, markSize * light_.radius()}, {}});
        contacts.mesh().drawIndirect(commands, contacts.marks(), contacts.draw());
    }
}

} // namespace sinew::viewer
