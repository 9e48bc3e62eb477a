// The window and its input events, through GLFW. Its only use of Vulkan is to make a surface.
#pragma once

#include "sinew/vk/device.hpp"
#include "viewer/input/input.hpp"
#include "viewer/ui/display.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace sinew::viewer {

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
