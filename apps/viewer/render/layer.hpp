// A layer as one record: its key, its names, how its buffers are made, how it is drawn, and its legend. To
// add a layer, write a file in viewer/layers and a row of the table there (docs/extending-viewer.md).
#pragma once

#include "sinew/simulation.hpp"
#include "viewer/frame.h"
#include "viewer/render/layers.hpp"
#include "viewer/render/legend.hpp"
#include "viewer/render/pipeline.hpp"

#include <memory>

namespace sinew::viewer {

/// A simulation to make the buffers of a layer for. The references must outlive the buffers, except for
/// `scene`, which may be a copy.
struct LayerContext {
    const vk::Device& device;
    const sim::Scene& scene;
    const sim::Settings& settings; ///< those of the simulation
    const sim::Simulation& simulation;
    std::uint32_t slots; ///< the most recordings in flight at a time
};

/// A picture in which a layer is drawn; its pipeline is bound.
struct LayerDrawing {
    const vk::Device& device;
    VkCommandBuffer commands;
    VkPipelineLayout layout;
    const sim::Simulation& simulation;
    float range;  ///< value of the last colour; 0 = not known yet
    float radius; ///< of the scene [m]

    void push(const layout::SkinPush& values) const noexcept {
        device.functions().vkCmdPushConstants(commands, layout,
                                              VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                              sizeof values, &values);
    }
};

/// The statements of a layer about a state.
struct LayerReading {
    MapReading values; ///< of its colours, if it has a range
    std::vector<LegendLine> legend;
    std::string note; ///< why nothing is drawn; empty = something may be
};

/// Buffers and kernels of a layer for one simulation. Must not outlive its Device, which must not move, nor
/// the simulation.
class LayerPart {
public:
    virtual ~LayerPart() = default;

    /// Runs the kernels of a look (index into Layer::looks) on the state for which recordSkin() was recorded.
    /// `slot` < slots; the slot's previous commands must have finished.
    virtual void record(VkCommandBuffer, std::size_t /*look*/, std::uint32_t /*slot*/) const noexcept {}
    /// Its statements, once the commands of that slot have finished.
    virtual LayerReading reading(std::uint32_t /*slot*/) const { return {}; }
    /// Adds the buffers of a look that the renderer draws bodies with.
    virtual void addTo(LayerBuffers&, std::size_t /*look*/) const noexcept {}
    /// Draws over the bodies with the layer's own pipeline.
    virtual void draw(const LayerDrawing&) const noexcept {}
};

/// A row of layerTable().
struct Layer {
    struct Look {
        std::string_view name;   ///< on the command line
        std::string_view button; ///< label of its button while this look is on
    };
    char key;                      ///< a digit or a capital letter
    std::string_view help;         ///< in the table of keys
    std::string_view button;       ///< label while the layer is off
    std::span<const Look> looks{}; ///< each press of the key turns to the next one, and then off

    /// Makes the buffers, in any thread. Throws vk::Error. Null: the layer needs none.
    std::unique_ptr<const LayerPart> (*make)(const LayerContext&) = nullptr;
    /// The pipeline that its part draws with; null: only the renderer draws it.
    PipelineRequest (*pipeline)() = nullptr;
    const vk::ShaderCode* opened = nullptr; ///< its fragment shader for pictures with a section
    bool hasRange = false;                  ///< colours span the values of the last reading
    bool isOfScene = false; ///< its buffers belong to the scene: a second simulation is drawn with them too
};

} // namespace sinew::viewer
