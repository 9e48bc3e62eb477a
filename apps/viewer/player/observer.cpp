// One probe of positions, one of pieces.
#include "viewer/player/observer.hpp"

#include "viewer/input/pick.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr double strainEvery = 0.25; // [s]: a copy of all positions
constexpr double countEvery = 0.25;  // [s]: a copy of all triangles, while something is being cut

} // namespace

Observer::Observer(const PlayerContext& player, const LayerView& layers, const Comparison& comparison,
                   Gauges& gauges)
    : player_(player), layers_(layers), comparison_(comparison), gauges_(gauges),
      probe_(std::in_place, player.device, player.document.scene(), player.document.settings(),
             player.document.simulation()),
      pieceProbe_(player.device, player.document),
      inspector_(player.document, player.opening.loaded.holds, Presenter::framesInFlight) {
    if (player.opening.isFirstView && !player.opening.input) framing_ = Framing{player.opening.camera};
}

void Observer::frame(const Box& box) {
    const float aspect = comparison_.pictureAspect();
    Camera& camera = player_.controller.camera;
    camera = framing(camera, box, aspect);
    framing_ = Framing{camera, box, aspect};
}

void Observer::keepFraming() {
    const float aspect = comparison_.pictureAspect();
    Camera& camera = player_.controller.camera;
    if (!framing_ || framing_->camera != camera || framing_->aspect == aspect) return;
    camera =
        framing_->box ? framing(camera, *framing_->box, aspect) : firstView(player_.opening.loaded, aspect);
    framing_->camera = camera;
    framing_->aspect = aspect;
    player_.redraw();
}

Camera Observer::seenBesidePanels() const {
    Camera camera = player_.controller.camera;
    camera.shift = comparison_.shift();
    return camera;
}

void Observer::lookAt(Target target) {
    wantsLook_ = Look{target, pointerRay()};
}

bool Observer::take(Input& input) {
    return input.pointer != std::exchange(pointer_, input.pointer);
}

void Observer::takePress(Input& input) {
    const auto isPress = [](const Input::Press& press) {
        return press.isDown && press.action == Action::grab;
    };
    if (armed_ && std::erase_if(input.presses, isPress) > 0) lookAt(*std::exchange(armed_, std::nullopt));
}

// Updates the counts of pieces; pieces with a surface are counted some pictures later, in a copy.
void Observer::stepFinished(const sim::Status& status) {
    wantsCount_ = status.linksCutInAll > 0 && (wantsCount_ || status.linksCutInAll != linksCut_);
    linksCut_ = status.linksCutInAll;
    allPieces_ = status.pieces;
    gauges_.stepFinished(status);
}

bool Observer::isStrainDue(std::uint32_t steps) {
    const auto now = Clock::now();
    const bool isDue = steps > 0 && player_.session.panels().isShown(player_.session.presenter().extent()) &&
                       now - lastStrain_ >= std::chrono::duration<double>(strainEvery);
    if (isDue) lastStrain_ = now;
    return isDue;
}

// True if something was cut since the last count and the time between counts has passed.
bool Observer::isCountDue() {
    const auto now = Clock::now();
    if (!wantsCount_ || now - lastCount_ < std::chrono::duration<double>(countEvery)) return false;
    wantsCount_ = false;
    lastCount_ = now;
    return true;
}

void Observer::ask(std::uint32_t slot, std::uint32_t steps, bool asksTools) {
    if (std::ranges::any_of(pending_, &Pending::isAny)) return;
    Pending& asked = pending_[slot];
    asked.isBounded = std::exchange(wantsBounds_, false);
    asked.look = std::exchange(wantsLook_, std::nullopt);
    if (asksTools) asked.question = player_.tools.question();
    asked.isMeasured = isStrainDue(steps);
    asked.isInspected = inspector_.isDue(pointerRay());
    asked.isCounted = isCountDue();
}

Ray Observer::pointerRay() const {
    return rayThrough(player_.controller.camera, pointer_);
}

void Observer::record(const Presenter::Frame& frame) {
    const Pending& asked = pending_[frame.slot];
    if (asked.needsCopy()) probe_->record(frame.commands);
    if (asked.isCounted) pieceProbe_.record(frame.commands);
    if (asked.isInspected) {
        probe_->recordVelocities(frame.commands);
        inspector_.record(frame.commands, frame.slot, pointerRay(), layers_.counter());
    }
    if (!asked.hasRay()) return;
    Picker::Casts casts;
    if (asked.question) casts[ofTools] = {asked.question->ray, asked.question->among};
    if (asked.look) casts[ofLook] = {asked.look->ray, Among::all};
    if (asked.isInspected) casts[ofInspector] = {pointerRay(), Among::all};
    player_.prepared.picker.record(frame.commands, frame.slot, casts, layers_.section());
}

void Observer::answer(const Question& question, const std::optional<Pick>& found) {
    player_.tools.answer(question, found, found ? holdRadius(player_.document.scene(), found->particle) : 0);
}

// settleCount() takes the rest.
void Observer::settle(std::uint32_t slot) {
    const Pending asked = std::exchange(pending_[slot], {.isCounted = pending_[slot].isCounted});
    const Picker& picker = player_.prepared.picker;
    if (asked.question && asked.question == player_.tools.question())
        answer(*asked.question, picker.answer(slot, ofTools));
    if (asked.isMeasured) gauges_.strainMeasured(measureStrain(player_.document.scene(), *probe_));
    if (asked.look) settleLook(*asked.look, picker.answer(slot, ofLook));
    if (const Box bounds = asked.isBounded ? probe_->bounds() : Box(); !bounds.isEmpty()) {
        frame(bounds);
        player_.redraw(); // what is on screen was seen from elsewhere
    }
    if (asked.isInspected)
        inspector_.settle(slot, picker.answer(slot, ofInspector), *probe_, layers_.counter());
}

// A look that misses all bodies frames the scene and keeps the target of the orbit.
void Observer::settleLook(const Look& look, const std::optional<Pick>& found) {
    Camera& camera = player_.controller.camera;
    if (look.at == Target::point) {
        if (found) camera = centered(camera, found->point);
    } else {
        const Box box =
            found ? probe_->bounds(bodyOf(player_.document.scene(), found->particle)) : probe_->bounds();
        if (!box.isEmpty()) frame(box);
    }
    player_.redraw();
}

bool Observer::settleCount(std::uint32_t slot, bool isUndone) {
    const bool isCounted = std::exchange(pending_[slot].isCounted, false);
    if (!isCounted || isUndone || linksCut_ == 0) return false; // 0: the state is an earlier one
    gauges_.piecesCounted(pieceProbe_.count(allPieces_));
    return true;
}

void Observer::restart() {
    const Document& document = player_.document;
    probe_.emplace(player_.device, document.scene(), document.settings(), document.simulation());
    player_.prepared.picker.restart();
    pieceProbe_.restart();
    wantsCount_ = linksCut_ > 0; // a count that was asked for gets no answer
    inspector_.restart();
}

void Observer::takeOver(const Observer& before) {
    pointer_ = before.pointer_;
    framing_ = before.framing_;
    if (before.inspector_.isOn()) inspector_.toggle();
    linksCut_ = before.linksCut_;
    allPieces_ = before.allPieces_;
}

void Observer::addTo(Facts& facts) const {
    facts.isInspecting = inspector_.isOn();
    facts.found = inspector_.found();
    if (armed_)
        facts.hint.awaited =
            *armed_ == Target::body ? "click a body to frame it" : "click a body to orbit around that point";
}

} // namespace sinew::viewer
