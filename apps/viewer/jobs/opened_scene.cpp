// Loads scenes and chooses their first view.
#include "viewer/jobs/opened_scene.hpp"

#include "sinew/ranges.hpp"
#include "sinew/solver_names.hpp"
#include "viewer/jobs/prepared_player.hpp"
#include "viewer/render/legend.hpp"

#include <cstdio>

namespace sinew::viewer {

namespace {

Vector3 toVector(const sim::Vec3& v) {
    return {v.x, v.y, v.z};
}

// The camera of a saved view.
Camera seenAgain(Camera camera, const app::SavedView& view) {
    camera.target = toVector(view.target);
    camera.distance = view.distance;
    camera.azimuth = view.azimuth;
    camera.elevation = view.elevation;
    camera.fieldOfView = view.fieldOfView;
    return camera;
}

// Options for a saved state: its scene, solver, substeps, levels and clamp.
Options withScene(Options options, const app::SavedRun& run) {
    options.scene.clear();
    (run.scene.starts_with('/') ? options.scene : options.builtIn) = run.scene;
    if (!options.overrides.solver) options.overrides.solver = sim::solverName(run.settings.solver);
    if (!options.overrides.substeps) options.overrides.substeps = run.settings.substeps;
    if (!options.overrides.levels) options.overrides.levels = run.settings.levels;
    options.overrides.takeClamp(run.hasSharpClamp);
    return options;
}

} // namespace

OpenedScene::OpenedScene() = default;
OpenedScene::OpenedScene(OpenedScene&&) noexcept = default;
OpenedScene::~OpenedScene() = default;

Camera firstView(const scenes::LoadedScene& loaded, float aspect) {
    const std::optional<float> ground = groundHeight(loaded.scene);
    const Box bounds = sceneBounds(loaded.scene);
    Camera camera;
    if (loaded.camera)
        camera = fitted(lookingFrom(toVector(loaded.camera->eye), toVector(loaded.camera->target),
                                    loaded.camera->fieldOfView),
                        bounds, aspect);
    else
        camera = framing(camera, bounds, aspect);
    if (ground) camera.lowestEye = *ground + 0.02f * bounds.diagonal().norm();
    return camera;
}

OpenedScene open(const Options& options, float aspect) {
    OpenedScene opening = look(options, aspect);
    for (const std::string& note : opening.loaded.notes) std::fprintf(stderr, "%s\n", note.c_str());
    for (const std::string& warning : opening.loaded.warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return opening;
}

OpenedScene look(const Options& asked, float aspect) {
    OpenedScene opening;
    if (app::isRunFile(asked.scene)) opening.run = app::readRun(asked.scene);
    const Options options = opening.run ? withScene(asked, *opening.run) : asked;
    opening.loaded = options.scene.empty() ? scenes::loadBuiltIn(options.builtIn, options.overrides)
                                           : scenes::load(options.scene, options.overrides);
    if (opening.run) {
        opening.loaded.settings = app::withRun(opening.loaded.settings, *opening.run);
        app::addRoomForUser(opening.loaded.settings);
    }
    opening.bladeDepth = options.bladeDepth ? options.bladeDepth : opening.loaded.bladeDepth;
    opening.camera = firstView(opening.loaded, aspect);
    opening.light = lightFor(opening.loaded.scene, opening.camera);
    opening.light.marks =
        marksOf(opening.loaded.scene, opening.loaded.holds, pinShare * opening.light.radius());
    opening.light.showsSleep = opening.loaded.settings.sleeps;
    opening.isFirstView = !opening.run || !opening.run->view;
    if (!opening.isFirstView) opening.camera = seenAgain(opening.camera, *opening.run->view);
    return opening;
}

sim::Material firstMaterial(const OpenedScene& opening) {
    return opening.reload ? opening.reload->material : opening.run ? opening.run->material : sim::Material{};
}

vk::DeviceRequest deviceRequest(const Options& options, std::atomic<std::size_t>& messages) {
    return {.device = options.device,
            .hasValidation = options.hasValidation,
            .onValidationMessage = [&messages](const std::string& message) {
                ++messages;
                std::fprintf(stderr, "validation: %s\n", message.c_str());
            }};
}

std::string headline(const OpenedScene& opening, const vk::Device& device) {
    const sim::Settings& settings = opening.loaded.settings;
    return opening.loaded.scene.name + ": " + countText(opening.loaded.scene.particles.size(), "particle") +
           ", solver " + sim::solverName(settings.solver) + " with " + sim::toText(settings) + ", on " +
           device.description().name + " (" + device.description().type + ")";
}

PictureText pictureText(const OpenedScene& opening, const vk::Device& device, std::uint64_t step) {
    return {{"Software", "Sinew " SINEW_VERSION},
            {"Scene", opening.loaded.scene.name},
            {"Step", std::to_string(step)},
            {"Device", device.description().name + ", " + device.description().driver}};
}

ToolContext toolContext(const OpenedScene& opening) {
    return {opening.light, opening.loaded.scene, opening.loaded.holds, opening.bladeDepth};
}

} // namespace sinew::viewer
