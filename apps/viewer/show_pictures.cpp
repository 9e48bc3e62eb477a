// Picture files and films of the scene on show, and the messages about them.
#include "viewer/show.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "vk/check.hpp"

#include <cinttypes>
#include <cstdio>

namespace sinew::viewer {

// File name such as "organ-000120".
std::string Show::nameAt(std::uint64_t step) const {
    char stem[40];
    std::snprintf(stem, sizeof stem, "-%06" PRIu64, step);
    return opening_.loaded.scene.name + stem;
}

// The renderer of full quality, already compiled: files look like the still window.
Renderer& Show::wholeQuality() {
    return prepared_.still ? prepared_.still->renderer : prepared_.moving.renderer;
}

void Show::recordScreenshot(const Presenter::Frame& frame, const Overlay& overlay) {
    InFlight& flight = inFlight_[frame.slot];
    try {
        flight.screenshot = std::make_unique<Shot>(device_, wholeQuality(), screen_.presenter().extent());
    } catch (const vk::Error& error) {
        if (error.failure() != vk::Failure::outOfMemory) throw;
        return screen_.warn(std::string("no picture: ") + error.what());
    }
    flight.screenshotStep = stage_.steps();
    recordShot(*flight.screenshot, frame.commands, frame.slot + 2 * Presenter::framesInFlight, overlay);
}

// Includes the second simulation, like the window.
void Show::recordShot(Shot& shot, VkCommandBuffer commands, std::uint32_t slot, const Overlay& overlay) {
    if (!beside_) return shot.record(commands, slot, controller_.camera, stage_.simulation(), overlay);
    const Overlay other = overlayBeside(overlay);
    shot.recordHalves(commands, {slot, slot + 3 * Presenter::framesInFlight}, controller_.camera,
                      {{{stage_.simulation(), overlay}, {beside_->simulation(), other}}});
}

// Waits for the earlier file, since a free name needs it.
void Show::settleScreenshot(const InFlight& flight) {
    reportFiles(PictureWriter::Wait::yes);
    writer_.add(freeName(nameAt(flight.screenshotStep), ".png"), flight.screenshot->read(),
                pictureText(opening_, device_, flight.screenshotStep));
}

void Show::toggleRecording() {
    if (recording_) return stopRecording();
    const VkExtent2D extent = screen_.presenter().extent();
    screen_.presenter().waitIdle(); // frames may still use the images of a film that failed
    try {
        recording_.emplace(nameAt(stage_.steps()), extent.width, extent.height,
                           1 / double{stage_.scene().dt});
        for (auto& camera : cameras_) camera = std::make_unique<Shot>(device_, wholeQuality(), extent);
        std::printf("recording %s\n", recording_->target().c_str());
        std::fflush(stdout);
        screen_.tell("recording " + recording_->target().string() + ", a picture a step; " +
                     std::string(keyOf(Action::record)) + " stops");
    } catch (const std::runtime_error& error) { // app::Failure; vk::Error: no memory for the pictures
        recording_.reset();
        screen_.warn(error.what());
    }
}

void Show::stopRecording() {
    if (!recording_) return;
    settleAll(); // the last pictures
    finishFilm();
    for (auto& camera : cameras_) camera.reset();
}

void Show::finishFilm() {
    if (!recording_) return;
    try {
        recording_->finish();
        const std::string text =
            std::to_string(recording_->count()) + " pictures in " + recording_->target().string();
        std::printf("%s\n", text.c_str());
        std::fflush(stdout);
        screen_.tell(text);
    } catch (const std::runtime_error& error) { // app::Failure, mesh::ExportError
        screen_.warn(error.what());
    }
    recording_.reset();
}

void Show::recordCamera(const Presenter::Frame& frame, const Overlay& overlay) {
    recordShot(*cameras_[frame.slot], frame.commands, frame.slot + Presenter::framesInFlight, overlay);
    inFlight_[frame.slot].isRecorded = true;
}

// An error ends only the film.
void Show::settleCamera(std::uint32_t slot, const InFlight& flight) {
    if (!recording_) return;
    try {
        const std::uint64_t step = flight.firstStep + flight.steps - 1;
        recording_->add(cameras_[slot]->read(), pictureText(opening_, device_, step));
    } catch (const vk::Error&) {
        throw;
    } catch (const std::runtime_error& error) { // app::Failure, mesh::ExportError
        recording_.reset();
        for (InFlight& other : inFlight_) other.isRecorded = false;
        screen_.warn(error.what());
    }
}

// An error of a picture file does not end the program.
void Show::reportFiles(PictureWriter::Wait wait) {
    try {
        while (const auto file = writer_.take(wait)) {
            std::printf("picture: %s\n", file->c_str());
            std::fflush(stdout);
            screen_.tell("picture: " + file->string());
        }
    } catch (const mesh::ExportError& error) {
        screen_.warn(error.what());
    }
}

} // namespace sinew::viewer
