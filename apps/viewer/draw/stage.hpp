// The simulation controller: the simulation of the scene on show, its step count, material, solver and
// capacity.
#pragma once

#include "app/growing_simulation.hpp"
#include "app/state_file.hpp"
#include "scenes/blades.hpp"
#include "scenes/load.hpp"
#include "sim/material.hpp"
#include "sim/substeps.hpp"
#include "viewer/draw/camera.hpp"

#include <deque>
#include <future>
#include <optional>

namespace sinew::viewer {

/// The place and step of a divergence.
struct Divergence {
    std::uint64_t step = 0;
    std::uint32_t particles = 0;     ///< number of particles with a non-finite state
    std::uint32_t firstParticle = 0; ///< smallest index among them
    std::string body;                ///< body of that particle
    /// Text such as "the simulation diverged: step 12, body "organ", particle 417: 3 particles are not finite
    /// ...: use more ..."
    std::string sentence() const;
};

/// Must not outlive its Device, which must not move.
class Stage {
public:
    /// The scene is given as in its file; `material` is applied to it from the start.
    Stage(const vk::Device& device, sim::Scene scene, const sim::Settings& settings,
          const sim::Material& material = {});
    ~Stage(); ///< waits for a material that is being prepared
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// These functions: see sim::Simulation. A new stage must be reset once before its first step.
    void recordReset(VkCommandBuffer commands) noexcept;
    void recordStep(VkCommandBuffer commands, vk::Timestamps* timestamps = nullptr,
                    std::span<const sim::Grab> grabs = {}, const sim::Blade& blade = {},
                    std::span<const sim::Poke> pokes = {}) noexcept;
    /// Records the skins for drawing; sim::Overlap::some only for layers that all allow it (Layers::overlap).
    void recordSkin(VkCommandBuffer commands, sim::Overlap overlap = sim::Overlap::none) noexcept {
        growing_.simulation().recordSkin(commands, sim::SkinDetail::drawn, overlap);
    }

    /// See app::saveRun and loadRun; step counts start at 0 after load().
    app::SavedRun save(const vk::Device& device, vk::Queue& queue) const;
    void load(const vk::Device& device, const app::SavedRun& run, vk::Queue& queue);

    /// See app::GrowingSimulation::widen.
    void widen(const sim::Settings& roomy, vk::Queue& queue) { growing_.widen(roomy, queue); }

    /// Sets scenes::LoadedScene::defaults of the scene: features that are dropped if a solver has no form for
    /// them.
    void setDefaults(scenes::Defaults defaults) { defaults_ = std::move(defaults); }

    /// Sets the scripted blades, which start at the reset; in their steps no other blade cuts.
    void setBlades(scenes::ScriptedBlades blades) { blades_ = std::move(blades); }

    /// Sets gravity downwards from the next step on: along the scene's own, or -y if the scene has none
    /// [m/s^2].
    void setGravity(float gravity) noexcept;
    void setGravity(const sim::Vec3& gravity) noexcept { gravity_ = gravity; }
    const sim::Vec3& gravity() const noexcept { return gravity_; }

    /// Requests another material of the given scene, from a later step on. A thread of its own prepares it;
    /// of several requests in the meantime the last one counts.
    void turn(const sim::Material& material);
    /// Applies the material from the next step on; waits, so that replays are exact. A material that needs
    /// other passes waits for reshape(). Throws as Simulation::prepareChange.
    void turnNow(const sim::Material& material);
    /// Polls the material change; call it for every picture. `refused`: the change needs another step
    /// program. Throws as turnNow(); the stage is then unchanged.
    enum class Turn { none, ready, refused };
    Turn takeTurn(bool isPaused);
    /// Records the prepared material for the next step; returns it. Does nothing if none is ready or
    /// undoneSteps() come first. recordStep() calls this itself.
    std::optional<sim::Material> recordTurn(VkCommandBuffer commands) noexcept;
    const sim::Material& material() const noexcept { return material_; }
    /// Stiffness report of the scene with its present material.
    const sim::StiffnessReport& stiffness() const noexcept { return stiffness_; }

    /// Requests another solver and number of substeps for reshape(), in place of an earlier request. In
    /// replays no step may be recorded before reshape().
    void wantShape(sim::Solver solver, std::uint32_t substeps);
    /// Withdraws the request. Waits for a simulation in the making, as does another wantShape() meanwhile.
    void keepShape();
    bool wantsShape() const noexcept { return shape_ || refused_; }
    /// Whether the requested simulation has been made; the first call starts a thread that makes it.
    bool isShapeMade();
    /// Continues after the newest step in the requested simulation. Waits for `queue`, in which everything
    /// was submitted, and for the simulation in the making. Throws as sim::Simulation; the stage is then
    /// unchanged, without a request.
    void reshape(vk::Queue& queue, const app::Bring& bring = {});

    /// Continues from the state of `from`, a stage of the same scene that may have another material, solver,
    /// number of substeps and device (see app::GrowingSimulation::takeOver). Instead of recordReset().
    void takeOver(const Stage& from, const app::Bring& bring = {});

    /// Records a take-over on the same device; all steps of both must have finished before the commands run.
    /// Capacities stay as they are: requires hasRoomOf(from).
    void recordTakeOver(VkCommandBuffer commands, const Stage& from);
    bool hasRoomOf(const Stage& other) const noexcept;

    /// For callers that restore earlier states.
    sim::Simulation& simulation() noexcept { return growing_.simulation(); }

    /// Steps of the time in which scripted blades move; equal to steps() unless an earlier state was
    /// restored.
    std::uint64_t played() const noexcept { return played_; }
    /// Call after loading the state after that many steps: undone steps are not taken again.
    void setPlayed(std::uint64_t steps) noexcept {
        played_ = steps;
        newest_ = steps_;
    }

    /// Steps since the reset.
    std::uint64_t steps() const noexcept { return steps_; }
    /// Number of undone steps behind steps() that are to be repeated before another material or an earlier
    /// state may come.
    std::uint64_t undoneSteps() const noexcept { return newest_ - steps_; }

    /// The divergence that a finished step found; empty if all is well, or if a step after a reset has
    /// replaced it. The step must be one of the last Simulation::framesInFlight recorded.
    std::optional<Divergence> check(std::uint64_t step) const;

    /// Status::contactRoom of such a step; if more than 0, that step and all after it were undone.
    std::uint32_t neededRoom(std::uint64_t step) const;
    /// Whether later steps may lack contact lists (sim::Step::repeats). The caller must then check
    /// lacksLists() of each step, oldest first. Off at first.
    void setRepeats(bool repeats) noexcept { repeats_ = repeats; }
    bool repeats() const noexcept { return repeats_; }
    /// Whether recordTurn() has a material for the next step.
    bool isTurnReady() const noexcept { return ready_ && undoneSteps() == 0; }
    /// Status::lacksLists of such a step; if true, that step and all after it were undone.
    bool lacksLists(std::uint64_t step) const;
    /// The next step repeats `step`, which was undone. All recorded steps must have finished.
    void goBackBefore(std::uint64_t step) noexcept;
    /// Goes back before that step, in another simulation() with capacity for it. Waits for `queue`, in which
    /// everything was submitted. False if there cannot be such a capacity. Throws vk::Error.
    bool makeRoom(std::uint64_t step, vk::Queue& queue, const app::Bring& bring = {});

    /// For finished steps whose Status::cutSurfaceMissing was at most `needed`: continues after the newest in
    /// another simulation() with capacity for it. False if there cannot be such a capacity, or nothing is
    /// missing. Waits for `queue`.
    bool makeSurfaceRoom(std::uint32_t needed, vk::Queue& queue, const app::Bring& bring = {});

    /// Like the two functions above, without waiting: a thread of its own makes a simulation with that
    /// capacity. No step may be recorded meanwhile if it is for contacts; steps go on if it is for the
    /// surface of cuts. False if there cannot be such a capacity. One growth at a time.
    bool beginRoom(std::uint64_t step);
    bool beginSurfaceRoom(std::uint32_t needed);
    bool isGrowing() const noexcept { return growth_.has_value(); }
    bool lacksContactRoom() const noexcept { return wantedRoom_ || (growth_ && growth_->isOfContacts); }
    /// Polls the growth. `none`, for the surface only: there is no memory for it, and growth ends. If it is
    /// for contacts, throws what making the simulation threw.
    enum class Growth { making, made, none };
    Growth askGrowth();
    /// The three steps of a growth once it is made, when all steps have finished: bringGrowth() moves saved
    /// states (waits for `queue`); recordGrowth() copies the present state; endGrowth(), when those commands
    /// have finished, replaces simulation(). No step may be recorded in between.
    void bringGrowth(vk::Queue& queue, const app::Bring& bring);
    void recordGrowth(VkCommandBuffer commands) noexcept;
    void endGrowth();

    const sim::Scene& scene() const noexcept { return scene_; }
    /// Settings at construction; settings() has the present capacities.
    const sim::Settings& madeWith() const noexcept { return settings_; }
    const sim::Settings& settings() const noexcept { return growing_.settings(); }
    const sim::Simulation& simulation() const noexcept { return growing_.simulation(); }
    /// These functions: see GrowingSimulation.
    std::vector<std::string> complaints() { return growing_.complaints(); }
    const app::ContactRoom& contactRoom() const noexcept { return growing_.contactRoom(); }
    const app::SurfaceRoom& surfaceRoom() const noexcept { return growing_.surfaceRoom(); }

private:
    struct Turned {
        sim::Material material;
        sim::Scene scene;
        sim::StiffnessReport stiffness;
        std::optional<sim::SceneChange> change; // empty: needs another step program
    };
    struct Recorded {
        sim::SceneChange change;
        std::uint64_t step; // in recordedSteps_
    };
    struct Shape {
        sim::Solver solver;
        std::uint32_t substeps;
    };
    struct Reshaping {
        sim::Settings settings;
        sim::Material material;
        std::future<std::unique_ptr<sim::Simulation>> making;
    };
    struct Growing {
        sim::Settings settings;
        bool isOfContacts;
        sim::Material material;
        std::future<std::unique_ptr<sim::Simulation>> making; // later in `made`
        std::unique_ptr<sim::Simulation> made;
    };
    sim::Scene sceneOf(const sim::Material& material, const sim::Settings& settings) const;
    Turned prepare(const sim::Material& material) const;
    void beginTurn();
    void awaitTurn();
    std::future<std::unique_ptr<sim::Simulation>> make(const sim::Settings& settings,
                                                       const sim::Material& material) const;
    void beginShape();
    void beginGrowth(const sim::Settings& settings, bool isOfContacts);
    void beginWanted();

    const sim::Scene given_;
    scenes::Defaults defaults_; // for given_
    sim::Scene scene_;          // with the present material
    sim::Settings settings_;
    sim::StiffnessReport stiffness_;
    app::GrowingSimulation growing_;
    scenes::ScriptedBlades blades_;
    sim::Vec3 gravity_, down_{0, -1, 0};
    std::uint64_t steps_ = 0, played_ = 0, recordedSteps_ = 0;
    std::uint64_t newest_ = 0; // newest recorded step, undone or not; at least steps_
    bool repeats_ = false;
    sim::Material material_;
    std::optional<sim::Material> wanted_; // prepared after the present one
    std::optional<Turned> ready_;
    std::optional<Shape> shape_;           // for reshape()
    std::optional<sim::Material> refused_; // for reshape()
    std::deque<Recorded> recorded_;        // the device may still copy from these
    std::future<Turned> turning_;          // uses the members above, as do growth_ and reshaping_
    std::optional<Growing> growth_;
    std::optional<Reshaping> reshaping_;
    std::optional<std::uint32_t> wantedRoom_; // contacts to provide for after the present growth
};

} // namespace sinew::viewer
