// A display that goes away while the window is open.
#pragma once

namespace sinew::viewer {

/// After GLFW was initialised: from now on the program ends at once when its display goes away, with one line
/// and app::noDevice. Pictures are whole or not there, for they get their names when they are; a film's
/// encoder sees the end of its pipe and closes it.
void watchDisplay();

} // namespace sinew::viewer
