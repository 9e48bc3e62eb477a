// No picture is on its way while the simulation is replaced.
#include "viewer/player/succession.hpp"

#include "scenes/recovery.hpp"
#include "sinew/vk/queue.hpp"

#include <stdexcept>
#include <utility>

namespace sinew::viewer {

void Succession::beginSurfaceRoom() {
    if (isSurfaceShort_ || player_.document.isGrowing() || player_.document.wantsShape()) return;
    const std::uint32_t needed = std::exchange(surfaceMissing_, 0);
    if (needed > 0 && !player_.document.beginSurfaceRoom(needed)) warnOfSurface();
}

void Succession::takeRoom() {
    if (!player_.document.isGrowing() || parts_.layerLoader.isMaking())
        return; // layers that are being made first
    const Document::Growth growth = player_.document.askGrowth();
    if (growth == Document::Growth::none) warnOfSurface();
    if (growth != Document::Growth::made) return;
    player_.settleAll();
    parts_.layerLoader.forget();
    vk::Queue queue(player_.device);
    player_.document.bringGrowth(queue, player_.tools.bring());
    parts_.layerLoader.rehearse([this](VkCommandBuffer commands) { player_.document.recordGrowth(commands); },
                                [this] { end(); });
}

void Succession::end() {
    player_.document.endGrowth();
    restartParts();
    player_.tools.moveOn();
    if (surfaceMissing_ <= player_.document.settings().cutSurfaceRoom)
        surfaceMissing_ = 0; // otherwise more was cut meanwhile
}

// Once: only the picture lacks something.
void Succession::warnOfSurface() {
    if (std::exchange(isSurfaceShort_, true)) return;
    player_.session.warn(
        "too little memory for the surface of the cuts: a part is not drawn, or drawn uncut");
}

void Succession::takeShape() {
    if (player_.document.wantsShape() && player_.document.isShapeMade()) reshape();
}

void Succession::reshape() {
    player_.settleAll();
    if (!player_.document.wantsShape() || !player_.document.isShapeMade()) return; // steps were undone
    parts_.layerLoader.forget(); // layers of the simulation that goes
    vk::Queue queue(player_.device);
    try {
        player_.document.reshape(queue, player_.tools.bring());
    } catch (const std::invalid_argument& error) {
        parts_.journal.breakOff(); // the log has the shape and the material already
        return parts_.journal.endReplay(error.what());
    }
    restartParts();
    player_.tools.reshaped();
    parts_.times.restart();
    Gauges gauges(player_.document, player_.opening.loaded.scene.dt);
    gauges.goOn(parts_.gauges);
    parts_.gauges = std::move(gauges);
    parts_.adjustments.reshaped();
    const scenes::LoadedScene& loaded = player_.opening.loaded;
    for (const std::string& warning : scenes::newWarnings(loaded, player_.document.settings()))
        player_.session.warn(warning);
    for (const std::string& note : scenes::recoveryLeftOut(loaded, player_.document.settings()))
        player_.session.note(note);
}

void Succession::restartParts() {
    parts_.observer.restart();
    parts_.layers.restart();
    player_.redraw();
}

} // namespace sinew::viewer
