// The state of each pipeline.
#include "viewer/render/renderer.hpp"

#include "viewer_shaders.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

using Input = PipelineRequest::Input;
using Faces = PipelineRequest::Faces;
using Blend = PipelineRequest::Blend;
using Depth = PipelineRequest::Depth;

constexpr Depth solid = Depth::testAndWrite;

constexpr std::array plan{vk::SpecialisationConstant{3, 1}};

} // namespace

void Renderer::addPipeline(Additions& to, std::size_t index, PipelineRequest request) const {
    request.layout = sets_.layout();
    to.made_.push_back({index, request, Pipeline(device_, request)});
}

void Renderer::addLit(Additions& to, std::size_t index, PipelineRequest request) const {
    request.name.insert(0, "picture.");
    request.pass = pass_.handle();
    request.samples = format_.samples;
    if (request.constants.empty()) request.constants = look_;
    addPipeline(to, index, request);
}

void Renderer::addDepths(Additions& to, std::size_t ofShadow, std::size_t ofPlan,
                         const PipelineRequest& request) const {
    PipelineRequest each = request;
    each.depth = solid;
    each.name = "picture.shadow." + request.name;
    each.pass = maps_.shadow.pass.handle();
    addPipeline(to, ofShadow, each);
    each.name = "picture.plan." + request.name;
    if (request.faces == Faces::fronts) each.faces = Faces::backs; // the plan map is mirrored
    each.pass = maps_.plan.pass.handle();
    each.constants = plan;
    addPipeline(to, ofPlan, each);
}

void Renderer::add(Additions additions) {
    for (Additions::Made& made : additions.made_) {
        pipelines_[made.index].emplace(std::move(made.pipeline));
        if (made.index < pipelineCount) requests_[made.index] = std::move(made.request);
    }
    if (additions.countsPass_) countsPass_.emplace(std::move(*additions.countsPass_));
}

void Renderer::makeMaps(Additions& to) const {
    addDepths(to, shadowPipeline, planPipeline,
              {.name = "skin", .vertex = &shaders::depthVert, .input = Input::positions});
    addDepths(to, shadowFacingPipeline, planFacingPipeline,
              {.name = "skin_facing",
               .vertex = &shaders::depthVert,
               .input = Input::positions,
               .faces = Faces::fronts});
    addPipeline(to, floorPipeline,
                {.name = "picture.floor",
                 .vertex = &shaders::screenVert,
                 .fragment = &shaders::floorFrag,
                 .pass = maps_.floor.pass.handle(),
                 .constants = look_});
}

void Renderer::makeBodies(Additions& to) const {
    const PipelineRequest skin{.name = "skin",
                               .vertex = &shaders::skinVert,
                               .fragment = &shaders::skinFrag,
                               .input = Input::positionsAndNormals,
                               .depth = solid,
                               .faces = Faces::fronts};
    addLit(to, skinPipeline, skin);
    PipelineRequest backs = skin;
    backs.name = "skin_backs";
    backs.faces = Faces::backs;
    addLit(to, skinBacksPipeline, backs);
    addLit(to, handPipeline,
           {.name = "hand",
            .vertex = &shaders::handVert,
            .fragment = &shaders::skinFrag,
            .input = Input::hand,
            .depth = solid});
    addLit(to, groundPipeline,
           {.name = "ground",
            .vertex = &shaders::groundVert,
            .fragment = &shaders::groundFrag,
            .depth = solid,
            .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP});
    addLit(
        to, skyPipeline,
        {.name = "sky", .vertex = &shaders::screenVert, .fragment = &shaders::skyFrag, .depth = Depth::test});
}

void Renderer::makeBackdrop(Additions& to) const {
    addLit(to, backdropPipeline,
           {.name = "backdrop",
            .vertex = &shaders::screenVert,
            .fragment = &shaders::backdropFrag,
            .depth = Depth::test});
}

void Renderer::makeEnlarging(Additions& to) const {
    addPipeline(to, enlargePipeline,
                {.name = "picture.enlarge",
                 .vertex = &shaders::enlargeVert,
                 .fragment = &shaders::enlargeFrag,
                 .pass = wholePass_->handle()});
}

void Renderer::makeCuts(Additions& to) const {
    PipelineRequest request{.name = "inside",
                            .vertex = &shaders::cutVert,
                            .fragment = &shaders::insideFrag,
                            .input = Input::cuts,
                            .depth = solid};
    addLit(to, insidePipeline, request);
    request.name = "clipped";
    request.vertex = &shaders::cutPiecesVert;
    request.fragment = &shaders::clippedFrag;
    addLit(to, clippedPipeline, request);
}

void Renderer::makeSurfaces(Additions& to) const {
    const auto add = [&](std::size_t index, std::size_t whole, const vk::ShaderCode& fragment) {
        const auto lit = std::ranges::find(to.made_, whole, &Additions::Made::index);
        PipelineRequest request = lit->request;
        request.name += ".surface";
        request.fragment = &fragment;
        request.pass = surfacesPass_->handle();
        request.colors = surfaceFormats.size();
        addPipeline(to, index, request);
    };
    add(skinSurfacePipeline, skinPipeline, shaders::skinSurfaceFrag);
    add(skinBacksSurfacePipeline, skinBacksPipeline, shaders::skinSurfaceFrag);
    add(insideSurfacePipeline, insidePipeline, shaders::insideSurfaceFrag);
    add(clippedSurfacePipeline, clippedPipeline, shaders::clippedSurfaceFrag);
    addLit(to, surfacesPipeline,
           {.name = "surfaces",
            .vertex = &shaders::screenVert,
            .fragment = &shaders::surfacesFrag,
            .depth = Depth::testBehind});
}

void Renderer::makeSheets(Additions& to) const {
    addLit(to, clothPipeline,
           {.name = "cloth",
            .vertex = &shaders::skinSheetVert,
            .fragment = &shaders::clothWholeFrag,
            .input = Input::sheets,
            .depth = solid});
    addLit(to, clothPiecesPipeline,
           {.name = "cloth_pieces",
            .vertex = &shaders::skinVert,
            .fragment = &shaders::clothFrag,
            .input = Input::positionsAndNormals,
            .depth = solid});
}

void Renderer::makeBalls(Additions& to) const {
    addDepths(to, ballShadowPipeline, ballPlanPipeline,
              {.name = "ball", .vertex = &shaders::ballDepthVert, .input = Input::balls});
    addLit(to, ballPipeline,
           {.name = "ball",
            .vertex = &shaders::ballVert,
            .fragment = &shaders::skinFrag,
            .input = Input::balls,
            .depth = solid});
}

void Renderer::makeHeld(Additions& to) const {
    addLit(to, heldPipeline,
           {.name = "held",
            .vertex = &shaders::ballVert,
            .fragment = &shaders::skinFrag,
            .input = Input::balls,
            .depth = solid,
            .constants = heldLook_});
}

void Renderer::makeWalls(Additions& to) const {
    addLit(to, wallPipeline,
           {.name = "wall",
            .vertex = &shaders::wiresVert,
            .fragment = &shaders::wallFrag,
            .input = Input::positions,
            .depth = Depth::test,
            .faces = Faces::fronts,
            .blend = Blend::over});
}

void Renderer::makeGlass(Additions& to) const {
    const auto add = [&](std::size_t index, const char* name, const vk::ShaderCode& vertex,
                         const vk::ShaderCode& fragment, Input input) {
        addLit(to, index,
               {.name = name,
                .vertex = &vertex,
                .fragment = &fragment,
                .input = input,
                .depth = Depth::test,
                .blend = Blend::over});
    };
    add(skinGlassPipeline, "skin_glass", shaders::skinVert, shaders::skinGlassFrag,
        Input::positionsAndNormals);
    add(insideGlassPipeline, "inside_glass", shaders::cutVert, shaders::insideGlassFrag, Input::cuts);
    add(clippedGlassPipeline, "clipped_glass", shaders::cutPiecesVert, shaders::clippedGlassFrag,
        Input::cuts);
}

void Renderer::makeValues(Additions& to) const {
    const auto add = [&](std::size_t index, const char* name, const vk::ShaderCode& vertex, Input input) {
        addLit(to, index,
               {.name = name,
                .vertex = &vertex,
                .fragment = &shaders::valuesFrag,
                .input = input,
                .depth = solid});
    };
    add(skinValuesPipeline, "skin_values", shaders::skinValuesVert, Input::skinValues);
    add(cutValuesPipeline, "cut_values", shaders::cutValuesVert, Input::cutValues);
    add(ballValuesPipeline, "ball_values", shaders::ballValuesVert, Input::ballValues);
}

void Renderer::makeWires(Additions& to) const {
    addLit(to, wiresPipeline,
           {.name = "wires",
            .vertex = &shaders::wiresVert,
            .fragment = &shaders::wiresFrag,
            .input = Input::positions,
            .depth = Depth::test,
            .hasEdgesAlone = true,
            .blend = Blend::over});
}

} // namespace sinew::viewer
