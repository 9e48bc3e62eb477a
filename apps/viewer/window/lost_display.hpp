// A display that goes away while the window is open.
#pragma once

namespace sinew::viewer {

/// After GLFW was initialised: from now on the program ends at once when its X server goes away, with one
/// line and app::noDevice. Pictures are whole or not there, for they get their names when they are; a film's
/// encoder sees the end of its pipe and closes its file, which keeps the name that it has while it is made.
/// Where GLFW has not loaded Xlib, nothing changes.
void watchDisplay();

} // namespace sinew::viewer
