// Events in the order in which they came.
#include "viewer/input/input_log.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

void InputLog::restart() {
    events_.clear();
    camera_.reset();
    pointed_.reset();
    gravity_.reset();
    settings_.fill(std::nullopt);
    material_ = {};
}

void InputLog::look(const Camera& camera) {
    if (camera_ == camera) return;
    camera_ = camera;
    pointed_.reset(); // the pointer now points elsewhere
    events_.emplace_back(camera);
}

void InputLog::point(const Vector2& pointer) {
    if (pointed_ == Pointed{pointer}) return;
    pointed_ = Pointed{pointer};
    events_.emplace_back(*pointed_);
}

void InputLog::press(bool isDown, const Vector2& pointer) {
    events_.emplace_back(Pressed{isDown, pointer});
    pointed_.reset();
}

void InputLog::key(Action action) {
    events_.emplace_back(action);
    pointed_.reset();
}

// Drops the distance of a pick, which nobody uses.
void InputLog::answer(Answered answer) {
    if (answer.pick) answer.pick->distance = 0;
    events_.emplace_back(std::move(answer));
    pointed_.reset();
}

void InputLog::pull(float gravity) {
    if (gravity_ == gravity) return;
    gravity_ = gravity;
    events_.emplace_back(Pulled{gravity});
}

void InputLog::turn(const sim::Material& material) {
    if (material_ == material) return;
    material_ = material;
    events_.emplace_back(Turned{material});
}

void InputLog::shape(const Shaped& shaped) {
    events_.emplace_back(shaped);
    pointed_.reset();
}

void InputLog::set(std::size_t tool, const std::optional<float>& setting) {
    if (settings_[tool] == setting) return;
    settings_[tool] = setting;
    events_.emplace_back(ToolSet{tool, setting});
}

void InputLog::forget(const Forgot& forgot) {
    events_.emplace_back(forgot);
}

void InputLog::step() {
    auto* last = events_.empty() ? nullptr : std::get_if<Stepped>(&events_.back());
    if (last == nullptr) last = &std::get<Stepped>(events_.emplace_back(Stepped{}));
    ++last->count;
}

// Adds a line of its own even after steps: the undo followed them.
void InputLog::goBack() {
    events_.emplace_back(Stepped{});
    pointed_.reset();
}

// Keeps the lines of undone steps, so that events between them stay in place.
void InputLog::takeBack(std::uint64_t steps) {
    for (auto event = events_.rbegin(); event != events_.rend() && steps > 0; ++event)
        if (auto* stepped = std::get_if<Stepped>(&*event)) {
            const auto taken = static_cast<std::uint32_t>(std::min<std::uint64_t>(steps, stepped->count));
            stepped->count -= taken;
            steps -= taken;
        }
    pointed_.reset();
}

bool InputLog::hasDeeds(std::size_t first) const {
    const auto isDeed = [](const InputEvent& event) {
        return std::holds_alternative<Pressed>(event) || std::holds_alternative<Action>(event) ||
               std::holds_alternative<Pulled>(event) || std::holds_alternative<Turned>(event) ||
               std::holds_alternative<Shaped>(event);
    };
    return first < events_.size() &&
           std::any_of(events_.begin() + static_cast<std::ptrdiff_t>(first), events_.end(), isDeed);
}

std::uint64_t InputFile::steps() const {
    std::uint64_t all = 0;
    for (const InputEvent& event : events)
        if (const auto* stepped = std::get_if<Stepped>(&event)) all += stepped->count;
    return all;
}

} // namespace sinew::viewer
