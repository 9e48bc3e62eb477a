// Graphics pipelines from the embedded shaders. A request holds what differs between the viewer's pipelines.
#pragma once

#include "sinew/vk/device.hpp"
#include "sinew/vk/kernel.hpp"

namespace sinew::viewer {

/// A corner of a panel's triangle, as Dear ImGui lays it out.
struct PanelVertex {
    float place[2];        ///< from the upper left corner of the picture [pixels]
    float atlas[2];        ///< in the glyph atlas, whose sides have length 1
    std::uint8_t color[4]; ///< red, green, blue in sRGB, alpha
};

/// The layout of a vertex, or of an instance.
struct VertexForm {
    std::span<const VkVertexInputBindingDescription> bindings;
    std::span<const VkVertexInputAttributeDescription> attributes;
};

struct PipelineRequest {
    std::string name;
    const vk::ShaderCode* vertex = nullptr;
    const vk::ShaderCode* fragment = nullptr; ///< null: depth only
    bool isDepthOnly = false;                 ///< even if there is a fragment shader
    std::uint32_t colors = 1;                 ///< colour images that a fragment shader writes, at most 2
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    /// Vertex inputs. positions, positionsAndNormals: SkinVertex at binding 0. balls: corners at 0, and per
    /// instance position (1), piece (2, location 4) and radius (3); hand: as balls without radius. cuts:
    /// SkinVertex at 0, CutVertex at 1. panels: PanelVertex. skinValues, ballValues, cutValues: also a float
    /// at location 3, from binding 1, 4 (per instance) and 2. sheets: positionsAndNormals, and a vec4 at
    /// location 4 from binding 1. own: `vertices`.
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
        sheets,
        own
    } input = Input::none;
    VertexForm vertices{}; ///< must outlive the request
    /// testBehind: passes where the image is nearer.
    enum class Depth { none, test, testAndWrite, testBehind } depth = Depth::none;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    enum class Faces {
        all,
        fronts,
        backs
    } faces = Faces::all;       ///< fronts are counter-clockwise in the picture
    bool hasEdgesAlone = false; ///< draws only edges of triangles; only if drawsEdges()
    /// over: alpha blending. sum: adds to the image. laid: alpha blending into an image that is blended over
    /// another later; it holds colours times alpha. overTimesAlpha: blends such colours over an image.
    enum class Blend { none, over, sum, laid, overTimesAlpha } blend = Blend::none;
    std::span<const vk::SpecialisationConstant> constants; ///< for both stages; unknown ids are ignored
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
