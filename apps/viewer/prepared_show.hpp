// All of a show that takes its time to make, on a device of its own: made in the thread that opens the scene
// while another one is on show, so that nothing waits for it and the two share nothing.
#pragma once

#include "viewer/draw/canvas.hpp"
#include "viewer/draw/renderer.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/picture_budget.hpp"
#include "viewer/opening.hpp"
#include "viewer/panels/facts.hpp"
#include "viewer/panels/panel_painter.hpp"
#include "viewer/window/presenter.hpp"

#include <optional>

namespace sinew::viewer {

/// How a device reaches the window: without a swapchain until Screen makes one. Must not outlive its Device.
struct Place {
    Place(const vk::Device& device, const Window& window);
    Presenter presenter;
    PanelPainter painter;
};

/// Drawing of one quality into the swapchain's images.
struct View {
    View(const vk::Device& device, VkFormat format, const Quality& quality, const StageLight& light);
    void dropCanvases();
    Renderer renderer;
    /// By PictureBudget::scale(), of which there is 0 alone where quality has no mayEnlarge; made when they
    /// are first needed.
    std::array<std::optional<Canvas>, PictureBudget::scales.size()> canvases;
    std::optional<Halves> halves; ///< of the same pictures, likewise
};

/// Must not outlive opening and device, which must not move.
struct PreparedShow {
    /// Throws std::invalid_argument and vk::Error, as sim::Simulation, and as Stage::load. `format` of the
    /// window's pictures.
    PreparedShow(const vk::Device& device, const Opening& opening, VkFormat format);

    Stage stage; ///< to be reset before its first step, unless it goes on from a state
    SceneFacts facts;
    View moving;
    std::optional<View> still; ///< where `moving` has less than full quality
};

/// Gives an opening its place and its show. Any thread. Throws as they do.
void prepare(Opening& opening, const vk::Device& device, const Window& window);

} // namespace sinew::viewer
