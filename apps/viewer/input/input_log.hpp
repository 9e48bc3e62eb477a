// A log of user input since a scene's reset, or since a saved state: camera, pointer, presses, keys, and what
// was found under a press, step by step. The same events lead a simulation of the same scene to the same
// bits.
#pragma once

#include "sinew/material.hpp"
#include "viewer/input/bindings.hpp"
#include "viewer/input/pick.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace sinew::viewer {

/// A position of the pointer (see Input::pointer).
struct Pointed {
    Vector2 at = Vector2::Zero();
    bool operator==(const Pointed&) const = default;
};
/// Press or release of the button of the tools.
struct Pressed {
    bool isDown = false;
    Vector2 at = Vector2::Zero();
    bool operator==(const Pressed&) const = default;
};
/// The answer to a tool's question (see Tools::answer).
struct Answered {
    std::size_t tool = 0; ///< index into toolTable()
    std::optional<Pick> pick;
    float radius = 0;
    bool operator==(const Answered&) const = default;
};
/// Gravity downwards, from here on [m/s^2].
struct Pulled {
    float gravity = 0;
    bool operator==(const Pulled&) const = default;
};
/// The material of the scene, from here on.
struct Turned {
    sim::Material material;
    bool operator==(const Turned&) const = default;
};
/// Another simulation continues from here, with this solver and number of substeps and the newest Turned
/// material. Steps before it cannot be undone one by one.
struct Shaped {
    sim::Solver solver = sim::Solver::split;
    std::uint32_t substeps = 0;
    bool operator==(const Shaped&) const = default;
};
/// The setting of a tool, from here on (Tool::setting).
struct ToolSet {
    std::size_t tool = 0; ///< index into toolTable()
    std::optional<float> setting;
    bool operator==(const ToolSet&) const = default;
};
/// Loss of all states to undo, or only of those of single steps.
struct Forgot {
    bool areOfSteps = false;
    bool operator==(const Forgot&) const = default;
};
/// Steps that use the events before this one; 0 = an undo or a redo without a step.
struct Stepped {
    std::uint32_t count = 0;
    bool operator==(const Stepped&) const = default;
};
using InputEvent = std::variant<Camera, Pointed, Pressed, Action, Answered, Pulled, Turned, Shaped, ToolSet,
                                Forgot, Stepped>;

/// Collects events; skips those that change nothing.
class InputLog {
public:
    /// Starts a new log, at a reset.
    void restart();
    /// Starts with this material.
    void begin(const sim::Material& material) { material_ = material; }

    void look(const Camera& camera);
    void point(const Vector2& pointer);
    void press(bool isDown, const Vector2& pointer);
    void key(Action action);
    void answer(Answered answer);
    void pull(float gravity);
    void turn(const sim::Material& material);
    void shape(const Shaped& shaped);
    void set(std::size_t tool, const std::optional<float>& setting);
    void forget(const Forgot& forgot = {});
    /// Call after a step was recorded.
    void step();
    /// Call after an undo or a redo.
    void goBack();
    /// Removes the last `steps`, which the device undid and which will be repeated.
    void takeBack(std::uint64_t steps);

    const std::vector<InputEvent>& events() const { return events_; }
    /// Whether the events from `first` on include more than steps and camera moves.
    bool hasDeeds(std::size_t first) const;

private:
    std::vector<InputEvent> events_;
    std::optional<Camera> camera_;
    std::optional<Pointed> pointed_; // empty: the next position counts in any case
    std::optional<float> gravity_;
    std::array<std::optional<float>, mostTools> settings_; // of tools, as far as they are known
    sim::Material material_;                               // the scene's own after a reset
};

/// The saved state from which a log starts.
struct SavedOrigin {
    std::string file;       ///< absolute path
    std::uint64_t hash = 0; ///< app::SavedRun::fileHash
    bool operator==(const SavedOrigin&) const = default;
};

/// A log with the scene and the settings that it belongs to.
struct InputFile {
    std::string scene;               ///< see rememberedScene(); empty = not known
    std::optional<SavedOrigin> from; ///< instead of the reset
    std::string solver;
    std::uint32_t substeps = 0;          ///< 0 = chosen by the program
    std::optional<std::uint32_t> levels; ///< Settings::levels; this and the next are empty in older logs
    std::optional<bool> hasSharpClamp;   ///< Settings::hasSharpClamp
    std::uint32_t room = 0;              ///< least capacity for contacts; 0 = the scene's
    std::uint32_t surface = 0;           ///< triangles and vertices of the surface of cuts; 0 = the scene's
    std::optional<sim::Forms> forms;     ///< of kernels; empty = chosen by the program
    std::vector<InputEvent> events;
    std::optional<std::uint64_t> hash; ///< state at the end (see stateHash())

    std::uint64_t steps() const;
};

/// One event per line; numbers have enough digits to restore their bits.
std::string toText(const InputFile& file);
/// Throws app::Failure (badInput) that names `name` and the line.
InputFile parseInput(const std::string& text, const std::string& name);
/// Throws like parseInput().
InputFile loadInput(const std::filesystem::path& file);

} // namespace sinew::viewer
