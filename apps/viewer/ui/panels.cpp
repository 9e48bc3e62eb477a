// Layout: one panel on the right, a line at the foot of the picture, and messages over both.
#include "viewer/ui/panels.hpp"

#include "viewer/render/length_text.hpp"
#include "viewer/ui/panel_parts.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace sinew::viewer {

namespace {

constexpr float textHeight = 14, sidePanel = 296, gap = 12, leastNotice = 200, recordingWidth = 200,
                legendWidth = 260, largestIcon = 34, smallestIcon = 18, iconPad = 5, iconGap = 3,
                longestBar = 110, leastWithBar = 700; // at a scale of 1 [pixels]
constexpr int mostPicturesUnfocused = 20;             // that a text field may wait for keys
constexpr float roomBeside = 2.6f; // in panels: least width of a picture that shows panels at first

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoFocusOnAppearing; // keeps the focus of a text field

// The font's file in Debian, Fedora and Arch; without any, Dear ImGui's built-in font.
const char* findFont() {
    for (const char* file :
         {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
          "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
          "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
          "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"})
        if (std::error_code error; std::filesystem::is_regular_file(file, error)) return file;
    return nullptr;
}

GlyphAtlas makeAtlas(float scale) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Flags |= ImFontAtlasFlags_NoBakedLines | ImFontAtlasFlags_NoMouseCursors;
    ImFontConfig config;
    config.OversampleH = config.OversampleV = 1; // pixel on pixel: the painter does not filter
    config.PixelSnapH = true;
    config.SizePixels = std::round(textHeight * scale);
    if (const char* file = findFont())
        fonts.AddFontFromFileTTF(file, config.SizePixels, &config);
    else
        fonts.AddFontDefault(&config);
    unsigned char* coverage = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsAlpha8(&coverage, &width, &height);
    GlyphAtlas atlas{.width = static_cast<std::uint32_t>(width),
                     .height = static_cast<std::uint32_t>(height)};
    atlas.full = {fonts.TexUvWhitePixel.x * static_cast<float>(width),
                  fonts.TexUvWhitePixel.y * static_cast<float>(height)};
    atlas.coverage.assign(coverage,
                          coverage + static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    fonts.ClearTexData();
    return atlas;
}

ImVec4 color(int red, int green, int blue, float alpha = 1) {
    return {static_cast<float>(red) / 255, static_cast<float>(green) / 255, static_cast<float>(blue) / 255,
            alpha};
}

void setColors(ImGuiStyle& style) {
    ImVec4* colors = style.Colors;
    const ImVec4 clear = color(0, 0, 0, 0);
    colors[ImGuiCol_Text] = color(232, 234, 237);
    colors[ImGuiCol_TextDisabled] = parts::quiet();
    colors[ImGuiCol_WindowBg] = color(20, 23, 28);
    colors[ImGuiCol_PopupBg] = color(32, 36, 42, 0.98f);
    colors[ImGuiCol_ChildBg] = clear;
    colors[ImGuiCol_Border] = color(255, 255, 255, 0.08f);
    colors[ImGuiCol_FrameBg] = color(255, 255, 255, 0.07f);
    colors[ImGuiCol_FrameBgHovered] = color(255, 255, 255, 0.12f);
    colors[ImGuiCol_FrameBgActive] = color(255, 255, 255, 0.16f);
    colors[ImGuiCol_Button] = color(255, 255, 255, 0.08f);
    colors[ImGuiCol_ButtonHovered] = color(255, 255, 255, 0.16f);
    colors[ImGuiCol_ButtonActive] = color(86, 180, 233, 0.55f);
    colors[ImGuiCol_Header] = clear;
    colors[ImGuiCol_HeaderHovered] = color(255, 255, 255, 0.08f);
    colors[ImGuiCol_HeaderActive] = color(255, 255, 255, 0.14f);
    colors[ImGuiCol_Separator] = color(255, 255, 255, 0.10f);
    colors[ImGuiCol_SliderGrab] = color(86, 180, 233, 0.45f); // the number is read over it
    colors[ImGuiCol_SliderGrabActive] = color(86, 180, 233, 0.65f);
    colors[ImGuiCol_CheckMark] = color(86, 180, 233);
    colors[ImGuiCol_ScrollbarBg] = clear;
    colors[ImGuiCol_ScrollbarGrab] = color(255, 255, 255, 0.14f);
    colors[ImGuiCol_ScrollbarGrabHovered] = color(255, 255, 255, 0.24f);
    colors[ImGuiCol_ScrollbarGrabActive] = color(255, 255, 255, 0.34f);
    colors[ImGuiCol_TableRowBgAlt] = color(255, 255, 255, 0.03f);
}

void setStyle(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = {14, 12};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {6, 5};
    style.ItemInnerSpacing = {6, 4};
    style.WindowRounding = 8;
    style.FrameRounding = style.PopupRounding = 4;
    style.GrabRounding = 3;
    style.ScrollbarSize = 8;
    style.ScrollbarRounding = 4;
    style.WindowBorderSize = 0;
    style.FrameBorderSize = 0;
    style.IndentSpacing = 12;
    style.AntiAliasedLinesUseTex = false;
    style.WindowMinSize = {16, 16};
    style.ScaleAllSizes(scale);
    setColors(style);
}

void mapKeys(ImGuiIO& io) {
    constexpr std::array<std::pair<ImGuiKey_, int>, 18> keys{{{ImGuiKey_Tab, GLFW_KEY_TAB},
                                                              {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                                              {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                                              {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                                              {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                                              {ImGuiKey_Home, GLFW_KEY_HOME},
                                                              {ImGuiKey_End, GLFW_KEY_END},
                                                              {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                                              {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                                              {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                                              {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                                              {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                                              {ImGuiKey_A, GLFW_KEY_A},
                                                              {ImGuiKey_C, GLFW_KEY_C},
                                                              {ImGuiKey_V, GLFW_KEY_V},
                                                              {ImGuiKey_X, GLFW_KEY_X},
                                                              {ImGuiKey_Y, GLFW_KEY_Y},
                                                              {ImGuiKey_Z, GLFW_KEY_Z}}};
    for (const auto& [key, code] : keys) io.KeyMap[key] = code;
}

} // namespace

Panels::Panels(float scale) : context_(ImGui::CreateContext()), scale_(scale) {
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr; // writes no files
    io.BackendRendererName = "sinew";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    mapKeys(io);
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* panels) {
        auto& self = *static_cast<Panels*>(panels);
        self.pasted_ = self.paste_ ? self.paste_() : "";
        return self.pasted_.c_str();
    };
    io.SetClipboardTextFn = [](void* panels, const char* text) {
        const auto& self = *static_cast<Panels*>(panels);
        if (self.copy_) self.copy_(text);
    };
    atlas_ = makeAtlas(scale);
    setStyle(scale);
}

void Panels::rescale(float scale) {
    ImGui::GetIO().Fonts->Clear();
    scale_ = scale;
    atlas_ = makeAtlas(scale);
    setStyle(scale);
}

Panels::~Panels() {
    ImGui::DestroyContext(context_);
}

bool Panels::isShown(VkExtent2D extent) const {
    return isShown_.value_or(static_cast<float>(extent.width) >= roomBeside * sidePanel * scale_);
}

std::uint32_t Panels::sideWidth(VkExtent2D extent) const {
    return isShown(extent) ? static_cast<std::uint32_t>(std::ceil((sidePanel + 2 * gap) * scale_)) : 0;
}

bool Panels::covers(const Vector2& pixels) const {
    return std::ranges::any_of(covered_, [&](const Rectangle& one) {
        return (pixels.array() >= one.from.array()).all() && (pixels.array() < one.to.array()).all();
    });
}

bool Panels::takesKeys() const {
    return ImGui::GetIO().WantTextInput || isAsking();
}

// Width of the picture that the panel leaves free, from the left [pixels].
float Panels::freeWidth(VkExtent2D extent) const {
    return static_cast<float>(extent.width) - (isShown(extent) ? (sidePanel + gap) * scale_ : 0);
}

// A hidden text field gets no keys.
bool Panels::isAsking() const {
    return fields_.files.isShown && isShown(lastExtent_);
}

const ImDrawData& Panels::drawn() const {
    return *ImGui::GetDrawData();
}

void Panels::toggleFiles() {
    const bool opens = !isAsking();
    closeHelp(); // the help covers everything
    if (!isShown(lastExtent_)) toggle();
    fields_.gallery.closes = fields_.gallery.isOpen;
    fields_.files.isShown = fields_.files.wantsKeys = fields_.files.wantsFolder = opens;
    fields_.files.pictures = 0;
    fields_.files.text = {};
    early_ = {};
}

void Panels::toggleGallery() {
    GalleryState& gallery = fields_.gallery;
    gallery.closes = gallery.isOpen;
    gallery.wants = !gallery.isOpen;
    if (!gallery.wants) return;
    closeHelp();
    if (!isShown(lastExtent_)) toggle();
    folds_.reset(indexOf(Fold::scene));
}

void Panels::closeAll() {
    closeHelp();
    fields_.files.isShown = fields_.gallery.wants = false;
    closesAll_ = true;
}

bool Panels::closeTop() {
    if (!isHelpShown_ && !fields_.gallery.isOpen) return false;
    fields_.gallery.closes = !isHelpShown_;
    closeHelp();
    return true;
}

void Panels::feed(const PanelInput& input, VkExtent2D extent, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(extent.width), static_cast<float>(extent.height)};
    io.DeltaTime = std::clamp(static_cast<float>(seconds), 1e-4f, 0.1f);
    io.MousePos = {input.pointer.x(), input.pointer.y()};
    for (std::size_t button = 0; button < input.isDown.size(); ++button) feedButton(input, button);
    io.MouseWheel = input.notches;
    io.KeyCtrl = (input.modifiers & GLFW_MOD_CONTROL) != 0;
    io.KeyShift = (input.modifiers & GLFW_MOD_SHIFT) != 0;
    feedTyped(input);
}

// Presses the button in one picture for each press, and releases it in one picture in between.
void Panels::feedButton(const PanelInput& input, std::size_t button) {
    bool& isDown = ImGui::GetIO().MouseDown[button];
    int& owed = owed_[button];
    owed += input.presses[button];
    if (owed > 0) {
        isDown = !isDown;
        owed -= isDown ? 1 : 0;
    } else {
        isDown = input.isDown[button];
    }
}

// Holds keys that are typed before the text field for a path has the focus.
void Panels::feedTyped(const PanelInput& input) {
    if (takesLetters()) return search_.type(input);
    const bool isEarly = isAsking() && !ImGui::GetIO().WantTextInput;
    early_.keys.insert(early_.keys.end(), input.keys.begin(), input.keys.end());
    early_.characters.insert(early_.characters.end(), input.characters.begin(), input.characters.end());
    if (isEarly) {
        if (++fields_.files.pictures > mostPicturesUnfocused) fields_.files.isShown = false;
        return;
    }
    fields_.files.pictures = 0;
    const PanelInput typed = std::exchange(early_, {});
    feedKeys(typed);
    for (const unsigned character : typed.characters) ImGui::GetIO().AddInputCharacter(character);
}

// A key pressed and released between two pictures is down in one of them.
void Panels::feedKeys(const PanelInput& input) {
    ImGuiIO& io = ImGui::GetIO();
    for (const int key : released_) io.KeysDown[key] = false;
    released_.clear();
    std::vector<int> pressed;
    for (const auto& [key, isDown] : input.keys) {
        if (key < 0 || key >= IM_ARRAYSIZE(io.KeysDown)) continue;
        if (isDown) pressed.push_back(key);
        if (!isDown && std::ranges::count(pressed, key) > 0)
            released_.push_back(key);
        else
            io.KeysDown[key] = isDown;
    }
}

Wishes Panels::build(const SceneFacts& scene, const Facts& facts, const PanelInput& input, VkExtent2D extent,
                     double seconds) {
    PanelInput given = input;
    const auto before = reveal_.take(given, 4 * scale_);
    if (before) folds_ = before->folds;
    feed(given, extent, seconds);
    lastExtent_ = extent;
    Wishes wishes;
    wishes.previews.emplace();
    ImGui::NewFrame();
    if (std::exchange(closesAll_, false)) {
        ImGui::ClearActiveID();
        if (!context_->OpenPopupStack.empty()) ImGui::ClosePopupToLevel(0, false);
    }
    if (before) ImGui::SetNextWindowScroll({-1, before->scroll});
    if (isShown(extent)) buildSide(scene, facts, extent, wishes);
    if (toolbarWidth(extent) > 0) buildToolbar(facts, extent, wishes);
    buildHint(facts, extent, buildScaleBar(facts, extent));
    if (isShown(extent) && isLegendApart(extent) && parts::hasLegend(facts))
        buildLegend(scene, facts, extent);
    if (isAsking()) buildFiles(facts, extent, wishes);
    buildNotice(facts, extent);
    parts::halves(facts, scale_,
                  extent.width - (2 * sideWidth(extent) < extent.width ? sideWidth(extent) : 0));
    if (facts.recorded) buildRecording(facts, extent);
    parts::probe(facts, scale_, freeWidth(extent));
    if (isHelpShown_) parts::help(search_, scale_);
    ImGui::Render();
    remember();
    return wishes;
}

void Panels::buildText(const std::string& text, VkExtent2D extent) {
    for (int picture = 0; picture < 2; ++picture) { // Dear ImGui hides a window until it knows its size
        feed({}, extent, 0);
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(
            {0.5f * static_cast<float>(extent.width), 0.5f * static_cast<float>(extent.height)},
            ImGuiCond_Always, {0.5f, 0.5f});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20 * scale_, 12 * scale_});
        ImGui::Begin("text", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
        ImGui::TextUnformatted(text.c_str());
        ImGui::End();
        ImGui::PopStyleVar();
        ImGui::Render();
    }
}

// Adds all top-level windows: popups may extend beyond a panel.
void Panels::remember() {
    covered_.clear();
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        const bool isPart =
            window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_ChildWindow) == 0;
        if (!isPart || (window->Flags & ImGuiWindowFlags_NoInputs) == ImGuiWindowFlags_NoInputs) continue;
        covered_.push_back({{window->Pos.x, window->Pos.y},
                            {window->Pos.x + window->Size.x, window->Pos.y + window->Size.y}});
    }
}

namespace {

// Draws the background of the present window: opaque without blending, which would take a software device
// longer than everything else in the window. Only the rounded ends are blended.
void addGround() {
    if (ImGui::GetCurrentWindow()->Hidden) return; // it has no size yet
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_WindowBg);
    const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const ImVec2 to{from.x + size.x, from.y + size.y};
    const float round = ImGui::GetStyle().WindowRounding, end = std::ceil(round);
    list.AddRectFilled(from, {to.x, from.y + end + 2}, color, round, ImDrawFlags_RoundCornersTop);
    list.AddRectFilled({from.x, to.y - end - 2}, to, color, round, ImDrawFlags_RoundCornersBottom);
    list.PushTextureID(reinterpret_cast<ImTextureID>(areaTexture));
    list.AddRectFilled({from.x, from.y + end}, {to.x, to.y - end}, color);
    list.PopTextureID();
}

} // namespace

void Panels::buildSide(const SceneFacts& scene, const Facts& facts, VkExtent2D extent, Wishes& wishes) {
    const float edge = gap * scale_;
    const float width =
        std::min(sidePanel * scale_, std::max(static_cast<float>(extent.width) - 2 * edge, 40.0f));
    ImGui::SetNextWindowPos({static_cast<float>(extent.width) - width - edge, edge});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowSizeConstraints(
        {width, 0}, {width, std::max(static_cast<float>(extent.height) - 2 * edge, 40.0f)});
    ImGui::Begin("side", nullptr, fixed | ImGuiWindowFlags_NoBackground);
    addGround();
    const Reveal::Before before{folds_, ImGui::GetScrollY()};
    parts::deviceLine(scene, facts);
    buildSections(scene, facts, extent, wishes);
    if (folds_ != before.folds && ImGui::GetCurrentWindow()->ScrollTarget.y < FLT_MAX)
        reveal_.begin(before, {ImGui::GetMousePos().x, ImGui::GetMousePos().y});
    keepHeight();
    ImGui::End();
}

// A heading shows what matters of a section that is folded.
void Panels::buildSections(const SceneFacts& scene, const Facts& facts, VkExtent2D extent, Wishes& wishes) {
    parts::section(Fold::scene, folds_, facts.isOpening ? "opening ..." : "", [&] {
        parts::scenes(scene, facts, fields_, wishes);
        parts::play(facts, wishes);
    });
    parts::section(Fold::material, folds_, "", [&] { parts::parameters(scene, facts, typed_, wishes); });
    parts::section(Fold::view, folds_, "", [&] {
        parts::camera(wishes);
        parts::look(facts, wishes);
        if (!isLegendApart(extent)) parts::legend(scene, facts);
    });
    parts::section(Fold::record, folds_, "", [&] { parts::files(scene, facts, wishes); });
    parts::section(Fold::compare, folds_, facts.beside.isOn ? "on" : "",
                   [&] { parts::beside(scene, facts, typed_, wishes); });
    buildPerformance(scene, facts, wishes);
    parts::section(Fold::window, folds_, "", [&] { parts::window(facts, wishes); });
}

// The warning of soft bodies must be seen in any case.
void Panels::buildPerformance(const SceneFacts& scene, const Facts& facts, Wishes& wishes) {
    const bool isFolded = folds_[indexOf(Fold::performance)], isSoft = !scene.stiffness.empty();
    const std::string summary = !isFolded ? "" : isSoft ? "softer than asked" : parts::stepText(facts);
    const auto content = [&] {
        parts::device(scene, facts, wishes);
        parts::solver(scene, facts, typed_, wishes);
        if (scene.canCut) parts::cuts(facts);
        parts::counts(scene, facts);
        parts::speed(facts);
        parts::program(scene);
    };
    parts::section(Fold::performance, folds_, summary, content, isSoft ? parts::warning() : parts::quiet());
}

// Below the pointer the panel does not become shorter: scrolled to its end, all of it would move down, and
// another button would come under the pointer.
void Panels::keepHeight() {
    const float height = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
    const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const bool isBelowPointer = ImGui::IsMouseHoveringRect(from, {from.x + size.x, from.y + size.y}, false);
    if (!(isBelowPointer || reveal_.isHeld()) || height > sideHeight_) sideHeight_ = height;
    if (height == sideHeight_) return;
    ImGui::SetCursorPosY(sideHeight_);
    ImGui::Dummy({0, 0});
}

// Sides of the icons' buttons: smaller in a low window [pixels].
float Panels::toolbarSide(VkExtent2D extent) const {
    const auto buttons = static_cast<float>(parts::toolbarButtons());
    const auto rules = static_cast<float>(parts::toolbarGroups() - 1);
    const float hint = ImGui::GetFontSize() + (12 + gap) * scale_;
    const float taken = (2 * gap + 2 * iconPad + (buttons - 1 + 3 * rules) * iconGap) * scale_ + rules + hint;
    const float room = static_cast<float>(extent.height) - taken;
    return std::floor(std::min(room / buttons, largestIcon * scale_));
}

// Width of the toolbar, or 0: the user hides it with the panel. A window too small for both has neither
// icons nor an undo in view, but its keys.
float Panels::toolbarWidth(VkExtent2D extent) const {
    const float side = toolbarSide(extent), width = side + 2 * iconPad * scale_;
    const bool hasRoom = side >= smallestIcon * scale_ && freeWidth(extent) >= 3 * width;
    return isShown_.value_or(true) && hasRoom ? width : 0;
}

// At the left edge of the picture, away from the panel's controls.
void Panels::buildToolbar(const Facts& facts, VkExtent2D extent, Wishes& wishes) {
    ImGui::SetNextWindowPos({gap * scale_, gap * scale_});
    ImGui::SetNextWindowSize({toolbarWidth(extent), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {iconPad * scale_, iconPad * scale_});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {iconGap * scale_, iconGap * scale_});
    ImGui::Begin("toolbar", nullptr, fixed | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
    addGround();
    parts::toolbar(facts, toolbarSide(extent), wishes);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

// A bar with its length, right of the hint; none in a narrow picture. Returns the width that it takes from
// the hint [pixels].
float Panels::buildScaleBar(const Facts& facts, VkExtent2D extent) {
    const float length = roundLength(longestBar * scale_ * facts.metersPerPixel);
    if (length == 0 || freeWidth(extent) < leastWithBar * scale_) return 0;
    const float edge = gap * scale_, pad = 10 * scale_, bar = std::round(length / facts.metersPerPixel);
    const std::string text = lengthText(length);
    const float between = 8 * scale_, line = ImGui::GetTextLineHeight();
    ImGui::SetNextWindowPos({freeWidth(extent) - edge, static_cast<float>(extent.height) - edge},
                            ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, 6 * scale_});
    ImGui::Begin("scale", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
    ImGui::TextUnformatted(text.c_str());
    ImGui::SameLine(0, between);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float from = std::round(at.x), middle = std::round(at.y + line / 2),
                thick = std::round(1.5f * scale_), tick = std::round(4 * scale_);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_Text);
    list.AddRectFilled({from, middle}, {from + bar, middle + thick}, color);
    for (const float x : {from, from + bar - thick})
        list.AddRectFilled({x, middle - tick}, {x + thick, middle + thick + tick}, color);
    ImGui::Dummy({bar, line});
    ImGui::End();
    ImGui::PopStyleVar();
    return ImGui::CalcTextSize(text.c_str()).x + between + bar + 2 * pad + edge;
}

void Panels::buildHint(const Facts& facts, VkExtent2D extent, float taken) {
    const float edge = gap * scale_, pad = 10 * scale_, room = freeWidth(extent) - 2 * edge - taken;
    const std::string text = hintText(facts.hint, [&](const std::string& one) {
        return ImGui::CalcTextSize(one.c_str()).x + 2 * pad <= room;
    });
    const float low = 6 * scale_;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()); // Dear ImGui fits a window one picture later
    ImGui::SetNextWindowPos({edge, static_cast<float>(extent.height) - edge}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSize({std::ceil(size.x) + 2 * pad, size.y + 2 * low});
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, low});
    ImGui::Begin("hint", nullptr, fixed | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoInputs);
    ImGui::TextUnformatted(text.c_str());
    ImGui::End();
    ImGui::PopStyleVar();
}

// In a wide picture legends stand over the hint, so that nothing in the panel moves when they appear.
bool Panels::isLegendApart(VkExtent2D extent) const {
    return freeWidth(extent) - toolbarWidth(extent) >= 2 * (legendWidth + gap) * scale_;
}

void Panels::buildLegend(const SceneFacts& scene, const Facts& facts, VkExtent2D extent) {
    const float edge = gap * scale_, hint = ImGui::GetTextLineHeight() + 12 * scale_;
    const float foot = static_cast<float>(extent.height) - 1.5f * edge - hint, tools = toolbarWidth(extent);
    const float most = std::max(foot - 5 * edge, 40.0f);
    for (const bool isMeasured : {false, true}) { // Dear ImGui fits a window one picture later
        ImGui::SetNextWindowPos({edge + (tools > 0 ? tools + edge : 0), foot}, ImGuiCond_Always, {0, 1});
        ImGui::SetNextWindowSize({legendWidth * scale_, isMeasured ? std::min(legendHeight_, most) : most});
        ImGui::SetNextWindowBgAlpha(0.85f);
        ImGui::Begin(isMeasured ? "legend" : "measured legend", nullptr, fixed);
        if (!isMeasured) ImGui::GetCurrentWindow()->Hidden = true;
        parts::legend(scene, facts);
        const ImGuiStyle& style = ImGui::GetStyle();
        legendHeight_ =
            ImGui::GetCursorPosY() + ImGui::GetScrollY() - style.ItemSpacing.y + style.WindowPadding.y;
        ImGui::End();
    }
}

void Panels::buildNotice(const Facts& facts, VkExtent2D extent) {
    if (facts.notice.empty()) return;
    const float edge = gap * scale_;
    const float all = static_cast<float>(extent.width) - 2 * edge;
    const float tools = toolbarWidth(extent), from = tools > 0 ? tools + edge : 0;
    const float beside = freeWidth(extent) - 2 * edge - from - (facts.recorded ? recordingWidth * scale_ : 0);
    const bool isBeside = beside >= leastNotice * scale_;
    const float width = std::min(560 * scale_, isBeside ? beside : all);
    ImGui::SetNextWindowPos({edge + (isBeside ? from : 0), edge});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::Begin("notice", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
    if (facts.isNoticeBad) {
        ImGui::TextColored(parts::bad(), "This did not work");
    }
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(facts.notice.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

// Left of the panel, so that nothing in the panel moves.
void Panels::buildFiles(const Facts& facts, VkExtent2D extent, Wishes& wishes) {
    constexpr float widest = 460, highest = 520, narrowest = 240; // at a scale of 1 [pixels]
    FileField& files = fields_.files;
    if (files.browser.folder().empty() || files.wantsFolder)
        files.browser.open(startFolder(facts.recent), facts.recent);
    files.wantsFolder = false;
    const float edge = gap * scale_, all = static_cast<float>(extent.width) - edge;
    const float beside = freeWidth(extent) - edge, right = beside >= narrowest * scale_ ? beside : all;
    const float high = static_cast<float>(extent.height) - 2 * edge;
    ImGui::SetNextWindowPos({right, edge}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowSize({std::min(widest * scale_, right - edge), std::min(highest * scale_, high)});
    ImGui::Begin("files", nullptr, fixed);
    parts::open(files, wishes);
    ImGui::End();
}

// A sign as long as a film is recorded, also without panels: a red dot and the length of the film.
void Panels::buildRecording(const Facts& facts, VkExtent2D extent) {
    const float edge = gap * scale_, line = ImGui::GetTextLineHeight();
    ImGui::SetNextWindowPos({freeWidth(extent) - edge, edge}, ImGuiCond_Always, {1, 0});
    ImGui::Begin("recording", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + line / 2, at.y + line / 2}, 0.4f * line,
                                                IM_COL32(235, 45, 40, 255));
    ImGui::Dummy({line, line});
    ImGui::SameLine();
    ImGui::Text("REC %.1f s", *facts.recorded);
    ImGui::SameLine();
    ImGui::TextColored(parts::quiet(), "%s stops", std::string(keyOf(Action::record)).c_str());
    ImGui::End();
}

} // namespace sinew::viewer
