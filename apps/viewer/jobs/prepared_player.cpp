// Makes the simulation, the renderers and the warm-up.
#include "viewer/jobs/prepared_player.hpp"

#include "app/kept_forms.hpp"
#include "app/kept_pipelines.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/queue.hpp"
#include "viewer/jobs/gauges.hpp"
#include "viewer/jobs/replay.hpp"
#include "viewer/jobs/warm_up.hpp"

namespace sinew::viewer {

namespace {

// Settings with the fastest kernel forms; a saved state and a log keep their own.
sim::Settings fastest(const vk::Device& device, const OpenedScene& opening) {
    vk::Queue queue(device);
    sim::Settings settings = opening.loaded.settings;
    app::addRoomForUser(settings);
    if (opening.reload) settings = sim::withRoomsOf(settings, opening.reload->settings);
    if (opening.run || (opening.input && opening.input->forms)) return settings;
    settings.forms = app::chooseForms(device, queue, opening.loaded.scene, settings).forms;
    return settings;
}

} // namespace

WindowOutput::WindowOutput(const vk::Device& device, const Window& window)
    : presenter(device, window),
      painter(device, presenter.format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, Presenter::framesInFlight) {}

View::View(const vk::Device& device, VkFormat format, const Quality& quality, const SceneLight& light)
    : renderer(device, {.color = format, .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}, quality, light) {}

void View::dropCanvases() {
    for (std::optional<Canvas>& canvas : canvases) canvas.reset();
    halves.reset();
}

PreparedPlayer::PreparedPlayer(const vk::Device& device, const OpenedScene& opening, VkFormat format)
    : document(device, opening.loaded.scene, fastest(device, opening), firstMaterial(opening)),
      picker(device, document, opening.light, Presenter::framesInFlight),
      facts(sceneFacts(opening, document, device)),
      moving(device, format, isSoftware(device) ? reducedQuality() : Quality{}, opening.light) {
    document.setDefaults(opening.loaded.defaults);
    document.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
    if (isSoftware(device)) {
        still.emplace(device, format, Quality{}, opening.light);
        warmUp(device, *this, format, opening.camera);
    }
    if (!opening.run || opening.reload) return;
    vk::Queue queue(device);
    document.load(device, *opening.run, queue);
    if (opening.input) document.widen(roomOf(*opening.input), queue);
    picker.restart();
}

void prepare(OpenedScene& opening, const vk::Device& device, const Window& window) {
    opening.output = std::make_unique<WindowOutput>(device, window);
    prepare(opening, device, opening.output->presenter.format());
}

void prepare(OpenedScene& opening, const vk::Device& device, VkFormat format) {
    const vk::KeptKernels kept(device); // shared by the timing runs and the player
    opening.prepared = std::make_unique<PreparedPlayer>(device, opening, format);
    app::keepPipelines(device);
}

} // namespace sinew::viewer
