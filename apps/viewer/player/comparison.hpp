// The second simulation of a comparison: made in a thread, kept in step with the first, drawn in the right
// half of the window.
#pragma once

#include "viewer/jobs/layer_loader.hpp"
#include "viewer/player/player_context.hpp"

#include <future>
#include <memory>
#include <optional>

namespace sinew::viewer {

/// Main thread only. The destructor waits for the thread.
class Comparison {
public:
    /// `layer loader` must outlive it.
    Comparison(const PlayerContext& player, LayerLoader& layerLoader)
        : player_(player), layerLoader_(layerLoader) {}

    /// Null while there is none to be drawn.
    const sim::Simulation* simulation() const noexcept { return beside_ ? &beside_->simulation() : nullptr; }
    bool isMaking() const noexcept { return making_.valid(); }

    /// Asks for one, or for none.
    void toggle();
    /// Makes, drops or updates it as Session::beside() asks. No picture and no rehearsal may be under way in
    /// LayerLoader. `isDiverged`: the first cannot go on.
    void tend(bool isDiverged);
    /// Notes that the first has left the common course: it takes over its state at the next tend().
    void fallBehind() noexcept { isBehind_ = true; }
    /// Records the reset of the first.
    void recordReset(VkCommandBuffer commands) noexcept;
    /// Records the step that the first has just taken, if it is in step.
    void recordStep(const Presenter::Frame& frame, const StepHands& hands, bool isTimed) noexcept;
    /// Records the skins of a picture, and the copy that measures its strain if it `isMeasured`.
    void recordPicture(const Presenter::Frame& frame, bool isMeasured) noexcept;
    /// Takes the results of a slot that has finished. `first`: the state of the first, as
    /// SecondSimulation::settle() takes it.
    void settle(std::uint32_t slot, const StateProbe* first);

    /// Width over height of the area that panels leave to one picture: a half of it while there are two.
    float pictureAspect() const;
    /// Camera::shift of the whole window: from its middle to that of the area beside the panels.
    float shift() const;
    bool isButtonDown() const { return isButtonDown_; }
    /// Moves pointer and presses so that they count from the middle of the free area, or of the half of it
    /// that they are in. While a button is down it stays the half in which it was pressed.
    void fold(Input& input);
    /// Draws both halves. There is a simulation().
    void drawHalves(const Presenter::Frame& frame, const Overlay& overlay, View& view);
    BesideFacts facts() const;

    /// Goes on with the pointer of `before`.
    void takeOver(const Comparison& before);

private:
    bool isFit() const;
    void make(const BesideShape& shape, const sim::Settings& room);
    void take();
    BesideShape defaultShape() const;
    void beginInScene();
    bool compareInstead();
    void drop();
    std::uint32_t freeWidth() const;
    std::uint32_t halvesWidth() const;

    const PlayerContext& player_;
    LayerLoader& layerLoader_;
    std::unique_ptr<SecondSimulation> beside_;
    std::optional<BesideShape> asked_; // that it is, or is being made as
    std::future<std::unique_ptr<SecondSimulation>> making_;
    bool isBehind_ = false;
    bool isOfScene_ = false; // what is wanted was looked at in this scene
    bool isInstead_ = false; // something else than the default is shown, as the scene has no form for that
    float fold_ = 0; // from the middle of the window to that of the pointer's picture, as Input::pointer
    // Picture and pointer keep their place while a button is down, whatever panels come and go.
    std::optional<float> heldShift_;
    bool isButtonDown_ = false;
};

} // namespace sinew::viewer
