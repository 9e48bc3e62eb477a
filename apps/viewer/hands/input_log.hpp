// What hands did to a scene since its reset, or since a saved state, step by step, to be done again: camera,
// pointer, presses, keys, and what was found under a press. The same events lead a simulation of the same
// scene to the same bits.
#pragma once

#include "sim/material.hpp"
#include "viewer/hands/bindings.hpp"
#include "viewer/hands/pick.hpp"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace sinew::viewer {

/// Where the pointer is, as Input::pointer.
struct Pointed {
    Vector2 at = Vector2::Zero();
    bool operator==(const Pointed&) const = default;
};
/// The button that grabs, cuts or pokes went down or up.
struct Pressed {
    bool isDown = false;
    Vector2 at = Vector2::Zero();
    bool operator==(const Pressed&) const = default;
};
/// What a tool's question met, as Tools::answer.
struct Answered {
    Question::Asker asker = Question::Asker::hand;
    std::optional<Pick> pick;
    float radius = 0;
    bool operator==(const Answered&) const = default;
};
/// Downwards, from here on [m/s^2].
struct Pulled {
    float gravity = 0;
    bool operator==(const Pulled&) const = default;
};
/// The scene has this material from here on.
struct Turned {
    sim::Material material;
    bool operator==(const Turned&) const = default;
};
/// Another simulation goes on from here, with this solver and so many substeps, and with the material that
/// was turned last. There is no way back step by step from it.
struct Shaped {
    sim::Solver solver = sim::Solver::split;
    std::uint32_t substeps = 0;
    bool operator==(const Shaped&) const = default;
};
/// The sphere that pokes has this radius from here on [m].
struct Sized {
    float radius = 0;
    bool operator==(const Sized&) const = default;
};
/// The blade goes this deep from here on [m]; nothing = through.
struct Deepened {
    std::optional<float> depth;
    bool operator==(const Deepened&) const = default;
};
/// States to go back to were lost, or those to go back to step by step alone.
struct Forgot {
    bool areOfSteps = false;
    bool operator==(const Forgot&) const = default;
};
/// Steps with what came before them; none = something was undone or redone without one.
struct Stepped {
    std::uint32_t count = 0;
    bool operator==(const Stepped&) const = default;
};
using InputEvent = std::variant<Camera, Pointed, Pressed, Action, Answered, Pulled, Turned, Shaped, Sized,
                                Deepened, Forgot, Stepped>;

/// Collects them; what changes nothing is left out.
class InputLog {
public:
    /// Begins anew, at a reset.
    void restart();
    /// Begins where there is this material already.
    void begin(const sim::Material& material) { material_ = material; }

    void look(const Camera& camera);
    void point(const Vector2& pointer);
    void press(bool isDown, const Vector2& pointer);
    void key(Action action);
    void answer(Answered answer);
    void pull(float gravity);
    void turn(const sim::Material& material);
    void shape(const Shaped& shaped);
    void size(float radius);
    void deepen(const std::optional<float>& depth);
    void forget(const Forgot& forgot = {});
    /// A step was recorded.
    void step();
    /// Something was undone or redone.
    void goBack();
    /// The last so many steps were undone by the device, and will be taken again.
    void takeBack(std::uint64_t steps);

    const std::vector<InputEvent>& events() const { return events_; }
    /// Whether there is more from that one on than steps and looks around.
    bool hasDeeds(std::size_t first) const;

private:
    std::vector<InputEvent> events_;
    std::optional<Camera> camera_;
    std::optional<Pointed> pointed_; // nothing: the next one counts, wherever it is
    std::optional<float> gravity_, radius_, depth_;
    sim::Material material_; // as at a reset, the scene's own
};

/// A saved state that a log begins from.
struct SavedOrigin {
    std::string file;       ///< from the root
    std::uint64_t hash = 0; ///< app::SavedRun::fileHash
    bool operator==(const SavedOrigin&) const = default;
};

/// A log and what it is of.
struct InputFile {
    std::string scene;               ///< as rememberedScene(); empty = not said
    std::optional<SavedOrigin> from; ///< instead of the reset
    std::string solver;
    std::uint32_t substeps = 0; ///< 0 = chosen
    std::uint32_t room = 0;     ///< of contacts, at least; 0 = as the scene says
    std::uint32_t surface = 0;  ///< triangles and vertices of the surface of cuts, likewise
    std::vector<InputEvent> events;
    std::optional<std::uint64_t> hash; ///< of the state at the end, as stateHash()

    std::uint64_t steps() const;
};

/// One event a line; numbers in as many digits as bring their bits back.
std::string toText(const InputFile& file);
/// Throws app::Failure (badInput) that names `name` and the line.
InputFile parseInput(const std::string& text, const std::string& name);
/// Likewise.
InputFile loadInput(const std::filesystem::path& file);

} // namespace sinew::viewer
