// Converts GLFW's callbacks to Input.
#include "viewer/ui/window.hpp"

#include "app/guard.hpp"
#include "sinew/vk/check.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr double mostBetweenClicks = 0.4; // [s]
constexpr float farthestClick = 4;        // from the first click [screen coordinates]

[[noreturn]] void failWithoutDisplay() {
    const char* why = nullptr;
    glfwGetError(&why);
    throw app::Failure(app::noDevice, std::string("cannot open a window: no display: ") +
                                          (why ? why : "unknown cause") +
                                          ": use --headless --frames N --out DIR");
}

// Looks letters up by the keyboard layout, not by their place on an American keyboard.
int layoutKey(int key, int scancode) {
    if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return key; // digits by place, whatever the layout
    const char* name = glfwGetKeyName(key, scancode);
    const bool isOneLetter = name != nullptr && name[0] != '\0' && name[1] == '\0';
    return isOneLetter ? std::toupper(static_cast<unsigned char>(name[0])) : key;
}

} // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    Input input;
    Cover cover;
    std::array<bool, 3> isDownInPanel{};
    bool wasCovered = false; // the pointer
    std::optional<Action> dragged;
    int dragButton = 0;
    std::optional<std::optional<Action>> heldAtPress; // at the first press since the last poll
    int clicked = -1;                                 // button of the last press; -1 after a double click
    double clickTime = 0;                             // [s]
    std::uint64_t polls = 0, clickPoll = 0;
    Vector2 clickPlace = Vector2::Zero();
    Vector2 cursor = Vector2::Zero();        // screen coordinates
    int x = 0, y = 0, width = 0, height = 0; // of the window, except full screen
    // From events: a query would cost round trips to the display server, several per picture.
    int nowWidth = 0, nowHeight = 0, pixelsWide = 0, pixelsHigh = 0;
    bool isIconified = false;
    Farewell farewell;

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

    float windowHeight() const { return static_cast<float>(std::max(nowHeight, 1)); }

    // From the middle, in window heights.
    Vector2 pointer() const {
        return (cursor - 0.5f * Vector2(static_cast<float>(nowWidth), static_cast<float>(nowHeight))) /
               windowHeight();
    }

    // From the upper left corner of the picture [pixels].
    Vector2 pixels() const { return static_cast<float>(pixelsHigh) / windowHeight() * cursor; }

    // Modifiers that are down: GLFW reports them only with keys and buttons.
    int modifiers() const {
        const auto isDown = [this](int left, int right) {
            return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
        };
        return (isDown(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) ? GLFW_MOD_SHIFT : 0) |
               (isDown(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT) ? GLFW_MOD_ALT : 0);
    }

    std::optional<Action> held() const {
        const bool isControlDown = glfwGetKey(window, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                                   glfwGetKey(window, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
        return heldWith(isControlDown ? GLFW_MOD_CONTROL : 0);
    }

    std::optional<Action> heldWith(int modifiers) const {
        if ((modifiers & GLFW_MOD_CONTROL) == 0 || cover.takesKeys()) return std::nullopt;
        return actionFor({Trigger::Kind::held, 0, GLFW_MOD_CONTROL});
    }

    bool isCovered() const { return cover.holds(pixels()); }

    // Whether a key belongs to the panels: in GLFW, codes of keys that type a letter are below that of Esc.
    bool isTyped(int key, int modifiers) const {
        const bool isLetter =
            (key < GLFW_KEY_ESCAPE && (modifiers & GLFW_MOD_CONTROL) == 0) || key == GLFW_KEY_BACKSPACE;
        return cover.takesKeys() || (isLetter && cover.takesLetters());
    }

    void onKey(int key, int scancode, int event, int modifiers) {
        input.panels.modifiers = modifiers;
        const bool isOfPanels = isTyped(key, modifiers);
        if (event == GLFW_RELEASE || isOfPanels) {
            input.panels.keys.emplace_back(key, event != GLFW_RELEASE);
            input.panels.isTouched = input.panels.isTouched || isOfPanels;
            return;
        }
        const auto action = actionFor({Trigger::Kind::key, layoutKey(key, scancode), modifiers});
        if (action && (event == GLFW_PRESS || *action == Action::step)) input.actions.push_back(*action);
    }

    void onCharacter(unsigned character) {
        if (!cover.takesKeys() && !cover.takesLetters()) return;
        input.panels.characters.push_back(character);
        input.panels.isTouched = true;
    }

    // The receiver of a press also gets the release.
    bool isOfPanels(int button, int event) {
        if (button < 0 || button >= static_cast<int>(isDownInPanel.size())) return false;
        const auto b = static_cast<std::size_t>(button);
        const bool isTheirs = event == GLFW_PRESS ? !dragged && isCovered() : isDownInPanel[b];
        if (!isTheirs) return false;
        isDownInPanel[b] = event == GLFW_PRESS;
        input.panels.presses[b] += event == GLFW_PRESS ? 1 : 0;
        return input.panels.isTouched = true;
    }

    void onButton(int button, int event, int modifiers) {
        input.panels.modifiers = modifiers;
        if (isOfPanels(button, event)) return;
        if (event == GLFW_PRESS && !heldAtPress) heldAtPress = heldWith(modifiers);
        if (event == GLFW_PRESS) countClick(button, modifiers);
        if (event == GLFW_PRESS && !dragged) {
            dragged = actionFor({Trigger::Kind::drag, button, modifiers});
            dragButton = button;
            if (dragged) input.presses.push_back({*dragged, true, pointer()});
        } else if (event == GLFW_RELEASE && button == dragButton && dragged) {
            input.presses.push_back({*dragged, false, pointer()});
            dragged.reset();
        }
    }

    // Detects double clicks, which GLFW does not. GLFW gives no event times, so presses from one poll or from
    // two successive polls count as fast, even if pictures take long.
    void countClick(int button, int modifiers) {
        const double now = glfwGetTime();
        const bool isSoon = now - clickTime < mostBetweenClicks || polls - clickPoll <= 1;
        const bool isSecond = button == clicked && isSoon && (cursor - clickPlace).norm() < farthestClick;
        clicked = isSecond ? -1 : button;
        clickTime = now;
        clickPoll = polls;
        clickPlace = cursor;
        if (!isSecond) return;
        if (const auto action = actionFor({Trigger::Kind::doubleClick, button, modifiers}))
            input.actions.push_back(*action);
    }

    void onMove(double toX, double toY) {
        const Vector2 to(static_cast<float>(toX), static_cast<float>(toY));
        if (dragged) input.drags.push_back({*dragged, (to - cursor) / windowHeight()});
        cursor = to;
        if ((cursor - clickPlace).norm() >= farthestClick) clicked = -1; // a drag is no click
        const bool isOver = isCovered() || isDownInPanel != std::array<bool, 3>{};
        input.panels.isTouched = input.panels.isTouched || isOver || wasCovered;
        wasCovered = isOver;
    }

    void onWheel(double notches) {
        if (isCovered()) {
            input.panels.notches += static_cast<float>(notches);
            input.panels.isTouched = true;
            return;
        }
        const auto action = actionFor({Trigger::Kind::wheel, 0, modifiers()});
        float& turned = action == Action::toolSize      ? input.growth
                        : action == Action::moveSection ? input.slide
                                                        : input.notches;
        turned += static_cast<float>(notches);
    }

    void listen() {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int event, int modifiers) {
            of(w).onKey(key, scancode, event, modifiers);
        });
        glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) { of(w).onCharacter(character); });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int event, int modifiers) {
            of(w).onButton(button, event, modifiers);
        });
        glfwSetCursorPosCallback(window,
                                 [](GLFWwindow* w, double toX, double toY) { of(w).onMove(toX, toY); });
        glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) { of(w).onWheel(notches); });
        glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
            of(w).input.files.assign(files, files + count);
        });
        glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).input.needsRedraw = true; });
        glfwSetWindowSizeCallback(window, [](GLFWwindow* w, int across, int down) {
            of(w).nowWidth = across;
            of(w).nowHeight = down;
            if (glfwGetWindowMonitor(w) != nullptr) return;
            of(w).width = across;
            of(w).height = down;
        });
        glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int across, int down) {
            of(w).pixelsWide = across;
            of(w).pixelsHigh = down;
            of(w).input.needsRedraw = true;
        });
        glfwSetWindowIconifyCallback(
            window, [](GLFWwindow* w, int iconified) { of(w).isIconified = iconified == GLFW_TRUE; });
        measure();
    }

    void measure() {
        glfwGetWindowSize(window, &nowWidth, &nowHeight);
        glfwGetFramebufferSize(window, &pixelsWide, &pixelsHigh);
        isIconified = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
    }
};

Window::Window(VkExtent2D size) : state_(std::make_unique<State>()) {
    if (glfwInit() != GLFW_TRUE) failWithoutDisplay();
    watchDisplay(state_->farewell);
    widenDisplay();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    state_->window = glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), "Sinew",
                                      nullptr, nullptr);
    if (state_->window == nullptr) {
        const char* why = nullptr;
        glfwGetError(&why);
        const std::string reason = why ? why : "unknown cause";
        glfwTerminate();
        throw app::Failure(app::noDevice,
                           "cannot open a window: " + reason + ": use --headless --frames N --out DIR");
    }
    state_->listen();
    state_->width = state_->nowWidth;
    state_->height = state_->nowHeight;
}

Window::~Window() {
    glfwDestroyWindow(state_->window);
    glfwTerminate();
}

std::vector<std::string> Window::surfaceExtensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
        throw app::Failure(app::noDevice,
                           "cannot open a window: no Vulkan driver draws to this display: use --headless "
                           "--frames N --out DIR");
    return {names, names + count};
}

bool Window::canPresent(VkInstance instance, VkPhysicalDevice device, std::uint32_t family) {
    return glfwGetPhysicalDevicePresentationSupport(instance, device, family) == GLFW_TRUE;
}

VkSurfaceKHR Window::createSurface(VkInstance instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    vk::check(glfwCreateWindowSurface(instance, state_->window, nullptr, &surface), "glfwCreateWindowSurface",
              "the window");
    return surface;
}

Input Window::poll(double seconds) {
    ++state_->polls;
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    Input input = std::exchange(state_->input, {});
    input.pointer = state_->pointer();
    const auto atPress = std::exchange(state_->heldAtPress, std::nullopt);
    input.held = atPress ? *atPress : state_->held(); // it may have been released already
    input.panels.pointer = state_->pixels();
    input.panels.isDown = state_->isDownInPanel;
    return input;
}

void Window::setFarewell(Farewell farewell) {
    state_->farewell = std::move(farewell);
}

void Window::setCover(Cover cover) {
    state_->cover = std::move(cover);
}

float Window::scale() const {
    float across = 1, down = 1;
    glfwGetWindowContentScale(state_->window, &across, &down);
    return std::max(1.0f, down);
}

VkExtent2D Window::pixels() const {
    const int wide = state_->pixelsWide, high = state_->pixelsHigh;
    const bool isHidden = state_->isIconified || wide <= 0 || high <= 0;
    return isHidden ? VkExtent2D{}
                    : VkExtent2D{static_cast<std::uint32_t>(wide), static_cast<std::uint32_t>(high)};
}

VkExtent2D Window::size() const {
    return {static_cast<std::uint32_t>(std::max(state_->width, 0)),
            static_cast<std::uint32_t>(std::max(state_->height, 0))};
}

bool Window::isClosing() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(state_->window, GLFW_TRUE);
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(state_->window);
    return text != nullptr ? text : "";
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(state_->window, text.c_str());
}

void Window::hide() {
    glfwHideWindow(state_->window);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::toggleFullScreen() {
    State& state = *state_;
    if (glfwGetWindowMonitor(state.window) != nullptr) {
        glfwSetWindowMonitor(state.window, nullptr, state.x, state.y, state.width, state.height,
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(state.window, &state.x, &state.y);
    glfwGetWindowSize(state.window, &state.width, &state.height);
    glfwSetWindowMonitor(state.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

} // namespace sinew::viewer
