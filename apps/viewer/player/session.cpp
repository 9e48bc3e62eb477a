// Changes swapchain and panels together.
#include "viewer/player/session.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::chrono::milliseconds panelsStay{100};
constexpr std::uint32_t picturesOfPanels = 5; // drawing them anew takes a software device four times as long

// Merges the input of several polls before one picture.
void merge(PanelInput& all, const PanelInput& next) {
    PanelInput merged = next;
    for (std::size_t b = 0; b < merged.presses.size(); ++b) merged.presses[b] += all.presses[b];
    merged.notches += all.notches;
    merged.characters.insert(merged.characters.begin(), all.characters.begin(), all.characters.end());
    merged.keys.insert(merged.keys.begin(), all.keys.begin(), all.keys.end());
    all = std::move(merged);
}

} // namespace

Session::Session(Window& window, std::unique_ptr<WindowOutput> output, const Timing& timing,
                 const Preferences& preferences)
    : window_(window), output_(std::move(output)), timing_(timing),
      panels_(window.scale() * preferences.scale), ownScale_(preferences.scale), windowScale_(window.scale()),
      isVsync_(preferences.isVsync) {
    panels_.choose(preferences.arePanelsShown);
    panels_.fold(preferences.folded);
    output_->painter.setAtlas(panels_.atlas());
    panels_.setPaste([this] { return window_.clipboard(); });
    panels_.setCopy([this](const std::string& text) { window_.setClipboard(text); });
    window_.setCover({[this](const Vector2& pixels) { return panels_.covers(pixels); },
                      [this] { return panels_.takesKeys(); }, [this] { return panels_.takesLetters(); }});
}

Session::~Session() {
    window_.setCover({});
    output_->presenter.drain(); // the painter's buffers may be in use
}

std::unique_ptr<WindowOutput> Session::moveTo(std::unique_ptr<WindowOutput> output) {
    const auto change = [&] {
        output_->presenter.retire(); // a window has one swapchain at a time
        std::swap(output_, output);
        pixels_ = {};
    };
    change();
    try {
        output_->painter.setAtlas(panels_.atlas());
        output_->painter.setSheet(sheet_);
        prepare([] {});
    } catch (...) {
        change();
        throw;
    }
    return output;
}

bool Session::prepare(const std::function<void()>& beforehand) {
    if (window_.scale() != windowScale_) rescale(); // the window may be on another display
    const VkExtent2D pixels = window_.pixels();
    const bool isSame = pixels.width == pixels_.width && pixels.height == pixels_.height;
    if (pixels.width > 0 && isSame && !output_->presenter.isOutdated()) return true;
    pixels_ = pixels;
    if (pixels.width > 0) output_->presenter.waitIdle();
    beforehand();
    if (pixels.width == 0 || !output_->presenter.resize(pixels, isVsync_)) return false;
    output_->painter.setPictures(output_->presenter.extent(), output_->presenter.views());
    return true;
}

void Session::showText(const vk::Device& device, const std::string& text) {
    if (!prepare([] {})) return;
    Presenter& presenter = output_->presenter;
    presenter.waitForSlot();
    const std::optional<Presenter::Frame> frame = presenter.begin();
    if (!frame) return;
    const VkExtent2D extent = presenter.extent();
    const RenderPass pass = RenderPass::whole(device, presenter.format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    const Framebuffer framebuffer(device, pass.handle(), presenter.views().subspan(frame->image, 1), extent,
                                  "text");
    const VkRenderPassBeginInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                     .renderPass = pass.handle(),
                                     .framebuffer = framebuffer.handle(),
                                     .renderArea = {{0, 0}, extent}};
    const VkClearAttachment ground{VK_IMAGE_ASPECT_COLOR_BIT, 0, {.color = {{0.62f, 0.64f, 0.66f, 1}}}};
    const VkClearRect all{{{0, 0}, extent}, 0, 1};
    const vk::DeviceFunctions& functions = device.functions();
    functions.vkCmdBeginRenderPass(frame->commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    functions.vkCmdClearAttachments(frame->commands, 1, &ground, 1, &all);
    functions.vkCmdEndRenderPass(frame->commands);
    panels_.buildText(text, extent);
    output_->painter.record(frame->commands, frame->slot, frame->image, panels_.drawn());
    presenter.end(*frame);
    presenter.waitIdle(); // the framebuffer is in use
}

void Session::toggleVsync() {
    isVsync_ = !isVsync_;
    pixels_ = {}; // requests a new swapchain
}

void Session::act(Action action) {
    switch (action) {
    case Action::fullScreen:
        return window_.toggleFullScreen();
    case Action::vsync:
        return toggleVsync();
    case Action::largerTexts:
        return changeScale(1);
    case Action::smallerTexts:
        return changeScale(-1);
    case Action::times:
        tell(timing_.times().summary());
        return timing_.printTable();
    case Action::panels:
        return panels_.toggle();
    case Action::gallery:
        return panels_.toggleGallery();
    case Action::help:
        return panels_.toggleHelp();
    case Action::quit:
        return window_.close();
    default:
        return; // drags and the wheel
    }
}

Preferences Session::preferences() const {
    const VkExtent2D size = window_.size();
    const auto isSensible = [](std::uint32_t side) {
        return side >= Preferences::smallest && side <= Preferences::largest;
    };
    Preferences preferences{.arePanelsShown = panels_.choice(),
                            .folded = panels_.folds(),
                            .scale = ownScale_,
                            .isVsync = isVsync_};
    if (isSensible(size.width) && isSensible(size.height)) {
        preferences.width = size.width;
        preferences.height = size.height;
    }
    return preferences;
}

void Session::changeScale(int steps) {
    constexpr float step = 1.125f;
    const float scale = ownScale_ * std::pow(step, static_cast<float>(steps));
    const float whole = std::abs(scale - 1) < 0.01f ? 1 : scale; // returns to exactly 1
    ownScale_ = std::clamp(whole, Preferences::leastScale, Preferences::mostScale);
    rescale();
    char text[40];
    std::snprintf(text, sizeof text, "texts at %.0f %%", 100 * double{ownScale_});
    tell(text);
}

void Session::rescale() {
    windowScale_ = window_.scale();
    output_->presenter.waitIdle(); // the atlas may be in use
    panels_.rescale(windowScale_ * ownScale_);
    output_->painter.setAtlas(panels_.atlas());
    notices_.touch(); // the message needs a new layout
}

void Session::expectPreviews(std::size_t count) {
    sheet_ = PictureSheet(count);
    output_->presenter.waitIdle(); // the old sheet may be in use
    output_->painter.setSheet(sheet_);
}

void Session::addPreview(std::size_t scene, const Picture& picture) {
    if (!sheet_.set(scene, picture)) return;
    output_->painter.addPicture(sheet_, scene);
    notices_.touch();
}

void Session::feed(const PanelInput& input) {
    merge(input_, input);
}

Wishes Session::drawPanels(const Presenter::Frame& frame, const SceneFacts& scene, Facts facts, bool areDue) {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - std::exchange(lastPicture_, now)).count();
    facts.isVsync = isVsync_;
    facts.notice = notices_.shown().text;
    facts.isNoticeBad = notices_.shown().isBad;
    facts.previews = sheet_.has();
    PanelInput input = std::move(input_);
    input_ = {};
    input_.pointer = input.pointer;
    input_.isDown = input.isDown;
    input_.modifiers = input.modifiers;
    Wishes wishes = panels_.build(scene, facts, input, output_->presenter.extent(), seconds);
    const bool areOld = ++picturesOfPanels_ >= picturesOfPanels && now - panelsDrawn_ >= panelsStay;
    if (areDue || areOld) {
        panelsDrawn_ = now;
        picturesOfPanels_ = 0;
    }
    output_->painter.record(frame.commands, frame.slot, frame.image, panels_.drawn(),
                            areDue || areOld ? PanelPainter::Draw::anew : PanelPainter::Draw::asKept);
    return wishes;
}

void Session::warn(const std::string& text) {
    std::fprintf(stderr, "warning: %s\n", text.c_str());
    notices_.show({text, true}, Clock::now());
}

void Session::note(const std::string& text) {
    std::fprintf(stderr, "note: %s\n", text.c_str());
    tell(text);
}

void Session::tell(const std::string& text) {
    notices_.show({text}, Clock::now());
}

void Session::announce(const std::vector<std::string>& texts) {
    notices_.announce(texts, Clock::now());
}

bool Session::hasNewNotice() {
    notices_.pass(Clock::now());
    return notices_.hasChanged();
}

} // namespace sinew::viewer
