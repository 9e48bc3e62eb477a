// Makes one set of layers after another in a thread, then rehearses them, one submission each.
#include "viewer/jobs/layer_loader.hpp"

#include "sinew/vk/check.hpp"

#include <array>
#include <chrono>
#include <utility>

namespace sinew::viewer {

LayerLoader::LayerLoader(const vk::Device& device, PreparedPlayer& player, const Camera& camera,
                         std::uint32_t slots)
    : device_(device), player_(player), camera_(camera), inspection_(device, player.document, slots),
      slots_(slots), isRehearsing_(isSoftware(device)), queue_(device) {}

LayerLoader::~LayerLoader() {
    if (making_.valid()) making_.wait();
    try {
        queue_.waitIdle();
    } catch (const vk::Error&) { // a lost device finishes nothing
    }
}

bool LayerLoader::has(const WantedLayers& watched) const noexcept {
    return inspection_.has(watched) && player_.moving.renderer.has(watched.layers) &&
           (!player_.still || player_.still->renderer.has(watched.layers));
}

WantedLayers LayerLoader::ready(const WantedLayers& wanted) {
    if (!isMaking() && !has(wanted))
        making_ = std::async(std::launch::async, [this, wanted, scene = player_.document.scene()] {
            return make(wanted, scene);
        });
    WantedLayers ready;
    const auto add = [&](auto& part, const auto& asked) {
        const auto before = std::exchange(part, asked);
        if (!has(ready)) part = before;
    };
    add(ready.layers.section, wanted.layers.section);
    for (std::size_t i = 0; i < mostLayers; ++i) add(ready.layers.looks[i], wanted.layers.looks[i]);
    add(ready.isCounting, wanted.isCounting);
    return ready;
}

// Runs in a thread of its own.
LayerLoader::Made LayerLoader::make(const WantedLayers& wanted, const sim::Scene& scene) const {
    const auto unseen = [this](const Renderer& renderer) {
        Image image(device_,
                    {.name = "unseen picture",
                     .extent = {60, 44}, // no powers of two: some drivers treat those differently
                     .format = renderer.format(),
                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
        Canvas canvas = renderer.makeCopiedCanvas(image.extent(), std::array{image.view()});
        return Unseen{std::move(image), std::move(canvas)};
    };
    Made made{.layers = wanted.layers,
              .moving = player_.moving.renderer.make(wanted.layers),
              .still = player_.still ? player_.still->renderer.make(wanted.layers) : Renderer::Additions{},
              .parts = inspection_.make(wanted, scene),
              .ofMoving = {},
              .ofStill = {}};
    if (!isRehearsing_) return made;
    made.ofMoving.emplace(unseen(player_.moving.renderer));
    if (player_.still) made.ofStill.emplace(unseen(player_.still->renderer));
    return made;
}

bool LayerLoader::goOn() {
    const auto isThere = [this] {
        return making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    };
    if (making_.valid() && isThere()) made_.emplace(making_.get());
    if (!made_ || isBusy()) return false;
    const std::size_t all = 1 + made_->moving.count() + made_->still.count();
    const bool isRehearsed = !isRehearsing_ || made_->rehearsed == all;
    if (isRehearsed)
        add();
    else
        rehearseNext();
    return isRehearsed;
}

// Rehearses one pipeline at a time, so that pictures can be drawn in between.
void LayerLoader::rehearseNext() {
    rehearse([this](VkCommandBuffer commands) {
        const std::size_t next = made_->rehearsed++;
        if (next == 0) return made_->parts.recordRehearsal(commands, slots_);
        const bool isOfMoving = next <= made_->moving.count();
        const Renderer::Additions& additions = isOfMoving ? made_->moving : made_->still;
        const Renderer& renderer = isOfMoving ? player_.moving.renderer : player_.still->renderer;
        Canvas& canvas = isOfMoving ? made_->ofMoving->canvas : made_->ofStill->canvas;
        renderer.recordRehearsal(commands, Renderer::slots - 1, canvas, camera_, made_->layers, additions,
                                 next - 1 - (isOfMoving ? 0 : made_->moving.count()));
    });
}

void LayerLoader::add() {
    Made made = *std::exchange(made_, std::nullopt);
    player_.moving.renderer.add(std::move(made.moving));
    if (player_.still) player_.still->renderer.add(std::move(made.still));
    inspection_.add(std::move(made.parts));
}

void LayerLoader::rehearse(const std::function<void(VkCommandBuffer)>& record, std::function<void()> done) {
    const VkCommandBuffer commands = queue_.begin();
    record(commands);
    running_ = queue_.submit(commands);
    done_ = std::move(done);
}

bool LayerLoader::isBusy() {
    if (!running_) return false;
    std::uint64_t finished = 0;
    vk::check(device_.functions().vkGetSemaphoreCounterValue(device_.handle(), queue_.timeline(), &finished),
              "vkGetSemaphoreCounterValue", "the rehearsal");
    if (finished < *running_) return true;
    running_.reset();
    if (const std::function<void()> done = std::exchange(done_, {})) done();
    return running_.has_value();
}

void LayerLoader::forget() {
    if (making_.valid()) making_.wait();
    making_ = {};
    queue_.waitIdle();
    running_.reset();
    done_ = {};
    made_.reset();
    inspection_.restart();
}

} // namespace sinew::viewer
