// How the system tells a program that it should end. signals_posix.cpp and signals_windows.cpp implement it.
#pragma once

namespace sinew::app::signals {

/// Functions that a system calls. Both are safe in signal handlers and on other threads.
struct Handlers {
    void (*interrupt)() noexcept; ///< somebody asked the program to end
    void (*leave)() noexcept;     ///< the time that startWaiting() began is over
};

/// Ends a wait that has begun, and calls `handlers` from now on. Whoever asks a second time ends the program.
void install(const Handlers& handlers);

/// Lets `leave` be called 1.8 s later. Safe in signal handlers.
void startWaiting() noexcept;

} // namespace sinew::app::signals
