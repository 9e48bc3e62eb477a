// What each pipeline consists of.
#include "viewer/draw/renderer.hpp"

#include "viewer_shaders.hpp"

namespace sinew::viewer {

namespace {

using Input = PipelineRequest::Input;
using Faces = PipelineRequest::Faces;
using Blend = PipelineRequest::Blend;
using Depth = PipelineRequest::Depth;

constexpr Depth solid = Depth::testAndWrite;

constexpr std::array plan{vk::SpecialisationConstant{3, 1}};

} // namespace

void Renderer::addPipeline(std::size_t index, PipelineRequest request) {
    request.layout = sets_.layout();
    pipelines_[index].emplace(device_, request);
    if (index < pipelineCount) requests_[index] = request;
}

void Renderer::addLit(std::size_t index, PipelineRequest request) {
    request.name.insert(0, "picture.");
    request.pass = pass_.handle();
    request.samples = format_.samples;
    request.constants = look_;
    addPipeline(index, request);
}

void Renderer::addDepths(std::size_t ofShadow, std::size_t ofPlan, const PipelineRequest& request) {
    PipelineRequest each = request;
    each.depth = solid;
    each.name = "picture.shadow." + request.name;
    each.pass = maps_.shadow.pass.handle();
    addPipeline(ofShadow, each);
    each.name = "picture.plan." + request.name;
    each.pass = maps_.plan.pass.handle();
    each.constants = plan;
    addPipeline(ofPlan, each);
}

void Renderer::createMapPipelines() {
    addDepths(shadowPipeline, planPipeline,
              {.name = "skin", .vertex = &shaders::depthVert, .input = Input::positions});
    addPipeline(floorPipeline, {.name = "picture.floor",
                                .vertex = &shaders::screenVert,
                                .fragment = &shaders::floorFrag,
                                .pass = maps_.floor.pass.handle(),
                                .constants = look_});
}

void Renderer::createPipelines() {
    const PipelineRequest skin{.name = "skin",
                               .vertex = &shaders::skinVert,
                               .fragment = &shaders::skinFrag,
                               .input = Input::positionsAndNormals,
                               .depth = solid,
                               .faces = Faces::fronts};
    addLit(skinPipeline, skin);
    PipelineRequest backs = skin;
    backs.name = "skin_backs";
    backs.faces = Faces::backs;
    addLit(skinBacksPipeline, backs);
    addLit(handPipeline, {.name = "hand",
                          .vertex = &shaders::handVert,
                          .fragment = &shaders::skinFrag,
                          .input = Input::hand,
                          .depth = solid});
    addLit(groundPipeline, {.name = "ground",
                            .vertex = &shaders::groundVert,
                            .fragment = &shaders::groundFrag,
                            .depth = solid,
                            .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP});
    addLit(
        skyPipeline,
        {.name = "sky", .vertex = &shaders::screenVert, .fragment = &shaders::skyFrag, .depth = Depth::test});
}

void Renderer::createBackdrop() {
    addLit(backdropPipeline, {.name = "backdrop",
                              .vertex = &shaders::screenVert,
                              .fragment = &shaders::backdropFrag,
                              .depth = Depth::test});
}

void Renderer::createEnlarging() {
    wholePass_.emplace(RenderPass::whole(device_, format_.color, finalLayout_));
    addPipeline(enlargePipeline, {.name = "picture.enlarge",
                                  .vertex = &shaders::enlargeVert,
                                  .fragment = &shaders::enlargeFrag,
                                  .pass = wholePass_->handle()});
}

void Renderer::createCutPipelines() {
    PipelineRequest request{.name = "inside",
                            .vertex = &shaders::cutVert,
                            .fragment = &shaders::insideFrag,
                            .input = Input::cuts,
                            .depth = solid};
    addLit(insidePipeline, request);
    request.name = "clipped";
    request.fragment = &shaders::clippedFrag;
    addLit(clippedPipeline, request);
}

void Renderer::createBallPipelines() {
    addDepths(ballShadowPipeline, ballPlanPipeline,
              {.name = "ball", .vertex = &shaders::ballDepthVert, .input = Input::balls});
    addLit(ballPipeline, {.name = "ball",
                          .vertex = &shaders::ballVert,
                          .fragment = &shaders::skinFrag,
                          .input = Input::balls,
                          .depth = solid});
}

void Renderer::prepareGlass() {
    const auto add = [&](std::size_t index, const char* name, const vk::ShaderCode& vertex,
                         const vk::ShaderCode& fragment, Input input) {
        addLit(index, {.name = name,
                       .vertex = &vertex,
                       .fragment = &fragment,
                       .input = input,
                       .depth = Depth::test,
                       .blend = Blend::over});
    };
    add(skinGlassPipeline, "skin_glass", shaders::skinVert, shaders::skinGlassFrag,
        Input::positionsAndNormals);
    add(insideGlassPipeline, "inside_glass", shaders::cutVert, shaders::insideGlassFrag, Input::cuts);
    add(clippedGlassPipeline, "clipped_glass", shaders::cutVert, shaders::clippedGlassFrag, Input::cuts);
}

void Renderer::prepareValues() {
    const auto add = [&](std::size_t index, const char* name, const vk::ShaderCode& vertex, Input input) {
        addLit(index, {.name = name,
                       .vertex = &vertex,
                       .fragment = &shaders::valuesFrag,
                       .input = input,
                       .depth = solid});
    };
    add(skinValuesPipeline, "skin_values", shaders::skinValuesVert, Input::skinValues);
    add(cutValuesPipeline, "cut_values", shaders::cutValuesVert, Input::cutValues);
    add(ballValuesPipeline, "ball_values", shaders::ballValuesVert, Input::ballValues);
}

void Renderer::prepareWires() {
    addLit(wiresPipeline, {.name = "wires",
                           .vertex = &shaders::wiresVert,
                           .fragment = &shaders::wiresFrag,
                           .input = Input::positions,
                           .depth = Depth::test,
                           .hasEdgesAlone = true,
                           .blend = Blend::over});
}

void Renderer::prepareLinks() {
    addLit(linkPipeline, {.name = "links",
                          .vertex = &shaders::wiresVert,
                          .fragment = &shaders::linkFrag,
                          .input = Input::particles,
                          .depth = solid,
                          .topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST});
}

// What touches is hidden by what touches it, so marks are seen through everything.
void Renderer::prepareContacts() {
    addLit(contactPipeline, {.name = "contacts",
                             .vertex = &shaders::markVert,
                             .fragment = &shaders::markFrag,
                             .input = Input::marks});
}

} // namespace sinew::viewer
