// What the programs share at their edge: exit codes, the one-line error, and stopping on signals.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>

namespace sinew::app {

enum ExitCode : int {
    done = 0,
    wrongUsage = 2,
    badInput = 3,
    noDevice = 4,
    deviceFailed = 5, ///< lost or out of memory
    outputFailed = 6,
    diverged = 7,
    internalFault = 70,
    interrupted = 130,
};

/// A failure with its exit code; the text is "<what>: <where>: <why>: <what to do>".
class Failure : public std::runtime_error {
public:
    Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const noexcept { return code_; }

private:
    ExitCode code_;
};

/// Runs a program's body. Whatever it throws becomes one line "error: ..." on stderr and the right exit code:
/// Failure its own, mesh::ImportError 3, mesh::ExportError 6, vk::Error 4, 5 or 70, std::bad_alloc 5, all
/// else 70.
int guarded(const std::function<int()>& body) noexcept;

/// Says it in a line of that kind, with a blank for what would break the line; returns `code`.
int report(ExitCode code, std::string message) noexcept;

/// Asks SIGINT, SIGTERM, SIGHUP and SIGPIPE to set a flag instead of ending the process; SIGHUP unless it is
/// ignored.
/// A program that has not come to its end, or begun to write its outputs (Writing), 2 s later is ended then,
/// with a line on stderr and exit code 130: a device or a long computation may not come back before.
void catchSignals();
bool isInterrupted() noexcept;

/// Messages of the validation layer, counted as they come, from now on. A program that ends early for a
/// signal says then that there are some, and its exit code is that of a fault, as at its end. `messages`
/// stays as long as the program; null = none.
void watchMessages(const std::atomic<std::size_t>* messages) noexcept;
/// The sentence on so many validation messages at the end of a program.
std::string textOfMessages(std::size_t messages);

/// Calls `wait`, which waits at most as long as it is told and returns whether it is over, until it is.
/// Throws Failure (interrupted) where a signal has asked the program to end and it is not over half a second
/// later: there is then time to finish outputs, and no time for what still waits.
void waitUntil(const std::function<bool(std::chrono::nanoseconds)>& wait);

/// Says in a line that a signal has ended the program, whose outputs are whole; returns `interrupted`.
int reportInterruption() noexcept;

/// Says it as report() does and ends the program with exit code 130 at once, or 70 (watchMessages), without
/// destructors, which may wait for the device. Outputs are finished before.
[[noreturn]] void leaveInterrupted(const std::string& message) noexcept;

/// While it lives, a program that was asked to end takes the time that its outputs need. For the thread that
/// writes them; what it writes is all there, so nothing else is to be waited for. Not to be nested.
class Writing {
public:
    Writing() noexcept;
    ~Writing();
    Writing(const Writing&) = delete;
    Writing& operator=(const Writing&) = delete;
};

} // namespace sinew::app
