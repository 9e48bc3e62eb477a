// The step program that a scene compiles to: buffers and a plain list of passes, without Vulkan handles. Its
// makers (constraints, solvers) never touch a GPU; its users (executor, profiler, describe) walk the list.
#pragma once

#include "sim/program/pass.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#pragma push_macro("interface") // windows.h defines it
#undef interface

namespace sinew::sim {

/// Elements of a scene. A part of the state has one entry for each element of a kind, in the order of the
/// program, and another program may have these elements at other indices.
enum class Elements : std::uint8_t {
    none,
    one, ///< the whole buffer, for the scene
    slots,
    particles,
    attachments,
    movers, ///< host colliders, colliders, driven bodies
    bodies,
    bodyPartners, ///< of each body, what it may touch (EventBuffers)
    interlocks,   ///< pairs of bodies (StepProgram::interlocks)
    prisms,       ///< of clipped skins (SkinSpan)
    skinVertices, ///< of clipped skins (SkinSpan)
};

/// The entries of a buffer that follow their elements into a scene with other bodies: the elements, and those
/// that the values, which are then indices, stand for. none = a take-over by such a scene starts the buffer
/// anew, or derives it (List::rewrite).
struct Carry {
    Elements of = Elements::none, values = Elements::none;
};

/// A buffer of the state between steps: a take-over copies `from` of the other program, which is valid also
/// after an undone step, into `to`.
struct StateBuffer {
    BufferId to, from;
    Carry carry;
};

/// Contact lists with a memory (collision/pooled_lists.hpp): by owner ranges of entries, which name the other
/// element of a pair, and whose memory outlives a rebuild.
struct ContactMemory {
    BufferId contacts, ranges, memory;
    BufferId savedRanges, savedMemory, savedOthers;
};

/// The prisms and vertices of one clipped skin.
struct SkinSpan {
    std::uint32_t skin = 0;
    std::uint32_t firstPrism = 0, prisms = 0, firstVertex = 0, vertices = 0;
};

/// A contiguous range of slots of cuttable bodies with equal strides: one dispatch.
struct CutRun {
    std::uint32_t first = 0, count = 0;           ///< slots
    std::uint32_t rowStride = 0, sliceStride = 0; ///< as layout::CutPush has them
};

/// The radii of a hash grid of contacts, by slot (below 0 = neither in the grid nor touching what is in it),
/// and the bounds of the grid.
struct ContactGrid {
    BufferId radii, bounds;
};

/// Buffers of cuttable bodies (cutting/cut.hpp); invalid if a scene has none.
struct CuttingBuffers {
    BufferId links;      ///< by slot: bits of the live links (lattice/link_masks.hpp)
    BufferId wholeCells; ///< by slot: fillAround without cells that lost an edge; if cells have volumes
    BufferId hits;       ///< by slot: layout::LinkHits of the links that the node owns
    BufferId savedLinks; ///< by slot: links before the step
    BufferId dirty;      ///< a bit for each slot: whether the last blade cut within reach of the node
    /// Slots with a dirty corner in one of their cells, by run, each run from its first slot on; their
    /// number, and the group counts of the passes over them, by run.
    BufferId listed, listedCounts, listedArguments;
    bool tears = false;        ///< whether a step without a blade may cut something
    std::vector<CutRun> runs;  ///< ranges of the dispatches over cuttable slots
    BufferId places;           ///< by slot: position at the start of the step [m]
    BufferId placesBefore;     ///< by slot: position at the last blade [m]; w = 0: there was none
    BufferId counts;           ///< one layout::CutCounts
    BufferId bladeForce;       ///< layout::ColliderForce without moments, 0 between steps; by Grid::toughness
    float bladeForceScale = 0; ///< 1 / its unit [1 / N s]
    BufferId labels;           ///< by slot: the lowest slot of its piece
    BufferId particles;        ///< by slot: the particle in it, or layout's NO_PARTICLE
    /// By particle: the one that names its piece; NO_PARTICLE if not cuttable, REMOVED_PIECE in a fragment.
    BufferId pieces;
    BufferId pieceSizes;            ///< by particle: size of the piece that the particle names, or 0
    std::vector<BufferId> topology; ///< buffers that form a copy of the cuts
    /// Lists of links and bends whose stiffness a cut removes; reset to their initial contents before
    /// settling.
    std::vector<BufferId> lists;
    /// Positions at the last rebuild of contact lists that depend on cuts.
    std::vector<BufferId> contactsSeen;
    std::uint32_t debris = 0;              ///< Scene::debris, if a cut can make some; 0 = none are removed
    double debrisUnit = 0;                 ///< unit of layout::CutCounts::debrisMass [kg]
    std::vector<ContactGrid> contactGrids; ///< grids that fragments are removed from
};

/// Buffers of the surface of cuts (surface/cut_surface.hpp); invalid if no skin is clipped.
struct CutSurfaceBuffers {
    BufferId state;     ///< one layout::SurfaceState
    BufferId vertices;  ///< layout::SkinVertex, updated by the list of skins
    BufferId rest;      ///< layout::CutVertex of each vertex
    BufferId indices;   ///< triangles of the inside, then of the outside
    BufferId draws;     ///< layout::DrawArguments of the inside and of the outside
    BufferId particles; ///< by slot: the particle that CutVertex::corners refer to
    BufferId hung;      ///< layout::HungVertex of clipped skins of meshes; invalid without such skins
    BufferId moved;     ///< of each of these: position at rest, if w is VERTEX_MOVED or more
    BufferId textureCoordinates; ///< TexturePoint of each vertex; invalid if no skin has them
};

/// Contact candidates: lists by slot of layout::ContactCandidate (collision/contact_lists.hpp,
/// face_lists.hpp, edge_lists.hpp), and the range of each slot in them, layout::ListRange. Invalid, or 0, if
/// a scene has none.
struct ContactBuffers {
    BufferId pairs, pairLists;     ///< particles near a particle
    BufferId faces;                ///< layout::ContactFace, between slots
    BufferId facePairs, faceLists; ///< faces near a particle
    BufferId edges;                ///< layout::ContactEdge, between slots
    BufferId edgePairs, edgeLists; ///< edges near an edge
    std::uint32_t edgeCount = 0;
};

/// The hash grid of a contact search, for inspection between steps: as last built.
struct GridBuffers {
    std::string name;        ///< "grid" of particles, "faces.grid" of points, "edges.grid" of edges
    BufferId bounds;         ///< first entry in `sorted` by slot of the table; then the entry count
    BufferId starts;         ///< bits of a position, and an index, ordered by slot
    BufferId sorted;         ///< capacity of `sorted`
    std::uint32_t count = 0; ///< elements that `sorted` may have
    std::uint32_t cells = 0; ///< slots of the table
    BufferId detected;       ///< by slot of the state: position when lists were made [m]; w: body
    BufferId radii;          ///< by element; below 0 = not in the grid
    /// By slot, below 0 = left out: what touches faces, or invalid; what is checked for its way since then.
    BufferId touching, watched;
};

/// The vertices of a sheet's skin along cuts, and what they depend on (surface/sheet_pieces.hpp).
struct PieceVertices {
    BufferId vertices;       ///< layout::SheetVertex
    std::uint32_t first = 0; ///< index in skinVertices
};

/// Group counts of passes that run only while a host collider is present.
struct HostColliderGroups {
    std::uint32_t placed = 0, touching = 0; ///< once a step, once a substep
};

/// Group counts of the passes of force fields.
struct FieldGroups {
    std::uint32_t areas = 0, applied = 0; ///< once a step, once a substep
};

/// A body that the host moves: the slots between which its particles are.
struct MotionBody {
    std::uint32_t first = 0, end = 0;
    std::uint32_t origin = 0;                  ///< slot of its first particle
    bool isHeld = false;                       ///< has a particle that never moves, or is driven
    bool isAbsent = false, isRestored = false; ///< may be absent (Body::isAbsent); may be cut besides
    std::array<float, 3> center{};             ///< of its mass in the scene [m]; of one that may be absent
};

/// Passes of motions (motions.hpp), and the bodies of the scene; the last one stands for all.
struct MotionGroups {
    std::uint32_t slots = 0, previous = 0;
    std::array<std::uint32_t, 3> lists{}; ///< owners of contact lists with a memory, in work groups
    std::vector<MotionBody> bodies{};
};

/// Buffers of sleeping bodies (sleep.hpp); invalid if no body can sleep.
struct SleepBuffers {
    BufferId arguments; ///< of dispatches that run only while a particle is awake
    BufferId listed;    ///< awake work groups: the last binding of kernels that run only for these
};

/// Buffers of the impulses of a step (forces.hpp); invalid if none are kept.
struct ForceBuffers {
    BufferId terms; ///< impulses by particle, section by section
    BufferId parts, rowParts;
    BufferId sums; ///< layout::ForceSum: FORCE_KINDS for each body, then the rows
    std::uint32_t bodies = 0, grabs = 0, planes = 0, hostColliders = 0, colliders = 0, stops = 0,
                  attachments = 0, holds = 0,
                  blades = 0; ///< number of each
};

/// Events of a step (events.hpp); invalid if none are listed.
struct EventBuffers {
    BufferId list; ///< layout::EventEntry: a head, then the events
    /// Partners of a body, in this order. Numbers of planes and colliders are 0 if contacts are not listed.
    std::uint32_t bodies = 0, planes = 0, hostColliders = 0, colliders = 0;
    std::uint32_t rowWords = 0; ///< a body has 32 of these partners, and unused ones

    bool hasPartnersOf(const EventBuffers& other) const {
        return bodies == other.bodies && planes == other.planes && hostColliders == other.hostColliders &&
               colliders == other.colliders;
    }
};

/// The pass lists of a program. Each is recorded by itself; any but the first may be empty.
enum class List : std::uint8_t {
    step, ///< for every step
    skin, ///< to draw the skins
    /// Instead of `skin` while nothing is cut, for wholeIndices; empty if no skin has whole triangles.
    wholeSkin,
    /// After a state of another material, or of other substeps, was put into the buffers: recomputes the
    /// values that follow from the scene alone.
    refresh,
    /// After another solver's public state was put into the public buffers: initialises this solver's state
    /// from it. Empty without public velocities.
    initialise,
    /// After links that a cut removed were put into the buffers of the uncut bodies: derives all else that
    /// follows from them. Empty if nothing may be cut.
    rewrite,
};
constexpr std::size_t listCount = 6;

/// A compiled scene; immutable once built.
struct StepProgram {
    std::vector<BufferSpec> buffers;
    std::vector<KernelUse> kernels;
    std::vector<std::string> phases;                ///< what is timed, in order
    std::array<std::vector<Pass>, listCount> lists; ///< by List
    std::uint64_t order = 0; ///< hash of the order of particles: programs with equal order exchange states
    std::vector<std::string> skipped;      ///< features that this scene does not need, for reports
    std::vector<StateBuffer> stateBuffers; ///< buffers copied when a simulation takes over another's state
    std::vector<BufferId> ofStep; ///< made anew by each step before it reads them: no part of a saved state
    std::vector<ContactMemory> contactMemory;
    std::vector<SkinSpan> skinSpans;
    std::vector<std::array<std::uint32_t, 2>> interlocks; ///< the smallest particles of pairs of bodies
    BufferId statePositions, stateVelocities;             ///< of the solver, by slot
    std::vector<std::uint32_t> slots;                     ///< by particle: its slot in the state
    std::uint32_t slotCount = 0;                          ///< of the state, empty ones included
    BufferId parameters, status, positions, velocities;   ///< public buffers; velocities may be invalid
    BufferId skinVertices, skinIndices;                   ///< invalid without skins
    BufferId previousPositions, previousSkinVertices;     ///< invalid unless Settings::keepsPrevious
    BufferId wholeIndices;                                ///< of all skins: wholeTriangles, else triangles
    BufferId textureCoordinates;      ///< TexturePoint of each skin index; invalid if no skin has them
    BufferId wholeTextureCoordinates; ///< the same of wholeIndices
    ContactBuffers contacts;
    std::vector<GridBuffers> grids; ///< one for each contact search that uses a grid
    SleepBuffers sleep;
    HostColliderGroups hostColliders;
    FieldGroups fields;
    MotionGroups motions;
    ForceBuffers forces;
    EventBuffers events;
    CuttingBuffers cutting;
    CutSurfaceBuffers cutSurface;
    std::vector<PieceVertices> pieceSkins; ///< one for each cuttable sheet with a skin
    std::vector<BufferId> sheetStates;     ///< one layout::SheetState for each skin that a cut divides
    BufferId pieceDraws; ///< by skin: layout::DrawArguments of the parts of sheets; invalid without them
    std::uint32_t pieceVertices = 0; ///< vertices reserved for those parts, after those of all skins
    std::uint32_t particleCount = 0, constraintCount = 0;
    std::uint64_t sweeps = 0; ///< number of times that every constraint is read in one step

    std::vector<Pass>& operator[](List list) & { return lists[static_cast<std::size_t>(list)]; }
    const std::vector<Pass>& operator[](List list) const& { return lists[static_cast<std::size_t>(list)]; }
    std::vector<Pass> operator[](List list) && { return std::move(lists[static_cast<std::size_t>(list)]); }
};

/// Calls `visit(pass)` for the passes of all lists, list by list.
template <typename Visit> void forEachPass(const StepProgram& program, const Visit& visit) {
    for (const std::vector<Pass>& list : program.lists)
        for (const Pass& pass : list) visit(pass);
}

/// The buffers of all bindings of a dispatch, in the order of its kernel's interface. The executor binds a
/// small buffer of its own where one is `unbound`: to bindings of a feature that is off, and to texel twins
/// in programs without texels.
std::vector<BufferId> boundBuffers(const StepProgram& program, const Pass& pass);

/// Walks the passes of a recording, which run front to back on one queue, and sets which need a barrier
/// before them. Keeps the buffers read and written since the last barrier: a pass that touches a written one,
/// or writes a read one, gets a barrier and both sets are cleared. A barrier orders the kinds of work that
/// occur between it and its neighbours. This is correct because all name compute shaders on both sides: what
/// one barrier makes available to them, a later one makes visible to transfers or to reads of arguments.
void planBarriers(std::span<Pass> passes, std::size_t bufferCount, Recording recording = {});

/// The program as text: `label xitems buffer:access ...`, barriers in between, equal substeps folded, then
/// totals.
std::string describe(const StepProgram& program);

/// Size of a recording of a step.
struct PassCounts {
    std::size_t passes = 0, dispatches = 0, barriers = 0;
};
PassCounts countPasses(const StepProgram& program, Recording recording);

/// Key of a program: a hash of names, sizes and initial contents of buffers and of the passes of a step.
std::uint64_t keyOf(const StepProgram& program) noexcept;

/// Bytes that the kernels of one step are declared to access: each used buffer once a pass, twice if read and
/// written.
std::uint64_t declaredBytes(const StepProgram& program);

/// Collects buffers and passes. Throws std::logic_error naming kernel and buffer if a dispatch does not fit
/// the SPIR-V.
class ProgramBuilder {
public:
    /// `usesTexels`: kernels read buffers with a texel twin as texels (Forms::usesTexels).
    explicit ProgramBuilder(bool isReversed, bool usesTexels = true)
        : isReversed_(isReversed), usesTexels_(usesTexels) {}

    template <typename T>
    requires std::is_trivially_copyable_v<T> BufferId upload(std::string label, std::span<const T> elements) {
        const auto bytes = std::as_bytes(elements);
        return add({std::move(label), elements.size(), sizeof(T), {bytes.begin(), bytes.end()}});
    }
    template <typename T> BufferId upload(std::string label, const std::vector<T>& elements) {
        return upload(std::move(label), std::span<const T>(elements));
    }
    /// A buffer that is initially zero.
    template <typename T> BufferId scratch(std::string label, std::uint64_t count) {
        return add({std::move(label), count, sizeof(T), {}});
    }
    /// The same of one that each step makes anew before it reads it (StepProgram::ofStep).
    template <typename T> BufferId scratchOfStep(std::string label, std::uint64_t count) {
        return program_.ofStep.emplace_back(scratch<T>(std::move(label), count));
    }

    /// The initial contents of an uploaded buffer, as a buffer that passes can read.
    BufferId initialOf(std::string label, BufferId buffer) {
        const BufferSpec& spec = program().buffers[buffer.index];
        return add({std::move(label), spec.count, spec.stride, {}, buffer.index});
    }

    void beginPhase(std::string name);
    void beginSubstep() { ++substep_; }
    void endSubsteps() { substep_ = 0; }
    bool isAfterFirstSubstep() const { return substep_ > 1; }

    using Constants = std::map<std::uint32_t, std::uint32_t>;
    /// Appends a dispatch of `items` > 0 invocations; `buffers` in binding order, without texel twins;
    /// `unbound` for bindings of features that `constants` switch off. `push` is the kernel's push constant
    /// struct.
    template <typename Push>
    void dispatch(const vk::ShaderCode& code, std::uint32_t items, std::span<const BufferId> buffers,
                  const Push& push, const Constants& constants = {}) {
        dispatchDirect(code, items, buffers, std::as_bytes(std::span(&push, 1)), constants);
    }
    template <typename Push>
    void dispatch(const vk::ShaderCode& code, std::uint32_t items, std::initializer_list<BufferId> buffers,
                  const Push& push, const Constants& constants = {}) {
        dispatch(code, items, std::span(buffers.begin(), buffers.size()), push, constants);
    }
    /// Appends a dispatch with as many groups as the arguments hold when the device reads them.
    template <typename Push>
    void dispatchIndirect(const vk::ShaderCode& code, const IndirectItems& items,
                          std::span<const BufferId> buffers, const Push& push,
                          const Constants& constants = {}) {
        dispatchBytes(code, items.most, buffers, std::as_bytes(std::span(&push, 1)), constants);
        makeLastIndirect(items);
    }
    template <typename Push>
    void dispatchIndirect(const vk::ShaderCode& code, const IndirectItems& items,
                          std::initializer_list<BufferId> buffers, const Push& push,
                          const Constants& constants = {}) {
        dispatchIndirect(code, items, std::span(buffers.begin(), buffers.size()), push, constants);
    }
    /// The same for listed work groups or, with the constant RUNS_OVER_ITEMS, items. The kernel must be one
    /// that may run over a list (kernel.glsl: MAY_RUN_LISTED).
    template <typename Push>
    void dispatchListed(const vk::ShaderCode& code, const IndirectItems& items,
                        std::span<const BufferId> buffers, BufferId listed, const Push& push,
                        const Constants& constants = {}) {
        dispatchListedBytes(code, items.most, buffers, listed, std::as_bytes(std::span(&push, 1)), constants);
        makeLastIndirect(items);
    }
    /// A function that replaces the direct dispatches that follow, by kernel and number of items; none = they
    /// stay direct.
    using Indirection =
        std::function<IndirectForm(const vk::KernelInterface& interface, std::uint32_t items)>;
    void setIndirection(Indirection indirection) { indirection_ = std::move(indirection); }
    /// Direct dispatches over `all` slots of the state then run over these, whole work groups, where kernels
    /// may. Empty = over all.
    void setSlots(std::vector<std::uint32_t> slots, std::uint32_t all);
    /// The same list, for dispatches that are not direct; it is uploaded once something asks for it.
    const Slots& slots();
    /// Adds [index] to the label of the last pass, for passes that differ only in their range.
    void numberLast(std::uint32_t index);
    /// Registers a buffer of vec4 that a solver carries from step to step: restored when a step with a
    /// non-finite state is undone.
    void restoreOnUndo(BufferId buffer) { restoredOnUndo_.push_back(buffer); }
    /// Registers a part of the state that another program for the same scene can take over; it may be longer
    /// there.
    void addToState(BufferId to, BufferId from, Carry carry = {}) {
        program_.stateBuffers.push_back({to, from, carry});
    }
    /// Registers a buffer of vec4 of which a copy from the last finite step is kept, so that a step can be
    /// repeated with the same bits: the state that publishing restores after an undone step is rounded.
    void keepForRepeat(BufferId buffer) { keptForRepeat_.push_back(buffer); }
    const std::vector<BufferId>& keptForRepeat() const { return keptForRepeat_; }
    const std::vector<BufferId>& restoredOnUndo() const { return restoredOnUndo_; }
    void fill(BufferId buffer, std::uint32_t value);
    void copy(BufferId from, BufferId to);
    void updateParameters(BufferId parameters) { update(parameters, HostData::parameters); }
    void updateAnchors(BufferId anchors) { update(anchors, HostData::anchors); }
    void updateColliders(BufferId ways) { update(ways, HostData::colliders); }
    /// The `shapes` of host colliders precede those of colliders.
    void updateHostColliders(BufferId shapes, BufferId arguments) {
        update(shapes, HostData::hostColliders);
        update(arguments, HostData::hostColliderArguments);
    }
    void updateGrabs(BufferId requests) { update(requests, HostData::grabs); }
    void updateFields(BufferId requests, BufferId arguments) {
        update(requests, HostData::fields);
        update(arguments, HostData::fieldArguments);
    }
    void updateMotions(BufferId requests, BufferId arguments) {
        update(requests, HostData::motions);
        update(arguments, HostData::motionArguments);
    }
    void updateBlade(BufferId blade, BufferId points) {
        update(blade, HostData::blade);
        update(points, HostData::bladePoints);
    }
    /// Calls `add()`; the passes that it appends are recorded only in such steps. Gates do not change them.
    template <typename Add> void only(When when, const Add& add) {
        const When before = std::exchange(when_, when);
        add();
        when_ = before;
    }
    /// Calls `add()`; the passes that it appends belong to `list`. Gates change those of the step alone.
    template <typename Add> void into(List list, const Add& add) {
        const List before = std::exchange(list_, list);
        add();
        list_ = before;
    }
    void skip(std::string feature) { program_.skipped.push_back(std::move(feature)); }

    StepProgram& program() { return program_; }
    StepProgram finish();

private:
    BufferId add(BufferSpec spec);
    void update(BufferId buffer, HostData data);
    void append(Pass pass);
    Pass& last() { return program_[list_].back(); }
    void makeLastIndirect(const IndirectItems& items);
    const vk::KernelInterface& interfaceOf(const vk::ShaderCode& code);
    std::uint32_t kernelIndex(const vk::ShaderCode& code, Constants constants);
    void bind(const vk::ShaderCode& code, Pass& pass, std::span<const BufferId> buffers);
    void dispatchDirect(const vk::ShaderCode& code, std::uint32_t items, std::span<const BufferId> buffers,
                        std::span<const std::byte> push, const Constants& constants);
    void dispatchBytes(const vk::ShaderCode& code, std::uint32_t items, std::span<const BufferId> buffers,
                       std::span<const std::byte> push, const Constants& constants);
    void dispatchListedBytes(const vk::ShaderCode& code, std::uint32_t items,
                             std::span<const BufferId> buffers, BufferId listed,
                             std::span<const std::byte> push, Constants constants);

    StepProgram program_;
    std::map<const vk::ShaderCode*, vk::KernelInterface> interfaces_;
    std::vector<BufferId> restoredOnUndo_, keptForRepeat_;
    Indirection indirection_;
    std::vector<std::uint32_t> slotList_;
    Slots slots_;
    List list_ = List::step;
    When when_ = When::always;
    bool isReversed_ = false, usesTexels_ = true;
    std::uint32_t substep_ = 0;
};

} // namespace sinew::sim

#pragma pop_macro("interface")
