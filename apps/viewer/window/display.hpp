// The X server that the window is on, where there is one.
#pragma once

#include <functional>
#include <string>

namespace sinew::viewer {

/// What is done before the program ends; what it returns ends the line that is said. Empty = nothing.
using Farewell = std::function<std::string()>;

/// After GLFW was initialised: from now on the program ends when its X server goes away, with `farewell`, one
/// line and app::noDevice. `farewell` is asked for in the thread that GLFW is used in, in the middle of a
/// call of it: it must ask nothing of GLFW, and stay where it is until GLFW is terminated. Pictures are whole
/// or not there, for they get their names when they are; a film's encoder sees the end of its pipe and closes
/// its file, which keeps the name that it has while it is made. Before libX11 1.7 there is no farewell. Where
/// GLFW has not loaded Xlib, nothing changes.
void watchDisplay(const Farewell& farewell);

/// After GLFW was initialised: a software device hands its pictures to an X server without DRI3 through the
/// connection's socket, and waits as often as that is full. From now on as much of one fits as the system
/// lets it. Where GLFW has not loaded Xlib, nothing changes.
void widenDisplay();

} // namespace sinew::viewer
