// Makes the simulation, the renderers and the warm-up.
#include "viewer/prepared_show.hpp"

#include "sinew/gpu_tune.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/queue.hpp"
#include "viewer/gauges.hpp"
#include "viewer/replay.hpp"
#include "viewer/warm_up.hpp"

namespace sinew::viewer {

namespace {

// Settings with the fastest kernel forms; a saved state keeps its own.
sim::Settings fastest(const vk::Device& device, const Opening& opening) {
    vk::Queue queue(device);
    sim::Settings settings = opening.loaded.settings;
    app::addRoomForUser(settings);
    if (opening.again) settings = sim::withRoomsOf(settings, opening.again->settings);
    return opening.run ? settings : sim::tuned(device, queue, opening.loaded.scene, settings);
}

} // namespace

Place::Place(const vk::Device& device, const Window& window)
    : presenter(device, window),
      painter(device, presenter.format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, Presenter::framesInFlight) {}

View::View(const vk::Device& device, VkFormat format, const Quality& quality, const StageLight& light)
    : renderer(device, {.color = format, .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}, quality, light) {}

void View::dropCanvases() {
    for (std::optional<Canvas>& canvas : canvases) canvas.reset();
    halves.reset();
}

PreparedShow::PreparedShow(const vk::Device& device, const Opening& opening, VkFormat format)
    : stage(device, opening.loaded.scene, fastest(device, opening), firstMaterial(opening)),
      picker(device, stage, opening.light, Presenter::framesInFlight),
      facts(sceneFacts(opening, stage, device)),
      moving(device, format, isSoftware(device) ? reducedQuality() : Quality{}, opening.light) {
    stage.setDefaults(opening.loaded.defaults);
    stage.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
    if (isSoftware(device)) {
        still.emplace(device, format, Quality{}, opening.light);
        warmUp(device, *this, format, opening.camera);
    }
    if (!opening.run || opening.again) return;
    vk::Queue queue(device);
    stage.load(device, *opening.run, queue);
    if (opening.input) stage.widen(roomOf(*opening.input), queue);
    picker.restart();
}

void prepare(Opening& opening, const vk::Device& device, const Window& window) {
    const vk::KeptKernels kept(device); // shared by the timing runs and the player
    opening.place = std::make_unique<Place>(device, window);
    opening.prepared = std::make_unique<PreparedShow>(device, opening, opening.place->presenter.format());
}

} // namespace sinew::viewer
