// A scene compiles to a step program: buffers and a plain list of passes, with no Vulkan handles inside. Pure
// data: what makes it (constraints, solvers) never touches a GPU; what uses it (executor, profiler, describe)
// walks it.
#pragma once

#include "vk/spirv.hpp"

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
#include <vector>

#pragma push_macro("interface") // windows.h defines it
#undef interface

namespace sinew::sim {

struct BufferId {
    std::uint32_t index = 0xffffffffu;
    bool operator==(const BufferId&) const = default;
};

struct BufferSpec {
    std::string label;
    std::uint64_t count = 0;        ///< elements
    std::uint32_t stride = 0;       ///< [B]
    std::vector<std::byte> initial; ///< count x stride bytes, or empty = zeros
    /// Instead of a buffer of its own: what the buffer with this index begins with, as resets copy it.
    std::optional<std::uint32_t> initialOf = {};
    std::uint64_t bytes() const { return initialOf ? 0 : count * stride; }
};

struct BufferUse {
    BufferId buffer;
    vk::Access access = vk::Access::readWrite;
};

/// A kernel with the specialisation constants that make it a pipeline.
struct KernelUse {
    const vk::ShaderCode* code = nullptr;
    vk::KernelInterface interface;
    std::map<std::uint32_t, std::uint32_t> constants; ///< specialisation id -> 32 bits
};

enum class PassKind : std::uint8_t {
    dispatch,
    fill,   ///< sets every word of uses[0] to `value`
    copy,   ///< uses[0] to uses[1], whole buffers of equal size
    update, ///< writes what the host has for this step into uses[0]; `value` says which of HostData
};

/// What update passes can write.
enum class HostData : std::uint32_t {
    parameters,
    anchors,
    colliders,
    pokes,
    pokeArguments,
    grabs,
    blade,
    bladePoints
};
constexpr std::size_t hostDataCount = 8;

/// A step is recorded in one of several ways, each with barriers of its own.
struct Recording {
    bool hasBlade = true; ///< with passes of cuts
    bool isCalm = false;  ///< without passes that make lists of contacts after the first substep
    constexpr std::size_t index() const { return std::size_t{!hasBlade} + 2 * std::size_t{isCalm}; }
};
constexpr std::size_t recordingCount = 4;
constexpr std::array<Recording, recordingCount> allRecordings{
    {{true, false}, {false, false}, {true, true}, {false, true}}};
/// A step without a blade: one that may make lists of contacts in any substep, and a calm one.
constexpr Recording plainStep{.hasBlade = false, .isCalm = false},
    calmStep{.hasBlade = false, .isCalm = true};

/// One entry of the list.
struct Pass {
    PassKind kind = PassKind::dispatch;
    std::string label;
    std::uint32_t kernel = 0;    ///< index into StepProgram::kernels (dispatch)
    std::uint32_t items = 0;     ///< invocations wanted (dispatch); where indirect, at most
    std::vector<BufferUse> uses; ///< in binding order; then the arguments of an indirect dispatch
    std::vector<std::byte> push;
    std::uint32_t value = 0;
    bool isIndirect = false;   ///< a kernel decides how many groups: element `value` of the last use
    std::uint32_t phase = 0;   ///< index into StepProgram::phases
    std::uint32_t substep = 0; ///< 1-based; 0 = outside the substeps
    bool isOfCut = false;      ///< recorded only in a step with a blade
    bool isOfSurface = false;  ///< among those: writes the surface of cuts from what is known of cells
    bool isOfLists = false;    ///< makes lists of contacts after the first substep: not in a calm step
    /// By Recording, set by planBarriers: whether a barrier stands before the pass.
    std::array<bool, recordingCount> barriers{};
};

/// Whether `pass` is recorded at all, and with a barrier before it.
inline bool isIn(Recording recording, const Pass& pass) {
    return (recording.hasBlade || !pass.isOfCut) && (!recording.isCalm || !pass.isOfLists);
}
inline bool hasBarrier(Recording recording, const Pass& pass) {
    return isIn(recording, pass) && pass.barriers[recording.index()];
}

/// The uses that a dispatch binds to its kernel: all but the arguments.
inline std::span<const BufferUse> boundUses(const Pass& pass) {
    return std::span(pass.uses).first(pass.uses.size() - (pass.isIndirect ? 1 : 0));
}

/// Where a kernel writes how many groups a later dispatch has: an element of a buffer of
/// layout::DispatchArguments. 0 groups = the pass is skipped on the device, for next to nothing.
struct IndirectItems {
    BufferId arguments;
    std::uint32_t element = 0;
    std::uint32_t most = 0; ///< invocations that the arguments ever ask for
    bool isOfLists = false; ///< none unless lists of contacts are made
};

/// A direct dispatch turned into one of which a kernel decides: the form of the kernel to use, its groups,
/// and what that form binds in addition.
struct GatedDispatch {
    const vk::ShaderCode* code = nullptr;
    IndirectItems items;
    BufferId last; ///< invalid = nothing
};

/// A buffer of the state between steps, and where another program for the same scene has it after an undone
/// step.
struct Carried {
    BufferId to, from;
};

/// Slots of bodies one behind another that are cut alike: one dispatch.
struct CutRun {
    std::uint32_t first = 0, count = 0;           ///< slots
    std::uint32_t rowStride = 0, sliceStride = 0; ///< as layout::CutPush has them
};

/// Which slots are in a grid of contacts, or touch what is in it (below 0 = not), and the bounds of the grid.
struct ContactGrid {
    BufferId radii, bounds;
};

/// What is kept of bodies that may be cut (cutting/cut.hpp); invalid where a scene has none.
struct CuttingBuffers {
    BufferId links; ///< by slot: bits of the links that are alive (lattice/link_masks.hpp)
    BufferId
        wholeCells; ///< by slot: fillAround without the cells that lost an edge; where cells have volumes
    BufferId hits;  ///< by slot: layout::LinkHits of the links that the node owns
    BufferId savedLinks; ///< likewise before the step
    BufferId dirty;      ///< a bit for each slot: whether the last blade cut within a node's reach
    /// Slots of cells with such a corner, by run from its first slot on; how many, and how many groups of the
    /// passes over them, by run.
    BufferId listed, listedCounts, listedArguments;
    bool tears = false;       ///< whether something may be cut in a step without a blade
    std::vector<CutRun> runs; ///< what passes over slots that may be cut are dispatched for
    BufferId places;          ///< by slot: where particles were when the step began [m]
    BufferId counts;          ///< one layout::CutCounts
    BufferId labels;          ///< by slot: the lowest slot of its piece
    BufferId particles;       ///< by slot: which one is there, or layout's NO_PARTICLE
    /// By particle: that which its piece is named after; layout's NO_PARTICLE where nothing may be cut, its
    /// REMOVED_PIECE in a crumb.
    BufferId pieces;
    BufferId pieceSizes;            ///< by particle: particles of the piece that is named after it, or 0
    std::vector<BufferId> topology; ///< all that a copy of the cuts consists of
    /// Lists of links and bends that lose their stiffness: as they begin, but for what settling makes of
    /// them.
    std::vector<BufferId> lists;
    /// Where everything was when contacts that cuts change were listed.
    std::vector<BufferId> contactsSeen;
    std::uint32_t crumbs = 0;              ///< Scene::crumbs, where some may be made; 0 = nothing is removed
    double crumbUnit = 0;                  ///< of layout::CutCounts::crumbMass [kg]
    std::vector<ContactGrid> contactGrids; ///< that crumbs leave
};

/// The surface of cuts (surface/cut_surface.hpp); invalid where no skin is clipped.
struct CutSurfaceBuffers {
    BufferId state;     ///< one layout::SurfaceState
    BufferId vertices;  ///< layout::SkinVertex, as of the last skin list
    BufferId rest;      ///< layout::CutVertex of each
    BufferId indices;   ///< of triangles inside, then outside
    BufferId draws;     ///< layout::DrawArguments for each of the two
    BufferId particles; ///< by slot: which one CutVertex::corners mean
    BufferId hung;      ///< layout::HungVertex of skins of meshes that are clipped; invalid without them
    BufferId moved;     ///< of each: where it is at rest, if w is VERTEX_MOVED
};

/// What may touch: lists by slot of layout::ContactCandidate (collision/contact_lists.hpp, face_lists.hpp,
/// edge_lists.hpp), and where each stands in them, layout::ListRange. Invalid, 0, where a scene has none.
struct ContactBuffers {
    BufferId pairs, pairLists;     ///< particles near a particle
    BufferId faces;                ///< layout::ContactFace, between slots
    BufferId facePairs, faceLists; ///< faces near a particle
    BufferId edges;                ///< layout::ContactEdge, between slots
    BufferId edgePairs, edgeLists; ///< edges near an edge
    std::uint32_t edgeCount = 0;
};

/// A hash grid, in which contacts are looked for, to be looked at between steps: as it was built last.
struct GridBuffers {
    std::string name;        ///< "grid" of particles, "faces.grid" of points, "edges.grid" of edges
    BufferId bounds;         ///< layout::GridBounds
    BufferId starts;         ///< of the table's slots in `sorted`; behind them, how many that has
    BufferId sorted;         ///< bits of a place, and an index, slot by slot
    std::uint32_t count = 0; ///< elements that `sorted` may have
    std::uint32_t cells = 0; ///< slots of the table
    float edge = 0;          ///< layout::GridPush::edge [m]
};

/// What the vertices hang on that the skin of a sheet has along cuts (surface/sheet_pieces.hpp).
struct PieceVertices {
    BufferId vertices;       ///< layout::SheetVertex
    std::uint32_t first = 0; ///< of skinVertices
};

/// Work groups of passes that only pokes need, while one is there.
struct PokeGroups {
    std::uint32_t placed = 0, touching = 0; ///< once a step, once a substep
};

/// Where bodies may sleep (sleep.hpp); invalid where none may.
struct SleepBuffers {
    BufferId arguments; ///< of dispatches that run only while somebody is awake
    BufferId listed;    ///< work groups in which somebody is: bound last by those that run for them alone
};

/// Impulses of a step (forces.hpp); invalid where none are kept.
struct ForceBuffers {
    BufferId terms; ///< what each particle was given, section by section
    BufferId parts, rowParts;
    BufferId sums; ///< layout::ForceSum: FORCE_KINDS for each body, then the rows
    std::uint32_t bodies = 0, grabs = 0, planes = 0, pokes = 0, colliders = 0, stops = 0, attachments = 0,
                  holds = 0; ///< how many of each
};

/// Immutable once built.
struct StepProgram {
    std::vector<BufferSpec> buffers;
    std::vector<KernelUse> kernels;
    std::vector<std::string> phases; ///< what is timed, in order
    std::vector<Pass> step;          ///< recorded for every step
    std::vector<Pass> skin;          ///< recorded when somebody draws; may be empty
    /// Likewise while nothing is cut, for wholeIndices; empty where no skin has fewer triangles then.
    std::vector<Pass> wholeSkin;
    /// Likewise once something is cut, for mixedIndices; empty where there are none.
    std::vector<Pass> mixedSkin;
    /// Recorded after a state of another material, or of other substeps, was put into the buffers: makes what
    /// of the state follows from the scene alone that of this program. May be empty.
    std::vector<Pass> settle;
    /// Recorded after another solver's public state was put into the public buffers: makes this one's own of
    /// it. Empty without public velocities.
    std::vector<Pass> adopt;
    std::uint64_t order = 0; ///< hash of where particles are in the state: programs with one can exchange it
    std::vector<std::string> skipped; ///< features this scene does not need, for reports
    std::vector<Carried> carried;     ///< what a simulation that takes over another's state copies
    BufferId parameters, status, positions, velocities; ///< the public ones; velocities may be invalid
    BufferId skinVertices, skinIndices;                 ///< invalid without skins
    BufferId wholeIndices;                              ///< Skin::wholeTriangles, or triangles, of all skins
    // Once something is cut; invalid where no skin is split.
    BufferId mixedTriangles; ///< of both: those that are not drawn are points
    BufferId mixedIndices;   ///< the others, in that order
    BufferId mixedDraws;     ///< of these, by skin: layout::DrawArguments
    BufferId shownVertices;  ///< by vertex of all skins: what drawing those takes (VERTEX_SHOWN ...)
    struct IndexRange {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<IndexRange> mixedRanges; ///< by skin: room in mixedTriangles and mixedIndices
    ContactBuffers contacts;
    std::vector<GridBuffers> grids; ///< by kind of contact that is looked for in one
    SleepBuffers sleep;
    PokeGroups pokes;
    ForceBuffers forces;
    CuttingBuffers cutting;
    CutSurfaceBuffers cutSurface;
    std::vector<PieceVertices> pieceSkins; ///< by sheet that may be cut and has a skin
    std::vector<BufferId> sheetStates;     ///< one layout::SheetState each: of skins that fall into pieces
    BufferId pieceDraws; ///< by skin: layout::DrawArguments of what sheets fall into; invalid without them
    std::uint32_t pieceVertices = 0; ///< room for the vertices of those, behind those of all skins
    std::uint32_t particleCount = 0, constraintCount = 0;
    std::uint64_t sweeps = 0; ///< times every constraint is read in one step
};

/// Walks the passes of a recording, which run front to back on one queue, and says which need a barrier
/// before them. Keeps the buffers read and written since the last barrier: a pass that touches a written one,
/// or writes a read one, gets one and both sets are cleared; right because every barrier covers all earlier
/// work with the same masks.
void planBarriers(std::span<Pass> passes, std::size_t bufferCount, Recording recording = {});

/// The printed form: `label xitems buffer:access ...`, barriers in between, equal substeps folded, then
/// totals.
std::string describe(const StepProgram& program);

/// How much a recording of a step consists of.
struct PassCounts {
    std::size_t passes = 0, dispatches = 0, barriers = 0;
};
PassCounts countPasses(const StepProgram& program, Recording recording);

/// Tells programs apart: a hash of names, sizes and first contents of buffers and of the passes of a step.
std::uint64_t keyOf(const StepProgram& program) noexcept;

/// Bytes that the kernels of one step declare to touch: each used buffer once a pass, twice where read and
/// written.
std::uint64_t declaredBytes(const StepProgram& program);

/// Collects buffers and passes; refuses (std::logic_error naming kernel and buffer) what disagrees with the
/// SPIR-V.
class ProgramBuilder {
public:
    explicit ProgramBuilder(bool isReversed) : isReversed_(isReversed) {}

    template <typename T>
    requires std::is_trivially_copyable_v<T> BufferId upload(std::string label, std::span<const T> elements) {
        const auto bytes = std::as_bytes(elements);
        return add({std::move(label), elements.size(), sizeof(T), {bytes.begin(), bytes.end()}});
    }
    template <typename T> BufferId upload(std::string label, const std::vector<T>& elements) {
        return upload(std::move(label), std::span<const T>(elements));
    }
    /// Zeros at first.
    template <typename T> BufferId scratch(std::string label, std::uint64_t count) {
        return add({std::move(label), count, sizeof(T), {}});
    }

    /// What a buffer that was uploaded begins with, to be read by passes.
    BufferId initialOf(std::string label, BufferId buffer) {
        const BufferSpec& spec = program().buffers[buffer.index];
        return add({std::move(label), spec.count, spec.stride, {}, buffer.index});
    }

    void beginPhase(std::string name);
    void beginSubstep() { ++substep_; }
    void endSubsteps() { substep_ = 0; }
    bool isAfterFirstSubstep() const { return substep_ > 1; }

    using Constants = std::map<std::uint32_t, std::uint32_t>;
    /// `items` > 0 invocations; `buffers` in binding order; `push` is the kernel's push constant struct.
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
    /// As many groups as the arguments say when the device gets there.
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
    /// What becomes of direct dispatches from here on, by kernel and number of items; none = they stay
    /// direct.
    using Gate = std::function<GatedDispatch(const vk::ShaderCode& code, std::uint32_t items)>;
    void setGate(Gate gate) { gate_ = std::move(gate); }
    /// Adds [index] to the label of the last pass: one of several that differ in their range only.
    void numberLast(std::uint32_t index);
    /// A buffer of vec4 that a solver carries from step to step: undone with a step that ends not finite.
    void remember(BufferId buffer) { remembered_.push_back(buffer); }
    /// Part of the state that another program for the same scene can go on with; there it may be longer.
    void carry(BufferId to, BufferId from) { program_.carried.push_back({to, from}); }
    /// A buffer of vec4 of which a copy of the last step that came to its end is kept, to repeat a step with
    /// the same bits: what publishing makes of an undone one is rounded.
    void keep(BufferId buffer) { kept_.push_back(buffer); }
    const std::vector<BufferId>& kept() const { return kept_; }
    /// Passes between the check that a step has come to its end and what is made of that.
    void afterCheck(std::function<void()> addPasses) { checked_.push_back(std::move(addPasses)); }
    const std::vector<std::function<void()>>& checked() const { return checked_; }
    /// Passes that end the step, after the check that it is finite.
    void atEnd(std::function<void()> addPasses) { endings_.push_back(std::move(addPasses)); }
    const std::vector<std::function<void()>>& endings() const { return endings_; }
    const std::vector<BufferId>& remembered() const { return remembered_; }
    /// Passes of the list of skins between places and normals of vertices.
    void beforeNormals(std::function<void()> addPasses) { skinMiddles_.push_back(std::move(addPasses)); }
    const std::vector<std::function<void()>>& skinMiddles() const { return skinMiddles_; }
    /// Passes that end the list of skins.
    void atSkin(std::function<void()> addPasses) { skinEndings_.push_back(std::move(addPasses)); }
    const std::vector<std::function<void()>>& skinEndings() const { return skinEndings_; }
    void fill(BufferId buffer, std::uint32_t value);
    void copy(BufferId from, BufferId to);
    void updateParameters(BufferId parameters) { update(parameters, HostData::parameters); }
    void updateAnchors(BufferId anchors) { update(anchors, HostData::anchors); }
    void updateColliders(BufferId ways) { update(ways, HostData::colliders); }
    /// `shapes` of pokes come first among those of colliders.
    void updatePokes(BufferId shapes, BufferId arguments) {
        update(shapes, HostData::pokes);
        update(arguments, HostData::pokeArguments);
    }
    void updateGrabs(BufferId hands) { update(hands, HostData::grabs); }
    void updateBlade(BufferId blade, BufferId points) {
        update(blade, HostData::blade);
        update(points, HostData::bladePoints);
    }
    /// Passes from here on, until endCut(), belong to steps with a blade alone; no gate changes them.
    void beginCut() { isCut_ = true; }
    void endCut() { isCut_ = false; }
    /// Among those: passes that write the surface of cuts anew from what is kept of cells.
    void beginSurface() { isSurface_ = true; }
    void endSurface() { isSurface_ = false; }
    /// All that follows belongs to StepProgram::skin, or to another list of skins; no gate changes it.
    void beginSkin() { skinList_ = &StepProgram::skin; }
    void beginWholeSkin() { skinList_ = &StepProgram::wholeSkin; }
    void beginMixedSkin() { skinList_ = &StepProgram::mixedSkin; }
    bool isOfMixedSkin() const { return skinList_ == &StepProgram::mixedSkin; }
    /// Passes from here on, until endSettling(), belong to StepProgram::settle; no gate changes them.
    void beginSettling() { isSettling_ = true; }
    void endSettling() { isSettling_ = false; }
    /// Likewise StepProgram::adopt.
    void beginAdopting() { isAdopting_ = true; }
    void endAdopting() { isAdopting_ = false; }
    void skip(std::string feature) { program_.skipped.push_back(std::move(feature)); }

    StepProgram& program() { return program_; }
    StepProgram finish();

private:
    BufferId add(BufferSpec spec);
    void update(BufferId buffer, HostData data);
    void append(Pass pass);
    std::vector<Pass>& list() {
        if (isSettling_) return program_.settle;
        if (isAdopting_) return program_.adopt;
        return skinList_ ? program_.*skinList_ : program_.step;
    }
    Pass& last() { return list().back(); }
    void makeLastIndirect(const IndirectItems& items);
    std::uint32_t kernelIndex(const vk::ShaderCode& code, const Constants& constants);
    void dispatchDirect(const vk::ShaderCode& code, std::uint32_t items, std::span<const BufferId> buffers,
                        std::span<const std::byte> push, const Constants& constants);
    void dispatchBytes(const vk::ShaderCode& code, std::uint32_t items, std::span<const BufferId> buffers,
                       std::span<const std::byte> push, const Constants& constants);

    StepProgram program_;
    std::vector<BufferId> remembered_, kept_;
    std::vector<std::function<void()>> checked_, endings_, skinMiddles_, skinEndings_;
    Gate gate_;
    std::vector<Pass> StepProgram::*skinList_ = nullptr; // null: passes are of the step
    bool isReversed_ = false, isSettling_ = false, isAdopting_ = false, isCut_ = false, isSurface_ = false;
    std::uint32_t substep_ = 0;
};

} // namespace sinew::sim

#pragma pop_macro("interface")
