// The window and its input events, through GLFW. Its only use of Vulkan is to make a surface.
#pragma once

#include "sinew/vk/device.hpp"
#include "viewer/hands/bindings.hpp"
#include "viewer/panels/panel_input.hpp"
#include "viewer/window/display.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace sinew::viewer {

/// Events since the last poll, as actions: keys and buttons are already looked up in the table of bindings.
struct Input {
    struct Drag {
        Action action;
        Vector2 heights; ///< x right, y down, in window heights
    };
    /// A press or release of a button that drags.
    struct Press {
        Action action;
        bool isDown;
        Vector2 pointer; ///< see `pointer` below
    };
    std::vector<Action> actions;
    std::vector<Press> presses;
    std::vector<Drag> drags;
    std::vector<std::string> files; ///< dropped on the window
    float notches = 0;              ///< of the wheel, forwards positive
    float growth = 0; ///< of the wheel for the blade's depth or the sphere's size, forwards positive
    float slide = 0;  ///< of the wheel for the section plane, forwards positive
    Vector2 pointer = Vector2::Zero(); ///< from the middle, x right, y down, in window heights
    std::optional<Action> held;        ///< by modifiers alone
    bool needsRedraw = false;          ///< resized or uncovered
    PanelInput panels;                 ///< all other events
    bool isEmpty() const {
        return actions.empty() && presses.empty() && drags.empty() && files.empty() && notches == 0 &&
               growth == 0 && slide == 0 && !needsRedraw;
    }
};

/// Only one may exist; main thread only.
class Window {
public:
    /// Throws app::Failure (noDevice) if there is no display.
    explicit Window(VkExtent2D size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions that a device needs to draw here. Throws app::Failure (noDevice) if there are
    /// none.
    std::vector<std::string> surfaceExtensions() const;
    static bool canPresent(VkInstance instance, VkPhysicalDevice device, std::uint32_t family);
    /// The caller destroys it. Throws vk::Error.
    VkSurfaceKHR createSurface(VkInstance instance) const;

    /// Asks `cover` first for each event from now on. Its references must outlive the last poll().
    void setCover(Cover cover);

    /// Sets the function called if the display goes away (see watchDisplay()); none at first.
    void setFarewell(Farewell farewell);

    /// Handles pending events; waits at most `seconds` for the first one.
    Input poll(double seconds);

    float scale() const;       ///< of texts, as the display requests; 1 = 96 pixels per inch
    VkExtent2D pixels() const; ///< 0 x 0 while minimised
    /// Size for another window like this one, at the last poll; in full screen, the size before it. Does not
    /// query the display.
    VkExtent2D size() const;
    bool isClosing() const;
    void close();
    std::string clipboard() const; ///< empty if it holds no text
    void setClipboard(const std::string& text);
    void hide(); ///< before a slow end of the program
    void setTitle(const std::string& title);
    void toggleFullScreen();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sinew::viewer
