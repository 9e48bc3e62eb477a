// Plays a log of input: what hands did before each step goes to the tools again.
#pragma once

#include "viewer/hands/input_log.hpp"
#include "viewer/options.hpp"
#include "vk/queue.hpp"

namespace sinew::viewer {

struct Opening;
class Stage;
class Tools;

class Replay {
public:
    explicit Replay(InputFile file) : file_(std::move(file)) {}

    enum class Due {
        history, ///< something is to be undone or redone first: Tools::recordHistory
        shape,   ///< all is to be finished, then Stage::reshape() and Tools::reshaped()
        step,    ///< a step is to be recorded
        nothing  ///< all is done
    };
    /// Does what is to be done until something is to be recorded; after that is, call it again. Throws
    /// app::Failure (badInput) where the log is of another scene.
    Due next(Tools& tools, Camera& camera, Stage& stage);

    void restart() {
        at_ = 0;
        taken_ = 0;
    }

    const InputFile& file() const { return file_; }

private:
    InputFile file_;
    std::size_t at_ = 0;      // of the events
    std::uint32_t taken_ = 0; // steps of that one
};

/// FNV-1a (64 bits) of the bytes of positions, then velocities: the state_hash of a report. Waits for
/// `queue`, in which all was submitted. Throws vk::Error.
std::uint64_t stateHash(const vk::Device& device, const Stage& stage, vk::Queue& queue);

/// The scene that the log is of, with what was asked for over it; what the command line says goes first.
Options withReplay(Options options, const InputFile& file);
/// Hands for the tools, and room for contacts as there was: for a log that begins from a state
/// Stage::widen(roomOf()) makes that, once the state is there. Throws app::Failure (badInput) where the log
/// begins from another state than the one that was opened.
void prepareForReplay(Opening& opening, const InputFile& file);
sim::Settings roomOf(const InputFile& file);

/// "state hash 0123456789abcdef after 240 steps".
std::string hashText(std::uint64_t hash, std::uint64_t steps);
/// The same with ", as recorded" or ", not as recorded: ..."; of another number of steps than were recorded
/// nothing is known, and it says so.
std::string hashText(std::uint64_t hash, std::uint64_t steps, const InputFile& recorded);

} // namespace sinew::viewer
