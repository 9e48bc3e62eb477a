// Finds Xlib's functions at run time: the viewer does not link Xlib; GLFW does, or loads it.
#include "viewer/ui/display.hpp"

#include "app/guard.hpp"

#include <dlfcn.h>
#include <sys/socket.h>
#include <unistd.h>

#include <exception>

namespace sinew::viewer {

namespace {

template <typename Function> Function find(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

// Ends the program at once: Xlib would call exit() while other threads run. Xlib could continue, but GLFW
// cannot.
[[noreturn]] void leave(const std::string& kept) {
    _exit(
        app::report(app::noDevice,
                    "the window was closed: its display went away: open it again on another display" + kept));
}

[[noreturn]] void leaveWith(void* /*display*/, void* farewell) {
    const auto& keep = *static_cast<const Farewell*>(farewell);
    std::string kept;
    try {
        if (keep) kept = keep();
    } catch (const std::exception& error) { // it must not reach Xlib
        kept = std::string(": nothing was saved: ") + error.what();
    }
    leave(kept);
}

int leaveAtOnce(void* /*display*/) {
    leave({});
}

// Prints nothing; Xlib calls leaveWith() next.
int keepQuiet(void* /*display*/) {
    return 0;
}

void* openDisplay() {
    const auto open = find<void* (*)()>("glfwGetX11Display");
    return open ? open() : nullptr;
}

} // namespace

void watchDisplay(const Farewell& farewell) {
    using Handler = int (*)(void* display);
    using ExitHandler = void (*)(void* display, void* data);
    const auto set = find<Handler (*)(Handler)>("XSetIOErrorHandler");
    const auto setExit = find<void (*)(void* display, ExitHandler, void* data)>("XSetIOErrorExitHandler");
    void* const display = openDisplay();
    if (!set || display == nullptr) return;
    set(setExit ? keepQuiet : leaveAtOnce);
    if (setExit) setExit(display, leaveWith, const_cast<Farewell*>(&farewell));
}

void widenDisplay() {
    constexpr int wide = 4 << 20; // [bytes]: a picture of 1280 x 720; net.core.wmem_max may grant less
    const auto connection = find<int (*)(void* display)>("XConnectionNumber");
    void* const display = openDisplay();
    if (connection && display != nullptr)
        setsockopt(connection(display), SOL_SOCKET, SO_SNDBUF, &wide, sizeof(wide)); // slower on failure
}

} // namespace sinew::viewer
