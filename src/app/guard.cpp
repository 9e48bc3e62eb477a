// The table from exceptions to exit codes, and what happens when a signal asks a run to end.
#include "app/guard.hpp"

#include "app/signals.hpp"
#include "mesh/export.hpp"
#include "mesh/import.hpp"
#include "sinew/vk/check.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <unistd.h>

namespace sinew::app {

namespace {

constexpr std::chrono::milliseconds patienceForWaits{500}, betweenLooks{50};

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interruptions = 0, writings = 0;
std::atomic<const std::atomic<std::size_t>*> watched = nullptr;
std::atomic<Clock::rep> interruptedAt = 0; // of the first signal; lock-free, so that handlers may set it
static_assert(std::atomic<Clock::rep>::is_always_lock_free && std::atomic<std::size_t>::is_always_lock_free);

std::size_t messagesSoFar() {
    const std::atomic<std::size_t>* const messages = watched.load();
    return messages == nullptr ? 0 : messages->load();
}

// Neither destructors nor threads: they may wait for the device.
void leave() noexcept {
    if (writings != 0) return;
    constexpr char line[] = "error: interrupted: the running work did not end within 2 s: nothing more was "
                            "written\n";
    [[maybe_unused]] auto written = write(STDERR_FILENO, line, sizeof line - 1);
    if (messagesSoFar() == 0) _exit(interrupted);
    constexpr char more[] =
        "error: the validation layer complained: see the messages above: please report them\n";
    written = write(STDERR_FILENO, more, sizeof more - 1);
    _exit(internalFault);
}

void noteInterruption() noexcept {
    if (interruptions == 0) interruptedAt = Clock::now().time_since_epoch().count();
    interruptions = 1;
    signals::startWaiting();
}

ExitCode codeOf(vk::Failure failure) {
    switch (failure) {
    case vk::Failure::noDevice:
        return noDevice;
    case vk::Failure::outOfMemory:
    case vk::Failure::deviceLost:
        return deviceFailed;
    case vk::Failure::misuse:
        return internalFault;
    }
    return internalFault;
}

int translate() {
    try {
        throw;
    } catch (const Failure& error) {
        return report(error.code(), error.what());
    } catch (const mesh::ImportError& error) { // scenes::SceneError is one
        return report(badInput, error.what());
    } catch (const mesh::ExportError& error) {
        return report(outputFailed, error.what());
    } catch (const vk::Error& error) {
        return report(codeOf(error.failure()), error.what());
    } catch (const std::bad_alloc&) {
        return report(deviceFailed, "out of memory: make the scene smaller");
    } catch (const std::exception& error) {
        return report(internalFault, std::string("internal fault: ") + error.what() + ": please report it");
    } catch (...) {
        return report(internalFault, "internal fault: an unknown exception: please report it");
    }
}

} // namespace

int report(ExitCode code, std::string message) noexcept {
    std::ranges::replace_if(
        message, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }, ' ');
    std::fprintf(stderr, "error: %s\n", message.c_str());
    return code;
}

int guarded(const std::function<int()>& body) noexcept {
    try {
        return body();
    } catch (...) {
        try {
            return translate();
        } catch (...) { // no memory left for the message itself
            std::fputs("error: out of memory: make the scene smaller\n", stderr);
            return deviceFailed;
        }
    }
}

void catchSignals() {
    interruptions = 0;
    signals::install({.interrupt = noteInterruption, .leave = leave});
}

bool isInterrupted() noexcept {
    return interruptions != 0;
}

void waitUntil(const std::function<bool(std::chrono::nanoseconds)>& wait) {
    while (!wait(betweenLooks))
        if (isInterrupted() &&
            Clock::now().time_since_epoch() - Clock::duration(interruptedAt.load()) >= patienceForWaits)
            throw Failure(interrupted, "interrupted: a running step did not end in time: outputs "
                                       "end with the step before it");
}

int reportInterruption() noexcept {
    return report(interrupted, "interrupted: outputs are whole and end with the last finished step");
}

void watchMessages(const std::atomic<std::size_t>* messages) noexcept {
    watched = messages;
}

std::string textOfMessages(std::size_t messages) {
    return "the validation layer complained: " + std::to_string(messages) +
           " messages above: please report them";
}

void leaveInterrupted(const std::string& message) noexcept {
    std::fflush(stdout);
    int code = report(interrupted, message);
    if (const std::size_t messages = messagesSoFar(); messages > 0)
        code = report(internalFault, textOfMessages(messages));
    std::_Exit(code);
}

Writing::Writing() noexcept {
    writings = 1;
}

Writing::~Writing() {
    writings = 0;
    if (isInterrupted()) signals::startWaiting();
}

} // namespace sinew::app
