// Control events of a console, which the system reports on a thread of its own.
#include "app/signals.hpp"

#include <atomic>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

namespace sinew::app::signals {

namespace {

constexpr DWORD patienceMs = 1800;

Handlers installed{};
std::atomic<bool> isAsked = false;
std::atomic<unsigned> waits = 0; // a newer one makes those before it void

BOOL WINAPI answer(DWORD event) {
    if (isAsked.exchange(true)) return FALSE; // a second time: the system ends the process
    installed.interrupt();
    // The system ends the process of a closed console, or of a user who leaves, when this returns, or some
    // seconds later.
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) Sleep(INFINITE);
    return TRUE;
}

DWORD WINAPI waitThenLeave(void* number) {
    Sleep(patienceMs);
    if (waits.load() == static_cast<unsigned>(reinterpret_cast<ULONG_PTR>(number))) installed.leave();
    return 0;
}

} // namespace

void install(const Handlers& handlers) {
    ++waits;
    installed = handlers;
    isAsked = false;
    SetConsoleCtrlHandler(answer, FALSE);
    SetConsoleCtrlHandler(answer, TRUE);
}

void startWaiting() noexcept {
    const auto number = static_cast<ULONG_PTR>(++waits);
    if (const HANDLE thread =
            CreateThread(nullptr, 0, waitThenLeave, reinterpret_cast<void*>(number), 0, nullptr))
        CloseHandle(thread);
}

} // namespace sinew::app::signals
