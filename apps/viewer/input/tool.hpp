// A tool of the pointer as one record: its key, its texts, its name in logs, and how its state for a scene is
// made. To add a tool, write a file in apps/viewer/tools and a row of the table there
// (docs/extending-viewer.md).
#pragma once

#include "sinew/holds.hpp"
#include "sinew/ranges.hpp"
#include "sinew/simulation.hpp"
#include "viewer/input/bindings.hpp"
#include "viewer/input/icon.hpp"
#include "viewer/input/pick.hpp"
#include "viewer/render/hand_mesh.hpp"
#include "viewer/render/scene_light.hpp"

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::viewer {

/// A grab that holds nothing: for entries of Step::grabs before one that holds.
inline sim::Grab emptyHand() {
    constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
    return {.target = {nowhere, nowhere, nowhere}};
}

/// The piece of a blade's stroke for one step (sim::Blade).
struct Sweep {
    std::array<sim::Vec3, 2> from, to; ///< ends of the blade at start and end of the sweep [m]
    bool isCarried = false;            ///< false for the first piece of a stroke
};

/// Input of the tools for one step.
struct StepHands {
    StepHands() { grabs.fill(emptyHand()); }
    std::array<sim::Grab, sim::ranges::mostGrabs> grabs; ///< the pointer's, then pins; others hold nothing
    std::optional<Sweep> sweep;                          ///< of the blade
    std::optional<sim::HostCollider> collider;
};

/// The particle that a tool holds, and the radius of its grab [m].
struct Held {
    Hand hand;
    float radius = 0;
};

/// A scene to make the state of a tool for. The references need not outlive the call.
struct ToolContext {
    const SceneLight& light;
    const sim::Scene& scene;
    const std::vector<sim::NamedHold>& holds; ///< of the scene file
    const std::optional<float>& bladeDepth;   ///< the first one (see CutTool::setDepth)
};

/// The state of a tool for one scene. Every function does nothing unless a tool says otherwise.
class ToolState {
public:
    virtual ~ToolState() = default;
    virtual std::unique_ptr<ToolState> clone() const = 0;

    /// Whether the left button belongs to it.
    virtual bool isOn() const { return false; }
    /// Takes it up, or puts it away and ends what it does.
    virtual void toggle() {}
    /// The left button was pressed at `pointer` (see Input::pointer) while the tool is in hand; released.
    virtual void press(const Camera& /*camera*/, const Vector2& /*pointer*/) {}
    virtual void release() {}
    virtual bool isDown() const { return false; }
    /// The pointer has moved; called for every tool.
    virtual void move(const Camera& /*camera*/, const Vector2& /*pointer*/) {}
    /// Whether moves of the pointer matter to it now, and are logged.
    virtual bool followsPointer() const { return false; }
    /// The part of a drag, in (x, y) window heights, that orbits the camera.
    virtual Vector2 drag(const Vector2& /*heights*/) { return Vector2::Zero(); }
    /// The key of a tool whose record says `isMomentary`. `held`: by the tool in hand. True if this tool
    /// holds that from now on.
    virtual bool use(const Ray& /*ray*/, const std::optional<Held>& /*held*/) { return false; }

    /// The ray of a pick that it waits for; none after answer(). An answer without a question is ignored.
    virtual const std::optional<Ray>& question() const { return noRay(); }
    /// `radius`: see holdRadius().
    virtual void answer(const std::optional<Pick>& /*pick*/, float /*radius*/) {}
    /// The same for a pick that changes only what is drawn, and is not logged.
    virtual const std::optional<Ray>& preview() const { return noRay(); }
    virtual void answerPreview(const std::optional<Pick>& /*pick*/) {}

    /// The number that the record names (Tool::setting); set() clamps it.
    virtual std::optional<float> setting() const { return std::nullopt; }
    virtual void set(const std::optional<float>& /*setting*/) {}
    virtual std::array<float, 2> settingRange() const { return {}; } ///< least, largest; 0, 0 = any
    virtual void turnWheel(float /*notches*/) {}

    /// Ends what it does: Esc. Strokes that are not carried out are dropped.
    virtual void drop() { release(); }
    /// The same, and removes what it left in the scene: places are no longer valid.
    virtual void clear() { drop(); }
    /// Its state in a scene just opened.
    virtual void putAway() {}

    /// Adds its part to the input of a step, which is then recorded.
    virtual void addTo(StepHands& /*hands*/) {}
    /// Whether the state before that step is kept for undo.
    virtual bool beginsStroke() const { return false; }
    /// The same sweeps again, in order: the steps that had them were undone.
    virtual void putBack(std::span<const Sweep> /*sweeps*/) {}

    virtual void addTo(Overlay& /*overlay*/) const {}
    virtual std::optional<Held> held() const { return std::nullopt; }
    /// Whether its button is lit.
    virtual bool isShownOn() const { return isOn(); }
    /// Takes its newest message to the user; empty = none.
    virtual std::string takeNote() { return {}; }

private:
    static const std::optional<Ray>& noRay() {
        static const std::optional<Ray> none;
        return none;
    }
};

/// A row of toolTable().
struct Tool {
    std::string_view name;  ///< in logs, before the answer to its question
    std::string_view title; ///< in the title of the window
    char key = 0;           ///< a capital letter; 0: it is in hand while no other tool is
    std::string_view help = {}, button = {};
    Icon icon = Icon::none;      ///< in the toolbar
    std::string_view letGo = {}; ///< what Esc does to it

    /// Hints at the foot of the picture: a whole one for while nothing is in use, and what its key does while
    /// something is held; empty = none. addHints() adds those for while it is in use.
    std::string_view offer = {}, offerHeld = {};
    std::string_view awaited = {}; ///< hint while its button waits for a press (Tools::arm())
    void (*addHints)(HintLine& line, const std::optional<float>& setting) = nullptr;

    std::string_view setting = {};     ///< name in logs of its number, which the wheel changes; empty = none
    std::string_view settingHelp = {}; ///< "radius of the sphere"
    bool isSettingOptional = false;    ///< it may be absent, and is so where a log begins: a dash in logs
    /// Message when the wheel has changed it.
    std::string (*settingNote)(const std::optional<float>& setting) = nullptr;

    bool isLent = false;      ///< in hand while Ctrl is held; at most one tool
    bool isMomentary = false; ///< its key acts once, at the pointer; it is never in hand
    bool asksMuch = false;    ///< asks again and again: questions of other tools come first
    Among among = Among::all; ///< particles that its questions mean

    /// Whether it can do anything in a scene; null: in all. `refusal` is the sentence if not.
    bool (*fits)(const sim::Scene&) = nullptr;
    std::string_view refusal = {};

    std::unique_ptr<ToolState> (*make)(const ToolContext&) = nullptr;
};

/// Whether the tool can do anything in the scene.
inline bool fits(const Tool& tool, const sim::Scene& scene) {
    return tool.fits == nullptr || tool.fits(scene);
}

} // namespace sinew::viewer
