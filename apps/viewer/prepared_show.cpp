// Simulation, pipelines and maps.
#include "viewer/prepared_show.hpp"

#include "sim/gpu_tune.hpp"
#include "sim/ranges.hpp"
#include "viewer/gauges.hpp"
#include "vk/queue.hpp"

namespace sinew::viewer {

namespace {

// With hands for the pointer and its pins: those that hold nothing cost nothing.
sim::Settings fastest(const vk::Device& device, const scenes::LoadedScene& loaded) {
    vk::Queue queue(device);
    sim::Settings settings = loaded.settings;
    settings.grabs = sim::ranges::mostGrabs;
    return sim::tuned(device, queue, loaded.scene, settings);
}

} // namespace

Place::Place(const vk::Device& device, const Window& window)
    : presenter(device, window),
      painter(device, presenter.format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, Presenter::framesInFlight) {}

View::View(const vk::Device& device, VkFormat format, const Quality& quality, const StageLight& light)
    : renderer(device, {.color = format, .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}, quality, light) {}

PreparedShow::PreparedShow(const vk::Device& device, const Opening& opening, VkFormat format)
    : stage(device, opening.loaded.scene, fastest(device, opening.loaded)),
      facts(sceneFacts(opening, stage, device)),
      moving(device, format, isSoftware(device) ? reducedQuality() : Quality{}, opening.light) {
    stage.setBlades({opening.loaded.blades, opening.loaded.scene.dt});
    if (isSoftware(device)) still.emplace(device, format, Quality{}, opening.light);
}

void prepare(Opening& opening, const vk::Device& device, const Window& window) {
    opening.place = std::make_unique<Place>(device, window);
    opening.prepared = std::make_unique<PreparedShow>(device, opening, opening.place->presenter.format());
}

} // namespace sinew::viewer
