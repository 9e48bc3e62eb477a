// The X server of the window, if there is one.
#pragma once

#include <functional>
#include <string>

namespace sinew::viewer {

/// Called before the program ends; returns the end of its last line, or an empty text.
using Farewell = std::function<std::string()>;

/// Call after GLFW was initialised. From then on, when the X server goes away, the program ends with
/// `farewell`, one line and app::noDevice. `farewell` runs in the thread that uses GLFW, inside one of its
/// calls: it must not call GLFW, and must stay valid until GLFW is terminated. Picture files are whole or
/// missing, since they are renamed when complete; a film's encoder sees the end of its pipe and closes its
/// file, which keeps its temporary name. Before libX11 1.7 `farewell` is not called. If GLFW has not loaded
/// Xlib, nothing changes.
void watchDisplay(const Farewell& farewell);

/// Call after GLFW was initialised. Enlarges the send buffer of the X connection as far as the system allows:
/// without DRI3 a software device sends its pictures through that socket and waits whenever it is full. If
/// GLFW has not loaded Xlib, nothing changes.
void widenDisplay();

} // namespace sinew::viewer
