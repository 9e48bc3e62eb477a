// Graphics pipelines out of the embedded shaders, with the little that differs between ours.
#pragma once

#include "vk/device.hpp"
#include "vk/kernel.hpp"

namespace sinew::viewer {

/// A corner of a panel's triangle, as Dear ImGui lays it out.
struct PanelVertex {
    float place[2];        ///< from the upper left corner of the picture [pixels]
    float atlas[2];        ///< in the glyph atlas, which is 1 wide and high
    std::uint8_t color[4]; ///< red, green, blue as shown (sRGB), alpha
};

struct PipelineRequest {
    std::string name;
    const vk::ShaderCode* vertex = nullptr;
    const vk::ShaderCode* fragment = nullptr; ///< null: depth only
    bool isDepthOnly = false;                 ///< though there is one
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    /// Of SkinVertex, binding 0; or corners of a ball, and an instance its place, its piece at location 4,
    /// and its radius, bindings 0 to 3; of a hand those without a radius. Of a cut SkinVertex and CutVertex,
    /// bindings 0 and 1. Of panels PanelVertex. With a value (float) at location 3: skins at binding 1, balls
    /// an instance at 4, cuts at 2. Of a mark corners as of a hand, and ContactMark an instance, bindings 0
    /// and 1. Of particles positions. Of cells CellMark an instance, binding 0.
    enum class Input {
        none,
        positions,
        positionsAndNormals,
        balls,
        hand,
        cuts,
        panels,
        skinValues,
        ballValues,
        cutValues,
        marks,
        particles,
        cells
    } input = Input::none;
    enum class Depth { none, test, testAndWrite } depth = Depth::none;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    enum class Faces {
        all,
        fronts,
        backs
    } faces = Faces::all;       ///< fronts are counter-clockwise in the picture
    bool hasEdgesAlone = false; ///< of triangles; only where drawsEdges()
    /// Over what is there by alpha; or added to it; or over it in an image that is put over another later:
    /// laid, which keeps colors times alpha; or over it with such colors.
    enum class Blend { none, over, sum, laid, overTimesAlpha } blend = Blend::none;
    std::span<const vk::SpecialisationConstant> constants; ///< of both stages; ids a shader lacks are ignored
};

/// A VkPipeline with dynamic viewport and scissor. Movable. Must not outlive its Device.
class Pipeline {
public:
    Pipeline(const vk::Device& device, const PipelineRequest& request);
    Pipeline(Pipeline&& other) noexcept;
    Pipeline& operator=(Pipeline&&) = delete;
    ~Pipeline();

    VkPipeline handle() const noexcept { return pipeline_; }

private:
    const vk::Device* device_ = nullptr;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace sinew::viewer
