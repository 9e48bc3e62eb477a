// Signals of POSIX, with the interval timer for the wait.
#include "app/signals.hpp"

#include <csignal>
#include <initializer_list>

#include <sys/time.h>

namespace sinew::app::signals {

namespace {

constexpr itimerval patience{.it_interval = {}, .it_value = {.tv_sec = 1, .tv_usec = 800'000}};

Handlers installed{};

extern "C" void countInterruption(int) {
    installed.interrupt();
}

extern "C" void endWaiting(int) {
    installed.leave();
}

bool isIgnored(int signal) {
    struct sigaction now {};
    return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

} // namespace

void install(const Handlers& handlers) {
    constexpr itimerval none{};
    setitimer(ITIMER_REAL, &none, nullptr);
    installed = handlers;
    struct sigaction ending {};
    ending.sa_handler = endWaiting;
    ending.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &ending, nullptr);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        if (signal == SIGHUP && isIgnored(signal)) continue; // nohup: the run outlives its terminal
        struct sigaction action {};
        action.sa_handler = countInterruption;
        // Once: whoever asks a second time wants the process gone.
        action.sa_flags = signal == SIGPIPE ? SA_RESTART : static_cast<int>(SA_RESTART | SA_RESETHAND);
        sigaction(signal, &action, nullptr);
    }
}

// A system call and nothing else.
void startWaiting() noexcept {
    setitimer(ITIMER_REAL, &patience, nullptr);
}

} // namespace sinew::app::signals
