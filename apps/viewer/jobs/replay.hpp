// Plays an input log: passes the logged input before each step to the tools.
#pragma once

#include "sinew/vk/queue.hpp"
#include "viewer/input/input_log.hpp"
#include "viewer/jobs/options.hpp"

namespace sinew::viewer {

struct OpenedScene;
class Document;
class Tools;

class Replay {
public:
    explicit Replay(InputFile file) : file_(std::move(file)) {}

    enum class Due {
        history, ///< record an undo or a redo first: Tools::recordHistory
        shape,   ///< finish all commands, then Document::reshape() and Tools::reshaped()
        step,    ///< record a step
        nothing  ///< the log has ended
    };
    /// Plays events until commands must be recorded; call it again after that. Throws app::Failure (badInput)
    /// if the log belongs to another scene.
    Due next(Tools& tools, Camera& camera, Document& document);

    void restart() {
        at_ = 0;
        taken_ = 0;
    }

    const InputFile& file() const { return file_; }

private:
    InputFile file_;
    std::size_t at_ = 0;      // index of the event
    std::uint32_t taken_ = 0; // steps taken of that event
};

/// FNV-1a (64 bits) of the bytes of positions, then velocities: the state_hash of a report. Waits for
/// `queue`, in which everything was submitted. Throws vk::Error.
std::uint64_t stateHash(const vk::Device& device, const Document& document, vk::Queue& queue);

/// Options for the scene of the log, with its settings; options of the command line have priority.
Options withReplay(Options options, const InputFile& file);
/// Prepares the opening for the tools and capacities of the log; for a log that begins from a state,
/// Document::widen(roomOf()) sets the capacities once the state is loaded. Throws app::Failure (badInput) if
/// the log begins from another state than the opened one.
void prepareForReplay(OpenedScene& opening, const InputFile& file);
sim::Settings roomOf(const InputFile& file);

/// "state hash 0123456789abcdef after 240 steps".
std::string hashText(std::uint64_t hash, std::uint64_t steps);
/// hashText() followed by ", as recorded" or ", not as recorded: ..."; for another number of steps than
/// recorded it says that nothing is known.
std::string hashText(std::uint64_t hash, std::uint64_t steps, const InputFile& recorded);

} // namespace sinew::viewer
