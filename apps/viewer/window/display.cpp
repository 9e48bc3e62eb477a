// The viewer does not link Xlib: GLFW does, or loads it.
#include "viewer/window/display.hpp"

#include "app/guard.hpp"

#include <dlfcn.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string_view>

namespace sinew::viewer {

namespace {

constexpr std::string_view message =
    "error: the window was closed: its display went away: open it again on another display\n";

template <typename Function> Function find(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

// Xlib ends a program whose display has gone with exit(), in the middle of whatever its other threads do. It
// can go on instead, but GLFW cannot.
int end(void* /*display*/) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
    _exit(app::noDevice);
}

} // namespace

void watchDisplay() {
    using Handler = int (*)(void* display);
    if (const auto set = find<Handler (*)(Handler)>("XSetIOErrorHandler")) set(end);
}

void widenDisplay() {
    constexpr int wide = 4 << 20; // [bytes]: a picture of 1280 x 720; net.core.wmem_max may grant less
    const auto open = find<void* (*)()>("glfwGetX11Display");
    const auto connection = find<int (*)(void* display)>("XConnectionNumber");
    void* display = open && connection ? open() : nullptr;
    if (display != nullptr)
        setsockopt(connection(display), SOL_SOCKET, SO_SNDBUF, &wide, sizeof(wide)); // slower without
}

} // namespace sinew::viewer
