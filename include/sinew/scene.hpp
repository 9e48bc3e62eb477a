// The scene description: particles, permanent constraints, colliders and skins, as plain structs in SI units.
// A caller fills in a Scene and nothing else; the step program, buffers and barriers are compiled from it. y
// points up. Numbers are float32 so that the device and the double-precision reference start from the same
// values.
#pragma once

#include "sinew/export.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sinew::sim {

struct SINEW_API Vec3 {
    float x = 0, y = 0, z = 0;
};

/// A rotation: a unit quaternion.
struct SINEW_API Quaternion {
    float x = 0, y = 0, z = 0, w = 1;
};

/// The pose of a rigid body: its local point s is at position + rotation s.
struct SINEW_API Pose {
    Vec3 position{}; ///< of the centre [m]
    Quaternion rotation{};
};

/// A point mass.
struct SINEW_API Particle {
    Vec3 position{};       ///< [m]
    Vec3 velocity{};       ///< [m/s]
    float inverseMass = 1; ///< [1/kg]; 0 = never moves
    float contactOffset =
        0; ///< [m] distance kept from colliders; negative where the particle lies outside its skin
    /// [m]; two particles touch where their distance is below the sum of their radii. 0 = touches no other
    /// particle. Linked particles never touch. Two particles of one linked body never touch if their rest
    /// distance is below 1.05 times the sum of their radii.
    float radius = 0;
    /// Surface that others feel in a contact: 0 = ContactSettings::friction and restitution, k = its
    /// surfaces[k - 1].
    std::uint32_t surface = 0;
    /// Whether a pair that touches or overlaps when the scene is loaded keeps that distance as its rest
    /// distance: see ContactSettings::recoverySpeed. For a face the first corner decides. A pair keeps its
    /// distance if either of the two says so.
    bool keepsRest = false;
};

/// Contact properties of a particle or a face. A pair has the geometric mean of both frictions, so that a
/// smooth surface slides on everything, and the larger restitution. Planes have their own values.
struct SINEW_API Surface {
    float friction = 0;       ///< Coulomb coefficient while sliding, >= 0
    float restitution = 0;    ///< 0 (no rebound) to 1 (elastic)
    float staticFriction = 0; ///< coefficient before sliding starts; below `friction` = `friction`
};

/// A triangle that particles with a radius touch, from both sides: part of a cloth, or, if its corners never
/// move, of a collider. Contact distance is the sum of radius and thickness; the corners share a contact by
/// the barycentric weights of the touched point. Edges of a face touch edges of other faces, at the sum of
/// both thicknesses. No contact is made between a face and a particle, or two edges, of one linked body with
/// a rest distance below 1.05 times the contact distance; between elements that share a corner; and, in a
/// cuttable body, between a solid face and a particle linked to one of its corners. A face has the surface of
/// its first corner. If a face is at least as thick as a corner's radius, others touch the face instead of
/// the corner. A face thinner than a thousandth of its length touches nothing.
struct SINEW_API Face {
    std::array<std::uint32_t, 3> particles{};
    float thickness = 0; ///< from its middle plane [m]
    /// Part of the surface of a solid body (addSurfaceFaces), with corners counter-clockwise seen from the
    /// front. The face touches only points in front of it and lets points pass that come from behind; its
    /// corners still touch others as particles. Its edges touch nothing.
    bool isSolid = false;
};

/// Settings of contacts between particles, faces and edges.
struct SINEW_API ContactSettings {
    float friction = 0;       ///< where Particle::surface is 0; see Surface
    float restitution = 0;    ///< where Particle::surface is 0
    float staticFriction = 0; ///< where Particle::surface is 0
    /// Speed at which particles, faces and edges that overlap when the scene is loaded are separated [m/s].
    /// Does not limit the impulse of a contact, except between interlocked bodies, where one body reaches
    /// inside the other's lattice. A pair with Particle::keepsRest is not separated: its contact distance is
    /// the distance at load until the two have once been as far apart as the usual contact distance, which
    /// holds from then on. For a point behind a solid face the distance is negative; a point farther behind
    /// the face than the usual contact distance in front of it has no contact there.
    float recoverySpeed = 0.5f;
    /// Whether loose particles without restitution take back the speed at which pushes that part overlaps
    /// throw them: columns stay down. Without effect where particles are mostly linked, or any pair of
    /// surfaces has a restitution.
    bool takesRecoils = false;
    std::vector<Surface> surfaces{}; ///< surfaces that Particle::surface refers to, at most 64
};

/// |x_a - x_b| = restLength, with energy (|x_a - x_b| - restLength)^2 / (2 compliance). Permanent.
struct SINEW_API DistanceConstraint {
    std::uint32_t a = 0, b = 0;
    float restLength = 0; ///< [m]
    float compliance = 0; ///< [m/N]; 0 = rigid
};

/// Three particles in a row: C = x_a - 2 x_b + x_c, energy |C|^2 / (2 compliance). Straight at rest. A plate
/// of bending stiffness B [N m] sampled every s [m] has compliance s^2 / B, a rod of stiffness EI [N m^2] has
/// s^3 / EI: see bodies.hpp. Permanent.
struct SINEW_API BendConstraint {
    std::uint32_t a = 0, b = 0, c = 0; ///< b is the middle particle
    float compliance = 0;              ///< [m/N]; 0 = as straight as the solver can
};

/// A spring from a particle to a point that the host may move in each step (Step::anchors). Permanent.
struct SINEW_API Attachment {
    static constexpr float unlimited = 3.402823466e38f;
    std::uint32_t particle = 0;
    Vec3 anchor{};              ///< initial position of the point [m]
    float compliance = 0;       ///< [m/N]; 0 = the particle is at the point
    float maxForce = unlimited; ///< of the spring [N]
    float maxSpeed = unlimited; ///< of the point towards its target [m/s]
};

/// |x_particle - x_anchor| <= length: keeps pinned cloth and chains from stretching with one constraint a
/// particle (long-range attachments, Kim 2012). Permanent; dissipates energy when it is taut.
struct SINEW_API Tether {
    std::uint32_t particle = 0;
    std::uint32_t anchor = 0; ///< a particle that never moves
    float length = 0;         ///< [m]; rest distance from anchor to particle, measured along the body
};

/// Holds a particle at its position in the scene. Permanent. Compiles to inverse mass 0 and therefore to no
/// pass.
struct SINEW_API FixedConstraint {
    std::uint32_t particle = 0;
};

/// A half space that particles must stay in: normal . x >= offset + contactOffset. Contacts are found anew in
/// each substep.
struct SINEW_API Plane {
    Vec3 normal{0, 1, 0};     ///< unit length, pointing into the free side
    float offset = 0;         ///< [m]
    float friction = 0;       ///< Coulomb coefficient while sliding, >= 0
    float restitution = 0;    ///< 0 (no rebound) to 1 (elastic)
    float staticFriction = 0; ///< coefficient before sliding starts; below `friction` = `friction`
};

/// The pose of a collider at one time. Between two keyframes the collider moves at constant speed and turns
/// at constant rate the shorter way; a rotation of half a turn or more needs a keyframe in between.
struct SINEW_API Keyframe {
    float time = 0; ///< since the start of the simulation [s]
    Pose pose{};
};

enum class ColliderShape { sphere, capsule, box };
enum class PathEnd {
    hold, ///< stays at the last keyframe
    loop, ///< starts again at the first keyframe, which must equal the last one
};

/// A rigid body that particles stay out of and that only its own path moves. It pushes and carries particles:
/// friction and restitution are relative to the velocity of its surface at the contact. Contacts are found
/// anew in each substep; fast particles do not pass through. A particle that is inside when the simulation
/// begins leaves by the nearest side at 1 m/s and keeps no velocity from that.
struct SINEW_API Collider {
    ColliderShape shape = ColliderShape::sphere;
    float radius = 0;             ///< [m], > 0: of a sphere, or of a capsule and its ends. Unused by a box
    float halfLength = 0;         ///< [m]: from a capsule's middle to the centres of its ends, along its y
    Vec3 halfExtents{};           ///< [m], > 0: of a box, along its own axes
    float margin = 0;             ///< [m]: distance kept from the surface in addition to contactOffset
    float friction = 0;           ///< Coulomb coefficient while sliding, >= 0
    float staticFriction = 0;     ///< coefficient before sliding starts; below `friction` = `friction`
    float restitution = 0;        ///< 0 (no rebound) to 1 (elastic)
    Pose pose{};                  ///< pose of a collider without a path
    std::vector<Keyframe> path{}; ///< times ascending; before the first one the first pose
    PathEnd pathEnd = PathEnd::hold;
    Vec3 color{0.45f, 0.45f, 0.48f}; ///< linear RGB, for rendering
};

/// Particles that follow a path as one rigid body, whatever they meet: a moving mesh collider
/// (addMeshCollider), or a support that others hang from (drive() in holds.hpp). Each particle must be fixed:
/// its inverse mass is 0 or a FixedConstraint names it. The scene holds their positions at the start of the
/// simulation. `split` only.
struct SINEW_API DrivenBody {
    std::uint32_t firstParticle = 0, particleCount = 0;
    std::vector<Keyframe> path{}; ///< poses of the frame in which the particles stay in place; as in Collider
    PathEnd pathEnd = PathEnd::hold;
    std::vector<std::uint32_t> particles = {}; ///< more particles, in any order
};

/// Particles on the nodes of a regular grid, linked to their neighbours by distance constraints: a body whose
/// topology a solver may compute instead of reading it (addLattice, addCloth). It repeats what the scene's
/// lists of particles and constraints hold; validate() compares the two.
struct SINEW_API Grid {
    std::string name{};
    std::array<std::uint32_t, 3> nodes{}; ///< along x, y, z; a sheet has nodes[1] = 1
    std::uint32_t firstParticle = 0;
    std::vector<std::uint32_t>
        node{}; ///< grid node of particle firstParticle + i: x + nodes[0] (y + nodes[1] z); ascending
    std::uint32_t firstDistance = 0, distanceCount = 0;
    /// Share of each cell that is material, in 1/15, x fastest. A link's stiffness is the mean over the cells
    /// that can contain it (4 for an edge, 2 for a face diagonal, 1 for a body diagonal); a link with mean 0
    /// does not exist. A link of a sheet has its whole stiffness if any of its cells contains it.
    std::vector<std::uint8_t> fill{};
    std::uint32_t kinds = 2;           ///< 2: edges and face diagonals; 3: body diagonals too
    std::array<float, 3> compliance{}; ///< of a whole link of each kind [m/N]; 0 = rigid
    std::array<float, 3> restLength{}; ///< [m]
    /// The volume V of a cell is the determinant of its mean edges (each the mean of four), V0 =
    /// restLength[0]^3 and J = V / V0. Its energy is fill x V0 volumeStiffness / 2 (J - 1)^2. [Pa]; 0 = none
    float volumeStiffness = 0;
    /// The pressure that unfolds flattened and mirrored cells: full where J < 0, falling to 0 at J = 1/2.
    /// [Pa]; 0 = none
    float recoveryPressure = 0;
    /// Whether a blade may cut its links (Step::blade): the state then stores which links are alive. `split`
    /// only.
    bool isCuttable = false;
    /// Stretch above which a cuttable body tears, in any direction: a cut through the cell, perpendicular to
    /// the stretch. At most `tearsPerStep` cells tear in a step: in voxel bodies cells that a cut has reached
    /// first, then the most stretched ones. 0.2 = at 1.2 times the rest length; 0 = never.
    float tearStrain = 0;
    std::uint32_t tearsPerStep = 16;
    /// Work of a blade for each area that it cuts, of the body at rest [J/m^2], in a sheet for each length
    /// [J/m]. It gives the force on the blade (Impulses::blade) and changes no motion. 0 = no force
    float toughness = 0;
};

/// Whether the cells of a grid have volume energies. No list of constraints holds these, only the grid does.
inline bool hasCellVolumes(const Grid& grid) {
    return grid.volumeStiffness > 0 || grid.recoveryPressure > 0;
}

/// A named range of particles, for reports and messages.
struct SINEW_API Body {
    std::string name{};
    std::uint32_t firstParticle = 0, particleCount = 0;
    float restVolume = 0;            ///< [m^3]; 0 = encloses no volume (cloth)
    Vec3 color{0.62f, 0.62f, 0.60f}; ///< linear RGB, used if no skin shows the body
    /// Bodies with different numbers join the simulation at different times (World): the scene's positions of
    /// one say nothing about those of the other, and no overlap of the two counts as one at load. Particles
    /// of no body have the number 0.
    std::uint32_t arrival = 0;
    /// Starts outside of the world, and enters and leaves it by motions (MotionKind::spawn, despawn). Costs
    /// memory, and little time while it is absent. Needs `split`, Settings::motions, and a body that moves
    /// and is linked to no other and to no anchor. One that was cut is whole when it enters or leaves.
    bool isAbsent = false;
};

/// Position of a skin vertex in a lattice cell: x = sum over corners k of N_k(weights) x_k, trilinear. Corner
/// k has the offset (k & 1, k >> 1 & 1, k >> 2) in the cell.
struct SINEW_API CellEmbedding {
    std::array<std::uint32_t, 8> particles{};
    Vec3 weights{}; ///< local coordinates in the cell, each in [0, 1]
    float share(std::size_t corner) const {
        return ((corner & 1) != 0 ? weights.x : 1 - weights.x) *
               ((corner & 2) != 0 ? weights.y : 1 - weights.y) *
               ((corner & 4) != 0 ? weights.z : 1 - weights.z);
    }
};

/// A place in a texture, as OBJ has it: v grows upwards.
struct SINEW_API TexturePoint {
    float u = 0, v = 0;
    bool operator==(const TexturePoint&) const = default;
};
/// Those of the corners of a triangle. A seam is an edge along which two triangles have different ones.
using TextureCorners = std::array<TexturePoint, 3>;

/// The visible triangle mesh of a body. Its vertices are either particles (`particles`) or points in lattice
/// cells (`cells`); exactly one of the two lists is filled, one entry a vertex.
struct SINEW_API Skin {
    std::string name{};
    std::vector<std::array<std::uint32_t, 3>> triangles{}; ///< counter-clockwise seen from outside
    std::vector<std::uint32_t> particles{};
    std::vector<CellEmbedding> cells{};
    /// Empty, or the particle that each vertex of a skin in cells follows when the body is cut: a corner of
    /// its cell. Such a skin is clipped along cuts and closed with the cut surface, provided that it is
    /// closed and the anchors of every triangle are corners of one tetrahedron (lattice::isKuhn) of a filled
    /// cell; mesh::addMesh splits skins to achieve that. Any other skin stretches over a cut.
    std::vector<std::uint32_t> anchors{};
    /// Empty, or the same surface in fewer triangles between the first of the vertices: the skin before
    /// mesh::addMesh split it, drawn while nothing is cut (SkinDetail::drawn).
    std::vector<std::array<std::uint32_t, 3>> wholeTriangles{};
    /// Empty, or for each of `triangles` the whole triangle that it is a part of: after a cut, parts away
    /// from it are lit as their whole triangle was.
    std::vector<std::uint32_t> wholeOf{};
    /// Empty, or texture coordinates for each of `triangles`, and then for each of `wholeTriangles`. Without
    /// them in any skin of a scene no buffer or pass is added.
    std::vector<TextureCorners> textureCoordinates{}, wholeTextureCoordinates{};
    Vec3 color{0.78f, 0.36f, 0.32f}; ///< linear RGB
    std::size_t vertexCount() const { return particles.empty() ? cells.size() : particles.size(); }
};

/// A name for a set of fixed or driven particles.
struct SINEW_API NamedHold {
    std::string name{};
    std::vector<std::uint32_t> particles{}; ///< ascending
};

struct SINEW_API Scene {
    std::string name{};
    Vec3 gravity{0, -9.81f, 0}; ///< [m/s^2]
    float dt = 1.0f / 60.0f;    ///< length of a step [s], 0 < dt <= 0.1
    float damping = 0;          ///< rate c of velocity decay exp(-c t) [1/s]
    /// Internal damping of links proportional to their stiffness k (the stiffness term of Rayleigh damping,
    /// Kelvin-Voigt): force -k dampingTime (v_rel . n) n [s]. A vibration of angular frequency w has the
    /// damping ratio w dampingTime / 2. `split` limits it to what keeps its substep stable (dampingBudget in
    /// substeps.hpp).
    float dampingTime = 0;
    std::vector<Particle> particles{};
    std::vector<DistanceConstraint> distances{};
    std::vector<BendConstraint> bends{};
    std::vector<Attachment> attachments{};
    std::vector<Tether> tethers{};
    std::vector<FixedConstraint> fixed{};
    std::vector<Plane> planes{};
    std::vector<Collider> colliders{};
    std::vector<DrivenBody> driven{};
    std::vector<Face> faces{};
    ContactSettings contacts{};
    /// A cut removes pieces of fewer particles than this at the end of the step that separates them:
    /// contacts, grabs, drawing and counts then ignore them. Their particles stay in the state with their
    /// mass, belong to no piece, and move on under gravity, planes and colliders, or sleep
    /// (Settings::sleeps). An undo of the cut restores them. 0 = removes none.
    std::uint32_t debris = 0;
    std::vector<Body> bodies{};
    std::vector<Grid> grids{};
    std::vector<Skin> skins{};
    /// Names for fixed particles; the force on each is reported separately (Settings::keepsForces). A
    /// NamedHold does not fix its particles: FixedConstraint and DrivenBody do.
    std::vector<NamedHold> holds{};
};

enum class Solver { jacobi, split, gaussSeidel };

/// The choice between kernels that do the same work; which one is fastest depends on the device (tune()
/// measures). Only usesGrids changes rounding, because it changes the order in which links are summed.
struct SINEW_API Forms {
    bool usesTexels =
        true; ///< fetch positions, links, contacts, skins and cuts through the texture path, not by loads
    bool usesGrids = true; ///< compute the neighbours of bodies on a grid instead of listing them
    /// March of one invocation through a lattice: columns in x and in y, 1 or 2, and at most `chunk` slices,
    /// 1..65535. With both 1, an invocation computes one node. 0 = chosen by the kind of device
    /// (completed()).
    std::uint32_t columns = 0, chunk = 0;
    /// Bytes of shared memory in which a work group may keep a small body on a grid through all substeps of a
    /// step, limited by the device; 0 = none. Used only in scenes that consist of such bodies.
    std::uint32_t residentBytes = 0;
    bool operator==(const Forms&) const = default;
};

/// Kinds of devices: few threads with wide vectors, or many invocations at a time.
enum class DeviceKind { software, gpu };

/// `forms` with zeros replaced by the values for a kind of device, before anything is measured. A long march
/// leaves a GPU idle; on a CPU it saves loads.
constexpr Forms completed(Forms forms, DeviceKind kind) {
    const bool isGpu = kind == DeviceKind::gpu;
    if (forms.columns == 0) forms.columns = isGpu ? 1 : 2;
    if (forms.chunk == 0) forms.chunk = isGpu ? 1 : 16;
    return forms;
}

/// Default of Settings::framesInFlight.
inline constexpr std::uint32_t usualFramesInFlight = 4;

/// Value of Settings::levels: as many as win at equal error, from the kind of body, its size and the
/// substeps.
inline constexpr std::uint32_t autoLevels = ~0u;

/// How to solve a scene; determines the step program. Ranges are in ranges.hpp.
struct SINEW_API Settings {
    Solver solver = Solver::split;
    std::uint32_t substeps = 0; ///< per step, 1..1000; 0 = chosen by stiffness and tolerance (chooseSubsteps)
    float tolerance = 0.05f;    ///< with substeps 0: allowed share of lost link stiffness, above 0, below 1
    std::uint32_t iterations = 1; ///< sweeps per substep, 1..1000; `split` always has one
    float omega = 2;              ///< `split`: stiffness clamp; stable below 4 / (1 + 2 theta) on any graph
    float theta = 0.1f;           ///< `split`: 0 symplectic .. 1 PBD order; damps like theta h k
    /// `split`: coarse levels of every body on a grid, 0..6. A level has a block for 2 x 2 x 2 nodes of the
    /// one below, and links between blocks carry the stiffness that a substep is too long for below. 0 =
    /// none; autoLevels = chosen (chooseSubsteps).
    std::uint32_t levels = 0;
    /// `split`: a link is clamped to what its particles bear in the directions of their links, not to what
    /// they would bear if all were parallel: the same error takes 0.6 times the substeps in a solid, 0.7
    /// times in a sheet (docs/clamp.md). Without effect where there are levels or internal damping, and where
    /// the sum clamps nothing (clampOf).
    bool hasSharpClamp = false;
    float weight = 0;         ///< `jacobi`: factor on a particle's summed corrections; 0 = 1 / their number
    float overRelaxation = 1; ///< `jacobi`: second factor on that sum, below 4/3 with averaging
    float warmStart =
        0.9f; ///< `gauss_seidel`: largest share of the last multipliers that a substep starts with; 0 = none
    /// Distance beyond contact up to which candidates are listed, in median radii (with faces: or eighths of
    /// a median face or edge, if longer). Lists are rebuilt when a particle may have moved half of it.
    /// Affects speed, not results.
    float contactMargin = 0.5f;
    /// Mean capacity of contact lists, in candidates: particles near a particle, faces near a point, edges
    /// near an edge. Lists share their memory, so that a single list may be far longer; 1..1024
    std::uint32_t contactRoom = 8;
    /// Capacity for the surface of cuts, in triangles and as many vertices, and for the torn parts of each
    /// sheet's skin, at least; 0 = enough for several cuts through the whole of each body.
    std::uint32_t cutSurfaceRoom = 0;
    /// Bodies that rest for half a second sleep: they cost nothing and stay in place, bit for bit, until
    /// something touches them, their support moves, or Step::wakes is set. `split` only.
    bool sleeps = false;
    /// Sums the impulses of contacts, planes, colliders, holds and grabs over a step (Simulation::forces).
    /// Not available where bodies sleep; with `jacobi` only if the scene has neither links nor bends, with
    /// `gauss_seidel` only if none ends at a particle that never moves. Motion stays the same, except for
    /// rounding in `split` without contacts.
    bool keepsForces = false;
    /// Kinds of events that a step lists (Simulation::events): bits of EventKind, such as allEvents; 0 = no
    /// passes. Contacts add a pass to each substep, with a memory of 8 bytes for each body and each body,
    /// plane or collider that it may touch. Motion keeps its bits.
    std::uint32_t events = 0;
    std::uint32_t eventRoom = 256; ///< events that are kept of a step, 1..65536; 16 bytes each
    std::uint32_t grabs = 0;       ///< grabs that can be active at a time (Step::grabs), 0..8; 0 = no passes
    std::uint32_t hostColliders =
        0; ///< kinematic colliders at a time (Step::hostColliders), 0..1024; 0 = no passes
    /// Force fields at a time (Step::fields), 0..16; 0 = no passes. With room for one, no body stays in
    /// shared memory (Forms::residentBytes).
    std::uint32_t fields = 0;
    /// Motions in a step (Step::motions), 0..64; 0 = no passes.
    std::uint32_t motions = 0;
    Forms forms{};
    /// False saves 16 bytes a particle: the buffer of public velocities is omitted, and an undone step leaves
    /// its particles at rest.
    bool publishesVelocities = true;
    /// Keeps the positions before the newest step, and the vertices of skins before the newest recordSkin(),
    /// for motion vectors (Simulation::previousPositions, previousSkinVertices). Costs a copy of each.
    bool keepsPrevious = false;
    /// Keeps the outputs of as many of the newest steps, each in buffers of its own, 0..8; 0 = none. With 2 a
    /// host draws step N while step N + 1 is computed (Simulation::outputs). Costs a copy of each output.
    std::uint32_t outputFrames = 0;
    /// VkBufferUsageFlags that a host needs of outputs, such as those of a build of acceleration structures,
    /// beyond what they have: storage, uniform and texel buffer, source and target of copies, and vertex,
    /// index or indirect buffer by their contents. Outputs are all buffers that the views of a Simulation
    /// show. Allowed are ranges::outputUsages.
    std::uint32_t outputUsage = 0;
    /// Queue families that use outputs besides the family of the device: bit i = family i; 0 = none. Outputs
    /// are then shared (VK_SHARING_MODE_CONCURRENT), and a semaphore suffices to hand them over.
    std::uint32_t outputFamilies = 0;
    /// Makes each kind of pass a phase of its own in the `timestamps` of a step (Simulation::phases).
    bool timesPasses = false;
    bool isReversed = false; ///< runs every kernel in reversed invocation order; the state must not change
    /// Steps that may be recorded and unfinished at a time, 1..64: frames in flight times steps a frame. As
    /// many statuses are kept (Simulation::status), 64 to 256 bytes each.
    std::uint32_t framesInFlight = usualFramesInFlight;
};

} // namespace sinew::sim
