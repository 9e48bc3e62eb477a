// Pictures with a section: bodies use forms of their pipelines that omit the hidden side, and a cap is drawn
// where the plane passes through a body. Winding numbers decide where that is: along a ray from a point of
// the plane, the number of back faces minus the number of front faces tells how often closed surfaces enclose
// the point. This holds behind any occluder, for any number of bodies, for cut pieces and for inverted
// triangles.
#include "viewer/render/renderer.hpp"

#include "viewer/render/layer.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr float capGloss = 0.4f; // times that of balls

// A shader and its form for a section.
using Form = std::pair<const vk::ShaderCode*, const vk::ShaderCode*>;
constexpr std::array forms{Form{&shaders::depthVert, &shaders::depthSectionVert},
                           Form{&shaders::ballDepthVert, &shaders::ballDepthSectionVert},
                           Form{&shaders::skinFrag, &shaders::skinSectionFrag},
                           Form{&shaders::insideFrag, &shaders::insideSectionFrag},
                           Form{&shaders::clippedFrag, &shaders::clippedSectionFrag},
                           Form{&shaders::clothFrag, &shaders::clothSectionFrag},
                           Form{&shaders::clothWholeFrag, &shaders::clothWholeSectionFrag},
                           Form{&shaders::skinGlassFrag, &shaders::skinGlassSectionFrag},
                           Form{&shaders::insideGlassFrag, &shaders::insideGlassSectionFrag},
                           Form{&shaders::clippedGlassFrag, &shaders::clippedGlassSectionFrag},
                           Form{&shaders::valuesFrag, &shaders::valuesSectionFrag},
                           Form{&shaders::wiresFrag, &shaders::wiresSectionFrag}};

} // namespace

const RenderPass& Renderer::countsPass(Additions& to) const {
    if (countsPass_) return *countsPass_;
    if (!to.countsPass_)
        to.countsPass_.emplace(RenderPass::colorMap(device_, countsFormat, "section", format_.samples));
    return *to.countsPass_;
}

bool Renderer::hasSection() const noexcept {
    for (std::size_t i = 0; i < pipelineCount; ++i)
        if (has(i) && !has(i + pipelineCount) && openedForm(i, requests_[i]) != nullptr) return false;
    return has(capPipeline);
}

// The shader that replaces the last one of a pipeline. Grabs are drawn through the plane.
const vk::ShaderCode* Renderer::openedForm(std::size_t index, const PipelineRequest& request) noexcept {
    if (index == handPipeline) return nullptr;
    if (index >= layerPipelines) return layerTable()[index - layerPipelines]->opened;
    const auto* shader = request.fragment == nullptr ? request.vertex : request.fragment;
    const auto* found = std::ranges::find(forms, shader, &Form::first);
    return found == forms.end() ? nullptr : found->second;
}

void Renderer::makeOpened(Additions& to, std::size_t index, const PipelineRequest& whole) const {
    PipelineRequest request = whole;
    const bool isDepth = request.fragment == nullptr;
    const vk::ShaderCode* form = openedForm(index, request);
    if (form == nullptr) return;
    (isDepth ? request.vertex : request.fragment) = form;
    if (isDepth) request.fragment = &shaders::sectionDepthFrag;
    request.isDepthOnly = isDepth;
    request.name += ".section";
    const std::uint32_t hasOneSample = format_.samples == VK_SAMPLE_COUNT_1_BIT ? 1 : 0;
    std::vector<vk::SpecialisationConstant> constants(request.constants.begin(), request.constants.end());
    constants.push_back({4, hasOneSample});
    request.constants = constants;
    addPipeline(to, index + pipelineCount, request);
}

void Renderer::makeSection(Additions& to) const {
    for (std::size_t i = 0, made = to.made_.size(); i < made; ++i) {
        const PipelineRequest request = to.made_[i].request; // a copy: the vector grows
        makeOpened(to, to.made_[i].index, request);
    }
    for (std::size_t i = 0; i < pipelineCount; ++i)
        if (has(i) && !has(i + pipelineCount)) makeOpened(to, i, requests_[i]);
    if (!has(capPipeline)) makeCounts(to);
}

void Renderer::makeCounts(Additions& to) const {
    const bool hasOneSample = format_.samples == VK_SAMPLE_COUNT_1_BIT;
    const std::array constants{vk::SpecialisationConstant{4, hasOneSample ? 1u : 0u}};
    PipelineRequest request{.pass = countsPass(to).handle(),
                            .samples = format_.samples,
                            .blend = PipelineRequest::Blend::sum,
                            .constants = constants};
    const auto add = [&](PipelineIndex index, const char* name, const vk::ShaderCode& vertex,
                         const vk::ShaderCode& fragment, PipelineRequest::Input input) {
        request.name = std::string("section.") + name;
        request.vertex = &vertex;
        request.fragment = &fragment;
        request.input = input;
        addPipeline(to, index, request);
    };
    using In = PipelineRequest::Input;
    add(skinCountPipeline, "skins", shaders::skinVert, shaders::skinCountFrag, In::positionsAndNormals);
    add(cutCountPipeline, "cuts", shaders::cutVert, shaders::cutCountFrag, In::cuts);
    constexpr std::uint32_t isWallId = 6;
    const std::array ofPieces{constants[0], vk::SpecialisationConstant{isWallId, 0}};
    request.constants = ofPieces;
    add(pieceCountPipeline, "pieces", shaders::cutVert, shaders::cutCountFrag, In::cuts);
    request.constants = constants;
    add(ballCountPipeline, "balls", shaders::ballVert, shaders::ballCountFrag, In::balls);
    add(ballValuesCountPipeline, "ball_values", shaders::ballValuesVert, shaders::ballValuesCountFrag,
        In::ballValues);
    add(sectionValuesPipeline, "values", shaders::ballReachVert, shaders::sectionValuesFrag, In::ballValues);
    addLit(to, capPipeline,
           {.name = "section_cap",
            .vertex = &shaders::screenVert,
            .fragment = hasOneSample ? &shaders::sectionCapSingleFrag : &shaders::sectionCapFrag,
            .depth = PipelineRequest::Depth::testAndWrite});
}

// Counts only solid layers. A solid skin's cap hides the particles inside it.
void Renderer::recordCounts(VkCommandBuffer commands, const Canvas& canvas, const sim::Simulation& simulation,
                            const Overlay& overlay) const noexcept {
    const Layers& layers = overlay.layers;
    const bool isSolid = layers.skin() == SkinLook::solid, isMap = layers.map() != ColorMap::none;
    constexpr std::array nothing{VkClearValue{.color = {{0, 0, 0, 0}}}};
    begin(commands, *countsPass_, canvas.countsFramebuffer(), canvas.extent(), nothing);
    if (isSolid) {
        drawSkins(commands, skinCountPipeline, simulation);
        drawCuts(commands, cutCountPipeline, pieceCountPipeline, simulation);
        if (isMap) drawInsides(commands, simulation, overlay);
    }
    if (!isSolid || !layers.has(layer::particles)) {
        if (!isMap) drawBalls(commands, ballCountPipeline, simulation, overlay);
        if (isMap && overlay.buffers.particles.size > 0)
            drawBalls(commands, ballValuesCountPipeline, simulation, overlay);
    }
    device_.functions().vkCmdEndRenderPass(commands);
}

// Values of the particles of bodies with a skin, where they reach the plane.
void Renderer::drawInsides(VkCommandBuffer commands, const sim::Simulation& simulation,
                           const Overlay& overlay) const noexcept {
    if (insides_.ranges().empty() || overlay.buffers.particles.size == 0) return;
    bind(commands, sectionValuesPipeline);
    insides_.bind(commands, simulation.positions(), removedParticles(simulation), overlay.buffers.particles);
    push(commands, {overlay.buffers.range}, 0, {});
    for (const BallRange& range : insides_.ranges()) insides_.draw(commands, range);
}

void Renderer::drawCap(VkCommandBuffer commands, const Canvas& canvas, const Layers& layers) const noexcept {
    if (!layers.section || !canvas.hasCounts() || !has(capPipeline)) return;
    bind(commands, capPipeline);
    push(commands, {}, capGloss, {});
    device_.functions().vkCmdDraw(commands, 3, 1, 0, 0);
}

} // namespace sinew::viewer
