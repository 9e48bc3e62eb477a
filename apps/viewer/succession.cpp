// No picture is on its way while the simulation is replaced.
#include "viewer/succession.hpp"

#include "scenes/recovery.hpp"
#include "sinew/vk/queue.hpp"

#include <stdexcept>
#include <utility>

namespace sinew::viewer {

void Succession::beginSurfaceRoom() {
    if (isSurfaceShort_ || show_.stage.isGrowing() || show_.stage.wantsShape()) return;
    const std::uint32_t needed = std::exchange(surfaceMissing_, 0);
    if (needed > 0 && !show_.stage.beginSurfaceRoom(needed)) warnOfSurface();
}

void Succession::takeRoom() {
    if (!show_.stage.isGrowing() || parts_.backstage.isMaking()) return; // layers that are being made first
    const Stage::Growth growth = show_.stage.askGrowth();
    if (growth == Stage::Growth::none) warnOfSurface();
    if (growth != Stage::Growth::made) return;
    show_.settleAll();
    parts_.backstage.forget();
    vk::Queue queue(show_.device);
    show_.stage.bringGrowth(queue, show_.tools.bring());
    parts_.backstage.rehearse([this](VkCommandBuffer commands) { show_.stage.recordGrowth(commands); },
                              [this] { end(); });
}

void Succession::end() {
    show_.stage.endGrowth();
    restartParts();
    show_.tools.moveOn();
    if (surfaceMissing_ <= show_.stage.settings().cutSurfaceRoom)
        surfaceMissing_ = 0; // otherwise more was cut meanwhile
}

// Once: only the picture lacks something.
void Succession::warnOfSurface() {
    if (std::exchange(isSurfaceShort_, true)) return;
    show_.screen.warn("too little memory for the surface of the cuts: a part is not drawn, or drawn uncut");
}

void Succession::takeShape() {
    if (show_.stage.wantsShape() && show_.stage.isShapeMade()) reshape();
}

void Succession::reshape() {
    show_.settleAll();
    if (!show_.stage.wantsShape() || !show_.stage.isShapeMade()) return; // steps were undone
    parts_.backstage.forget();                                           // layers of the simulation that goes
    vk::Queue queue(show_.device);
    try {
        show_.stage.reshape(queue, show_.tools.bring());
    } catch (const std::invalid_argument& error) {
        parts_.journal.breakOff(); // the log has the shape and the material already
        return parts_.journal.endReplay(error.what());
    }
    restartParts();
    show_.tools.reshaped();
    parts_.times.restart();
    Gauges gauges(show_.stage, show_.opening.loaded.scene.dt);
    gauges.goOn(parts_.gauges);
    parts_.gauges = std::move(gauges);
    parts_.adjustments.reshaped();
    const scenes::LoadedScene& loaded = show_.opening.loaded;
    for (const std::string& warning : scenes::newWarnings(loaded, show_.stage.settings()))
        show_.screen.warn(warning);
    for (const std::string& note : scenes::recoveryLeftOut(loaded, show_.stage.settings()))
        show_.screen.note(note);
}

void Succession::restartParts() {
    parts_.observer.restart();
    parts_.layers.restart();
    show_.redraw();
}

} // namespace sinew::viewer
