// The document: the scene on show with its simulation, step count, material, solver and capacity.
#pragma once

#include "app/state_file.hpp"
#include "app/take_over.hpp"
#include "scenes/blades.hpp"
#include "scenes/load.hpp"
#include "sinew/material.hpp"
#include "sinew/rooms.hpp"
#include "sinew/substeps.hpp"
#include "sinew/successor.hpp"
#include "viewer/render/camera.hpp"

#include <deque>
#include <future>
#include <optional>

namespace sinew::viewer {

/// A step after which the state is not finite.
struct Divergence {
    std::uint64_t step = 0;
    std::uint32_t particles = 0;     ///< number of particles with a non-finite state
    std::uint32_t firstParticle = 0; ///< smallest index among them
    std::string body;                ///< body of that particle
    /// A sentence such as 'The simulation became unstable (body "organ", step 12).'
    std::string sentence() const;
    /// The same, and what a person at the window can do.
    std::string advice() const;
    /// The same for a run without a window: how many particles, the first of them, and what to change.
    std::string report() const;
};

/// Must not outlive its Device, which must not move.
class Document {
public:
    /// The scene is given as in its file; `material` is applied to it from the start.
    Document(const vk::Device& device, sim::Scene scene, const sim::Settings& settings,
             const sim::Material& material = {});
    ~Document(); ///< waits for a material that is being prepared
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    /// Record as those of sim::Simulation do. A new document must be reset once before its first step.
    void recordReset(VkCommandBuffer commands) noexcept;
    void recordStep(VkCommandBuffer commands, vk::Timestamps* timestamps = nullptr,
                    std::span<const sim::Grab> grabs = {}, const sim::Blade& blade = {},
                    std::span<const sim::HostCollider> hostColliders = {}) noexcept {
        recordStep(std::span(&commands, 1), timestamps, grabs, blade, hostColliders);
    }
    void recordStep(std::span<const VkCommandBuffer> parts, vk::Timestamps* timestamps = nullptr,
                    std::span<const sim::Grab> grabs = {}, const sim::Blade& blade = {},
                    std::span<const sim::HostCollider> hostColliders = {}) noexcept;
    /// The skins as they are drawn (sim::SkinDetail::drawn).
    void recordSkin(VkCommandBuffer commands) noexcept {
        simulation_->recordSkin(commands, sim::SkinDetail::drawn);
    }

    /// Save and load as app::saveRun and loadRun do. A state that was loaded has taken no step.
    app::SavedRun save(const vk::Device& device, vk::Queue& queue) const;
    void load(const vk::Device& device, const app::SavedRun& run, vk::Queue& queue);

    /// Goes on after the newest step in a simulation with at least the rooms of `roomy`, if there is less.
    /// Waits for `queue`. Throws as sim::Simulation: all is then as it was.
    void widen(const sim::Settings& roomy, vk::Queue& queue);

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
    /// Polls the material change; call it for every picture. `refused`: the material needs other passes.
    /// Throws as turnNow(); the document is then unchanged.
    enum class Turn { none, ready, refused };
    Turn takeTurn(bool isPaused);
    /// Records the prepared material for the next step; returns it. Does nothing if none is ready or
    /// undoneSteps() come first. recordStep() calls this itself.
    std::optional<sim::Material> recordTurn(VkCommandBuffer commands) noexcept;
    const sim::Material& material() const noexcept { return material_; }
    /// Report on the scene as it is.
    const sim::StiffnessReport& stiffness() const noexcept { return stiffness_; }

    /// Requests another solver and number of substeps for reshape(), in place of an earlier request. In
    /// replays no step may be recorded before reshape(), except undoneSteps().
    void wantShape(sim::Solver solver, std::uint32_t substeps);
    /// Withdraws the request.
    void keepShape();
    bool wantsShape() const noexcept { return shape_ || refused_; }
    /// Whether the requested simulation has been made. The first call starts a thread that makes it, and
    /// cancels a growth for the surface of cuts. False while there are undoneSteps() or lacksContactRoom():
    /// the present simulation repeats those steps first.
    bool isShapeMade();
    /// Continues after the newest step in the requested simulation. Waits for `queue`, in which everything
    /// was submitted, and for the simulation in the making. Throws as sim::Simulation; the document is then
    /// unchanged, without a request. Not while there are undoneSteps() or lacksContactRoom().
    void reshape(vk::Queue& queue, const app::Bring& bring = {});

    /// Continues from the state of `from`, a document of the same scene that may have another material,
    /// solver, number of substeps and device; capacities become at least those of `from`. Instead of
    /// recordReset(). All steps of both must have finished. Waits. Throws as sim::Simulation: this document
    /// must then be reset, and `from` is unchanged.
    void takeOver(const Document& from, const app::Bring& bring = {});

    /// Records a take-over on the same device; all steps of both must have finished before the commands run.
    /// Capacities stay as they are: requires hasRoomOf(from).
    void recordTakeOver(VkCommandBuffer commands, const Document& from);
    bool hasRoomOf(const Document& other) const noexcept;

    /// For callers that restore earlier states.
    sim::Simulation& simulation() noexcept { return *simulation_; }

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
    /// surface of cuts. False if there cannot be such a capacity. Growth for the surface: only while nothing
    /// else grows, and not while wantsShape().
    bool beginRoom(std::uint64_t step);
    bool beginSurfaceRoom(std::uint32_t needed);
    bool isGrowing() const noexcept { return next_ && next_->purpose != Purpose::shape; }
    bool lacksContactRoom() const noexcept {
        return wantedRoom_ || (next_ && next_->purpose == Purpose::contacts);
    }
    /// Whether it is there by now. `none`: nothing grows, or there is no memory for the surface of cuts.
    /// Throws what making it threw, where it is for contacts.
    enum class Growth { making, made, none };
    Growth askGrowth();
    /// The simulation that is made takes over the state that there is: all steps have finished, and no other
    /// is recorded until endGrowth(), once the commands have finished: simulation() is then that one. Before
    /// that kept states are brought over; waits for `queue`. Throws as Simulation::checkTakeOver, and
    /// vk::Error.
    void bringGrowth(vk::Queue& queue, const app::Bring& bring);
    void recordGrowth(VkCommandBuffer commands) noexcept;
    void endGrowth();

    const sim::Scene& scene() const noexcept { return scene_; }
    /// Settings as it was made; settings now, with all the room that there is.
    const sim::Settings& madeWith() const noexcept { return first_; }
    const sim::Settings& settings() const noexcept { return settings_; }
    const sim::Simulation& simulation() const noexcept { return *simulation_; }
    /// Complaints about the use of the simulation: warnings of the scene are told where it is loaded.
    std::vector<std::string> complaints() { return simulation_->complaintsOfUse(); }
    const sim::ContactRoom& contactRoom() const noexcept { return rooms_.contacts(); }
    const sim::SurfaceRoom& surfaceRoom() const noexcept { return rooms_.surface(); }

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
    // Use of the successor.
    enum class Purpose { contacts, surface, shape };
    struct Next {
        Purpose purpose;
        sim::Settings settings;
        sim::Material material;
    };
    sim::Scene sceneOf(const sim::Material& material, const sim::Settings& settings) const;
    Turned prepare(const sim::Material& material) const;
    void beginTurn();
    void awaitTurn();
    void make(const sim::Settings& settings, const sim::Material& material);
    void begin(const Next& next);
    void beginShape();
    void dropShape();
    void beginWanted();
    void takeSuccessor(const sim::Material& material, vk::Queue& queue, const app::Bring& bring);
    void enlarge(const sim::Settings& settings, vk::Queue& queue, const app::Bring& bring);
    void continueIn(sim::Successor::Made made, const sim::Material& material);

    const vk::Device& device_;
    const sim::Scene given_;
    scenes::Defaults defaults_; // for given_
    sim::Scene scene_;          // with the present material
    const sim::Settings first_;
    sim::Settings settings_; // of simulation_
    sim::StiffnessReport stiffness_;
    sim::Rooms rooms_;
    std::unique_ptr<sim::Simulation> simulation_;
    scenes::ScriptedBlades blades_;
    sim::Vec3 gravity_, down_{0, -1, 0};
    std::uint64_t steps_ = 0, played_ = 0, recordedSteps_ = 0;
    std::uint64_t newest_ = 0; // newest recorded step, undone or not; at least steps_
    bool repeats_ = false;
    sim::Material material_;
    std::optional<sim::Material> wanted_; // prepared after the present one
    std::optional<Turned> ready_;
    std::optional<Shape> shape_;               // for reshape()
    std::optional<sim::Material> refused_;     // for reshape()
    std::deque<Recorded> recorded_;            // that the device may still copy from
    std::optional<Next> next_;                 // of successor_ or made_
    std::optional<sim::Successor::Made> made_; // takes over at endGrowth()
    std::optional<std::uint32_t> wantedRoom_;  // for contacts, after the growth that there is
    bool isTurnOutdated_ = false;              // turning_ is for a simulation that is gone
    std::future<Turned> turning_;              // refers to what stands before it, as the next
    sim::Successor successor_;
};

} // namespace sinew::viewer
