// A Simulation on the shared device that is stepped and read back one step at a time.
#pragma once

#include "sim/device/gpu_executor.hpp"
#include "sinew/simulation.hpp"
#include "support/device.hpp"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <utility>

namespace sinew::test {

class Runner {
public:
    /// Uploads the initial state.
    explicit Runner(const sim::Scene& scene, const sim::Settings& settings = {});

    /// Makes one step under the scene's gravity and waits for it.
    sim::Status step(float dt, std::span<const sim::Vec3> anchors = {});
    /// Makes the given step, but sets its frame number.
    sim::Status step(sim::Step step);
    /// Makes one step of the scene's dt under its gravity with a blade or a ray.
    sim::Status cut(const sim::Blade& blade, const sim::RayCut& ray = {});
    /// Makes steps of the scene's dt; returns the status of the last.
    sim::Status run(int steps);
    void reset();
    /// Takes over the state of `from` and continues with its next frame.
    void takeOver(const Runner& from);
    /// Changes the scene from the next step on; returns false if this needs another simulation.
    bool change(const sim::Scene& scene);
    void skin();
    /// A saved state between steps.
    struct Saved {
        vk::Buffer buffer;
        sim::SavedState host;
    };
    Saved save();
    /// Takes over through host memory, as from another device: the current state of `from`, or the one in
    /// `saved`.
    void takeOverByHost(const Runner& from, const Saved* saved = nullptr);
    void load(const Saved& saved);
    /// Saves the topology, which can be loaded into a state of another time.
    vk::Buffer saveTopology() const;
    void loadTopology(const vk::Buffer& saved);
    /// Overwrites x of a particle in the solver's state, like a fault.
    void writePosition(std::uint32_t particle, float x);

    std::vector<Eigen::Vector3d> positions() const;  ///< [m]
    std::vector<Eigen::Vector3d> velocities() const; ///< [m/s]; empty if not published
    std::vector<float> inverseMasses() const;        ///< in the public state [1/kg]
    std::uint64_t stateHash() const;                 ///< FNV-1a over the bits of the public state
    sim::Simulation& simulation() { return simulation_; }

private:
    void rehearse(const sim::Step& step);
    // Runs on the device under test; if that has no validation layer, also on one that has it.
    template <typename Record> void submit(const Record& record);

    sim::Simulation simulation_;
    std::unique_ptr<sim::Simulation> rehearsed_;              // set if isPlayed()
    std::map<std::pair<unsigned, unsigned>, int> rehearsals_; // by kind of a step and of the one before
    unsigned kind_ = 0;                                       // of the previous step
    std::uint64_t rehearsedFrame_ = 0;
    float dt_;
    sim::Vec3 gravity_;
    std::vector<std::uint32_t> slots_; // of each particle in the solver's state
    std::uint64_t frame_ = 0;
};

/// Uploads a program's buffers and makes one step, and waits for it.
void runOnce(sim::GpuExecutor& executor);

/// Hash of the state after some steps of the scene's dt, all of which must be finite.
std::uint64_t hashOfRun(const sim::Scene& scene, const sim::Settings& settings, int steps = 3);

/// Whether a step of the scene has a pass with this label.
bool usesKernel(const sim::Scene& scene, const std::string& kernel, const sim::Settings& settings = {},
                const std::map<std::uint32_t, std::uint32_t>& constants = {});

} // namespace sinew::test
