// Submits one command buffer a step and waits for it.
#include "sim/runner.hpp"

#include "sim/compile/compile.hpp"
#include "sim/core/hash.hpp"
#include "vk/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace sinew::test {

namespace {

using Vec4 = std::array<float, 4>;

constexpr int rehearsalsOfAPair = 2; // steps of one kind after one of another

// The parts of a step that change its commands, as bits.
unsigned kindOf(const sim::Step& step) {
    return unsigned{!step.anchors.empty()} | unsigned{!step.grabs.empty()} << 1 |
           unsigned{!step.hostColliders.empty()} << 2 | unsigned{step.wakes} << 3 |
           unsigned{!step.blade.from.empty()} << 4 | unsigned{(step.ray.radius > 0)} << 5 |
           unsigned{!step.fields.empty()} << 6 | unsigned{!step.motions.empty()} << 7;
}

// Without a thread pool, small scenes are several times faster on a software device. An existing value of the
// variable is kept.
[[maybe_unused]] const bool hasThreadDefault = [] {
    if (std::getenv("LP_NUM_THREADS") == nullptr) vk::setVariable("LP_NUM_THREADS", "0");
    return true;
}();

std::vector<Eigen::Vector3d> download(const vk::BufferView& view, std::size_t count) {
    std::vector<Eigen::Vector3d> result;
    if (view.size == 0) return result;
    for (const Vec4& element : queue().download<Vec4>(view)) {
        if (result.size() == count) break; // buffers are never empty
        result.emplace_back(double{element[0]}, double{element[1]}, double{element[2]});
    }
    return result;
}

} // namespace

Runner::Runner(const sim::Scene& scene, const sim::Settings& settings)
    : simulation_(device(), scene, settings), dt_(scene.dt), gravity_(scene.gravity),
      slots_(sim::stateLayout(scene, settings).slot) {
    if (isPlayed()) rehearsed_ = std::make_unique<sim::Simulation>(validatedDevice(), scene, settings);
    reset();
}

template <typename Record> void Runner::submit(const Record& record) {
    const auto on = [&record](vk::Queue& queue, sim::Simulation& simulation) {
        const VkCommandBuffer commands = queue.begin();
        record(commands, simulation);
        queue.wait(queue.submit(commands));
    };
    on(queue(), simulation_);
    if (rehearsed_) on(validatedQueue(), *rehearsed_);
}

void Runner::rehearse(const sim::Step& step) {
    if (!rehearsed_) return;
    const unsigned kind = kindOf(step), before = std::exchange(kind_, kind);
    if (rehearsals_[{before, kind}]++ >= rehearsalsOfAPair) return;
    sim::Step rehearsed = step;
    rehearsed.frame = rehearsedFrame_++;
    const VkCommandBuffer commands = validatedQueue().begin();
    rehearsed_->record(commands, rehearsed);
    validatedQueue().wait(validatedQueue().submit(commands));
}

void Runner::reset() {
    submit([](VkCommandBuffer commands, sim::Simulation& simulation) { simulation.recordReset(commands); });
    frame_ = rehearsedFrame_ = 0;
}

void Runner::takeOver(const Runner& from) {
    submit([&](VkCommandBuffer commands, sim::Simulation& simulation) {
        const bool isTested = &simulation == &simulation_;
        simulation.recordTakeOver(commands, isTested ? from.simulation_ : *from.rehearsed_);
    });
    frame_ = from.frame_;
    rehearsedFrame_ = from.rehearsedFrame_;
}

sim::Status Runner::step(float dt, std::span<const sim::Vec3> anchors) {
    return step({.dt = dt, .gravity = gravity_, .anchors = anchors});
}

sim::Status Runner::cut(const sim::Blade& blade, const sim::RayCut& ray) {
    return step({.dt = dt_, .gravity = gravity_, .blade = blade, .ray = ray});
}

sim::Status Runner::step(sim::Step step) {
    step.frame = frame_;
    const VkCommandBuffer commands = queue().begin();
    simulation_.record(commands, step);
    queue().wait(queue().submit(commands));
    rehearse(step);
    return simulation_.status(frame_++);
}

sim::Status Runner::run(int steps) {
    sim::Status status;
    for (int s = 0; s < steps; ++s) status = step(dt_);
    return status;
}

void Runner::takeOverByHost(const Runner& from, const Saved* saved) {
    const auto make = [&](const char* name, vk::MemoryKind kind) {
        return vk::Buffer(
            device(),
            {.name = name, .count = from.simulation_.handOverSize() / 4, .stride = 4, .kind = kind});
    };
    const vk::Buffer read = make("handed", vk::MemoryKind::readback),
                     sent = make("taken", vk::MemoryKind::upload);
    VkCommandBuffer commands = queue().begin();
    from.simulation_.recordHandOver(commands, read.view(), saved ? saved->buffer.view() : vk::BufferView());
    queue().wait(queue().submit(commands));
    std::copy_n(read.mapped(), from.simulation_.handOverSize(), sent.mapped());
    commands = queue().begin();
    simulation_.recordTakeOver(commands, from.simulation_, sent.view(), saved ? &saved->host : nullptr);
    queue().wait(queue().submit(commands));
    frame_ = from.frame_;
}

bool Runner::change(const sim::Scene& scene) {
    std::vector<sim::SceneChange> changes; // kept until the commands have finished
    bool isPossible = true;
    submit([&](VkCommandBuffer commands, sim::Simulation& simulation) {
        std::optional<sim::SceneChange> change = simulation.prepareChange(scene);
        if (!change) {
            isPossible = false;
            return;
        }
        EXPECT_TRUE(simulation.recordChange(commands, changes.emplace_back(*std::move(change))));
    });
    return isPossible;
}

void Runner::skin() {
    submit([](VkCommandBuffer commands, sim::Simulation& simulation) { simulation.recordSkin(commands); });
}

Runner::Saved Runner::save() {
    Saved saved{vk::Buffer(device(), {.name = "saved",
                                      .count = simulation_.stateSize() / 4,
                                      .stride = 4,
                                      .kind = vk::MemoryKind::device}),
                {}};
    const VkCommandBuffer commands = queue().begin();
    saved.host = simulation_.recordSaveState(commands, saved.buffer.view());
    queue().wait(queue().submit(commands));
    return saved;
}

void Runner::load(const Saved& saved) {
    const VkCommandBuffer commands = queue().begin();
    simulation_.recordLoadState(commands, saved.buffer.view(), saved.host);
    queue().wait(queue().submit(commands));
}

vk::Buffer Runner::saveTopology() const {
    vk::Buffer saved(device(), {.name = "topology", .count = simulation_.topologySize() / 4, .stride = 4});
    const VkCommandBuffer commands = queue().begin();
    simulation_.recordSaveTopology(commands, saved.view());
    queue().wait(queue().submit(commands));
    return saved;
}

void Runner::loadTopology(const vk::Buffer& saved) {
    const VkCommandBuffer commands = queue().begin();
    simulation_.recordLoadTopology(commands, saved.view());
    queue().wait(queue().submit(commands));
}

void Runner::writePosition(std::uint32_t particle, float x) {
    vk::BufferView target;
    const auto& buffers = simulation_.program().buffers;
    for (std::uint32_t b = 0; b < buffers.size(); ++b)
        if (buffers[b].label == "state.positions") target = simulation_.view({b});
    const std::uint32_t slot = slots_[particle];
    target.offset += std::size_t{target.stride} * slot;
    target.size = sizeof x;
    queue().upload(target, &x, sizeof x);
}

std::vector<Eigen::Vector3d> Runner::positions() const {
    return download(simulation_.positions(), simulation_.program().particleCount);
}

std::vector<Eigen::Vector3d> Runner::velocities() const {
    return download(simulation_.velocities(), simulation_.program().particleCount);
}

std::vector<float> Runner::inverseMasses() const {
    std::vector<float> result;
    for (const Vec4& element : queue().download<Vec4>(simulation_.positions())) result.push_back(element[3]);
    result.resize(simulation_.program().particleCount);
    return result;
}

std::uint64_t Runner::stateHash() const {
    std::uint64_t hash = sim::fnv1a({});
    for (const vk::BufferView& view : {simulation_.positions(), simulation_.velocities()})
        hash = sim::fnv1a(queue().download<std::byte>(view), hash);
    return hash;
}

void runOnce(sim::GpuExecutor& executor) {
    const VkCommandBuffer buffer = queue().begin();
    vk::Commands commands(device(), buffer);
    executor.upload(commands);
    executor.step(commands, {}, {}, nullptr);
    queue().wait(queue().submit(buffer));
}

std::uint64_t hashOfRun(const sim::Scene& scene, const sim::Settings& settings, int steps) {
    Runner runner(scene, settings);
    EXPECT_EQ(runner.run(steps).nonFinite, 0u);
    return runner.stateHash();
}

bool usesKernel(const sim::Scene& scene, const std::string& kernel, const sim::Settings& settings,
                const std::map<std::uint32_t, std::uint32_t>& constants) {
    const sim::StepProgram program = sim::compile(scene, settings);
    return std::ranges::any_of(program[sim::List::step], [&](const sim::Pass& pass) {
        if (pass.label != kernel) return false;
        const auto& own = program.kernels[pass.kernel].constants;
        return std::ranges::all_of(constants, [&](const auto& constant) {
            const auto found = own.find(constant.first);
            return found != own.end() && found->second == constant.second;
        });
    });
}

} // namespace sinew::test
