// A thread that waits for wanted previews.
#include "viewer/jobs/previews.hpp"

#include "sinew/vk/queue.hpp"
#include "viewer/document/document.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/render/offscreen.hpp"
#include "viewer/ui/picture_sheet.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <exception>

namespace sinew::viewer {

namespace {

constexpr int patience = 10; // nice value: the player has priority

// Lowers the priority of the calling thread and of its future threads. Failure is harmless.
void giveWay() {
    (void)setpriority(PRIO_PROCESS, 0, patience);
}

} // namespace

// Checks for a stop between stages, each of which takes about a second on a software device.
std::optional<Picture> drawPreview(const vk::Device& device, const Options& options,
                                   const std::stop_token& stop) {
    constexpr VkExtent2D extent = PictureSheet::extent;
    const OpenedScene opening =
        look(options, static_cast<float>(extent.width) / static_cast<float>(extent.height));
    if (stop.stop_requested()) return std::nullopt;
    Document document(device, opening.loaded.scene, opening.loaded.settings);
    if (stop.stop_requested()) return std::nullopt;
    Offscreen offscreen(device, extent, opening.light);
    if (stop.stop_requested()) return std::nullopt;
    vk::Queue queue(device);
    const VkCommandBuffer commands = queue.begin();
    document.recordReset(commands);
    document.recordSkin(commands);
    offscreen.record(commands, opening.camera, document.simulation());
    queue.wait(queue.submit(commands));
    return offscreen.read();
}

Previews::Previews(Draw draw) : draw_(std::move(draw)) {}

Previews::~Previews() = default;

void Previews::want(std::vector<std::size_t> scenes) {
    const std::lock_guard lock(mutex_);
    std::erase_if(scenes, [this](std::size_t one) { return std::ranges::count(begun_, one) > 0; });
    wanted_ = std::move(scenes);
    if (wanted_.empty()) return;
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    isWanted_.notify_one();
}

std::optional<std::pair<std::size_t, Picture>> Previews::take() {
    const std::lock_guard lock(mutex_);
    if (made_.empty()) return std::nullopt;
    auto first = std::move(made_.front());
    made_.erase(made_.begin());
    return first;
}

void Previews::work(const std::stop_token& stop) {
    giveWay();
    std::unique_lock lock(mutex_);
    while (isWanted_.wait(lock, stop, [this] { return !wanted_.empty(); }) && !stop.stop_requested()) {
        const std::size_t scene = wanted_.front();
        wanted_.erase(wanted_.begin());
        begun_.push_back(scene);
        lock.unlock();
        std::optional<Picture> picture;
        try {
            picture = draw_(scene, stop);
        } catch (const std::exception&) { // opening the scene reports the error
        }
        lock.lock();
        if (picture) made_.emplace_back(scene, std::move(*picture));
    }
}

} // namespace sinew::viewer
