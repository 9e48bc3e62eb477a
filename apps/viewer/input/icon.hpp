// Icons of the toolbar (ui/icons.cpp draws them).
#pragma once

namespace sinew::viewer {

enum class Icon {
    none, ///< the letter of the key is shown instead
    grab,
    cut,
    poke,
    pin,
    inside,
    undo,
    redo,
    reset,
};

} // namespace sinew::viewer
