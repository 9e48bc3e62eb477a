// References that the parts of a ScenePlayer have in common, and what they ask of its loop.
#pragma once

#include "viewer/document/document.hpp"
#include "viewer/input/controller.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/jobs/prepared_player.hpp"
#include "viewer/player/session.hpp"
#include "viewer/tools/tools.hpp"

#include <cstdio>
#include <functional>

namespace sinew::viewer {

/// Prints a line on the standard output, at once.
inline void printLine(const std::string& text) {
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
}

/// All of it outlives the parts.
struct PlayerContext {
    Session& session;
    const vk::Device& device;
    const OpenedScene& opening;
    PreparedPlayer& prepared;
    Document& document;
    Controller& controller;
    Tools& tools;
    std::function<void()> settleAll; ///< waits for all pictures on their way and takes their results
    std::function<void()> redraw;    ///< makes a picture due, although nothing moves
    std::function<void()>
        wentBack; ///< the state of the document is an earlier one: pictures on their way are void
};

} // namespace sinew::viewer
