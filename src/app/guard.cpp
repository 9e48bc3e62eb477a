// The table from exceptions to exit codes, and the signals that ask a run to end.
#include "app/guard.hpp"

#include "mesh/export.hpp"
#include "mesh/import.hpp"
#include "vk/check.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>

namespace sinew::app {

namespace {

// Written by the handler: the one thing a signal handler may do portably.
volatile std::sig_atomic_t interruptions = 0;

extern "C" void countInterruption(int) {
    interruptions = 1;
}

bool isIgnored(int signal) {
    struct sigaction now {};
    return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
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
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        if (signal == SIGHUP && isIgnored(signal)) continue; // nohup: the run outlives its terminal
        struct sigaction action {};
        action.sa_handler = countInterruption;
        // Once: whoever asks a second time wants the process gone.
        action.sa_flags = signal == SIGPIPE ? SA_RESTART : static_cast<int>(SA_RESTART | SA_RESETHAND);
        sigaction(signal, &action, nullptr);
    }
}

bool isInterrupted() noexcept {
    return interruptions != 0;
}

} // namespace sinew::app
