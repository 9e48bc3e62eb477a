// The X server that the window is on, where there is one.
#pragma once

namespace sinew::viewer {

/// After GLFW was initialised: from now on the program ends at once when its X server goes away, with one
/// line and app::noDevice. Pictures are whole or not there, for they get their names when they are; a film's
/// encoder sees the end of its pipe and closes its file, which keeps the name that it has while it is made.
/// Where GLFW has not loaded Xlib, nothing changes.
void watchDisplay();

/// After GLFW was initialised: a software device hands its pictures to an X server without DRI3 through the
/// connection's socket, and waits as often as that is full. From now on as much of one fits as the system
/// lets it. Where GLFW has not loaded Xlib, nothing changes.
void widenDisplay();

} // namespace sinew::viewer
