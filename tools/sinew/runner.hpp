// Steps a scene on a device: one submission a step, a few of them in flight, no wait inside a step.
#pragma once

#include "app/growing_simulation.hpp"
#include "app/piece_count.hpp"
#include "app/state_file.hpp"
#include "mesh/export_gltf.hpp"
#include "scenes/blades.hpp"
#include "sinew/measure.hpp"
#include "sinew/session.hpp"

#include <functional>

namespace sinew::tools {

/// A step whose state was no longer finite, or that found more contacts than there can be room for.
struct Divergence {
    std::uint64_t step = 0; ///< counted from 1
    std::uint32_t particle = 0, count = 0;
    std::string body;       ///< empty where the particle belongs to none
    bool isCrowded = false; ///< all is finite: nothing else is meant but `step`
};

/// What is drawn of each skin of the scene.
struct SkinMeshes {
    std::vector<mesh::TriangleMesh> whole;
    std::vector<std::vector<mesh::TriangleMesh>> pieces; ///< the same; one each where nothing is cut
    std::vector<std::vector<mesh::ShadedMesh>> shaded;   ///< likewise, with normals
    app::PieceCount count{};                             ///< of bodies that may be cut
};

/// What sim::Status says of bodies that may be cut.
struct CutFigures {
    std::uint32_t links = 0, pieces = 0;
    std::uint32_t crumbs = 0, crumbParticles = 0; ///< pieces that were removed, and theirs
    double crumbMass = 0;                         ///< [kg]
};

/// How steps were recorded and repeated.
struct ListFigures {
    std::uint64_t calm = 0;     ///< steps that had none after their first substep (sim::Status::isCalm)
    std::uint64_t repeated = 0; ///< steps that were undone and taken again, for lists or for room
};

class Runner {
public:
    /// Creates the simulation and runs one step that is thrown away, so that drivers which compile late do so
    /// now. `session` and `scene` must outlive the Runner.
    Runner(Session& session, const sim::Scene& scene, const sim::Settings& settings,
           scenes::ScriptedBlades blades = {});

    /// Steps until `count` more are done, isInterrupted() or there is a divergence(). A step without room for
    /// its contacts is done again with more, one that lacked lists of them with all passes. `inFlight` is 1
    /// to Simulation::framesInFlight. `onStep` gets the number of steps done.
    void advance(std::uint64_t count, std::uint32_t inFlight,
                 const std::function<void(std::uint64_t)>& onStep = {});

    /// Back to the scene's state and to no steps and no times.
    void restart();

    /// The newest finite state. Scene, material and gravity of it are the caller's to fill in. Waits for the
    /// queue.
    app::SavedRun save();
    /// Goes on from a state instead of the scene's: scripted blades too. Throws app::Failure (badInput) where
    /// the state is of another simulation. Waits for the queue.
    void load(const app::SavedRun& run);

    std::uint64_t steps() const { return done_; } ///< with a finite state
    const std::optional<Divergence>& divergence() const { return divergence_; }
    std::uint64_t slowed() const { return slowed_; } ///< sum of Status::slowed over those steps
    const sim::Simulation& simulation() const { return growing_.simulation(); }
    const ListFigures& lists() const { return lists_; }
    const app::ContactRoom& contactRoom() const { return growing_.contactRoom(); }
    const app::SurfaceRoom& surfaceRoom() const { return growing_.surfaceRoom(); }
    std::uint32_t surfaceMissing() const { return surfaceMissing_; } ///< Status::cutSurfaceMissing, likewise
    /// Of the newest step with a finite state.
    const CutFigures& cuts() const { return cuts_; }
    /// Forces of that step; empty without Settings::keepsForces.
    const sim::Impulses& forces() const { return forces_; }

    /// Complaints of the simulation about its use (sim::Simulation::complaints), after advance(); nothing
    /// where it found too little room for contacts, which the divergence tells.
    std::vector<std::string> complaints();

    /// Wall-clock time [ms] from the end of one step to the end of the next, of the newest 65,536 steps at
    /// most, the one that diverged included: an endless run must not grow. In no order.
    const std::vector<double>& frameMs() const { return frameMs_; }
    /// Device time of a step [ms], its phases summed, of the same steps; empty without timestamps.
    const std::vector<double>& deviceMs() const { return deviceMs_; }
    /// Mean device time of a step [ms], one value per entry of simulation().phases(); empty without
    /// timestamps.
    std::vector<double> phaseMs() const;
    double recordMs() const; ///< mean host time to record and submit a step [ms]

    /// The newest finite state and the skins drawn from it, read back from the device.
    State readState();
    SkinMeshes readSkins();

private:
    void submitReset();
    void submitStep(std::uint64_t frame);
    bool finishStep(std::uint64_t frame);
    void growSurface();
    void countTime(std::size_t slot, double end);

    Session& session_;
    const sim::Scene& scene_;
    sim::Settings settings_;
    scenes::ScriptedBlades blades_;
    app::GrowingSimulation growing_;
    std::vector<vk::Timestamps> timestamps_;                                 // one a step in flight
    std::array<std::uint64_t, sim::Simulation::framesInFlight> submitted_{}; // timeline values
    std::uint64_t done_ = 0, slowed_ = 0;
    std::uint64_t played_ = 0; // steps before the first, of the state that it goes on from
    std::optional<Divergence> divergence_;
    std::vector<double> frameMs_, deviceMs_, phaseSums_;
    double recordSum_ = 0, lastEnd_ = 0; // [ms]
    std::uint64_t recorded_ = 0, timed_ = 0;
    CutFigures cuts_;
    ListFigures lists_;
    sim::Impulses forces_;
    std::uint32_t surfaceMissing_ = 0;
    vk::Drain drain_; // last: steps may be in flight when an exception destroys the rest
};

} // namespace sinew::tools
