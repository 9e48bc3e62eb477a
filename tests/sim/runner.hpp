// A Simulation on the shared device, stepped and read back one step at a time.
#pragma once

#include "sim/simulation.hpp"
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

    /// One step under the scene's gravity; waits for it.
    sim::Status step(float dt, std::span<const sim::Vec3> anchors = {});
    /// One step as it says, but for its frame.
    sim::Status step(sim::Step step);
    /// One step of the scene's dt under its gravity with a blade or a ray.
    sim::Status cut(const sim::Blade& blade, const sim::RayCut& ray = {});
    /// Steps of the scene's dt; returns the status of the last.
    sim::Status run(int steps);
    void reset();
    /// Goes on where `from` stands, with its next frame.
    void takeOver(const Runner& from);
    /// From the next step on; false where that needs another simulation.
    bool change(const sim::Scene& scene);
    void skin();
    /// The state between steps, to come back to.
    struct Saved {
        vk::Buffer buffer;
        sim::SavedState host;
    };
    Saved save();
    /// By way of host memory, as from another device; of a state that `from` has saved, if any.
    void takeOverByHost(const Runner& from, const Saved* saved = nullptr);
    void load(const Saved& saved);
    /// What is cut, to be put back into the state of another time.
    vk::Buffer saveTopology() const;
    void loadTopology(const vk::Buffer& saved);
    /// Overwrites x of a particle in the solver's own state, as a fault would.
    void writePosition(std::uint32_t particle, float x);

    std::vector<Eigen::Vector3d> positions() const;  ///< [m]
    std::vector<Eigen::Vector3d> velocities() const; ///< [m/s]; empty where they are not published
    std::vector<float> inverseMasses() const;        ///< as the public state has them [1/kg]
    std::uint64_t stateHash() const;                 ///< FNV-1a over the bits of the public state
    sim::Simulation& simulation() { return simulation_; }

private:
    void rehearse(const sim::Step& step);
    // On the device under test and, where that is without the validation layer, under it.
    template <typename Record> void submit(const Record& record);

    sim::Simulation simulation_;
    std::unique_ptr<sim::Simulation> rehearsed_;              // where isPlayed()
    std::map<std::pair<unsigned, unsigned>, int> rehearsals_; // of each kind of step after another
    unsigned kind_ = 0;                                       // of the step before
    std::uint64_t rehearsedFrame_ = 0;
    float dt_;
    sim::Vec3 gravity_;
    std::vector<std::uint32_t> slots_; // of each particle in the solver's state
    std::uint64_t frame_ = 0;
};

/// Of the state after some steps of the scene's dt, all of which must be finite.
std::uint64_t hashOfRun(const sim::Scene& scene, const sim::Settings& settings, int steps = 3);

/// Whether a step of the scene has a pass with this label.
bool usesKernel(const sim::Scene& scene, const std::string& kernel, const sim::Settings& settings = {});

} // namespace sinew::test
