// The public interface of the core: construct a Simulation from a Scene, record steps into a command buffer,
// read views.
#pragma once

#include "sinew/events.hpp"
#include "sinew/export.hpp"
#include "sinew/scene.hpp"
#include "sinew/step.hpp"
#include "sinew/vk/buffer.hpp"
#include "sinew/vk/timestamps.hpp"

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
class Carrying;
struct Origins;

/// Results of a finished step that the host can read.
struct SINEW_API Status {
    std::uint32_t frame = 0; ///< low 32 bits of Step::frame
    /// False if the step has not finished on the device, was never recorded, or is so old that another one
    /// has its slot (Settings::framesInFlight); all other members are then 0.
    bool isFinished = false;
    /// The simulation continues from the state before this step: see nonFinite, contactRoom and lacksLists.
    bool isUndone = false;
    std::uint64_t stepsUndone = 0; ///< this one included, since the simulation was made
    std::uint32_t nonFinite =
        0; ///< particles with a non-finite state: the step is undone, and the last finite state stays
    std::uint32_t firstBadParticle = 0; ///< smallest index of these particles; meaningful if nonFinite > 0
    /// 0, or the mean capacity of contact lists that the step needed, in candidates, if Settings::contactRoom
    /// is less. The step is then undone, and so is every later one until a simulation with more room takes
    /// over (Simulation::recordTakeOver; docs/embedding.md has the code). Counting stops at four times the
    /// room. A value above the largest possible room only says that there are too many.
    std::uint32_t contactRoom = 0;
    /// The step is undone because contact lists had to be rebuilt in a substep that has no passes for it
    /// (Step::repeats), and so is every later one until this step is recorded again. nonFinite is then 0.
    bool lacksLists = false;
    bool isCalm = false; ///< recorded without those passes
    /// Rebuilds of contact lists, or slow-downs of particles, after the first substep; each hash grid counts.
    std::uint32_t laterLists = 0;
    /// Particles, counted once a substep, that were slowed down to the largest speed for which contacts can
    /// be found: where more than 256 particles move farther in a substep than about their radius. Momentum is
    /// lost; use more substeps.
    std::uint32_t slowed = 0;
    std::uint32_t sleeping = 0; ///< particles that sleep at the end of the step
    float lostTime = 0;         ///< Step::dt minus the longest allowed step, where that is positive [s]
    /// Links cut or torn in this step, without those that only serve the surface of a cut.
    std::uint32_t linksCut = 0;
    std::uint32_t linksCutInAll = 0; ///< since the uncut bodies, or since recordLoadTopology()
    std::uint32_t pieces = 0;        ///< of cuttable bodies, single particles included
    std::uint32_t debris = 0;        ///< removed pieces (Scene::debris); not counted in `pieces`
    std::uint32_t debrisParticles = 0;
    float debrisMass = 0; ///< of removed particles, without those that never move [kg]
    /// Triangles and vertices that the surface of cuts needs, if that exceeds its capacity; else 0. The
    /// surface is then not drawn and skins are not clipped; nothing else is missing, and no step is undone. A
    /// simulation with more room (Settings::cutSurfaceRoom) that takes over draws the surface.
    std::uint32_t cutSurfaceMissing = 0;
};

using StepStatus = Status;

/// Impulse of one step and its moment. Divided by the length of the step they are the mean force [N] and
/// torque [N m].
struct SINEW_API Impulse {
    Vec3 linear{};  ///< [N s]
    Vec3 angular{}; ///< [N m s]
};

/// Impulses on a body. Angular ones are about its centre of mass at the end of the step, or about the mean
/// position of its particles if none of them moves.
struct SINEW_API BodyImpulses {
    Impulse contacts{}; ///< of other particles, faces and edges, including those of the same body (which
                        ///< cancel)
    Impulse planes{}, colliders{}; ///< host colliders count as colliders
    Impulse holds{};               ///< of constraints that fix particles against links and contacts, of
                                   ///< attachments and of tethers
    Impulse grabs{};
};

/// Impulses of one step (Settings::keepsForces): masses times changes of velocities, without gravity and
/// damping. A pass that moves a particle without changing its velocity contributes no impulse. All are 0 if
/// the step was undone. Scene::damping also reduces what gravity adds in a substep of length h, so that
/// weights at rest are too small by a share of at most 1 - exp(-damping h).
struct SINEW_API Impulses {
    bool isFinished = false;          ///< as Status::isFinished; if false the lists are empty
    std::vector<BodyImpulses> bodies; ///< one for each of Scene::bodies
    /// Impulses on planes, colliders and host colliders, opposite to those on the particles. Angular ones are
    /// about the point of a plane nearest to the origin, or about the middle of a collider.
    std::vector<Impulse> planes, colliders, hostColliders;
    /// Impulses on the particles. Angular ones are about the held point of a grab, and 0 for the others.
    std::vector<Impulse> grabs, attachments, holds; ///< by Settings::grabs, Scene::attachments, Scene::holds
    /// The impulse on the blade of the step, against its way through what it cuts; its work is that of
    /// Grid::toughness. Bodies do not feel it, and a ray has none. Empty if no body has a toughness.
    std::vector<Impulse> blade;
};

/// The range of one Skin of the scene in the skin buffers.
struct SINEW_API SkinRange {
    std::string name{};
    Vec3 color{};
    std::uint32_t firstIndex = 0, indexCount = 0;
};

/// The host's part of a saved state, in addition to the copy that recordSaveState() makes.
struct SINEW_API SavedState {
    float h = 0;                 ///< substep of the last step [s]; 0 = before the first step
    double colliderTime = 0;     ///< time of the colliders on their paths [s]
    std::vector<Vec3> anchors{}; ///< of the scene's attachments [m]
    std::vector<HostColliderState> hostColliders{};
    bool hasNewTopology = false;    ///< recordLoadTopology() since the last step
    std::uint32_t changes = 0;      ///< number of recordChange() before it
    bool isUncut = false;           ///< nothing can have been cut since the reset
    std::optional<float> undoneH{}; ///< substep of the undone steps after that one [s]
    float longestH = 0;             ///< substep that `split` clamped links for in the last step [s]
};

/// Vertices that recordSkin() makes of skins that were split so that they may be cut: all of them, or only
/// those of drawnSkins(), which are fewer while nothing is cut.
enum class SkinDetail { all, drawn };

/// The surface of cuts, drawn in addition to the skins after recordSkin(): the cut surface inside the body
/// and the clipped pieces of skins beside it. The skin's own triangles that the pieces replace become
/// degenerate. Both parts together form a closed two-sided surface: each piece has its own side. Views are
/// empty if no skin is clipped. Cuttable bodies have such a surface if their skin is the outer faces of their
/// cells (addLatticeSkin), or a closed mesh with Skin::anchors (mesh::addMesh).
struct SINEW_API CutSurface {
    vk::BufferView vertices{}; ///< layout::SkinVertex (position, normal; stride 32)
    /// layout::CutVertex of each vertex (stride 64). Its first vec4 is for a solid texture: position in the
    /// body when the scene was loaded [m], w = index of the skin that the vertex belongs to.
    vk::BufferView rest{};
    vk::BufferView indices{}; ///< 32 bits, of triangles
    /// Two VkDrawIndexedIndirectCommand, stride 20: the inside, then the pieces of skins. Both draw nothing
    /// while nothing is cut.
    vk::BufferView draws{};
    vk::BufferView counts{};    ///< one layout::SurfaceState: counts of what the buffers above hold
    vk::BufferView particles{}; ///< 32 bits: the particle in each slot (CutVertex::corners)
    /// TexturePoint of each vertex of the pieces of skins, stride 8; undefined at vertices of the inside,
    /// which have `rest` for a solid texture, and of skins without textureCoordinates. Empty if no skin has
    /// Skin::textureCoordinates.
    vk::BufferView textureCoordinates{};
};

/// Outputs of one step, in buffers that other steps do not write (Simulation::outputs).
struct SINEW_API Outputs {
    bool isKept = false;                      ///< if false all views are empty
    vk::BufferView positions{}, velocities{}; ///< as Simulation::positions(), velocities()
    /// After a recordSkin() that follows the step; empty before, and without skins.
    vk::BufferView skinVertices{}, skinIndices{}, pieceDraws{}, textureCoordinates{};
    CutSurface cutSurface{};
};

/// New material values for a simulation, ready to be copied (Simulation::prepareChange). Owns device buffers;
/// the device must outlive it.
class SINEW_API SceneChange {
public:
    SceneChange(SceneChange&&) noexcept;
    SceneChange& operator=(SceneChange&&) noexcept;
    ~SceneChange();

private:
    friend class Simulation;
    struct SINEW_LOCAL Parts;
    explicit SceneChange(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

/// The simulation of one scene; owns its buffers and pipelines. Must not outlive the Device, which may be
/// moved. Never submits, waits or owns a queue, and therefore must not be destroyed before all commands
/// recorded with it have finished or been discarded: wait for the submissions first, by a fence,
/// vkQueueWaitIdle() or, with a vk::Queue, a vk::Drain that is declared after the simulation.
/// oldestInFlight() names the missing step; a debug build reports it on stderr. One thread per Simulation;
/// different ones are independent. Recorded commands must be submitted once, in order, on one queue family.
class SINEW_API Simulation {
public:
    /// Default of Settings::framesInFlight.
    static constexpr std::uint32_t framesInFlight = usualFramesInFlight;

    /// Throws std::invalid_argument with the sentences of validate(), one a line, or vk::Error. Creates every
    /// buffer and pipeline; the first recordReset() fills the buffers.
    Simulation(const vk::Device& device, const Scene& scene, const Settings& settings);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Records the copies that put the simulation into the initial state of its scene. Must be recorded once
    /// before the first step; later it is a reset. `commands` must be recording and outside a render pass.
    void recordReset(VkCommandBuffer commands) noexcept;

    /// Records one step. Never submits, waits or allocates. Afterwards positions() and velocities() are
    /// visible to vertex input, compute and transfer on the same queue. `timestamps` receives one span per
    /// entry of phases().
    void record(VkCommandBuffer commands, const Step& step, vk::Timestamps* timestamps = nullptr) noexcept;
    /// Records one step into several command buffers, at least one, in shares of about equal numbers of
    /// passes: for steps so long that a driver would reset the device during one submission. Submit each by
    /// itself, in order, to one queue, with nothing else of this simulation between them. The results have
    /// the same bits.
    void record(std::span<const VkCommandBuffer> parts, const Step& step,
                vk::Timestamps* timestamps = nullptr) noexcept;

    /// Records the copies that put this simulation into the state of `from`; the next step continues from
    /// there. Use it instead of recordReset(), which it contains. `from` must have been made of the same
    /// scene, of any material, and of settings that may differ in solver, substeps, iterations, contactRoom
    /// and cutSurfaceRoom, the last two at most as large as here. All steps of `from` must have finished, and
    /// `from` must live until the commands have finished. `from` either is on the same device; or it is on
    /// another one, and `copy` holds the output of its recordHandOver(), moved to this device by the host.
    /// Colliders on a path, and host colliders, have their poses at the end of the last step that was not
    /// undone. If both have the same solver (and the same Forms::usesGrids), the whole state between steps is
    /// copied. Otherwise only positions and velocities are copied, and both simulations need
    /// Settings::publishesVelocities; a velocity half a substep before the end is taken as that of the end,
    /// grabs begin anew, and sleeping particles wake.
    /// With `saved`, `copy` is the output of recordHandOver() for a state that `from` saved, on this device
    /// or another one: this simulation continues from that state, and grabs begin anew.
    /// With another solver the scenes may also differ in contacts and in which bodies are cuttable, for which
    /// only `split` has forms. Throws std::invalid_argument, and records nothing, if the scenes differ in
    /// more than that, if a body of `from` may have been cut and none here is cuttable, if this simulation
    /// has less room than `from`, or if `copy` is too small.
    void recordTakeOver(VkCommandBuffer commands, const Simulation& from, const vk::BufferView& copy = {},
                        const SavedState* saved = nullptr);
    /// Throws what recordTakeOver() of the same arguments would throw; records nothing.
    void checkTakeOver(const Simulation& from, const vk::BufferView& copy = {},
                       const SavedState* saved = nullptr) const;
    /// Size of the data that recordTakeOver() copies from this simulation [B].
    std::uint64_t handOverSize() const noexcept;
    /// Records the copy of that data into `to`, of handOverSize() bytes, which the host may read afterwards.
    /// With `saved`, of stateSize() bytes, the data is that of a state that this simulation saved there.
    void recordHandOver(VkCommandBuffer commands, const vk::BufferView& to,
                        const vk::BufferView& saved = {}) const noexcept;

    /// Compiles the changes that turn this simulation into that of `scene`, which may differ in material
    /// alone: stiffness and compliance, friction, restitution, damping (made by withMaterial(), or by hand).
    /// Returns nothing if the new material needs other passes, such as friction where there was none: make a
    /// new Simulation then. The number of substeps is kept. Takes as long as compiling the scene; creates
    /// buffers but no pipelines. May run on any one thread, also while steps are recorded, but not during
    /// recordChange(). Throws as the constructor does, and std::invalid_argument if particles differ.
    std::optional<SceneChange> prepareChange(const Scene& scene) const;
    /// Records the copies that apply a change from the next step on, and after every reset; state, cuts and
    /// grabs stay, sleeping particles wake. `change` must live until `commands` have finished. `commands` as
    /// in recordReset(). Steps with Step::repeats must have finished, and those that lacked lists must have
    /// been repeated. Returns false, and records nothing, if another change was recorded since this one was
    /// prepared.
    bool recordChange(VkCommandBuffer commands, SceneChange& change) noexcept;

    /// Size of a copy of the whole state between steps [B].
    std::uint64_t stateSize() const noexcept;
    /// Records the copy of the state after the newest recorded step into `to`, of stateSize() bytes, and
    /// returns the host's part of the state. `commands` as in recordReset(). After a step that lacked lists
    /// and was not repeated yet, the copy holds the state before that step. While steps with Step::repeats
    /// are in flight it is unknown which state is copied: discard the copy if one of them lacked lists.
    SavedState recordSaveState(VkCommandBuffer commands, const vk::BufferView& to) const;
    /// Records the copy back: the following steps have the same bits as those that followed the save, except
    /// that grabs begin anew and frame numbers go on. For this very simulation, or for one with the same
    /// stateKey(); the material is kept.
    void recordLoadState(VkCommandBuffer commands, const vk::BufferView& from,
                         const SavedState& saved) noexcept;
    /// Key that tells whether a copy of the state fits: equal for simulations of the same scene and settings
    /// in every process, unless devices or versions differ in the passes of a step. Reads the initial
    /// contents of all buffers.
    std::uint64_t stateKey() const noexcept;
    /// Size of a copy of the cuts: links, pieces and counts [B]; 0 if no body is cuttable.
    std::uint64_t topologySize() const noexcept;
    /// Records the copy of the cuts into `to`, or back from `from`, both of topologySize() bytes: an undo of
    /// cuts. Positions are not part of it. Between steps; `commands` as in recordReset(). Begin a new stroke
    /// afterwards. Before recordLoadTopology() steps with Step::repeats must have finished and been repeated,
    /// as before recordChange().
    void recordSaveTopology(VkCommandBuffer commands, const vk::BufferView& to) const noexcept;
    void recordLoadTopology(VkCommandBuffer commands, const vk::BufferView& from) noexcept;

    /// Records the skins of the newest recorded state; afterwards skinVertices() is visible to vertex input.
    /// With SkinDetail::drawn only vertices of drawnSkins() are those of this state.
    void recordSkin(VkCommandBuffer commands, SkinDetail detail = SkinDetail::all) noexcept;

    /// Public state [m], [m/s]: particleCount x vec4, stride 16, w = inverse mass [1/kg], 0 while the
    /// particle sleeps. `split` reports the velocity half a substep before the step's end (leapfrog). Without
    /// Settings::publishesVelocities the view of velocities is empty.
    vk::BufferView positions() const noexcept;
    vk::BufferView velocities() const noexcept;
    /// Positions at the start of the newest recorded step, as positions(). After a reset the
    /// first step makes them. Those of an undone step equal positions(). Empty without
    /// Settings::keepsPrevious.
    vk::BufferView previousPositions() const noexcept;
    /// Pieces of cuttable bodies after the newest step. pieces() has for each particle a uint32, the particle
    /// that names its piece (one of its particles; 0xffffffff in other bodies, 0xfffffffe in removed pieces,
    /// Scene::debris). pieceSizes() has for each particle the size of the piece that it names, in particles,
    /// or 0. Empty views if no body is cuttable.
    vk::BufferView pieces() const noexcept;
    vk::BufferView pieceSizes() const noexcept;
    /// layout::SkinVertex (position, normal; stride 32) and 32-bit triangle indices; empty views without
    /// skins.
    vk::BufferView skinVertices() const noexcept;
    /// Contents of skinVertices() before the newest recordSkin(), in the same order; zeros after the first
    /// one of this simulation, one that has taken over included. Vertices that a cut has made since have no
    /// such place. Empty without Settings::keepsPrevious.
    vk::BufferView previousSkinVertices() const noexcept;
    vk::BufferView skinIndices() const noexcept;
    /// TexturePoint of each entry of skinIndices(), stride 8: a seam has several at one vertex. Draw without
    /// an index buffer; a vertex shader reads index and texture point n = gl_VertexIndex, and the vertex at
    /// that index (docs/skins.md). Changes with the indices: a vertex that a cut moves has those of its new
    /// place. Empty if no skin has Skin::textureCoordinates.
    vk::BufferView textureCoordinates() const noexcept;
    /// Outputs of a recorded step that is one of the last Settings::outputFrames; empty views for any other,
    /// or if a reset, a loaded state or a take-over came after it. Step `frame` lies in the copies of number
    /// frame % outputFrames: only steps that are a multiple of it apart share them. record() writes the first
    /// two, a recordSkin() that follows the rest, visible as positions() are: what reads them needs no
    /// barrier against the next outputFrames - 1 steps, on this queue or, after a semaphore, another one of
    /// the family. It must have finished before step frame + outputFrames runs. Indices, rest places and
    /// counts that no pass writes are the one buffer that all share.
    Outputs outputs(std::uint64_t frame) const noexcept;
    const std::vector<SkinRange>& skins() const noexcept;
    /// Triangles to draw of the skins after recordSkin(): 32-bit indices into skinVertices(), and the range
    /// of each skin in them. Valid for what was recorded until then; another step, reset or state may change
    /// it.
    struct DrawnSkins {
        vk::BufferView indices{};
        std::span<const SkinRange> ranges{};
        bool areWhole = false; ///< Skin::wholeTriangles, for skins that have them
        /// A TexturePoint for each of `indices`, as Simulation::textureCoordinates().
        vk::BufferView textureCoordinates{};
    };
    DrawnSkins drawnSkins() const noexcept;
    CutSurface cutSurface() const noexcept;
    /// The torn parts of the skins of sheets along cuts, drawn in addition to skins() with the same two
    /// buffers: one VkDrawIndexedIndirectCommand a skin, stride 20, which draws nothing while nothing is cut.
    /// The skin's own triangles that these parts replace become degenerate. An empty view if no skin belongs
    /// to a cuttable sheet.
    vk::BufferView pieceDraws() const noexcept;
    /// Poses of the scene's colliders at the end of the newest recorded step, in their order; if that step
    /// lacked lists, before that step until it is repeated. Valid until the next call of this or of
    /// hostColliders(), and until the next step is recorded.
    std::span<const Pose> colliderPoses() const noexcept;
    /// States of all host colliders (Settings::hostColliders of them), at the same time and valid as long.
    std::span<const HostColliderState> hostColliders() const noexcept;

    /// The status of a finished step that is one of the last Settings::framesInFlight recorded; for any other
    /// step Status::isFinished is false. Does not wait. Steps before a reset keep their status until others
    /// take their slots.
    Status status(std::uint64_t frame) const noexcept;
    /// The impulses of a step, available when its status() is, and as long. Does not wait; allocates its
    /// lists. Empty lists without Settings::keepsForces.
    Impulses forces(std::uint64_t frame) const;
    /// The sums behind forces() on the device, of the newest step: layout::ForceSum (stride 32), FORCE_KINDS
    /// for each body, then one for each grab, plane, host collider, collider, then the others; an empty view
    /// without Settings::keepsForces. Written by the commands of record(), visible as positions() are.
    vk::BufferView forceSums() const noexcept;
    /// The events of a step (Settings::events), available when its status() is, and as long. Does not wait;
    /// allocates its list. Equal on every device that computes the same bits, whatever the order of
    /// invocations and the forms of kernels.
    Events events(std::uint64_t frame) const;
    /// The reason why a motion would have no effect, as a part of a sentence: "has a number that is not
    /// finite"; null if it has one. Valid for good.
    const char* faultOf(const Motion& motion) const noexcept;
    /// Sentences about mistakes in the host's recording that were ignored: a step before the first reset,
    /// more steps in flight than Settings::framesInFlight, more grabs, host colliders, motions or anchors
    /// than allowed, an invalid blade or one without a cuttable body, and steps undone for lack of
    /// Settings::contactRoom. The first call also returns warnings() of validate.hpp. Each kind is returned
    /// once, by the next call after it occurred; show it to the host's developer. Allocates only if there is
    /// something to return.
    std::vector<std::string> complaints();
    /// The same without the warnings of the scene, for a host that showed them when it loaded the scene.
    std::vector<std::string> complaintsOfUse();
    /// The oldest of the last Settings::framesInFlight steps that was recorded and has not finished. Empty if
    /// all have finished; after a recorded step was discarded it names that step until others take its slot.
    /// For diagnosis: only the host's own fence says when the simulation may be destroyed.
    std::optional<std::uint64_t> oldestInFlight() const noexcept;

    const StepProgram& program() const noexcept;
    /// Any buffer of program(), for inspection; empty for an invalid id. Contents between steps are private
    /// to the solver.
    vk::BufferView view(BufferId buffer) const noexcept;
    /// Host address of what a view of this simulation shows, or null: its memory is not host visible, as on
    /// most GPUs, or not coherent. Read there when the commands that wrote it have finished, the last of them
    /// vk::Commands::hostBarrier(). Searches all buffers.
    const std::byte* mapped(const vk::BufferView& view) const noexcept;
    std::vector<std::string> phases() const; ///< names of the spans of `timestamps`

private:
    friend class World;
    /// Makes, on any thread, what carries the state of this simulation to one of another scene.
    SINEW_LOCAL std::unique_ptr<Carrying> makeCarrying(const Simulation& to, const Origins& origins) const;
    /// Writes the initial state of all buffers that the host sees, in place of a recordReset(). On any
    /// thread. Returns whether these are all.
    SINEW_LOCAL bool fill() noexcept;
    /// Records the copies of the next bytes that fill() could not write, for at most `most` [B]. Returns
    /// whether none is left.
    SINEW_LOCAL bool recordFilling(VkCommandBuffer commands, VkDeviceSize most) noexcept;
    /// recordTakeOver() from a simulation of another scene, with settings that may differ in substeps and
    /// room, after fill() and recordFilling(). With `wakes` nothing stays asleep.
    SINEW_LOCAL void recordCarried(VkCommandBuffer commands, const Simulation& from, const Carrying& carrying,
                                   const Origins& origins, bool wakes) noexcept;
    /// Whether no step waits to be recorded again, and the host's part of the state is known: it is the same
    /// whichever of the steps in flight will be undone.
    SINEW_LOCAL bool mayBeCarried() const noexcept;
    struct SINEW_LOCAL State;
    std::unique_ptr<State> state_;
};

} // namespace sinew::sim

#pragma pop_macro("Status")
