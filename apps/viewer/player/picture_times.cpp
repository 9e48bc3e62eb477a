// Two spans of drawing a slot, and a span for each phase of a step.
#include "viewer/player/picture_times.hpp"

#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <numeric>
#include <utility>

namespace sinew::viewer {

// Pipelines of the first scene were made before there was a window.
PictureTimes::PictureTimes(const PlayerContext& player)
    : player_(player), pipelines_(player.device.kernels().pipelinesMade()) {
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot)
        slots_.push_back({stepTimes(), vk::Timestamps(player.device, 2)});
}

vk::Timestamps PictureTimes::stepTimes() const {
    return {player_.device, static_cast<std::uint32_t>(player_.document.simulation().phases().size())};
}

void PictureTimes::restart() {
    for (Slot& slot : slots_) slot.step = stepTimes();
}

void PictureTimes::begin(const Presenter::Frame& frame, Part part) {
    Slot& slot = slots_[frame.slot];
    if (part == Part::drawing) slot.hasDrawing = player_.session.timing().isOn();
    if (!slot.hasDrawing) return;
    vk::Commands commands(player_.device, frame.commands);
    if (part == Part::drawing) slot.drawing.reset(commands);
    slot.drawing.begin(commands, static_cast<std::uint32_t>(part));
}

void PictureTimes::end(const Presenter::Frame& frame, Part part) {
    Slot& slot = slots_[frame.slot];
    vk::Commands commands(player_.device, frame.commands);
    if (slot.hasDrawing) slot.drawing.end(commands, static_cast<std::uint32_t>(part));
}

// Pictures that wait for one in which something was cut count as such, too.
void PictureTimes::submitted(const Presenter::Frame& frame, bool isCutting) {
    if (isCutting) cutFrames_ = Presenter::framesInFlight + 1;
    player_.session.timing().pictureSubmitted(frame.slot, cutFrames_ > 0);
    if (cutFrames_ > 0) --cutFrames_;
    onTheirWay(); // some are there when they have been presented
    if (!player_.session.timing().awaitsPicture()) return;
    player_.session.presenter().waitIdle();
    countPipelines();
    player_.session.timing().firstPicture();
}

std::vector<double> PictureTimes::settle(std::uint32_t index, bool hasSteps) {
    Slot& slot = slots_[index];
    Timing& timing = player_.session.timing();
    timing.pictureFinished(index);
    std::vector<double> phases;
    if (hasSteps) phases = slot.step.milliseconds();
    if (!phases.empty())
        timing.times().add(FrameTimes::Kind::step, std::accumulate(phases.begin(), phases.end(), 0.0));
    if (!std::exchange(slot.hasDrawing, false)) return phases;
    const std::vector<double> drawing = slot.drawing.milliseconds();
    if (drawing.size() < 2) return phases; // the device has no clock for it
    timing.times().add(FrameTimes::Kind::drawing, drawing[0]);
    timing.times().add(FrameTimes::Kind::panels, drawing[1]);
    return phases;
}

std::size_t PictureTimes::onTheirWay() {
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < slots_.size(); ++slot)
        if (player_.session.presenter().isFinished(slot))
            player_.session.timing().pictureFinished(slot);
        else
            ++count;
    return count;
}

void PictureTimes::countPipelines() {
    const std::size_t made = player_.device.kernels().pipelinesMade();
    player_.session.timing().times().addPipelines(made - std::exchange(pipelines_, made));
}

} // namespace sinew::viewer
