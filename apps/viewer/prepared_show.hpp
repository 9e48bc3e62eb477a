// A preloaded scene player on a device of its own. The thread that opens a scene makes it while another scene
// is on show; the two share nothing, and the window waits for nothing.
#pragma once

#include "viewer/draw/canvas.hpp"
#include "viewer/draw/renderer.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/picker.hpp"
#include "viewer/hands/picture_budget.hpp"
#include "viewer/opening.hpp"
#include "viewer/panels/facts.hpp"
#include "viewer/panels/panel_painter.hpp"
#include "viewer/window/presenter.hpp"

#include <optional>

namespace sinew::viewer {

/// Presenter and panel painter of a device, without a swapchain until Screen makes one. Must not outlive its
/// Device.
struct Place {
    Place(const vk::Device& device, const Window& window);
    Presenter presenter;
    PanelPainter painter;
};

/// Renderer of one quality and its canvases for the swapchain's images.
struct View {
    View(const vk::Device& device, VkFormat format, const Quality& quality, const StageLight& light);
    void dropCanvases();
    Renderer renderer;
    /// By PictureBudget::scale(), only index 0 unless quality has mayEnlarge; made at the first use.
    std::array<std::optional<Canvas>, PictureBudget::scales.size()> canvases;
    std::optional<Halves> halves; ///< of the same pictures; made at the first use
};

/// Must not outlive opening and device, which must not move.
struct PreparedShow {
    /// Throws std::invalid_argument and vk::Error like sim::Simulation, and like Stage::load. `format` is
    /// that of the window's pictures.
    PreparedShow(const vk::Device& device, const Opening& opening, VkFormat format);

    Stage stage; ///< to be reset before its first step, unless it starts from a state
    Picker picker;
    SceneFacts facts;
    View moving;
    std::optional<View> still; ///< set if `moving` has less than full quality
};

/// Makes the place and the player of an opening. Any thread. Throws like their constructors.
void prepare(Opening& opening, const vk::Device& device, const Window& window);

} // namespace sinew::viewer
