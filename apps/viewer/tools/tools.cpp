// Several tools for one pointer: the left button belongs to the one in hand.
#include "viewer/tools/tools.hpp"

#include "sinew/vk/check.hpp"
#include "viewer/input/controller.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr const char* lost = "warning: earlier cuts can no longer be undone: their states could not be moved";

} // namespace

Tools::Tools(const vk::Device& device, const ToolContext& of)
    : history_(device, History::mostCuts), steps_(device, History::mostSteps) {
    for (std::size_t i = 0; i < toolTable().size(); ++i) {
        states_.push_back(toolTable()[i]->make(of));
        canUse_[i] = fits(*toolTable()[i], of.scene);
        if (toolTable()[i]->isSettingOptional) logSetting(i);
    }
}

std::size_t Tools::indexInHand() const {
    std::size_t index = 0;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        if (states_[i]->isOn()) return i;
        if (toolTable()[i]->key == 0) index = i;
    }
    return index;
}

void Tools::handle(const Input& input, Controller& controller) {
    look(controller.camera);
    for (const Input::Press& one : input.presses)
        if (one.action == Action::grab) press(controller.camera, one.isDown, one.pointer);
    for (const Input::Drag& drag : input.drags) {
        if (drag.action != Action::grab)
            controller.drag(drag.action, drag.heights);
        else if (const Vector2 turn = inHand().drag(drag.heights); !turn.isZero())
            controller.drag(Action::orbit, turn);
    }
    look(controller.camera);
    if (input.growth != 0) turnWheel(input.growth);
    move(controller.camera, input.pointer);
}

void Tools::turnWheel(float notches) {
    const Tool& tool = recordInHand();
    if (tool.setting.empty()) return;
    inHand().turnWheel(notches);
    logSetting(indexInHand());
    if (tool.settingNote != nullptr) note_ = tool.settingNote(inHand().setting());
}

void Tools::logSetting(std::size_t tool) {
    if (!toolTable()[tool]->setting.empty()) log_.set(tool, states_[tool]->setting());
}

void Tools::move(const Camera& camera, const Vector2& pointer) {
    if (wants_.any() || std::ranges::any_of(states_, [](const auto& one) { return one->followsPointer(); }))
        log_.point(pointer);
    for (const auto& state : states_) state->move(camera, pointer);
    for (std::size_t i = 0; i < states_.size(); ++i) {
        if (!wants_[i]) continue;
        if (states_[i]->use(rayThrough(camera, pointer), inHand().held())) inHand().release();
        takeNoteOf(i);
    }
    wants_.reset();
}

void Tools::takeNoteOf(std::size_t tool) {
    if (std::string note = states_[tool]->takeNote(); !note.empty()) note_ = std::move(note);
}

std::string Tools::name() const {
    if (armed_) return " - " + std::string(toolTable()[*armed_]->title);
    const bool isUsed = inHand().isOn() || isHolding();
    return isUsed ? " - " + std::string(recordInHand().title) : "";
}

std::array<bool, mostTools> Tools::shownOn() const {
    std::array<bool, mostTools> shown{};
    for (std::size_t i = 0; i < states_.size(); ++i) shown[i] = states_[i]->isShownOn();
    if (armed_) shown[*armed_] = true;
    return shown;
}

HintFacts Tools::hintFacts() const {
    HintFacts facts{.canUse = canUse_, .canUndo = history_.undos() > 0};
    if (inHand().isOn() || isHolding()) facts.inUse = indexInHand();
    facts.setting = inHand().setting();
    if (armed_) facts.awaited = toolTable()[*armed_]->awaited;
    return facts;
}

Overlay Tools::overlay() const {
    Overlay overlay;
    for (const auto& state : states_) state->addTo(overlay);
    return overlay;
}

std::optional<Question> Tools::question() const {
    for (const bool areMany : {false, true})
        for (std::size_t i = 0; i < states_.size(); ++i)
            if (const Tool& tool = *toolTable()[i]; states_[i]->question() && tool.asksMuch == areMany)
                return Question{i, *states_[i]->question(), tool.among};
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (states_[i]->preview()) return Question{i, *states_[i]->preview(), toolTable()[i]->among, true};
    return std::nullopt;
}

void Tools::answer(const Question& question, const std::optional<Pick>& pick, float radius) {
    if (question != this->question()) return;
    ToolState& state = *states_[question.tool];
    if (question.isPreview) return state.answerPreview(pick);
    log_.answer({question.tool, pick, radius});
    state.answer(pick, radius);
    takeNoteOf(question.tool);
}

void Tools::press(const Camera& camera, bool isDown, const Vector2& at) {
    if (isDown && armed_) {
        act(actionOf(*toolTable()[*std::exchange(armed_, std::nullopt)]));
        return;
    }
    log_.press(isDown, at);
    if (isDown) return inHand().press(camera, at);
    inHand().move(camera, at);
    inHand().release();
}

void Tools::pull(Document& document, float gravity) {
    gravity_ = gravity;
    log_.pull(gravity);
    document.setGravity(gravity);
}

void Tools::turn(Document& document, const sim::Material& material) {
    document.turnNow(material);
    turned(material);
}

void Tools::turned(const sim::Material& material) {
    material_ = material;
    log_.turn(material);
}

void Tools::shape(Document& document, const Shaped& shaped) {
    document.wantShape(shaped.solver, shaped.substeps);
    log_.shape(shaped);
}

void Tools::begin(const Document& document) {
    material_ = document.material();
    log_.begin(material_);
}

void Tools::reshaped() {
    steps_.clear();
    if (std::exchange(isLost_, false)) say(lost);
}

app::Bring Tools::bringOf(const Tools& before) {
    return [this, &before](const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
                           vk::Queue& taking) {
        try {
            history_.bring(before.history_, from, giving, to, taking);
        } catch (const vk::Error&) {
            history_.clear();
            isLost_ = true;
        } catch (const std::invalid_argument&) { // cut states, and a solver without cutting
            history_.clear();
            isLost_ = true;
        }
    };
}

void Tools::goOn(const Tools& before, const Document& document) {
    for (std::size_t i = 0; i < states_.size(); ++i) states_[i] = before.states_[i]->clone();
    wants_ = before.wants_;
    armed_ = before.armed_;
    lent_ = before.lent_;
    before_ = before.before_;
    gravity_ = before.gravity_;
    wantsUndo_ = before.wantsUndo_;
    wantsRedo_ = before.wantsRedo_;
    stepsBack_ = before.stepsBack_;
    log_ = before.log_;
    turned(document.material());
    log_.shape({document.settings().solver, document.settings().substeps});
    const bool isLost = isLost_;
    reshaped();
    if (isLost) log_.forget();
}

void Tools::set(const Tool& tool, const std::optional<float>& setting) {
    const std::size_t index = indexOf(tool);
    states_[index]->set(setting);
    logSetting(index);
}

// Takes a tool up or puts it away; one is in hand at a time.
void Tools::take(std::size_t tool) {
    if (!inHand().isOn()) inHand().release();
    if (!canUse_[tool]) return say("note: " + std::string(toolTable()[tool]->refusal));
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (i != tool && states_[i]->isOn()) states_[i]->toggle();
    states_[tool]->toggle();
    if (states_[tool]->isOn()) logSetting(tool);
}

bool Tools::actsAtPointer(Action action) {
    const std::optional<std::size_t> tool = toolOf(action);
    return tool && toolTable()[*tool]->isMomentary;
}

void Tools::useKey(std::size_t tool) {
    if (toolTable()[tool]->isMomentary)
        wants_.set(tool);
    else
        take(tool);
}

bool Tools::lend(std::optional<Action> held, bool isUsed) {
    if (lent_ && !states_[*lent_]->isOn()) lent_.reset(); // the user put it away
    const std::optional<std::size_t> wanted = held ? toolOf(*held) : std::nullopt;
    if (wanted.has_value() == lent_.has_value()) return false;
    const std::size_t tool = wanted ? *wanted : *lent_;
    if (wanted) {
        if (!isUsed || !canUse_[tool] || states_[tool]->isOn() || inHand().isDown()) return false;
        before_ = inHand().isOn() ? std::optional(indexInHand()) : std::nullopt;
    } else if (states_[tool]->isDown()) {
        return false;
    }
    lent_ = wanted;
    act(actionOf(*toolTable()[tool]));
    if (!wanted && before_) act(actionOf(*toolTable()[*std::exchange(before_, std::nullopt)]));
    return true;
}

bool Tools::act(Action action) {
    if (const std::optional<std::size_t> tool = toolOf(action)) {
        useKey(*tool);
        log_.key(action);
        return true;
    }
    switch (action) {
    case Action::drop:
        drop();
        break;
    case Action::undo:
        wantsUndo_ = true;
        break;
    case Action::redo:
        wantsRedo_ = true;
        break;
    case Action::stepBack:
        ++stepsBack_;
        break;
    default:
        return false;
    }
    log_.key(action);
    return true;
}

void Tools::say(const std::string& note) {
    std::fprintf(stderr, "%s\n", note.c_str());
    note_ = note;
}

void Tools::drop() {
    armed_.reset();
    for (const auto& state : states_) {
        state->drop();
        if (state->isOn()) state->toggle();
    }
}

void Tools::clear() {
    armed_.reset();
    for (const auto& state : states_) state->clear();
}

// The log begins with the tool in hand and with the settings that a new log does not imply.
void Tools::reset() {
    clear();
    history_.recycle();
    steps_.recycle();
    wantsUndo_ = wantsRedo_ = false;
    stepsBack_ = 0;
    log_.restart();
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const bool isOn = states_[i]->isOn();
        if (isOn || toolTable()[i]->isSettingOptional) logSetting(i);
        if (isOn) log_.key(actionOf(*toolTable()[i]));
    }
    if (gravity_) log_.pull(*gravity_);
    log_.turn(material_);
}

void Tools::putAway(Document& document) {
    for (const auto& state : states_) state->putAway();
    gravity_.reset();
    document.setGravity(document.scene().gravity);
    if (material_ != sim::Material{}) document.turnNow({});
    material_ = {};
    const sim::Settings &now = document.settings(), &first = document.madeWith();
    if (now.solver != first.solver || now.substeps != first.substeps)
        document.wantShape(first.solver, first.substeps);
    else
        document.keepShape();
}

void Tools::forget() {
    log_.forget();
    history_.recycle();
    steps_.recycle();
}

void Tools::forgetSteps() {
    log_.forget({.areOfSteps = true});
    steps_.recycle();
}

} // namespace sinew::viewer
