// Runs a scene on a device: one submission per step, or several for a long one, a few steps in flight, no
// wait inside a step.
#pragma once

#include "app/piece_count.hpp"
#include "app/state_file.hpp"
#include "app/step_parts.hpp"
#include "mesh/export_gltf.hpp"
#include "scenes/blades.hpp"
#include "sinew/measure.hpp"
#include "sinew/rooms.hpp"
#include "sinew/session.hpp"
#include "sinew/step_times.hpp"
#include "sinew/successor.hpp"

#include <functional>

namespace sinew::tools {

/// A step with a non-finite state, or with more contacts than the largest capacity.
struct Divergence {
    std::uint64_t step = 0; ///< counted from 1
    std::uint32_t particle = 0, count = 0;
    std::string body;       ///< empty if the particle belongs to no body
    bool isCrowded = false; ///< the state is finite; only `step` is valid
};

/// The drawn skins of the scene.
struct SkinMeshes {
    std::vector<mesh::TriangleMesh> whole;
    std::vector<std::vector<mesh::TriangleMesh>> pieces; ///< by piece; one mesh if nothing is cut
    std::vector<std::vector<mesh::ShadedMesh>> shaded;   ///< the same pieces with normals
    app::PieceCount count{};                             ///< of bodies that can be cut
};

/// The figures of sim::Status on cuts.
struct CutFigures {
    std::uint32_t links = 0, pieces = 0;
    std::uint32_t debris = 0, debrisParticles = 0; ///< removed fragments and their particles
    double debrisMass = 0;                         ///< [kg]
};

/// Counts of how steps were recorded and repeated.
struct ListFigures {
    std::uint64_t calm = 0;     ///< steps without list passes after the first substep (sim::Status::isCalm)
    std::uint64_t repeated = 0; ///< steps undone and repeated, for lists or for capacity
};

class Runner {
public:
    /// Creates the simulation and runs one step that is discarded, so that drivers which compile at the first
    /// use do so now. `session` and `scene` must outlive the Runner.
    Runner(Session& session, const sim::Scene& scene, const sim::Settings& settings,
           scenes::ScriptedBlades blades = {});

    /// Takes steps until `count` more are done, isInterrupted() or there is a divergence(). Repeats a step
    /// that lacks capacity for contacts with more capacity, and one that lacks contact lists with all passes.
    /// `inFlight` is 1 to Simulation::framesInFlight. `onStep` gets the number of steps done.
    void advance(std::uint64_t count, std::uint32_t inFlight,
                 const std::function<void(std::uint64_t)>& onStep = {});

    /// Returns to the scene's state, without steps and times.
    void restart();

    /// The newest finite state. The caller fills in scene, material and gravity. Waits for the queue.
    app::SavedRun save();
    /// Continues from a state instead of the scene's own; so do scripted blades. Throws app::Failure
    /// (badInput) if the state belongs to another simulation. Waits for the queue.
    void load(const app::SavedRun& run);

    std::uint64_t steps() const { return done_; } ///< with a finite state
    const std::optional<Divergence>& divergence() const { return divergence_; }
    std::uint64_t slowed() const { return slowed_; } ///< sum of Status::slowed over those steps
    const sim::Simulation& simulation() const { return *simulation_; }
    const ListFigures& lists() const { return lists_; }
    const sim::ContactRoom& contactRoom() const { return rooms_.contacts(); }
    const sim::SurfaceRoom& surfaceRoom() const { return rooms_.surface(); }
    std::uint64_t deviceBytes() const;                               ///< in buffers of the session's device
    std::uint32_t surfaceMissing() const { return surfaceMissing_; } ///< Status::cutSurfaceMissing of these
    /// Figures of the newest step with a finite state.
    const CutFigures& cuts() const { return cuts_; }
    /// Forces in that step; empty without Settings::keepsForces.
    const sim::Impulses& forces() const { return forces_; }

    /// Complaints of the simulation about its use (sim::Simulation::complaints), after advance(); empty if it
    /// lacked capacity for contacts, which the divergence reports.
    std::vector<std::string> complaints();

    /// Wall-clock times [ms] between the ends of consecutive steps, including one that diverged; steps whose
    /// ends the host sees together share the time in equal parts (StepTimes). Only the newest 65,536, so that
    /// an endless run does not grow. Unordered.
    const std::vector<double>& frameMs() const { return frameMs_; }
    /// Device times of the same steps [ms], phases summed; empty without timestamps.
    const std::vector<double>& deviceMs() const { return deviceMs_; }
    /// Mean device times of a step [ms], one for each of simulation().phases(); empty without timestamps.
    std::vector<double> phaseMs() const;
    double recordMs() const; ///< mean host time to record and submit a step [ms]

    /// Reads the newest finite state and the skins drawn from it from the device.
    State readState();
    SkinMeshes readSkins();

private:
    void submitReset();
    void submitStep(std::uint64_t frame);
    bool finishStep(std::uint64_t frame);
    bool makeRoom(std::uint32_t needed);
    void makeSurfaceRoom();
    void continueWith(const sim::Settings& settings);
    std::uint64_t firstUnfinished(std::uint64_t frame) const;
    void countTime(std::size_t slot);

    Session& session_;
    const sim::Scene& scene_;
    sim::Settings settings_; // of simulation_
    scenes::ScriptedBlades blades_;
    sim::Rooms rooms_;
    std::unique_ptr<sim::Simulation> simulation_;
    sim::Successor successor_;
    app::StepParts parts_;
    std::vector<vk::Timestamps> timestamps_;                                 // one per step in flight
    std::array<std::uint64_t, sim::Simulation::framesInFlight> submitted_{}; // timeline values
    std::uint64_t done_ = 0, slowed_ = 0;
    std::uint64_t played_ = 0; // steps before the first one, in the loaded state
    std::optional<Divergence> divergence_;
    std::vector<double> frameMs_, deviceMs_, phaseSums_;
    double recordSum_ = 0; // [ms]
    StepTimes stepTimes_;
    std::uint64_t next_ = 0; // the next step to submit, during advance()
    std::uint64_t recorded_ = 0, timed_ = 0;
    CutFigures cuts_;
    ListFigures lists_;
    sim::Impulses forces_;
    std::uint32_t surfaceMissing_ = 0;
    vk::Drain drain_; // last: steps may be in flight when an exception destroys the other members
};

} // namespace sinew::tools
