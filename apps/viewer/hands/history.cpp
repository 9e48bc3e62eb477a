// Buffers go around: what is forgotten serves the next state.
#include "viewer/hands/history.hpp"

#include <algorithm>

namespace sinew::viewer {

History::State History::record(VkCommandBuffer commands, const Stage& stage) {
    if (spare_.empty())
        spare_.emplace_back(device_, vk::BufferRequest{.name = "history",
                                                       .count = stage.simulation().stateSize() / 4,
                                                       .stride = 4,
                                                       .kind = vk::MemoryKind::device});
    State state{std::move(spare_.back()), {}, stage.played()};
    spare_.pop_back();
    state.host = stage.simulation().recordSaveState(commands, state.buffer.view());
    return state;
}

std::size_t History::room(const Stage& stage) const {
    const std::uint64_t size = std::max<std::uint64_t>(stage.simulation().stateSize(), 1);
    return std::clamp<std::size_t>(mostBytes / size, 1, mostStates_);
}

void History::recordBefore(VkCommandBuffer commands, const Stage& stage) {
    const std::size_t most = room(stage);
    const auto forget = [this](States& states) {
        spare_.push_back(std::move(states.front().buffer));
        states.pop_front();
    };
    while (!after_.empty()) forget(after_);
    while (before_.size() >= most) forget(before_);
    before_.push_back(record(commands, stage));
}

bool History::recordSwap(VkCommandBuffer commands, Stage& stage, States& from, States& to) {
    if (from.empty()) return false;
    to.push_back(record(commands, stage));
    load(commands, stage, from);
    return true;
}

void History::load(VkCommandBuffer commands, Stage& stage, States& from) {
    stage.simulation().recordLoadState(commands, from.back().buffer.view(), from.back().host);
    stage.setPlayed(from.back().played);
    spare_.push_back(std::move(from.back().buffer));
    from.pop_back();
}

bool History::recordBack(VkCommandBuffer commands, Stage& stage) {
    if (before_.empty()) return false;
    load(commands, stage, before_);
    return true;
}

void History::forgetFrom(std::uint64_t played) {
    for (; !before_.empty() && before_.back().played >= played; before_.pop_back())
        spare_.push_back(std::move(before_.back().buffer));
}

bool History::recordUndo(VkCommandBuffer commands, Stage& stage) {
    return recordSwap(commands, stage, before_, after_);
}

bool History::recordRedo(VkCommandBuffer commands, Stage& stage) {
    return recordSwap(commands, stage, after_, before_);
}

std::vector<std::uint64_t> History::times() const {
    std::vector<std::uint64_t> times;
    for (const State& state : before_) times.push_back(state.played);
    for (auto state = after_.rbegin(); state != after_.rend(); ++state) times.push_back(state->played);
    return times;
}

void History::recycle() {
    for (States* states : {&before_, &after_})
        for (; !states->empty(); states->pop_front()) spare_.push_back(std::move(states->front().buffer));
}

void History::clear() {
    before_.clear();
    after_.clear();
    spare_.clear();
}

} // namespace sinew::viewer
