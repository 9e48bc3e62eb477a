// A preloaded scene player on a device of its own. The thread that opens a scene makes it while another scene
// is on show; the two share nothing, and the window waits for nothing.
#pragma once

#include "viewer/document/document.hpp"
#include "viewer/input/picker.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/render/canvas.hpp"
#include "viewer/render/picture_budget.hpp"
#include "viewer/render/renderer.hpp"
#include "viewer/ui/facts.hpp"
#include "viewer/ui/panel_painter.hpp"
#include "viewer/ui/presenter.hpp"

#include <optional>

namespace sinew::viewer {

/// Presenter and panel painter of a device, without a swapchain until Session makes one. Must not outlive its
/// Device.
struct WindowOutput {
    WindowOutput(const vk::Device& device, const Window& window);
    Presenter presenter;
    PanelPainter painter;
};

/// Renderer of one quality and its canvases for the swapchain's images.
struct View {
    View(const vk::Device& device, VkFormat format, const Quality& quality, const SceneLight& light);
    void dropCanvases();
    Renderer renderer;
    /// By PictureBudget::scale(), only index 0 unless quality has mayEnlarge; made at the first use.
    std::array<std::optional<Canvas>, PictureBudget::scales.size()> canvases;
    std::optional<Halves> halves; ///< of the same pictures; made at the first use
};

/// Must not outlive opening and device, which must not move.
struct PreparedPlayer {
    /// Throws std::invalid_argument and vk::Error like sim::Simulation, and like Document::load. `format` is
    /// that of the window's pictures.
    PreparedPlayer(const vk::Device& device, const OpenedScene& opening, VkFormat format);

    Document document; ///< to be reset before its first step, unless it starts from a state
    Picker picker;
    SceneFacts facts;
    View moving;
    std::optional<View> still; ///< set if `moving` has less than full quality
};

/// Makes the place and the player of an opening. Any thread. Throws like their constructors.
void prepare(OpenedScene& opening, const vk::Device& device, const Window& window);
/// Makes only the player, for a place with this format.
void prepare(OpenedScene& opening, const vk::Device& device, VkFormat format);

} // namespace sinew::viewer
