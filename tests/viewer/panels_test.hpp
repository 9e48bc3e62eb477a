// Panels without a device, for tests: facts of a scene, pictures and clicks.
#pragma once

#include "viewer/ui/panels.hpp"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace sinew::viewer {

inline constexpr VkExtent2D large{1280, 720}, small{640, 400};

inline SceneFacts someScene() {
    return {.name = "organ",
            .device = "llvmpipe",
            .driver = "Mesa",
            .isSoftware = true,
            .particles = 4211,
            .constraints = 50'000,
            .substepsWhy = "32 substeps: as asked",
            .passes = {{"solve", "gather_lattice", 32, 4224, false}},
            .dispatches = 34,
            .skipped = {"bends"},
            .canCut = true};
}

// The window of a name, if it is drawn.
inline const ImGuiWindow* shownWindow(const char* name) {
    const ImGuiWindow* window = ImGui::FindWindowByName(name);
    return window != nullptr && window->Active && !window->Hidden ? window : nullptr;
}

class PanelsTest : public testing::Test {
protected:
    // Clicks the left button at a point, over as many pictures as needed.
    Wishes click(const Vector2& at, VkExtent2D extent = large) {
        if (areSectionsOpen) panels.fold({}); // an earlier click may have folded one
        PanelInput input{.pointer = at};
        picture(input, extent);
        input.isDown[0] = true;
        input.presses[0] = 1;
        Wishes wishes = picture(input, extent);
        input.isDown[0] = false;
        input.presses[0] = 0;
        const Wishes after = picture(input, extent);
        wishes.actions.insert(wishes.actions.end(), after.actions.begin(), after.actions.end());
        if (after.device) wishes.device = after.device;
        if (after.knobs) wishes.knobs = after.knobs;
        return wishes;
    }
    Wishes picture(const PanelInput& input = {}, VkExtent2D extent = large) {
        return panels.build(scene, facts, input, extent, 1.0 / 60);
    }
    // Builds two pictures, because Dear ImGui measures sizes in the first.
    void settle(VkExtent2D extent = large) {
        if (areSectionsOpen) panels.fold({});
        picture({}, extent);
        picture({}, extent);
    }

    Panels panels{1};
    SceneFacts scene = someScene();
    Facts facts;
    bool areSectionsOpen = true; // before every click
};

} // namespace sinew::viewer
