// Questions about the state of a scene on show: where its bodies are, for the camera; what a ray meets, for
// tools and the inspector; strain and pieces, for the panels. Copies of the state answer them when their
// picture has finished; nothing waits.
#pragma once

#include "viewer/input/inspector.hpp"
#include "viewer/input/piece_probe.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/jobs/gauges.hpp"
#include "viewer/player/comparison.hpp"
#include "viewer/player/layer_view.hpp"
#include "viewer/player/player_context.hpp"

#include <chrono>

namespace sinew::viewer {

/// Main thread only. All references must outlive it.
class Observer {
public:
    /// Goal of the camera, once it is known what lies under the pointer.
    enum class Target { body, point };

    Observer(const PlayerContext& player, const LayerView& layers, const Comparison& comparison,
             Gauges& gauges);

    /// Frames all bodies.
    void frameAll() noexcept { wantsBounds_ = true; }
    /// Frames again for another size of the window or of the panels, if the camera has not moved since it
    /// framed the scene or a body.
    void keepFraming();
    /// The camera of the window's picture: its target is in the middle of the area beside the panels.
    Camera seenBesidePanels() const;
    /// Looks at what lies under the pointer now, or under the next press.
    void lookAt(Target target);
    void lookAtPress(Target target) noexcept { armed_ = target; }
    void forgetLook() noexcept { armed_.reset(); }
    /// Takes the press that lookAtPress() waits for out of `input`, and moves the pointer; true if it moved.
    bool take(Input& input);
    void takePress(Input& input);

    void toggleInspector() { inspector_.toggle(); }
    bool isInspecting() const { return inspector_.isOn(); }
    /// True while a question is to be asked although nothing moves.
    bool isWaiting() const noexcept { return wantsBounds_ || wantsLook_ || wantsCount_; }

    /// Notes the counts of a step that has finished.
    void stepFinished(const sim::Status& status);
    /// Chooses the questions of a picture after `steps` steps. One copy answers all; none is asked while
    /// another is on its way. `asksTools`: the tools may ask.
    void ask(std::uint32_t slot, std::uint32_t steps, bool asksTools);
    /// Records the copies that these questions need; call it after the skins were recorded.
    void record(const Presenter::Frame& frame);
    /// The copy of the state that settle() has read last; null before the first.
    const StateProbe* probe() const noexcept { return probe_ ? &*probe_ : nullptr; }
    bool isMeasured(std::uint32_t slot) const noexcept { return pending_[slot].isMeasured; }
    /// Answers the questions of a slot that has finished.
    void settle(std::uint32_t slot);
    /// The same of the number of pieces; `isUndone`: its steps were undone. True if the number was counted.
    bool settleCount(std::uint32_t slot, bool isUndone);

    /// An earlier or later state was loaded: counts on their way are of another one.
    void stateRestored() noexcept {
        linksCut_ = 0; // the next step asks anew
        wantsCount_ = false;
    }
    /// Forgets all copies: the document has another simulation.
    void restart();
    /// Goes on with the pointer, the inspector and the counts of `before`.
    void takeOver(const Observer& before);
    void addTo(Facts& facts) const;

private:
    using Clock = std::chrono::steady_clock;
    struct Look {
        Target at;
        Ray ray;
    };
    struct Pending {
        bool isBounded = false, isMeasured = false, isCounted = false, isInspected = false;
        std::optional<Look> look = {};
        std::optional<Question> question = {}; // of the tools
        bool isAny() const { return isBounded || isMeasured || isCounted || hasRay(); }
        bool hasRay() const { return isInspected || look || question; }
        bool needsCopy() const { return isBounded || isMeasured || isInspected || look; }
    };
    void answer(const Question& question, const std::optional<Pick>& found);
    void settleLook(const Look& look, const std::optional<Pick>& found);
    bool isStrainDue(std::uint32_t steps);
    bool isCountDue();
    /// A view that nobody has moved: its camera, and what that shows as a whole in a picture of this aspect
    /// ratio. Without a box it is the first view.
    struct Framing {
        Camera camera;
        std::optional<Box> box = {};
        float aspect = 0;
    };
    void frame(const Box& box);
    /// Rays of a picture, by what asks.
    enum Asker : std::size_t { ofTools, ofLook, ofInspector };
    Ray pointerRay() const;

    const PlayerContext& player_;
    const LayerView& layers_;
    const Comparison& comparison_;
    Gauges& gauges_;
    std::optional<StateProbe> probe_; // for the document's simulation
    PieceProbe pieceProbe_;
    Inspector inspector_;
    Vector2 pointer_ = Vector2::Zero(); // see Input::pointer
    std::optional<Look> wantsLook_;
    std::optional<Target> armed_;
    std::optional<Framing> framing_; // the newest
    bool wantsBounds_ = false, wantsCount_ = false;
    Clock::time_point lastStrain_ = Clock::now(), lastCount_ = lastStrain_;
    std::uint32_t linksCut_ = 0;  // Status::linksCutInAll of the newest step that has finished
    std::uint32_t allPieces_ = 0; // Status::pieces of that step
    std::array<Pending, Presenter::framesInFlight> pending_;
};

} // namespace sinew::viewer
