// Buffers are recycled: a dropped state's buffer serves the next state.
#include "viewer/document/history.hpp"

#include <algorithm>
#include <cstring>
#include <optional>

namespace sinew::viewer {

// Moves states from one simulation to another, through the host if their devices differ.
struct History::Ferry {
    Ferry(const vk::Device& givingDevice, const sim::Simulation& given, vk::Queue& givingQueue,
          const vk::Device& takingDevice, sim::Simulation& taken, vk::Queue& takingQueue)
        : from(given), to(taken), giving(givingQueue), taking(takingQueue),
          loaded(bufferFor(givingDevice, given.handOverSize(),
                           givingDevice.handle() == takingDevice.handle() ? vk::MemoryKind::device
                                                                          : vk::MemoryKind::readback)) {
        if (givingDevice.handle() != takingDevice.handle())
            landed.emplace(bufferFor(takingDevice, given.handOverSize(), vk::MemoryKind::upload));
    }

    // Leaves `to` in that state.
    void carry(const State& state) const {
        VkCommandBuffer commands = giving.begin();
        from.recordHandOver(commands, loaded.view(), state.buffer.view());
        giving.wait(giving.submit(commands));
        if (landed) std::memcpy(landed->mapped(), loaded.mapped(), from.handOverSize());
        commands = taking.begin();
        to.recordTakeOver(commands, from, landed ? landed->view() : loaded.view(), &state.host);
        taking.wait(taking.submit(commands));
    }

    static vk::Buffer bufferFor(const vk::Device& device, std::uint64_t size, vk::MemoryKind kind) {
        return {device, {.name = "history.brought", .count = size / 4, .stride = 4, .kind = kind}};
    }

    const sim::Simulation& from;
    sim::Simulation& to;
    vk::Queue &giving, &taking;
    vk::Buffer loaded;
    std::optional<vk::Buffer> landed;
};

History::State History::record(VkCommandBuffer commands, const sim::Simulation& simulation,
                               std::uint64_t played) {
    if (spare_.empty())
        spare_.emplace_back(device_, vk::BufferRequest{.name = "history",
                                                       .count = simulation.stateSize() / 4,
                                                       .stride = 4,
                                                       .kind = vk::MemoryKind::device});
    State state{std::move(spare_.back()), {}, played};
    spare_.pop_back();
    state.host = simulation.recordSaveState(commands, state.buffer.view());
    return state;
}

std::size_t History::room(const sim::Simulation& simulation) const {
    const std::uint64_t size = std::max<std::uint64_t>(simulation.stateSize(), 1);
    return std::clamp<std::size_t>(mostBytes / size, 1, mostStates_);
}

void History::bring(const History& other, const sim::Simulation& from, vk::Queue& giving, sim::Simulation& to,
                    vk::Queue& taking) {
    const std::size_t count = other.before_.size() + other.after_.size();
    if (count == 0) return clear();
    const Ferry ferry(other.device_, from, giving, device_, to, taking);
    History brought(device_, mostStates_);
    std::size_t forgotten = count - std::min(count, room(to));
    const auto bringAll = [&](const States& states, States& into) {
        for (const State& state : states) {
            if (forgotten > 0 && forgotten-- > 0) continue;
            ferry.carry(state);
            const VkCommandBuffer commands = taking.begin();
            into.push_back(brought.record(commands, to, state.played));
            taking.wait(taking.submit(commands));
        }
    };
    bringAll(other.before_, brought.before_);
    bringAll(other.after_, brought.after_);
    clear();
    before_ = std::move(brought.before_);
    after_ = std::move(brought.after_);
}

void History::recordBefore(VkCommandBuffer commands, const Document& document, std::size_t more) {
    const std::size_t most = room(document) + more;
    const auto forget = [this](States& states) {
        spare_.push_back(std::move(states.front().buffer));
        states.pop_front();
    };
    while (!after_.empty()) forget(after_);
    while (before_.size() >= most) forget(before_);
    before_.push_back(record(commands, document.simulation(), document.played()));
}

bool History::recordSwap(VkCommandBuffer commands, Document& document, States& from, States& to) {
    if (from.empty()) return false;
    to.push_back(record(commands, document.simulation(), document.played()));
    load(commands, document, from);
    return true;
}

void History::load(VkCommandBuffer commands, Document& document, States& from) {
    document.simulation().recordLoadState(commands, from.back().buffer.view(), from.back().host);
    document.setPlayed(from.back().played);
    spare_.push_back(std::move(from.back().buffer));
    from.pop_back();
}

bool History::recordBack(VkCommandBuffer commands, Document& document) {
    if (before_.empty()) return false;
    load(commands, document, before_);
    return true;
}

void History::forgetFrom(std::uint64_t played, std::size_t most) {
    for (; most > 0 && !before_.empty() && before_.back().played >= played; before_.pop_back(), --most)
        spare_.push_back(std::move(before_.back().buffer));
}

void History::limit(std::size_t states) {
    for (; before_.size() > states; before_.pop_front()) spare_.push_back(std::move(before_.front().buffer));
}

bool History::recordUndo(VkCommandBuffer commands, Document& document) {
    return recordSwap(commands, document, before_, after_);
}

bool History::recordRedo(VkCommandBuffer commands, Document& document) {
    return recordSwap(commands, document, after_, before_);
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
