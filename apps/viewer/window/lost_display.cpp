// Xlib ends a program whose display has gone with exit(), in the middle of whatever its other threads do. It
// can go on instead, but GLFW cannot. The viewer does not link Xlib: GLFW does.
#include "viewer/window/lost_display.hpp"

#include "app/guard.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <string_view>

namespace sinew::viewer {

namespace {

constexpr std::string_view message =
    "error: the window was closed: its display went away: open it again on another display\n";

int end(void* /*display*/) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
    _exit(app::noDevice);
}

} // namespace

void watchDisplay() {
    using Handler = int (*)(void* display);
    using SetHandler = Handler (*)(Handler);
    if (const auto set = reinterpret_cast<SetHandler>(dlsym(RTLD_DEFAULT, "XSetIOErrorHandler"))) set(end);
}

} // namespace sinew::viewer
