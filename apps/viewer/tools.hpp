// The tools of the pointer: the grab, the blade, the sphere and the pins, with their log and their undo
// history.
#pragma once

#include "sinew/holds.hpp"
#include "viewer/document/document.hpp"
#include "viewer/document/history.hpp"
#include "viewer/hands/cut_tool.hpp"
#include "viewer/hands/grab_tool.hpp"
#include "viewer/hands/input_log.hpp"
#include "viewer/hands/pins.hpp"
#include "viewer/hands/poke_tool.hpp"
#include "viewer/window/window.hpp"

#include <utility>

namespace sinew::viewer {

class Controller;
struct OpenedScene;

/// Input of the tools for one step.
struct StepHands {
    StepHands() { grabs.fill(emptyHand()); }
    std::array<sim::Grab, sim::ranges::mostGrabs> grabs; ///< the pointer's, then pins; others hold nothing
    std::optional<Sweep> sweep;                          ///< of the blade
    std::optional<sim::HostCollider> poke;
};
void recordStep(VkCommandBuffer commands, Document& document, const StepHands& hands,
                vk::Timestamps* timestamps = nullptr) noexcept;

/// Must not outlive its Device, which must not move.
class Tools {
public:
    Tools(const vk::Device& device, const OpenedScene& opening);

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
    /// Sets the radius of the sphere [m].
    void resize(float radius);
    /// Sets the depth of the blade (see CutTool::setDepth).
    void setDepth(const std::optional<float>& depth);
    const std::optional<float>& depth() const { return blade_.depth(); }
    CutTool::Depths depths() const { return blade_.depths(); }
    /// False for an action of others.
    bool act(Action action);
    /// Lends the blade while `isHeld`, from the next use of the pointer on; the tool before it returns when
    /// the stroke has ended. True if the tool changed.
    bool lendBlade(bool isHeld, bool isUsed);
    /// The next press of the left button places a pin; for a button of a panel.
    void armPin() { isPinArmed_ = true; }
    /// Releases grabs and pins and drops strokes, whose places are no longer valid.
    void clear();
    /// Call at a reset. Only the tool in hand, the depth of the blade, the radius of the sphere and gravity
    /// stay.
    void reset();
    /// Drops the states to undo, or those of single steps.
    void forget();
    void forgetSteps();

    /// The pick that a tool needs, one at a time; it stays until it is answered or dropped.
    std::optional<Question> question() const;
    /// Answers with the hit of the ray. `radius`: see holdRadius(). Ignored if the question was dropped.
    void answer(const Question& question, const std::optional<Pick>& pick, float radius);

    /// Whether commands must be recorded even without a step.
    bool isWaiting() const { return question() || wantsPin_ || wantsHistory(); }
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

    bool isHolding() const { return hand_.isHolding(); }
    bool isBladeOn() const { return blade_.isOn(); }
    bool isPokeOn() const { return poke_.isOn(); }
    const History& history() const { return history_; }
    /// Number of single steps that can be undone.
    std::size_t stepsBack() const { return std::min(steps_.undos(), keptSteps_); }
    std::size_t pins() const { return pins_.count(); }
    Overlay overlay() const { return {hand_.hand(), pins_.shown(), blade_.path(), blade_.gauge()}; }
    /// Takes the newest message, which also goes to stderr.
    std::string takeNote() { return std::exchange(note_, {}); }
    /// Text for the title: " - holding".
    const char* name() const;

private:
    void takeBlade();
    void takePoke();
    void turnWheel(float notches);
    void pinAt(const Ray& ray);
    void pin(const Hand& hand, float radius);
    void sayHeld(std::uint32_t particle);
    void drop();
    void say(const std::string& note);

    GrabTool hand_;
    Pins pins_;
    CutTool blade_;
    PokeTool poke_;
    // Most steps that may be taken back at once.
    static constexpr std::size_t mostTakenBack = sim::Simulation::framesInFlight;
    History history_, steps_;   // of cuts; of all steps
    std::size_t keptSteps_ = 0; // limit for steps_, which holds more: some may be taken back
    std::string note_;
    void rememberStep(VkCommandBuffer commands, const Document& document);
    bool goBack(VkCommandBuffer commands, Document& document);

    std::vector<sim::NamedHold> holds_; // of the scene
    std::vector<bool> isFixed_;         // for every particle
    float pinReach_;                    // largest distance of the pointer's ray from a pin [m]
    std::optional<Ray> pinned_;         // a question
    std::optional<float> gravity_;      // set by the user
    sim::Material material_;            // set by the user
    InputLog log_;
    std::uint32_t stepsBack_ = 0; // requested
    bool isLost_ = false;         // states to undo were lost in bring()
    bool canCut_ = false, isForgetful_ = false, isForgetfulOfSteps_ = false, wantsPin_ = false,
         isPinArmed_ = false, wantsUndo_ = false, wantsRedo_ = false, isLent_ = false, wasPokeOn_ = false;
};

} // namespace sinew::viewer
