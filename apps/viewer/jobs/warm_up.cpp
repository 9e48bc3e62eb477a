// Takes a step and a cut through the middle, and draws pictures of every size.
#include "viewer/jobs/warm_up.hpp"

#include "sinew/vk/queue.hpp"
#include "viewer/render/image.hpp"

#include <algorithm>
#include <array>

namespace sinew::viewer {

namespace {

// An upright blade through the whole box.
struct Through {
    explicit Through(const Box& box) {
        const Vector3 middle = box.center(), half = box.sizes();
        for (std::size_t n = 0; n < 2; ++n) {
            const float z = middle.z() + (n == 0 ? half.z() : -half.z());
            from[n] = {middle.x(), middle.y() + half.y(), z};
            to[n] = {middle.x(), middle.y() - half.y(), z};
        }
    }
    std::array<sim::Vec3, 2> from, to;
};

Box boxOf(const sim::Scene& scene) {
    Box box;
    for (const sim::Particle& particle : scene.particles)
        box.extend(Vector3(particle.position.x, particle.position.y, particle.position.z));
    return box;
}

void draw(const vk::Device& device, vk::Queue& queue, View& view, VkFormat format, float scale,
          const Camera& camera, const Document& document) {
    const Image image(device, {.name = "unseen picture",
                               .extent = {64, 64},
                               .format = format,
                               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT});
    Canvas canvas = view.renderer.makeCanvas(image.extent(), std::array{image.view()}, scale);
    const std::array<Vector3, 2> stroke{camera.target, camera.target + Vector3::UnitY()};
    Overlay overlay{.stroke = stroke};
    if (!document.scene().particles.empty()) overlay.hand = Hand{.target = camera.target};
    const VkCommandBuffer commands = queue.begin();
    view.renderer.record(commands, 0, canvas, 0, camera, document.simulation(), overlay);
    queue.wait(queue.submit(commands));
}

} // namespace

void warmUp(const vk::Device& device, PreparedPlayer& player, VkFormat format, const Camera& camera) {
    vk::Queue queue(device);
    const Through blade(boxOf(player.document.scene()));
    VkCommandBuffer commands = queue.begin();
    player.document.recordReset(commands);
    const bool canCut = std::ranges::any_of(player.document.scene().grids, &sim::Grid::isCuttable);
    player.document.recordStep(commands, nullptr, {},
                               canCut ? sim::Blade{blade.from, blade.to} : sim::Blade{});
    player.document.recordSkin(commands);
    player.picker.record(commands, 0, {Picker::Cast{{Vector3::Zero(), -Vector3::UnitY()}}}, Section{});
    queue.wait(queue.submit(commands));
    for (const float scale : PictureBudget::scales)
        draw(device, queue, player.moving, format, scale, camera, player.document);
    if (player.still) draw(device, queue, *player.still, format, 1, camera, player.document);
    commands = queue.begin();
    player.document.recordReset(commands);
    queue.wait(queue.submit(commands));
}

} // namespace sinew::viewer
