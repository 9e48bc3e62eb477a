// A shot a slot of the window.
#include "viewer/player/capture.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sinew/vk/check.hpp"
#include "viewer/render/legend.hpp"

#include <utility>

namespace sinew::viewer {

Renderer& Capture::renderer() {
    PreparedPlayer& prepared = player_.prepared;
    return prepared.still ? prepared.still->renderer : prepared.moving.renderer;
}

void Capture::recordPicture(const Presenter::Frame& frame, const Overlay& overlay) {
    if (!std::exchange(wantsPicture_, false)) return;
    Pending& pending = pending_[frame.slot];
    try {
        pending.picture =
            std::make_unique<Shot>(player_.device, renderer(), player_.session.presenter().extent());
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        return player_.session.warn(std::string("no picture: ") + error.what());
    }
    pending.pictureStep = player_.document.played();
    recordShot(*pending.picture, frame.commands, frame.slot + 2 * Presenter::framesInFlight, overlay);
}

void Capture::recordFilm(const Presenter::Frame& frame, const Overlay& overlay) {
    recordShot(*cameras_[frame.slot], frame.commands, frame.slot + Presenter::framesInFlight, overlay);
    pending_[frame.slot].filmStep = player_.document.played();
}

// With the simulation beside it, as the window shows both.
void Capture::recordShot(Shot& shot, VkCommandBuffer commands, std::uint32_t slot, const Overlay& overlay) {
    const Camera& camera = player_.controller.camera;
    const sim::Simulation& simulation = player_.document.simulation();
    const sim::Simulation* beside = comparison_.simulation();
    if (!beside) return shot.record(commands, slot, camera, simulation, overlay);
    const Overlay other = overlayBeside(overlay);
    shot.recordHalves(commands, {slot, slot + 3 * Presenter::framesInFlight}, camera,
                      {{{simulation, overlay}, {*beside, other}}});
}

void Capture::settle(std::uint32_t slot, bool isUndone) {
    const Pending pending = std::exchange(pending_[slot], {});
    if (pending.filmStep && !isUndone) addToFilm(slot, *pending.filmStep);
    if (!pending.picture) return;
    reportFiles(PictureWriter::Wait::yes); // the one before must be there: its name is taken only then
    writer_.add(freeName(nameAt(player_.opening.loaded.scene.name, pending.pictureStep), ".png"),
                pending.picture->read(), pictureText(player_.opening, player_.device, pending.pictureStep));
}

void Capture::keepAll() {
    if (film_) player_.session.presenter().waitIdle();
    for (std::uint32_t slot = 0; slot < Presenter::framesInFlight; ++slot)
        if (const auto step = std::exchange(pending_[slot].filmStep, std::nullopt)) addToFilm(slot, *step);
}

void Capture::leaveOut() noexcept {
    for (Pending& pending : pending_) pending.filmStep.reset();
}

void Capture::beginFilm() {
    const VkExtent2D extent = player_.session.presenter().extent();
    player_.session.presenter().waitIdle(); // frames may still use the cameras of a film that failed
    try {
        film_.emplace(nameAt(player_.opening.loaded.scene.name, player_.document.played()), extent.width,
                      extent.height, 1 / double{player_.document.scene().dt});
        for (auto& camera : cameras_) camera = std::make_unique<Shot>(player_.device, renderer(), extent);
        printLine("recording " + film_->target().string());
        const std::string slow = isSoftware(player_.device) ? " " + std::string(slowRecording) : "";
        player_.session.tell("Recording " + film_->target().string() + ". " +
                             std::string(keyOf(Action::record)) + " stops." + slow);
    } catch (const std::runtime_error& error) { // app::Failure; vk::Error: no memory for the pictures
        fail(error);
    }
}

std::optional<double> Capture::filmSeconds() const {
    if (!film_) return std::nullopt;
    return static_cast<double>(film_->count()) * double{player_.document.scene().dt};
}

void Capture::endFilm() {
    if (!film_) return;
    try {
        film_->finish();
        const std::string text = countText(film_->count(), "picture") + " in " + film_->target().string();
        printLine(text);
        player_.session.tell(text);
        film_.reset();
    } catch (const std::runtime_error& error) { // app::Failure, mesh::ExportError
        fail(error);
    }
}

void Capture::freeCameras() noexcept {
    for (auto& camera : cameras_) camera.reset();
}

void Capture::addToFilm(std::uint32_t slot, std::uint64_t step) {
    if (!film_) return;
    try {
        film_->add(cameras_[slot]->read(), pictureText(player_.opening, player_.device, step));
    } catch (const vk::Error&) {
        throw;
    } catch (const std::runtime_error& error) { // app::Failure, mesh::ExportError
        leaveOut();
        fail(error);
    }
}

void Capture::fail(const std::exception& error) {
    film_.reset();
    player_.session.warn(error.what());
}

void Capture::reportFiles(PictureWriter::Wait wait) {
    try {
        while (const auto file = writer_.take(wait)) {
            printLine("picture: " + file->string());
            player_.session.tell("picture: " + file->string());
        }
    } catch (const mesh::ExportError& error) { // no reason to close the window
        player_.session.warn(error.what());
    }
}

} // namespace sinew::viewer
