// Layers over or instead of the bodies: their draw calls, and pipelines that are made at the first use.
#include "viewer/render/renderer.hpp"

#include "viewer/render/layer.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>

namespace sinew::viewer {

// vk::Device::create enables the feature if the device has it.
bool drawsEdges(const vk::Device& device) {
    VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    device.instanceFunctions().vkGetPhysicalDeviceFeatures2(device.physical(), &features);
    return features.features.fillModeNonSolid == VK_TRUE;
}

std::span<const Renderer::Feature> Renderer::features() {
    static constexpr std::array all{
        Feature{[](const Layers& layers) { return layers.has(layer::particles); }, ballPipeline,
                &Renderer::makeBalls},
        Feature{[](const Layers& layers) { return layers.skin() == SkinLook::glass; }, skinGlassPipeline,
                &Renderer::makeGlass},
        Feature{[](const Layers& layers) { return layers.map() != ColorMap::none; }, skinValuesPipeline,
                &Renderer::makeValues},
        Feature{[](const Layers& layers) { return layers.has(layer::wires); }, wiresPipeline,
                &Renderer::makeWires}};
    return all;
}

bool Renderer::isDrawn(const Feature& feature, const Layers& layers) const {
    return feature.isIn(layers) && (feature.first != wiresPipeline || drawsEdges_);
}

bool Renderer::isDrawn(std::size_t layer, const Layers& layers) {
    return layers.looks[layer] > 0 && layerTable()[layer]->pipeline;
}

void Renderer::makeLayer(Additions& to, std::size_t layer) const {
    addLit(to, layerPipelines + layer, layerTable()[layer]->pipeline());
}

bool Renderer::has(const Layers& layers) const noexcept {
    const auto isMissing = [&](const Feature& feature) {
        return isDrawn(feature, layers) && !has(feature.first);
    };
    if (std::ranges::any_of(features(), isMissing)) return false;
    for (std::size_t i = 0; i < layerTable().size(); ++i)
        if (isDrawn(i, layers) && !has(layerPipelines + i)) return false;
    return !layers.section || hasSection();
}

Renderer::Additions Renderer::make(const Layers& layers) const {
    Additions to;
    for (const Feature& feature : features())
        if (isDrawn(feature, layers) && !has(feature.first)) (this->*feature.make)(to);
    for (std::size_t i = 0; i < layerTable().size(); ++i)
        if (isDrawn(i, layers) && !has(layerPipelines + i)) makeLayer(to, i);
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
    if (layers.skin() != SkinLook::solid) return;
    if (buffers.skins.size > 0) drawSkins(commands, opened(skinValuesPipeline, layers), simulation, buffers);
    const std::size_t ofCuts = opened(cutValuesPipeline, layers);
    if (buffers.cuts.size > 0) drawCuts(commands, ofCuts, ofCuts, simulation, buffers);
}

// Draws layers of their own: those with a depth test first, since the others are drawn through everything.
void Renderer::drawLayers(VkCommandBuffer commands, const sim::Simulation& simulation,
                          const Overlay& overlay) const noexcept {
    for (const bool isTested : {true, false})
        for (std::size_t i = 0; i < layerTable().size(); ++i) {
            const LayerPart* part = overlay.buffers.parts[i];
            const std::size_t pipeline = layerPipelines + i;
            if (part == nullptr || !has(pipeline)) continue;
            if ((requests_[pipeline].depth != PipelineRequest::Depth::none) != isTested) continue;
            bind(commands, opened(pipeline, overlay.layers));
            part->draw(
                {device_, commands, sets_.layout(), simulation, overlay.buffers.ranges[i], light_.radius()});
        }
}

// Draws layers over everything else.
void Renderer::recordLayers(VkCommandBuffer commands, const sim::Simulation& simulation,
                            const Overlay& overlay) const noexcept {
    const Layers& layers = overlay.layers;
    if (layers.skin() == SkinLook::glass && has(skinGlassPipeline)) {
        drawSkins(commands, opened(skinGlassPipeline, layers), simulation);
        drawCuts(commands, opened(insideGlassPipeline, layers), opened(clippedGlassPipeline, layers),
                 simulation);
    }
    if (layers.has(layer::wires) && has(wiresPipeline)) {
        const std::size_t wires = opened(wiresPipeline, layers);
        drawSkins(commands, wires, simulation);
        drawCuts(commands, wires, wires, simulation);
    }
    drawLayers(commands, simulation, overlay);
}

} // namespace sinew::viewer
