// The public face of the core: construct from a Scene, record steps into a command buffer, read views.
#pragma once

#include "sim/scene.hpp"
#include "vk/buffer.hpp"
#include "vk/timestamps.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#pragma push_macro("Status") // Xlib defines it; after that header use the name StepStatus
#undef Status

namespace sinew::sim {

struct StepProgram;
struct BufferId;

/// A hand that holds what is near a particle and linked to it, and pulls that towards a target. In the first
/// step of a grab the held point is the target, so taking hold moves nothing; what is nearest to the particle
/// is held most. Gains are accelerations of all that is linked, so light and heavy bodies feel alike; the
/// pull is implicit and limited, so it is stable for any target up to 1e9 m; gains are taken as at most 1e8.
/// What never moves is not held.
struct Grab {
    std::uint32_t particle = 0;
    float radius = 0;            ///< [m] at first, around the particle; 0 = it alone
    Vec3 target{};               ///< of the held point at the end of the step [m]
    float stiffness = 400;       ///< [1/s^2]; acceleration over distance
    float damping = 40;          ///< [1/s]; acceleration over speed; critical at 2 sqrt(stiffness)
    float maxAcceleration = 100; ///< [m/s^2]
    float maxSpeed = 10;         ///< of the held point on its way to the target [m/s]
};

/// A rigid thing that the host moves through the scene. Particles stay out of it as of a Collider, whatever
/// else they touch: it pushes and carries them, and what is fast does not pass through. It moves and turns
/// evenly during a step. In the first step that has it, it stands where it shall be: what is inside, or comes
/// to be by another shape, leaves by the nearest side at 1 m/s and keeps no speed of that. What it leads
/// through a plane is put back by that, and a particle between it and a collider is in front of the collider.
struct Poke {
    ColliderShape shape = ColliderShape::sphere;
    float radius = 0; ///< [m]; sizes as those of a Collider
    float halfLength = 0;
    Vec3 halfExtents{};
    float friction = 0.3f;    ///< Coulomb coefficient of what slides, >= 0
    float staticFriction = 0; ///< of what does not slide yet; less than `friction` is as much
    Pose pose{};              ///< where it shall be at the end of the step; the rotation has unit length
    float maxSpeed = 10;      ///< of any of its points on the way there [m/s]
};

/// Where a poke has come to.
struct PokeState {
    Poke poke{}; ///< as it was when it was last there, its pose that at the end of that step
    bool isThere = false;
    std::uint32_t changes = 0; ///< how often it came, left, or took another shape
};

/// The surface that the edge of a blade sweeps in a step: quads between two poly-lines, each of two triangles
/// that share the edge from a point of `from` to the next of `to`. It cuts the links of bodies that may be
/// cut (Grid::isCuttable) where these are as the step begins, and it may end inside of a body. Both [m],
/// equally many points, 2 to ranges::mostBladePoints; anything else is no blade.
struct Blade {
    std::span<const Vec3> from{}, to{};
    /// `from` is where the last blade's `to` was, and goes on from there wherever the material has moved
    /// since: a stroke over several steps then leaves no link between its sweeps. False begins a stroke.
    bool isCarried = false;
};

/// Cuts every link that comes nearer than `radius` to a segment, as a pointer's ray of a certain depth: the
/// plain cut, without a surface. [m]; radius 0 = none.
struct RayCut {
    Vec3 from{}, to{};
    float radius = 0;
};

/// What changes from step to step.
struct Step {
    float dt =
        1.0f / 60.0f; ///< length of the step [s], 1e-6 to 0.1; what is outside is taken as the nearer end
    Vec3 gravity{0, -9.81f, 0}; ///< [m/s^2]
    std::uint64_t frame = 0;    ///< grows by one from step to step
    /// Where the points of the scene's attachments are at the end of the step [m], in their order; the points
    /// move there evenly, but not faster than Attachment::maxSpeed. Those left out stay. Read by record()
    /// only.
    std::span<const Vec3> anchors{};
    /// What hand 0, 1, ... holds in this step, at most Settings::grabs; one that is not listed, or whose
    /// numbers are not finite, lets go. A hand that held another particle, or nothing, takes hold. Read by
    /// record() only.
    std::span<const Grab> grabs{};
    /// Poke 0, 1, ..., at most Settings::pokes; one that is not listed, or whose numbers are not finite or no
    /// sizes, is not there and touches nothing. Read by record() only.
    std::span<const Poke> pokes{};
    /// Wakes all that sleeps (Settings::sleeps). Not needed for what a step itself says: another gravity or
    /// dt wakes all, an anchor, a collider or a poke that moves wakes what it holds or comes near.
    bool wakes = false;
    /// True where the host looks at Status::lacksLists of every step. Once all that it has recorded has
    /// finished, it then records the first step that lacked lists again, of the same frame and with the same
    /// input, and all steps behind it. In return most steps have fewer passes. No result depends on it, to
    /// the bit where dt is the same in all that is in flight. It may change from step to step; until the step
    /// that lacked lists is recorded again, others are undone whatever they say here.
    bool repeats = false;
    Blade blade{}; ///< read by record() only; repeat it where the step was undone
    RayCut ray{};
};

/// What a finished step found out about itself.
struct Status {
    std::uint32_t frame = 0; ///< low 32 bits of Step::frame
    /// False where the step has not come back from the device, was never recorded, or is so old that another
    /// one has its place (Settings::framesInFlight): nothing else is known then, and all else is 0.
    bool isFinished = false;
    /// All goes on from the state before this step: see nonFinite, contactRoom and lacksLists.
    bool isUndone = false;
    std::uint64_t stepsUndone = 0; ///< with this one, since the simulation was made
    std::uint32_t nonFinite =
        0; ///< particles with a non-finite state: the step is undone, all goes on from the last finite state
    std::uint32_t firstBadParticle = 0; ///< smallest index among them; meaningful where nonFinite > 0
    /// 0, or how many candidates lists of contacts would need room for, on average, where
    /// Settings::contactRoom is less: the step is undone, and so is every later one until a simulation with
    /// more room takes over (Simulation::recordTakeOver; docs/embedding.md has the lines that do so).
    /// Counting ends at four times the room. More than there can be room for = too many anyway.
    std::uint32_t contactRoom = 0;
    /// The step is undone because contacts had to be listed anew in a substep for which it had no passes
    /// (Step::repeats), and so is every later one until it is recorded again. nonFinite is then 0.
    bool lacksLists = false;
    bool isCalm = false; ///< recorded without those passes
    /// Times that contacts had to be listed anew, or particles slowed down, after the first substep; each
    /// grid counts.
    std::uint32_t laterLists = 0;
    /// Particles, counted once a substep, that were slowed down to what contacts can be found at: where more
    /// than 256 move farther in a substep than about their radius. Momentum is lost; take more substeps.
    std::uint32_t slowed = 0;
    std::uint32_t sleeping = 0; ///< particles that sleep at the end of the step
    float lostTime = 0;         ///< how much longer than the longest step Step::dt was [s]
    /// In this step, or torn; links that only serve the surface of a cut do not count.
    std::uint32_t linksCut = 0;
    std::uint32_t linksCutInAll = 0; ///< since the uncut bodies, or those of recordLoadTopology()
    std::uint32_t pieces = 0;        ///< of bodies that may be cut, single particles among them
    std::uint32_t crumbs = 0;        ///< pieces that were removed (Scene::crumbs), which are not among those
    std::uint32_t crumbParticles = 0;
    float crumbMass = 0; ///< of those that are not without one for good [kg]
    /// Triangles and vertices that the surface of cuts needs, where that is more than there is room for; else
    /// 0. The surface is not drawn then, and skins are not clipped; nothing else is missing, and no step is
    /// undone. A simulation with more room (Settings::cutSurfaceRoom) that takes over draws it.
    std::uint32_t cutSurfaceMissing = 0;
};

using StepStatus = Status;

/// The impulse of one step, and its moment. Divided by the length of the step these are the mean force [N]
/// and torque [N m].
struct Impulse {
    Vec3 linear{};  ///< [N s]
    Vec3 angular{}; ///< [N m s]
};

/// Impulses on a body. Angular ones are about its centre of mass at the end of the step, or about the
/// middle of its particles if none of them moves.
struct BodyImpulses {
    Impulse contacts{}; ///< of other particles, faces and edges, those of the body itself among them (they
                        ///< cancel)
    Impulse planes{}, colliders{}; ///< pokes among the colliders
    Impulse holds{};               ///< of what keeps particles where they are against links and contacts, of
                                   ///< attachments and tethers
    Impulse grabs{};
};

/// The impulses of one step (Settings::keepsForces): masses times changes of velocities. Gravity and damping
/// are not among them. A pass that moves a particle without a change of its velocity gives no impulse. All
/// are 0 where the step was undone. Scene::damping also takes its part of what gravity gives in a substep of
/// length h, so weights at rest are too small by a part of at most 1 - exp(-damping h).
struct Impulses {
    bool isFinished = false;          ///< as Status::isFinished; else the lists are empty
    std::vector<BodyImpulses> bodies; ///< Scene::bodies
    /// Impulses on them, the opposite of those that they gave. Angular ones are about the point of a plane
    /// that is nearest to the origin, about the middle of a collider.
    std::vector<Impulse> planes, colliders, pokes;
    /// Impulses that they gave. Angular ones are about the held point of a hand, and 0 otherwise.
    std::vector<Impulse> grabs, attachments, holds; ///< by Settings::grabs, Scene::attachments, Scene::holds
};

/// A range of the skin buffers that is one Skin of the scene.
struct SkinRange {
    std::string name{};
    Vec3 color{};
    std::uint32_t firstIndex = 0, indexCount = 0;
};

/// What the host has of a state between steps, beside what recordSaveState() copies.
struct SavedState {
    float h = 0;                 ///< substep of the step before [s]; 0 = none was taken
    double colliderTime = 0;     ///< how far colliders have gone along their paths [s]
    std::vector<Vec3> anchors{}; ///< of the scene's attachments [m]
    std::vector<PokeState> pokes{};
    bool hasNewTopology = false;    ///< recordLoadTopology() since the last step
    std::uint32_t changes = 0;      ///< recordChange() before it
    bool isUncut = false;           ///< nothing can have been cut since the reset
    std::optional<float> undoneH{}; ///< substep of steps behind that one, which were undone [s]
};

/// What recordSkin() makes of skins that were split so that they may be cut: all of their triangles, or those
/// that are to be drawn (drawnSkins()), which are fewer.
enum class SkinDetail { all, drawn };

/// Whether some triangles of a skin may be drawn in two forms, one over the other, so that there are fewer of
/// them once something is cut: not for what counts, mixes or outlines them.
enum class Overlap { none, some };

/// The surface of cuts, to be drawn beside the skins after recordSkin(): the inside that a blade laid open,
/// and the pieces of skins beside it. Those of the skin's own triangles that pieces stand for are degenerate
/// from then on. Closed where both are taken together, two-sided: each piece has its own side. Views are
/// empty where no skin is clipped: bodies that may be cut have such a surface where their skin is the outer
/// faces of their cells (addLatticeSkin), or a closed mesh with Skin::anchors (mesh::addMesh).
struct CutSurface {
    vk::BufferView vertices{}; ///< layout::SkinVertex (position, normal; stride 32)
    /// layout::CutVertex of each (stride 64), of which the first vec4 is for a solid texture: where the point
    /// is in the body as the scene was loaded [m], w = index of the skin that it belongs to.
    vk::BufferView rest{};
    vk::BufferView indices{}; ///< 32 bits, of triangles
    /// Two VkDrawIndexedIndirectCommand, stride 20: the inside, then the pieces of skins. Both draw nothing
    /// while nothing is cut.
    vk::BufferView draws{};
    vk::BufferView counts{};    ///< one layout::SurfaceState: how much of the buffers above there is
    vk::BufferView particles{}; ///< 32 bits: of each slot (CutVertex::corners) the particle in it
};

/// Another material for a simulation, ready to be copied (Simulation::prepareChange). Holds buffers of the
/// device, which must outlive it.
class SceneChange {
public:
    SceneChange(SceneChange&&) noexcept;
    SceneChange& operator=(SceneChange&&) noexcept;
    ~SceneChange();

private:
    friend class Simulation;
    struct Parts;
    explicit SceneChange(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

/// Owns the buffers and pipelines of one scene. Must not outlive the Device, which may move. Never submits,
/// waits or owns a queue, and therefore must not be destroyed before all that was recorded with it has
/// finished or been thrown away: wait for the submissions first, by a fence, vkQueueWaitIdle() or, with a
/// vk::Queue, a vk::Drain that is declared after the simulation. oldestInFlight() says what is missing; a
/// debug build says so on stderr. One thread per Simulation; different ones are independent. What was
/// recorded must be submitted once, in order, on one queue family.
class Simulation {
public:
    /// Settings::framesInFlight where nobody says otherwise.
    static constexpr std::uint32_t framesInFlight = usualFramesInFlight;

    /// Throws std::invalid_argument with the sentences of validate(), one a line, or vk::Error. Creates every
    /// buffer and pipeline; contents arrive with the first recordReset().
    Simulation(const vk::Device& device, const Scene& scene, const Settings& settings);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Records the copies that put the simulation into the state of its scene. Must be recorded once before
    /// the first step; later it is a reset. `commands` must be recording and outside a render pass.
    void recordReset(VkCommandBuffer commands) noexcept;

    /// Records one step. Never submits, waits or allocates. Afterwards positions() and velocities() are
    /// visible to vertex input, compute and transfer on the same queue. With `timestamps`, one span per entry
    /// of phases().
    void record(VkCommandBuffer commands, const Step& step, vk::Timestamps* timestamps = nullptr) noexcept;

    /// Records the copies that put this simulation into the state of `from`, which was made of the same
    /// scene, of whatever material, and of settings that may differ in solver, substeps, iterations,
    /// contactRoom and cutSurfaceRoom, the last two at most as much as here: the next step goes on where
    /// `from` stands. Instead of recordReset(), which it contains. All steps of `from` must have finished. It
    /// must live until the commands have finished, and its device is this one's; or that is another one, and
    /// `copy` what recordHandOver() of it has copied, brought to this device by the host. Colliders on a
    /// path, and pokes, are where they were at the end of the last step that was not undone. Of the same
    /// solver (and the same Forms::usesGrids) all is carried that a step leaves behind. Of another solver
    /// positions and velocities are, both with Settings::publishesVelocities: a velocity half a substep
    /// before the end is taken as that of the end, hands take hold anew, and what slept is awake.
    /// With `saved`, `copy` is what recordHandOver() has copied of a state that `from` saved, on this device
    /// or another one: it goes on from that, and hands take hold anew.
    /// The scene of another solver may also differ in contacts and in what may be cut, which `split` alone
    /// has forms for. Throws std::invalid_argument, and nothing is recorded, where the scenes differ in more
    /// than that, where a body of `from` may have been cut and none of this one can be, where this one has
    /// less room than `from`, or where `copy` is too small.
    void recordTakeOver(VkCommandBuffer commands, const Simulation& from, const vk::BufferView& copy = {},
                        const SavedState* saved = nullptr);
    /// Size of what recordTakeOver() copies from this [B].
    std::uint64_t handOverSize() const noexcept;
    /// Records the copy of it into `to`, of handOverSize() bytes, after which the host may read it; or the
    /// same of a state that this has saved into `saved`, of stateSize().
    void recordHandOver(VkCommandBuffer commands, const vk::BufferView& to,
                        const vk::BufferView& saved = {}) const noexcept;

    /// What turns this into the simulation of `scene`: its own but for the material, which is stiffness and
    /// compliance, friction, restitution, damping (withMaterial(), or by hand). Nothing where that needs
    /// other passes, such as friction where there was none: a new Simulation does that. The number of
    /// substeps stays what it is. Takes as long as compiling the scene and creates buffers, no pipelines.
    /// Any one thread, also while steps are recorded, but not during recordChange(). Throws as the
    /// constructor does, and std::invalid_argument where particles differ.
    std::optional<SceneChange> prepareChange(const Scene& scene) const;
    /// Records the copies that make it so from the next step on, and after every reset; state, cuts and hands
    /// stay, what sleeps wakes. `change` must live until `commands` have finished. `commands` as in
    /// recordReset(). Steps with Step::repeats must have finished, and those that lacked lists must have been
    /// repeated. False, and nothing is recorded, where another change was recorded since it was prepared.
    bool recordChange(VkCommandBuffer commands, SceneChange& change) noexcept;

    /// Size of a copy of the whole state between steps [B].
    std::uint64_t stateSize() const noexcept;
    /// Records the copy of the state after the newest recorded step into `to`, of stateSize() bytes, and
    /// returns the rest of it. `commands` as in recordReset(). Behind a step that has lacked lists and was
    /// not repeated yet, this is the state before that step. While steps with Step::repeats are in flight it
    /// is not known which state that is: throw the copy away where one of them lacked lists.
    SavedState recordSaveState(VkCommandBuffer commands, const vk::BufferView& to) const;
    /// Records the copy back: what follows has the same bits as what followed the save, but hands take hold
    /// anew and what a step says of frames goes on. Of this very simulation, or of one with its stateKey();
    /// its material stays what it is.
    void recordLoadState(VkCommandBuffer commands, const vk::BufferView& from,
                         const SavedState& saved) noexcept;
    /// What says whether a copy fits: the same for simulations of the same scene and settings, whichever
    /// program made them, unless devices or versions differ in what a step consists of. Reads all that
    /// buffers begin with.
    std::uint64_t stateKey() const noexcept;
    /// Size of a copy of what cuts have done: links, pieces and counts; 0 where no body may be cut [B].
    std::uint64_t topologySize() const noexcept;
    /// Records the copy of it into `to`, or back from `from`, both of topologySize(): an undo of cuts.
    /// Positions are not in it. Between steps; `commands` as in recordReset(). Afterwards begin a new stroke.
    /// Before recordLoadTopology() steps with Step::repeats must have finished and been repeated, as before
    /// recordChange().
    void recordSaveTopology(VkCommandBuffer commands, const vk::BufferView& to) const noexcept;
    void recordLoadTopology(VkCommandBuffer commands, const vk::BufferView& from) noexcept;

    /// Records the skins of the newest recorded state; afterwards skinVertices() is visible to vertex input.
    /// With SkinDetail::drawn only vertices of drawnSkins(overlap) are those of this state.
    void recordSkin(VkCommandBuffer commands, SkinDetail detail = SkinDetail::all,
                    Overlap overlap = Overlap::none) noexcept;

    /// Public state [m], [m/s]: particleCount x vec4, stride 16, w = inverse mass [1/kg], 0 while the
    /// particle sleeps. `split` reports the velocity half a substep before the step's end (leapfrog). No
    /// velocities, an empty view, without Settings::publishesVelocities.
    vk::BufferView positions() const noexcept;
    vk::BufferView velocities() const noexcept;
    /// Pieces of bodies that may be cut, as of the newest step: for each particle a uint32, the particle that
    /// its piece is named after (one of them; 0xffffffff in other bodies, 0xfffffffe in pieces that were
    /// removed, Scene::crumbs), and for each particle the number
    /// of particles of the piece that is named after it, 0 where none is. Empty views where no body may be
    /// cut.
    vk::BufferView pieces() const noexcept;
    vk::BufferView pieceSizes() const noexcept;
    /// layout::SkinVertex (position, normal; stride 32) and 32-bit triangle indices; empty views without
    /// skins.
    vk::BufferView skinVertices() const noexcept;
    vk::BufferView skinIndices() const noexcept;
    const std::vector<SkinRange>& skins() const noexcept;
    /// What to draw of the skins after recordSkin(), with SkinDetail::all or the same overlap: 32-bit indices
    /// into skinVertices(), and the range of each skin in them. Valid for what was recorded until then;
    /// another step, reset or state may change it. With Overlap::some, after a cut, Skin::wholeTriangles away
    /// from it and `triangles` beside it, where the scene has no sheet that may be cut: how many, the device
    /// knows.
    struct DrawnSkins {
        vk::BufferView indices{};
        std::span<const SkinRange> ranges{};
        bool areWhole = false; ///< Skin::wholeTriangles, where a skin has some
        /// If not empty, one VkDrawIndexedIndirectCommand a skin, stride 20, to be drawn in place of its
        /// range, which is room: it begins there, and behind its end stands what was drawn before.
        vk::BufferView draws = {};
    };
    DrawnSkins drawnSkins(Overlap overlap = Overlap::none) const noexcept;
    CutSurface cutSurface() const noexcept;
    /// What the skins of sheets fall into along cuts, to be drawn beside skins() with the same two buffers:
    /// one VkDrawIndexedIndirectCommand a skin, stride 20, of nothing where nothing is cut. The skin's own
    /// triangles that pieces stand for are degenerate from then on. An empty view where no skin of a sheet
    /// may be cut.
    vk::BufferView pieceDraws() const noexcept;
    /// Poses of the scene's colliders at the end of the newest recorded step, one each in their order;
    /// before a step that has lacked lists, until it is repeated. Valid until the next call of this or of
    /// pokes(), and until the next step is recorded.
    std::span<const Pose> colliderPoses() const noexcept;
    /// Likewise the pokes, Settings::pokes of them.
    std::span<const PokeState> pokes() const noexcept;

    /// The status of a step that has finished on the device and is one of the last Settings::framesInFlight
    /// recorded; of any other Status::isFinished is false. Does not wait. Steps before a reset keep theirs
    /// until others take their places.
    Status status(std::uint64_t frame) const noexcept;
    /// The impulses of a step, ready when its status() is, and for as long. Does not wait; allocates its
    /// lists. Empty lists without Settings::keepsForces.
    Impulses forces(std::uint64_t frame) const;
    /// These sums on the device, of the newest step: layout::ForceSum (stride 32), FORCE_KINDS of each body,
    /// then grabs, planes, pokes, colliders, then others; an empty view without Settings::keepsForces.
    /// Written by the commands of record(), visible as positions() are.
    vk::BufferView forceSums() const noexcept;
    /// Mistakes in the host's recording that were ignored, in sentences: a step before the first reset,
    /// more steps in flight than Settings::framesInFlight, more grabs, pokes or anchors than there is room
    /// for, a blade that is none or that nothing may be cut by, and steps undone for lack of
    /// Settings::contactRoom; at first also warnings() of validate.hpp. Each kind is told once, by the next
    /// call after it came up; show it to who writes the host. Allocates only where there is something to
    /// tell.
    std::vector<std::string> complaints();
    /// The oldest of the last Settings::framesInFlight steps that was recorded and has not finished. Nothing
    /// where all have, and after a recorded step was thrown away it names that one until others take its
    /// place. For finding what is missing: only the host's own fence says when the simulation may be
    /// destroyed.
    std::optional<std::uint64_t> oldestInFlight() const noexcept;

    const StepProgram& program() const noexcept;
    /// Any buffer of program(), to inspect; empty for an invalid id. Contents between steps are the solver's.
    vk::BufferView view(BufferId buffer) const noexcept;
    std::vector<std::string> phases() const; ///< names of the spans of `timestamps`

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sinew::sim

#pragma pop_macro("Status")
