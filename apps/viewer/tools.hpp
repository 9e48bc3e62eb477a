// What the pointer holds, the hand, the blade or the sphere, what it has pinned, and what of their work can
// be undone.
#pragma once

#include "sim/holds.hpp"
#include "viewer/draw/stage.hpp"
#include "viewer/hands/cut_tool.hpp"
#include "viewer/hands/grab_tool.hpp"
#include "viewer/hands/history.hpp"
#include "viewer/hands/input_log.hpp"
#include "viewer/hands/pins.hpp"
#include "viewer/hands/poke_tool.hpp"
#include "viewer/window/window.hpp"

#include <utility>

namespace sinew::viewer {

class Controller;
struct Opening;

/// What hands do in one step.
struct StepHands {
    StepHands() { grabs.fill(emptyHand()); }
    std::array<sim::Grab, sim::ranges::mostGrabs> grabs; ///< the pointer's, then pins; at first empty
    std::optional<Sweep> sweep;                          ///< of the blade
    std::optional<sim::Poke> poke;
};
void recordStep(VkCommandBuffer commands, Stage& stage, const StepHands& hands,
                vk::Timestamps* timestamps = nullptr) noexcept;

/// Must not outlive its Device, which must not move.
class Tools {
public:
    Tools(const vk::Device& device, const Opening& opening);

    /// Presses and moves. Drags that no tool wants turn the camera.
    void handle(const Input& input, Controller& controller);
    /// What handle() does of it, one by one. `at`, `pointer` as Input::pointer.
    void look(const Camera& camera) { log_.look(camera); }
    void press(const Camera& camera, bool isDown, const Vector2& at);
    void move(const Camera& camera, const Vector2& pointer);
    /// As Stage::setGravity.
    void pull(Stage& stage, float gravity);
    /// As Stage::turnNow; and what Stage::recordTurn() has recorded.
    void turn(Stage& stage, const sim::Material& material);
    void turned(const sim::Material& material);
    /// As Stage::wantShape, and once the stage has been reshaped: states of single steps are of a simulation
    /// that is no more.
    void shape(Stage& stage, const Shaped& shaped);
    void reshaped();
    /// For what gives a stage another simulation: brings over what can be undone; that of `before`, for a
    /// stage that takes over from another one. Without memory for it, or with cuts for
    /// a solver that has no form for them, nothing can be undone any more.
    app::Bring bring() { return bringOf(*this); }
    app::Bring bringOf(const Tools& before);
    /// Instead of reset(): the stage has come to where it is without them.
    void begin(const Stage& stage);
    /// All that `before` has in hand, and its log, for a stage that has taken over that of `before`.
    void goOn(const Tools& before, const Stage& stage);
    /// Of the sphere that pokes [m].
    void resize(float radius);
    /// Of the blade, as CutTool::setDepth.
    void setDepth(const std::optional<float>& depth);
    const std::optional<float>& depth() const { return blade_.depth(); }
    CutTool::Depths depths() const { return blade_.depths(); }
    /// False for an action that is none of theirs.
    bool act(Action action);
    /// The blade as long as `isHeld`, from when the pointer is used: what was in hand before comes back then,
    /// once a stroke has ended. Whether that changes something.
    bool lendBlade(bool isHeld, bool isUsed);
    /// The next press of the left button pins what is under it, as the button of a panel cannot.
    void armPin() { isPinArmed_ = true; }
    /// Lets go of everything, and takes out all pins: what was held or to be cut is where nobody expects it.
    void clear();
    /// At a reset: as new, but for what stays in the hand, the blade or the sphere as large as it is, and for
    /// gravity.
    void reset();
    /// There is no way back to earlier states any more, or none step by step.
    void forget();
    void forgetSteps();

    /// One at a time; it stays until it is answered, or is no question any more.
    std::optional<Question> question() const;
    /// What the ray meets. `radius` as holdRadius(). Of a question that nobody asks any more, nothing comes.
    void answer(const Question& question, const std::optional<Pick>& pick, float radius);

    /// Whether something is to be recorded even where no step is.
    bool isWaiting() const { return question() || wantsPin_ || wantsHistory(); }
    bool wantsHistory() const { return wantsUndo_ || wantsRedo_ || stepsBack_ > 0; }
    /// The way back or forwards, where it was asked for; whether there was one.
    bool recordHistory(VkCommandBuffer commands, Stage& stage);
    /// For a replay that begins again: all put away, gravity as the scene has it.
    void putAway(Stage& stage);
    /// What they do in the next step, which is then recorded into `commands`; a copy of the state before a
    /// cut is recorded here.
    StepHands takeStep(VkCommandBuffer commands, const Stage& stage);
    /// After the stage has another simulation, with bring().
    void moveOn();
    /// Likewise, where so many steps were undone. `undone`, in their order, are cut again.
    void restart(const Stage& stage, std::span<const Sweep> undone, std::uint64_t steps);
    /// Takes back so many steps, which the same simulation takes again. `undone`, in their order, are cut
    /// again.
    void takeBack(const Stage& stage, std::span<const Sweep> undone, std::uint64_t steps);
    /// What can be undone of those sweeps was never done: takeStep(), or who takes those steps again,
    /// remembers anew.
    void forgetUndone(const Stage& stage, std::span<const Sweep> undone);
    void remember(VkCommandBuffer commands, const Stage& stage);

    /// All since the reset.
    const InputLog& log() const { return log_; }

    bool isHolding() const { return hand_.isHolding(); }
    bool isBladeOn() const { return blade_.isOn(); }
    bool isPokeOn() const { return poke_.isOn(); }
    const History& history() const { return history_; }
    /// How many steps there is a way back of.
    std::size_t stepsBack() const { return std::min(steps_.undos(), keptSteps_); }
    std::size_t pins() const { return pins_.count(); }
    Overlay overlay() const { return {hand_.hand(), pins_.shown(), blade_.path(), blade_.gauge()}; }
    /// What they said last, once: also a line on stderr.
    std::string takeNote() { return std::exchange(note_, {}); }
    /// For the title: " - holding".
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
    // Steps that may be taken back at once, which is to leave as many behind as elsewhere.
    static constexpr std::size_t mostTakenBack = sim::Simulation::framesInFlight;
    History history_, steps_;   // of cuts; of all steps
    std::size_t keptSteps_ = 0; // of those at most, in which there are more: some may be taken back
    std::string note_;
    void rememberStep(VkCommandBuffer commands, const Stage& stage);
    bool goBack(VkCommandBuffer commands, Stage& stage);

    std::vector<sim::NamedHold> holds_; // of the scene
    std::vector<bool> isFixed_;         // of every particle
    float pinReach_;                    // of the pointer around a pin [m]
    std::optional<Ray> pinned_;         // a question
    std::optional<float> gravity_;      // that was turned
    sim::Material material_;            // likewise
    InputLog log_;
    std::uint32_t stepsBack_ = 0; // that are wanted
    bool isLost_ = false;         // what could be undone, in bring()
    bool canCut_ = false, isForgetful_ = false, isForgetfulOfSteps_ = false, wantsPin_ = false,
         isPinArmed_ = false, wantsUndo_ = false, wantsRedo_ = false, isLent_ = false, wasPokeOn_ = false;
};

} // namespace sinew::viewer
