// The tools of the pointer, as toolTable() lists them, with their log and their undo history.
#pragma once

#include "viewer/document/document.hpp"
#include "viewer/document/history.hpp"
#include "viewer/input/input.hpp"
#include "viewer/input/input_log.hpp"
#include "viewer/input/tool.hpp"

#include <bitset>
#include <memory>
#include <utility>

namespace sinew::viewer {

class Controller;

void recordStep(VkCommandBuffer commands, Document& document, const StepHands& hands,
                vk::Timestamps* timestamps = nullptr) noexcept;
/// In several command buffers, as sim::Simulation::record.
void recordStep(std::span<const VkCommandBuffer> parts, Document& document, const StepHands& hands,
                vk::Timestamps* timestamps = nullptr) noexcept;

/// Must not outlive its Device, which must not move.
class Tools {
public:
    Tools(const vk::Device& device, const ToolContext& of);

    /// Passes presses and moves to the tool. Drags that no tool takes orbit the camera.
    void handle(const Input& input, Controller& controller);
    /// The single events that handle() passes on. `at`, `pointer`: see Input::pointer.
    void look(const Camera& camera) { log_.look(camera); }
    void press(const Camera& camera, bool isDown, const Vector2& at);
    void move(const Camera& camera, const Vector2& pointer);
    /// See Document::setGravity.
    void pull(Document& document, float gravity);
    /// See Document::turnNow; turned() logs a material that Document::recordTurn() has recorded.
    void turn(Document& document, const sim::Material& material);
    void turned(const sim::Material& material);
    /// See Document::wantShape. Call reshaped() after Document::reshape(): states of single steps belong to
    /// the old simulation.
    void shape(Document& document, const Shaped& shaped);
    void reshaped();
    /// Callback for a document that changes its simulation: moves the states to undo; bringOf() those of
    /// `before`, for a document that takes over another one. Drops them all without memory, or if there are
    /// cuts and the solver has no form for cutting.
    app::Bring bring() { return bringOf(*this); }
    app::Bring bringOf(const Tools& before);
    /// Instead of reset(): the document was brought to its state by other means.
    void begin(const Document& document);
    /// Takes over the tools of `before` and its log, for a document that has taken over that of `before`.
    void goOn(const Tools& before, const Document& document);
    /// The number of a tool (Tool::setting). set() clamps and logs it.
    void set(const Tool& tool, const std::optional<float>& setting);
    std::optional<float> setting(const Tool& tool) const { return of(tool).setting(); }
    std::array<float, 2> settingRange(const Tool& tool) const { return of(tool).settingRange(); }
    /// False for an action of others.
    bool act(Action action);
    /// Lends a tool while its modifier is `held`, from the next use of the pointer on; the tool before it
    /// returns when the stroke has ended. True if the tool changed.
    bool lend(std::optional<Action> held, bool isUsed);
    /// Whether the action is the key of a tool that acts at the pointer. A button of a panel calls arm()
    /// instead of act(): the next press of the left button is then the key.
    static bool actsAtPointer(Action action);
    void arm(Action action) { armed_ = toolOf(action); }
    /// Releases grabs and pins and drops strokes, whose places are no longer valid.
    void clear();
    /// Call at a reset. Only the tool in hand, settings of tools and gravity stay.
    void reset();
    /// Drops the states to undo, or those of single steps.
    void forget();
    void forgetSteps();

    /// The pick that a tool needs, one at a time; it stays until it is answered or dropped.
    std::optional<Question> question() const;
    /// Answers with the hit of the ray. `radius`: see holdRadius(). Ignored if the question was dropped.
    void answer(const Question& question, const std::optional<Pick>& pick, float radius);

    /// Whether commands must be recorded even without a step.
    bool isWaiting() const { return question() || wants_.any() || wantsHistory(); }
    bool wantsHistory() const { return wantsUndo_ || wantsRedo_ || stepsBack_ > 0; }
    /// Records a requested undo or redo; true if there was a state for it.
    bool recordHistory(VkCommandBuffer commands, Document& document);
    /// Call before a replay starts again: puts all tools away and restores the scene's gravity.
    void putAway(Document& document);
    /// Returns the input of the next step, which must then be recorded into `commands`; before a cut, records
    /// a copy of the state here.
    StepHands takeStep(VkCommandBuffer commands, const Document& document);
    /// Call after the document changed its simulation, with bring().
    void moveOn();
    /// Call after the document changed its simulation and `steps` were undone. Cuts `undone` again, in order.
    void restart(const Document& document, std::span<const Sweep> undone, std::uint64_t steps);
    /// Takes back `steps`, which the same simulation repeats. Cuts `undone` again, in order.
    void takeBack(const Document& document, std::span<const Sweep> undone, std::uint64_t steps);
    /// Drops the saved states of cuts that were undone; takeStep(), or the caller of remember() if it repeats
    /// the steps, saves new ones.
    void forgetUndone(const Document& document, std::span<const Sweep> undone);
    void remember(VkCommandBuffer commands, const Document& document);

    /// The log since the reset.
    const InputLog& log() const { return log_; }

    bool isOn(const Tool& tool) const { return of(tool).isOn(); }
    bool isHolding() const { return inHand().held().has_value(); }
    /// Whether Shift and the wheel change the tool in hand.
    bool takesWheel() const { return !recordInHand().setting.empty(); }
    /// Tools whose buttons are lit, by index into toolTable().
    std::array<bool, mostTools> shownOn() const;
    HintFacts hintFacts() const;
    const History& history() const { return history_; }
    /// Number of single steps that can be undone.
    std::size_t stepsBack() const { return std::min(steps_.undos(), keptSteps_); }
    Overlay overlay() const;
    /// Takes the newest message, which also goes to stderr.
    std::string takeNote() { return std::exchange(note_, {}); }
    /// Text for the title: " - holding".
    std::string name() const;

private:
    const ToolState& of(const Tool& tool) const { return *states_[indexOf(tool)]; }
    /// The tool that the left button belongs to: index into toolTable().
    std::size_t indexInHand() const;
    const Tool& recordInHand() const { return *toolTable()[indexInHand()]; }
    ToolState& inHand() { return *states_[indexInHand()]; }
    const ToolState& inHand() const { return *states_[indexInHand()]; }
    void take(std::size_t tool);
    void useKey(std::size_t tool);
    void turnWheel(float notches);
    void logSetting(std::size_t tool);
    void takeNoteOf(std::size_t tool);
    void drop(); ///< ends what all tools do, and puts away the one in hand
    void say(const std::string& note);

    std::vector<std::unique_ptr<ToolState>> states_; // in the order of toolTable()
    std::array<bool, mostTools> canUse_{};           // in this scene, by that order
    std::bitset<mostTools> wants_;                   // keys pressed, to be used at the pointer
    std::optional<std::size_t> armed_, lent_;
    std::optional<std::size_t> before_; // in hand before the lent one
    // Most steps that may be taken back at once.
    static constexpr std::size_t mostTakenBack = sim::Simulation::framesInFlight;
    History history_, steps_;   // of cuts; of all steps
    std::size_t keptSteps_ = 0; // limit for steps_, which holds more: some may be taken back
    std::string note_;
    void rememberStep(VkCommandBuffer commands, const Document& document);
    bool goBack(VkCommandBuffer commands, Document& document);

    std::optional<float> gravity_; // set by the user
    sim::Material material_;       // set by the user
    InputLog log_;
    std::uint32_t stepsBack_ = 0; // requested
    bool isLost_ = false;         // states to undo were lost in bring()
    bool isForgetful_ = false, isForgetfulOfSteps_ = false, wantsUndo_ = false, wantsRedo_ = false;
};

} // namespace sinew::viewer
