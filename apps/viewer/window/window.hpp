// The window and what hands do in it, by GLFW. Knows no Vulkan device beyond making a surface for one.
#pragma once

#include "viewer/hands/bindings.hpp"
#include "viewer/panels/panel_input.hpp"
#include "viewer/window/display.hpp"
#include "vk/device.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace sinew::viewer {

/// Since the last poll, as actions: GLFW's keys and buttons have been looked up in the table of bindings.
struct Input {
    struct Drag {
        Action action;
        Vector2 heights; ///< x right, y down, in window heights
    };
    /// A button that drags went down or up.
    struct Press {
        Action action;
        bool isDown;
        Vector2 pointer; ///< as below
    };
    std::vector<Action> actions;
    std::vector<Press> presses;
    std::vector<Drag> drags;
    std::vector<std::string> files; ///< dropped on the window
    float notches = 0;              ///< of the wheel, forwards positive
    float growth = 0; ///< likewise of the wheel that sets the depth of the blade, or the size of the sphere
    float slide = 0;  ///< likewise of the wheel that moves the section plane
    Vector2 pointer = Vector2::Zero(); ///< from the middle, x right, y down, in window heights
    std::optional<Action> held;        ///< by modifiers alone
    bool needsRedraw = false;          ///< resized or uncovered
    PanelInput panels;                 ///< what is not in the others
    bool isEmpty() const {
        return actions.empty() && presses.empty() && drags.empty() && files.empty() && notches == 0 &&
               growth == 0 && slide == 0 && !needsRedraw;
    }
};

/// One at a time; main thread only.
class Window {
public:
    /// Throws app::Failure (noDevice) where there is no display.
    explicit Window(VkExtent2D size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions a device needs to draw here. Throws app::Failure (noDevice) where there are none.
    std::vector<std::string> surfaceExtensions() const;
    static bool canPresent(VkInstance instance, VkPhysicalDevice device, std::uint32_t family);
    /// The caller destroys it. Throws vk::Error.
    VkSurfaceKHR createSurface(VkInstance instance) const;

    /// From now on `cover` is asked first. What it refers to must outlive the last poll().
    void setCover(Cover cover);

    /// Asked for should the display go away, as watchDisplay(); until then there is none.
    void setFarewell(Farewell farewell);

    /// Handles waiting events; waits for the first one at most `seconds`.
    Input poll(double seconds);

    float scale() const;       ///< of texts, as the display wants them; 1 = 96 pixels an inch
    VkExtent2D pixels() const; ///< 0 x 0 while minimised
    /// For another one of this size, as of the last poll; in full screen, as it was before. Asks nothing of
    /// the display.
    VkExtent2D size() const;
    bool isClosing() const;
    void close();
    std::string clipboard() const; ///< empty where it holds no text
    void setClipboard(const std::string& text);
    void hide(); ///< before what takes its time to end
    void setTitle(const std::string& title);
    void toggleFullScreen();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sinew::viewer
