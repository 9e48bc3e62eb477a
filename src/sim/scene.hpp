// What a user describes: particles, permanent constraints, boundary planes and skins, as plain structs in SI
// units. The only thing a caller fills in; everything else (the step program, buffers, barriers) is compiled
// from it. y points up. Numbers are float32 so that the device and the double-precision reference start from
// the same values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sinew::sim {

struct Vec3 {
    float x = 0, y = 0, z = 0;
};

/// A turn: a unit quaternion.
struct Quaternion {
    float x = 0, y = 0, z = 0, w = 1;
};

/// Where a rigid thing is: its point s is at position + rotation s.
struct Pose {
    Vec3 position{}; ///< of its middle [m]
    Quaternion rotation{};
};

/// A point mass.
struct Particle {
    Vec3 position{};       ///< [m]
    Vec3 velocity{};       ///< [m/s]
    float inverseMass = 1; ///< [1/kg]; 0 = never moves
    float contactOffset =
        0; ///< [m] distance kept from colliders; negative where the particle lies outside its skin
    /// [m]; two particles touch where they are nearer than the sum of their radii. 0 = touches no other
    /// particle. Linked ones never touch, nor do those of one linked body that are nearer than 1.05 times
    /// that at rest.
    float radius = 0;
    /// What others feel that touch it: 0 = ContactSettings::friction and restitution, k = its surfaces[k -
    /// 1].
    std::uint32_t surface = 0;
    /// Whether what it touches or overlaps when the scene is loaded keeps that distance, as its rest
    /// distance: see ContactSettings::recoverySpeed. The first corner of a face says so. A pair keeps it
    /// where either of the two does.
    bool keepsRest = false;
};

/// What a particle or a face is like to touch. A pair has the geometric mean of both frictions, so that what
/// is smooth slides on everything, and the larger restitution. Planes keep their own.
struct Surface {
    float friction = 0;       ///< Coulomb coefficient of what slides, >= 0
    float restitution = 0;    ///< 0 (no rebound) to 1 (elastic)
    float staticFriction = 0; ///< of what does not slide yet; less than `friction` is as much
};

/// A triangle that particles with a radius touch, from both sides: cloth, or with corners that never move a
/// collider. Kept at the sum of radius and thickness; corners feel it by the weights of the place that is
/// touched. Its edges touch those of other faces, at the sum of both thicknesses. A face and a particle, or
/// two edges, of one linked body that are nearer than 1.05 times that at rest never touch, nor does what
/// shares a corner, nor, in what may be cut, a solid face and what a link joins to a corner of it. A face has
/// the surface of its first corner. Where a face is at least as thick as a corner is wide, others touch the
/// face instead of the corner. A face thinner than a thousandth of its length touches nothing.
struct Face {
    std::array<std::uint32_t, 3> particles{};
    float thickness = 0; ///< from its middle [m]
    /// Part of the surface of something solid (addSurfaceFaces), in front of which its corners follow each
    /// other counter-clockwise: touches what is in front, lets out what comes from behind, and its corners
    /// touch others as before, beside it. Its edges touch nothing.
    bool isSolid = false;
};

/// How particles touch each other and faces.
struct ContactSettings {
    float friction = 0;       ///< of all whose Particle::surface is 0; see Surface
    float restitution = 0;    ///< likewise
    float staticFriction = 0; ///< likewise
    /// With which particles, faces and edges part that overlap when the scene is loaded [m/s]. Does not limit
    /// what a contact carries, but for bodies that interlock: of which one reaches the inside of another's
    /// lattice. A pair that keeps its rest distance (Particle::keepsRest) does not part: the distance at load
    /// is the one at which the two touch, until they are as far from each other as any two that do not touch.
    /// From then on they touch as any two do. A point behind the surface of something solid has a distance
    /// below 0; one that is deeper than it would have to be far in front touches nothing there.
    float recoverySpeed = 0.5f;
    std::vector<Surface> surfaces; ///< further ones, at most 64
};

/// |x_a - x_b| = restLength, with energy (|x_a - x_b| - restLength)^2 / (2 compliance). Permanent.
struct DistanceConstraint {
    std::uint32_t a = 0, b = 0;
    float restLength = 0; ///< [m]
    float compliance = 0; ///< [m/N]; 0 = rigid
};

/// Three particles in a row: C = x_a - 2 x_b + x_c, energy |C|^2 / (2 compliance). Straight at rest. A plate
/// of bending stiffness B [N m] sampled every s [m] has compliance s^2 / B, a rod of stiffness EI [N m^2] has
/// s^3 / EI: see bodies.hpp. Permanent.
struct BendConstraint {
    std::uint32_t a = 0, b = 0, c = 0; ///< b in the middle
    float compliance = 0;              ///< [m/N]; 0 = as straight as the solver can
};

/// A spring from a particle to a point that the host may move from step to step (Step::anchors). Permanent.
struct Attachment {
    static constexpr float unlimited = 3.402823466e38f;
    std::uint32_t particle = 0;
    Vec3 anchor{};              ///< where the point is at first [m]
    float compliance = 0;       ///< [m/N]; 0 = the particle is where the point is
    float maxForce = unlimited; ///< of the spring [N]
    float maxSpeed = unlimited; ///< with which the point follows its target [m/s]
};

/// |x_particle - x_anchor| <= length: keeps pinned cloth and chains from stretching without a sweep along
/// them (long-range attachments, Kim 2012). Permanent; dissipates when it is taut.
struct Tether {
    std::uint32_t particle = 0;
    std::uint32_t anchor = 0; ///< a particle that never moves
    float length = 0;         ///< [m]; the way from anchor to particle along the body at rest
};

/// Holds a particle where the scene puts it. Permanent. Compiles to inverse mass 0 and therefore to no pass.
struct FixedConstraint {
    std::uint32_t particle = 0;
};

/// A half space that particles must stay in: normal . x >= offset + contactOffset. Found active anew each
/// substep.
struct Plane {
    Vec3 normal{0, 1, 0};     ///< unit length, pointing into the free side
    float offset = 0;         ///< [m]
    float friction = 0;       ///< Coulomb coefficient of what slides, >= 0
    float restitution = 0;    ///< 0 (no rebound) to 1 (elastic)
    float staticFriction = 0; ///< of what does not slide yet; less than `friction` is as much
};

/// Where a collider is at a time; between two times it moves evenly and turns evenly the shorter way, so that
/// half a turn and more need a keyframe in between.
struct Keyframe {
    float time = 0; ///< since the simulation began [s]
    Pose pose{};
};

enum class ColliderShape { sphere, capsule, box };
enum class PathEnd {
    hold, ///< stays where the last keyframe is
    loop, ///< begins anew with the first keyframe, which must be where the last one is
};

/// A rigid thing that particles stay out of, and that nothing moves but its own path. It pushes and carries
/// them: friction and restitution are relative to its surface where they touch it. Found active anew each
/// substep; what is fast does not pass through. A particle that is inside when the simulation begins leaves
/// by the nearest side at 1 m/s and keeps no speed of that.
struct Collider {
    ColliderShape shape = ColliderShape::sphere;
    float radius = 0;         ///< [m], above 0: of a sphere; of a capsule and its ends. A box has none
    float halfLength = 0;     ///< [m]: a capsule has its ends' centres that far from its middle, along its y
    Vec3 halfExtents{};       ///< [m], above 0: of a box, along its own axes
    float margin = 0;         ///< [m]: kept from the surface beyond Particle::contactOffset
    float friction = 0;       ///< Coulomb coefficient of what slides, >= 0
    float staticFriction = 0; ///< of what does not slide yet; less than `friction` is as much
    float restitution = 0;    ///< 0 (no rebound) to 1 (elastic)
    Pose pose{};              ///< where it stands, if it has no path
    std::vector<Keyframe> path{}; ///< times ascending; before the first it stays where that is
    PathEnd pathEnd = PathEnd::hold;
    Vec3 color{0.45f, 0.45f, 0.48f}; ///< linear RGB, for whoever draws it
};

/// Particles that go along a path as one rigid thing, whatever they meet: a mesh that moves
/// (addMeshCollider), or what others hang on (drive() of holds.hpp). Each is held: its inverse mass is 0 or a
/// FixedConstraint has it. The scene has them where they are when the simulation begins. For `split` alone.
struct DrivenBody {
    std::uint32_t firstParticle = 0, particleCount = 0;
    std::vector<Keyframe> path; ///< as a collider's; of a frame that they keep their places in
    PathEnd pathEnd = PathEnd::hold;
    std::vector<std::uint32_t> particles = {}; ///< further ones, in any order
};

/// Particles on the nodes of a regular grid, linked to their neighbours by distance constraints: a body whose
/// topology a solver may compute instead of reading it (addLattice, addCloth). Says nothing new: particles
/// and constraints stand in the scene's lists, and validate() holds the two against each other.
struct Grid {
    std::string name;
    std::array<std::uint32_t, 3> nodes{}; ///< along x, y, z; a sheet has nodes[1] = 1
    std::uint32_t firstParticle = 0;
    std::vector<std::uint32_t>
        node; ///< of particle firstParticle + i: x + nodes[0] (y + nodes[1] z); ascending
    std::uint32_t firstDistance = 0, distanceCount = 0;
    /// How much of each cell is material, in 1/15, x fastest. A link's stiffness is the mean over the cells
    /// that may hold it (4 for an edge, 2 for a face diagonal, 1 for a body diagonal), and it is absent where
    /// that is 0. The links of a sheet are whole where any of its cells holds them.
    std::vector<std::uint8_t> fill;
    std::uint32_t kinds = 2;           ///< 2: edges and face diagonals; 3: body diagonals too
    std::array<float, 3> compliance{}; ///< of a whole link of each kind [m/N]; 0 = rigid
    std::array<float, 3> restLength{}; ///< [m]
    /// A cell's volume V is the determinant of its mean edges (each the mean of four), V0 = restLength[0]^3
    /// and J = V / V0. Its energy is fill x V0 volumeStiffness / 2 (J - 1)^2. [Pa]; 0 = none
    float volumeStiffness = 0;
    /// The pressure that unfolds flattened and mirrored cells: all of it where J < 0, falling to nothing at
    /// J = 1/2. [Pa]; 0 = none
    float recoveryPressure = 0;
    /// Whether a blade may cut its links (Step::blade): keeps which of them are alive, for `split` alone.
    bool isCuttable = false;
    /// A body that may be cut also tears where it is stretched farther than that, in whichever direction: by
    /// a cut through a cell, across it. Of all cells stretched so far at most `tearsPerStep` in a step: of
    /// voxels those that a cut has reached, then those stretched most. 0.2 = to 1.2 times; 0 = never.
    float tearStrain = 0;
    std::uint32_t tearsPerStep = 16;
};

/// Whether the cells of a grid have volumes: an energy that stands in no list but the grid's.
inline bool hasCellVolumes(const Grid& grid) {
    return grid.volumeStiffness > 0 || grid.recoveryPressure > 0;
}

/// A named range of particles: what reports and messages call a body.
struct Body {
    std::string name;
    std::uint32_t firstParticle = 0, particleCount = 0;
    float restVolume = 0;            ///< [m^3]; 0 = encloses none (cloth)
    Vec3 color{0.62f, 0.62f, 0.60f}; ///< linear RGB, where no skin shows the body
};

/// Where a skin vertex sits in a lattice cell: x = sum over corners k of N_k(weights) x_k, trilinear. Corner
/// k has the offset (k & 1, k >> 1 & 1, k >> 2) in the cell.
struct CellEmbedding {
    std::array<std::uint32_t, 8> particles{};
    Vec3 weights; ///< local coordinates in the cell, each in [0, 1]
    float share(std::size_t corner) const {
        return ((corner & 1) != 0 ? weights.x : 1 - weights.x) *
               ((corner & 2) != 0 ? weights.y : 1 - weights.y) *
               ((corner & 4) != 0 ? weights.z : 1 - weights.z);
    }
};

/// The visible triangle mesh a body carries. Its vertices either are particles (`particles`) or lie in
/// lattice cells
/// (`cells`); exactly one of the two lists is filled, one entry a vertex.
struct Skin {
    std::string name;
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise seen from outside
    std::vector<std::uint32_t> particles;
    std::vector<CellEmbedding> cells;
    /// Empty, or the particle that each vertex of a skin in cells goes with where the body is cut: a corner
    /// of its cell. Such a skin is clipped along cuts and closed with their inside, if it is closed and the
    /// anchors of every triangle are corners of one tetrahedron (lattice::isKuhn) of a filled cell;
    /// mesh::addMesh splits skins so. Else it stretches over a cut.
    std::vector<std::uint32_t> anchors;
    /// Empty, or the same surface in fewer triangles between the first of the vertices, as it was before
    /// mesh::addMesh split it: what is drawn while nothing is cut (SkinDetail::drawn).
    std::vector<std::array<std::uint32_t, 3>> wholeTriangles;
    /// Empty, or for each of `triangles` the whole triangle that it is a part of: away from cuts that one is
    /// drawn in place of its parts (Simulation::drawnSkins).
    std::vector<std::uint32_t> wholeOf;
    Vec3 color{0.78f, 0.36f, 0.32f}; ///< linear RGB
    std::size_t vertexCount() const { return particles.empty() ? cells.size() : particles.size(); }
};

/// The name that a scene gives to particles that it holds or drives.
struct NamedHold {
    std::string name;
    std::vector<std::uint32_t> particles; ///< ascending
};

struct Scene {
    std::string name;
    Vec3 gravity{0, -9.81f, 0}; ///< [m/s^2]
    float dt = 1.0f / 60.0f;    ///< length of a step [s], 0 < dt <= 0.1
    float damping = 0;          ///< rate c of velocity decay exp(-c t) [1/s]
    /// Internal damping of links proportional to their stiffness k (Rayleigh's second term, Kelvin-Voigt):
    /// force -k dampingTime (v_rel . n) n [s]. A vibration of angular frequency w has the damping ratio w
    /// dampingTime / 2. `split` takes as much as its substep stays stable with (substeps.hpp says how much).
    float dampingTime = 0;
    std::vector<Particle> particles;
    std::vector<DistanceConstraint> distances;
    std::vector<BendConstraint> bends;
    std::vector<Attachment> attachments;
    std::vector<Tether> tethers;
    std::vector<FixedConstraint> fixed;
    std::vector<Plane> planes;
    std::vector<Collider> colliders;
    std::vector<DrivenBody> driven;
    std::vector<Face> faces;
    ContactSettings contacts;
    /// Pieces of fewer particles than that are removed as the step ends whose cut has made them: nothing
    /// touches, holds, draws or counts them any more. Their particles stay in the state, as of no piece, with
    /// their mass, and move on under gravity, planes and colliders, or sleep (Settings::sleeps). An undo of
    /// the cut brings them back. 0 = none.
    std::uint32_t crumbs = 0;
    std::vector<Body> bodies;
    std::vector<Grid> grids;
    std::vector<Skin> skins;
    /// Names for particles that are held, each with a force of its own (Settings::keepsForces). They hold
    /// nothing by themselves: FixedConstraint and DrivenBody do.
    std::vector<NamedHold> holds;
};

enum class Solver { jacobi, split, gaussSeidel };

/// Which of several kernels for the same work a program is built from; which is fastest depends on the device
/// (tune() measures). Only usesGrids changes rounding, because it changes the order in which links are
/// summed.
struct Forms {
    bool usesTexels =
        true;              ///< fetch positions, skins and cuts through the texture path, not by storage loads
    bool usesGrids = true; ///< compute the neighbours of bodies on a grid instead of listing them
    /// Columns of a lattice, marched by one invocation in x and in y, 1 or 2, and slices marched at most,
    /// 1..65535. One of both: an invocation computes one node. 0 = as suits the device (completed()).
    std::uint32_t columns = 0, chunk = 0;
    /// Bytes of shared memory in which a work group may keep a small body on a grid through all substeps of a
    /// step, as far as the device has them; 0 = none. Used where a scene has nothing else than such bodies.
    std::uint32_t residentBytes = 0;
    bool operator==(const Forms&) const = default;
};

/// Kinds of devices: few threads with wide vectors, or many invocations at a time.
enum class DeviceKind { software, gpu };

/// `forms` with what they leave open as it suits such a device, before anything is measured. A long march
/// leaves a GPU idle; a CPU loads less by it.
constexpr Forms completed(Forms forms, DeviceKind kind) {
    const bool isGpu = kind == DeviceKind::gpu;
    if (forms.columns == 0) forms.columns = isGpu ? 1 : 2;
    if (forms.chunk == 0) forms.chunk = isGpu ? 1 : 16;
    return forms;
}

/// Settings::framesInFlight where nobody says otherwise.
inline constexpr std::uint32_t usualFramesInFlight = 4;

/// How to solve a scene; shapes the step program. Ranges are in ranges.hpp.
struct Settings {
    Solver solver = Solver::split;
    std::uint32_t substeps = 0; ///< per step, 1..1000; 0 = as many as stiffness and tolerance ask for
    float tolerance = 0.05f; ///< with substeps 0: how much softer a link may be than asked, above 0, below 1
    std::uint32_t iterations = 1; ///< sweeps per substep, 1..1000; `split` has one by construction
    float omega = 2;              ///< `split`: stiffness clamp; stable below 4 / (1 + 2 theta) on any graph
    float theta = 0.1f;           ///< `split`: 0 symplectic .. 1 PBD order; damps like theta h k
    float weight = 0;         ///< `jacobi`: factor on a particle's summed corrections; 0 = 1 / their number
    float overRelaxation = 1; ///< `jacobi`: second factor on that sum, below 4/3 with averaging
    float warmStart =
        0.9f; ///< `gauss_seidel`: most that a substep starts with of the multipliers of the last; 0 = cold
    /// How much farther than touching particles are listed together, in median radii (with faces: or eighths
    /// of a median face or edge, if longer); lists are made again when one may have moved half of that.
    /// Changes speed, but no result.
    float contactMargin = 0.5f;
    /// Candidates that lists of contacts have room for, on average: particles near a particle, faces near a
    /// point, edges near an edge. Lists share their room: one may have far more; 1..1024
    std::uint32_t contactRoom = 8;
    /// Triangles, and as many vertices, that the surface of cuts has room for at least, and the skin of each
    /// sheet for what it falls into; 0 = as much as some cuts through the whole of each body need.
    std::uint32_t cutSurfaceRoom = 0;
    /// Bodies that rest for half a second sleep: they cost nothing and stay where they are, bit for bit,
    /// until somebody touches them, what holds them moves, or Step::wakes. `split` only.
    bool sleeps = false;
    /// Sums up which impulse contacts, planes, colliders, holds and hands give in a step
    /// (Simulation::forces). Not where bodies sleep; `jacobi` only where the scene has neither links nor
    /// bends, `gauss_seidel` only where none ends at a particle that never moves. Motion is the same, but for
    /// rounding where `split` has no contacts.
    bool keepsForces = false;
    std::uint32_t grabs = 0; ///< hands that may hold something at a time (Step::grabs), 0..8; 0 = no passes
    std::uint32_t pokes = 0; ///< rigid things that the host may move at a time (Step::pokes), 0..8; 0 = none
    Forms forms{};
    /// False saves 16 bytes a particle: there is no buffer of public velocities, and a step that is undone
    /// leaves what it holds at rest.
    bool publishesVelocities = true;
    /// Makes each kind of pass a phase of its own, for the `timestamps` of a step (Simulation::phases).
    bool timesPasses = false;
    bool isReversed = false; ///< runs every kernel in reversed invocation order; the state must not change
    /// Steps that may be recorded and not finished at a time, 1..64: frames in flight times steps a frame.
    /// As many statuses are kept (Simulation::status), 64 to 256 bytes each.
    std::uint32_t framesInFlight = usualFramesInFlight;
};

} // namespace sinew::sim
