// The scene on show: its simulation, how many steps it has taken, and whether it still makes sense.
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

/// Where a simulation broke.
struct Divergence {
    std::uint64_t step = 0;
    std::uint32_t particles = 0;     ///< with a non-finite state
    std::uint32_t firstParticle = 0; ///< smallest index among them
    std::string body;                ///< that it belongs to
    /// "the simulation diverged: step 12, body "organ", particle 417: 3 particles are not finite ...: use
    /// more ..."
    std::string sentence() const;
};

/// Must not outlive its Device, which must not move.
class Stage {
public:
    /// `material` that the scene, given as it is in its file, is turned to from the start.
    Stage(const vk::Device& device, sim::Scene scene, const sim::Settings& settings,
          const sim::Material& material = {});
    ~Stage(); ///< waits for a material that is being prepared
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// As those of sim::Simulation. A new stage must be reset once before its first step.
    void recordReset(VkCommandBuffer commands) noexcept;
    void recordStep(VkCommandBuffer commands, vk::Timestamps* timestamps = nullptr,
                    std::span<const sim::Grab> grabs = {}, const sim::Blade& blade = {},
                    std::span<const sim::Poke> pokes = {}) noexcept;
    /// What is to be drawn of it: with sim::Overlap::some in layers none of which needs (Layers::overlap)
    /// another.
    void recordSkin(VkCommandBuffer commands, sim::Overlap overlap = sim::Overlap::none) noexcept {
        growing_.simulation().recordSkin(commands, sim::SkinDetail::drawn, overlap);
    }

    /// As app::saveRun and loadRun; what is loaded has taken no step since then.
    app::SavedRun save(const vk::Device& device, vk::Queue& queue) const;
    void load(const vk::Device& device, const app::SavedRun& run, vk::Queue& queue);

    /// As app::GrowingSimulation::widen.
    void widen(const sim::Settings& roomy, vk::Queue& queue) { growing_.widen(roomy, queue); }

    /// scenes::LoadedScene::defaults of the scene: bodies do without them in a shape that has no form for
    /// them.
    void setDefaults(scenes::Defaults defaults) { defaults_ = std::move(defaults); }

    /// Blades that cut by themselves, from the reset on; in their steps no other one does.
    void setBlades(scenes::ScriptedBlades blades) { blades_ = std::move(blades); }

    /// Downwards, from the next step on: along the scene's own, or -y where that is none [m/s^2].
    void setGravity(float gravity) noexcept;
    void setGravity(const sim::Vec3& gravity) noexcept { gravity_ = gravity; }
    const sim::Vec3& gravity() const noexcept { return gravity_; }

    /// Another material of the scene as it was given, from a later step on: prepared in a thread of its own;
    /// of several that are asked for meanwhile the last.
    void turn(const sim::Material& material);
    /// The same from the next step on: waits, for replays. What needs other passes needs reshape(). Throws as
    /// Simulation::prepareChange.
    void turnNow(const sim::Material& material);
    /// What came of turn(), where something did; to be called for every picture. Refused is what other passes
    /// are needed for. Throws likewise: all is then as it was.
    enum class Turn { none, ready, refused };
    Turn takeTurn(bool isPaused);
    /// Records what is ready: the next step has that material. Nothing where nothing is, or where
    /// undoneSteps() come first. Steps do so themselves.
    std::optional<sim::Material> recordTurn(VkCommandBuffer commands) noexcept;
    const sim::Material& material() const noexcept { return material_; }
    /// Of the scene as it is.
    const sim::StiffnessReport& stiffness() const noexcept { return stiffness_; }

    /// Another solver and number of substeps, at reshape(), in place of what was wanted before. For replays:
    /// no step may be recorded before that.
    void wantShape(sim::Solver solver, std::uint32_t substeps);
    /// None after all. What has begun to be made is waited for, as where another shape is wanted meanwhile.
    void keepShape();
    bool wantsShape() const noexcept { return shape_ || refused_; }
    /// Whether the simulation that is wanted has been made, in a thread of its own, which begins with the
    /// first time that somebody asks.
    bool isShapeMade();
    /// Goes on after the newest step in another simulation(), as wanted. Waits for `queue`, in which all was
    /// submitted, and for what has not been made yet. Throws as sim::Simulation: all is then as it was, and
    /// nothing wanted any more.
    void reshape(vk::Queue& queue, const app::Bring& bring = {});

    /// Goes on where `from` stands, a stage of the same scene that may have another material, solver, number
    /// of substeps and device: as app::GrowingSimulation::takeOver, instead of recordReset().
    void takeOver(const Stage& from, const app::Bring& bring = {});

    /// The same on this device, in commands before which all steps of both have finished, with the room that
    /// this has: hasRoomOf(from).
    void recordTakeOver(VkCommandBuffer commands, const Stage& from);
    bool hasRoomOf(const Stage& other) const noexcept;

    /// For what goes back to earlier states.
    sim::Simulation& simulation() noexcept { return growing_.simulation(); }

    /// Steps of the time that blades cut by themselves in: steps() where no earlier state was gone back to.
    std::uint64_t played() const noexcept { return played_; }
    /// After the state of so many of them was loaded: steps that were undone before are not taken again.
    void setPlayed(std::uint64_t steps) noexcept {
        played_ = steps;
        newest_ = steps_;
    }

    /// Taken since the reset.
    std::uint64_t steps() const noexcept { return steps_; }
    /// Steps behind steps() that had been taken, were undone and are to be taken again, before another
    /// material or an earlier state may come.
    std::uint64_t undoneSteps() const noexcept { return newest_ - steps_; }

    /// What a finished step found: nothing where all is well, or where a step after a reset has taken its
    /// place. It must be one of the last Simulation::framesInFlight recorded.
    std::optional<Divergence> check(std::uint64_t step) const;

    /// Status::contactRoom of such a step: more than 0 where it was undone, and all after it.
    std::uint32_t neededRoom(std::uint64_t step) const;
    /// Whether later steps are recorded so that they may lack lists of contacts (sim::Step::repeats): who
    /// asks for that looks at lacksLists() of each, from the oldest on. At first not.
    void setRepeats(bool repeats) noexcept { repeats_ = repeats; }
    bool repeats() const noexcept { return repeats_; }
    /// Whether the next step is of another material, which recordTurn() records.
    bool isTurnReady() const noexcept { return ready_ && undoneSteps() == 0; }
    /// Status::lacksLists of such a step: it was undone, and all after it.
    bool lacksLists(std::uint64_t step) const;
    /// The next step is that one, which was undone, again. All that were recorded have finished.
    void goBackBefore(std::uint64_t step) noexcept;
    /// Goes back before that step with room for it, in another simulation(). Waits for `queue`, in which all
    /// was submitted. False where there can be no such room. Throws vk::Error.
    bool makeRoom(std::uint64_t step, vk::Queue& queue, const app::Bring& bring = {});

    /// After steps of which Status::cutSurfaceMissing was `needed` at most, all of them finished: goes on
    /// after the newest with room for it, in another simulation(). False where there is none to be had, or
    /// nothing to do. Waits for `queue`.
    bool makeSurfaceRoom(std::uint32_t needed, vk::Queue& queue, const app::Bring& bring = {});

    /// The same without waiting: a simulation with that much room is made in a thread of its own. Before more
    /// room for contacts no step may be recorded; for the surface of cuts steps go on meanwhile. False where
    /// there can be none. One at a time.
    bool beginRoom(std::uint64_t step);
    bool beginSurfaceRoom(std::uint32_t needed);
    bool isGrowing() const noexcept { return growth_.has_value(); }
    bool lacksContactRoom() const noexcept { return wantedRoom_ || (growth_ && growth_->isOfContacts); }
    /// Whether it is there by now. `none` of the surface: there is no memory for it, and nothing grows any
    /// more. Throws what making it threw, where it is for contacts.
    enum class Growth { making, made, none };
    Growth askGrowth();
    /// What is made takes over the state that there is: all steps have finished, and no other is recorded
    /// until endGrowth(), once the commands have finished: simulation() is then that one. Before that kept
    /// states are brought over; waits for `queue`.
    void bringGrowth(vk::Queue& queue, const app::Bring& bring);
    void recordGrowth(VkCommandBuffer commands) noexcept;
    void endGrowth();

    const sim::Scene& scene() const noexcept { return scene_; }
    /// As it was made; as it is now, with all the room that there is.
    const sim::Settings& madeWith() const noexcept { return settings_; }
    const sim::Settings& settings() const noexcept { return growing_.settings(); }
    const sim::Simulation& simulation() const noexcept { return growing_.simulation(); }
    /// As GrowingSimulation.
    std::vector<std::string> complaints() { return growing_.complaints(); }
    const app::ContactRoom& contactRoom() const noexcept { return growing_.contactRoom(); }
    const app::SurfaceRoom& surfaceRoom() const noexcept { return growing_.surfaceRoom(); }

private:
    struct Turned {
        sim::Material material;
        sim::Scene scene;
        sim::StiffnessReport stiffness;
        std::optional<sim::SceneChange> change; // none: another step program
    };
    struct Recorded {
        sim::SceneChange change;
        std::uint64_t step; // of recordedSteps_
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
        std::future<std::unique_ptr<sim::Simulation>> making; // or, once there:
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
    scenes::Defaults defaults_; // of given_
    sim::Scene scene_;          // of the material that it has now
    sim::Settings settings_;
    sim::StiffnessReport stiffness_;
    app::GrowingSimulation growing_;
    scenes::ScriptedBlades blades_;
    sim::Vec3 gravity_, down_{0, -1, 0};
    std::uint64_t steps_ = 0, played_ = 0, recordedSteps_ = 0;
    std::uint64_t newest_ = 0; // of the steps that were recorded, undone or not: steps_ or more
    bool repeats_ = false;
    sim::Material material_;
    std::optional<sim::Material> wanted_; // after what is being prepared
    std::optional<Turned> ready_;
    std::optional<Shape> shape_;           // for reshape()
    std::optional<sim::Material> refused_; // likewise
    std::deque<Recorded> recorded_;        // that the device may still copy from
    std::future<Turned> turning_;          // refers to what stands before it, as the next
    std::optional<Growing> growth_;
    std::optional<Reshaping> reshaping_;
    std::optional<std::uint32_t> wantedRoom_; // for contacts, after the growth that there is
};

} // namespace sinew::viewer
