// Makers of bodies from particles and constraints: cloth sheets, chains, voxel lattices and loose particles,
// appended to a Scene.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim {

/// A rectangular sheet of columns x rows particles in the plane of `right` and `down`, with edge and diagonal
/// links.
struct SINEW_API ClothSheet {
    std::string name = "cloth";
    Vec3 origin{};                             ///< position of particle (0, 0) [m]
    Vec3 right{1, 0, 0}, down{0, 0, 1};        ///< unit directions of a row and of a column
    std::array<std::uint32_t, 2> size{64, 64}; ///< particles along right and down, each >= 2
    float spacing = 1.0f / 63;                 ///< [m]
    float areaDensity = 0.2f;                  ///< [kg/m^2]
    float stretchCompliance = 0;               ///< of an edge [m/N]
    float shearCompliance = 0;                 ///< of a diagonal [m/N]
    /// Young's modulus times thickness [N/m] of an isotropic sheet with Poisson's ratio 1/3: sets both
    /// compliances and overrides those above. 0 = uses those above.
    float membraneStiffness = 0;
    float skipStiffness = 0; ///< of links over two spacings in a row or column, against folds [N/m]; 0 = none
    float bendingStiffness = 0; ///< of rows and columns [N m]; 0 = no bends. Twist has no stiffness
    /// Thickness in contacts with particles, faces and the sheet itself: particles get half of it as radius
    /// and contact offset, triangles as thickness. Best below `spacing`. 0 = touches only planes. [m]
    float thickness = 0;
    std::uint32_t tethers = 0;           ///< number for each particle, to the nearest pinned ones
    float radius = 0;                    ///< of a particle in contacts [m], at most half of the spacing
    std::vector<std::uint32_t> pinned{}; ///< particles (row-major within the sheet) held where they are
    bool isCuttable = false;             ///< Grid::isCuttable
    float tearStrain = 0;                ///< Grid::tearStrain
    std::uint32_t tearsPerStep = 16;     ///< Grid::tearsPerStep
    float toughness = 0;                 ///< Grid::toughness [J/m]
    Vec3 color{0.16f, 0.34f, 0.58f};
};

/// Appends particles, constraints, a body, a grid and a two-sided skin. Returns the index of the first
/// particle.
SINEW_API std::uint32_t addCloth(Scene& scene, const ClothSheet& sheet);

/// A triangle mesh that is static or follows a path. Particles with a radius touch it from both sides, and
/// its vertices touch moving faces.
struct SINEW_API MeshCollider {
    std::string name = "collider";
    std::vector<Vec3> vertices{}; ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    float thickness = 0;          ///< distance that particles keep from it in addition to their radius [m]
    Pose pose{};                  ///< pose of the frame of `path` at which `vertices` are given
    std::vector<Keyframe> path{}; ///< as in Collider; empty = never moves
    PathEnd pathEnd = PathEnd::hold;
    Vec3 color{0.55f, 0.53f, 0.5f};
};

/// Appends a particle for each vertex, a face for each triangle with three distinct corners, a body, a skin
/// and, with a path, a driven body: its particles are then at the start of the path. Returns the index of the
/// first particle. Throws std::invalid_argument for a triangle with a vertex that does not exist.
SINEW_API std::uint32_t addMeshCollider(Scene& scene, const MeshCollider& mesh);

/// Equal masses in a straight line, each linked to the next.
struct SINEW_API Chain {
    std::string name = "chain";
    Vec3 origin{};                       ///< position of the first particle [m]
    Vec3 direction{0, -1, 0};            ///< unit direction from the first to the last
    std::uint32_t particles = 100;       ///< >= 2
    float length = 1;                    ///< from the first to the last [m]
    float mass = 0.1f;                   ///< of all particles if the last one is like the others [kg]
    float endMass = 0;                   ///< of the last particle [kg]; 0 = like the others
    float compliance = 0;                ///< of a link [m/N]
    std::vector<std::uint32_t> pinned{}; ///< particles (counted from the first) held where they are
};

/// Appends particles, constraints and a body, and no skin: a line has no surface. Returns the index of the
/// first particle.
SINEW_API std::uint32_t addChain(Scene& scene, const Chain& chain);

/// Compliance [m/N] of the bends of a row of particles `spacing` [m] apart: of a plate sampled by rows at
/// that distance, of `stiffness` [N m] (energy stiffness / 2 x curvature^2 an area), or of a rod of
/// `stiffness` [N m^2].
SINEW_API float bendComplianceOfPlate(float stiffness, float spacing);
SINEW_API float bendComplianceOfRod(float stiffness, float spacing);

/// How the length of a tether is measured.
enum class TetherLength : std::uint8_t {
    alongLinks, ///< the distance over links at rest
    straight,   ///< the straight distance at rest: right if the body is flat and convex
};

/// Ties every particle that moves to the nearest `perParticle` static ones that links connect it to, among
/// the particles of the range `first`, `count`. `slack` is the share by which tethers are longer than the
/// rest distance.
struct SINEW_API TetherPlan {
    std::uint32_t first = 0, count = 0;
    std::uint32_t perParticle = 1;
    TetherLength length = TetherLength::alongLinks;
    float slack = 0;
};
SINEW_API void addTethers(Scene& scene, const TetherPlan& plan);

/// Gains of a spring that pulls a particle of a body of `mass` [kg] towards a moving point, equal for light
/// and heavy bodies.
struct SINEW_API DragFeel {
    float frequency = 5;         ///< of the body on the spring [Hz]
    float maxAcceleration = 100; ///< of the body [m/s^2]
    float maxSpeed = 5;          ///< of the point [m/s]
};
SINEW_API Attachment makeDrag(const Scene& scene, std::uint32_t particle, float mass,
                              const DragFeel& feel = {});

/// A voxel body: cubic cells of a regular grid, with particles on their corners. Each filled cell adds a
/// share of the stiffness of its 12 edges and 12 face diagonals, and an eighth of its mass to each corner. An
/// 18-neighbour central-force lattice with k1 = k2 = 0.4 E a is isotropic with Young's modulus E and Poisson
/// ratio 1/4 (a = spacing, k1 edges, k2 face diagonals); so is a lattice with body diagonals k3 = k2 and k1 =
/// 11/3 k2. Links alone give lambda = mu, the Lame constants. For a larger Poisson ratio nu each cell adds
/// lambda_v = mu (2 nu / (1 - 2 nu) - 1), and mu = E / (2 (1 + nu)) scales the links.
struct SINEW_API Lattice {
    std::string name = "lattice";
    Vec3 origin{};                               ///< position of grid corner (0, 0, 0) [m]
    std::array<std::uint32_t, 3> cells{1, 1, 1}; ///< grid size in cells
    float spacing = 0.1f;                        ///< edge of a cell [m]
    std::vector<float> fill{}; ///< share of each cell that is material, 0 = empty; x fastest; empty = all 1
    float youngModulus = 1e5f; ///< [Pa]
    /// 0.25 to 0.49. Links alone give 1/4; above it cells resist a change of volume, and the substeps that
    /// resolve the full stiffness become shorter, about as (1 - 2 nu)^-1/2.
    float poissonRatio = 0.25f;
    /// Pressure that unfolds flattened and mirrored cells, in shear moduli, 0 to 10; 0 = none. 2 overcame the
    /// links in every case tried; 1 did not in a mirrored body with strong damping. Costs time but no
    /// substeps, and does not act on a cell with more than half of its volume; with a smaller threshold
    /// crumpled bodies come to rest below it.
    float recovery = 0;
    float density = 1000;            ///< [kg/m^3]
    float radius = 0;                ///< of a particle in contacts [m], at most half of the spacing
    bool hasBodyDiagonals = false;   ///< 26 neighbours instead of 18
    bool isCuttable = false;         ///< Grid::isCuttable
    float tearStrain = 0;            ///< Grid::tearStrain
    std::uint32_t tearsPerStep = 16; ///< Grid::tearsPerStep
    float toughness = 0;             ///< Grid::toughness [J/m^2]
    float restVolume = 0;            ///< of the body [m^3], for its mass; 0 = sum of fill x cell volume
};

/// Result of addLattice: the particle on each grid corner, or noParticle. Corner (i, j, k) is at i +
/// (cells[0] + 1) * (j + (cells[1] + 1) * k).
struct SINEW_API LatticeCorners {
    static constexpr std::uint32_t noParticle = 0xffffffffu;
    std::array<std::uint32_t, 3> cells{};
    std::vector<std::uint32_t> particle{};
    std::uint32_t at(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return particle[i + (cells[0] + 1) * (j + (cells[1] + 1) * std::size_t{k})];
    }
};

/// Appends particles, constraints, a body and a grid, but no skin. The mass of all particles is density times
/// the body's volume. Mass follows the fill as given, but a filled cell counts as at least 1/8 in the shares
/// among corners; stiffness follows the fill in steps of 1/15, at least 2/15. If the body is so far from the
/// origin that float32 rounds positions by 1e-4 of the spacing, the links have the lengths between the
/// rounded positions and the body gets no grid. Throws std::invalid_argument for values out of range and
/// std::domain_error if a body without a grid would need volumes of cells or be cuttable.
SINEW_API LatticeCorners addLattice(Scene& scene, const Lattice& lattice);

/// Appends a skin of the boundary faces of a lattice (for bodies without a mesh of their own), creased at its
/// edges.
SINEW_API void addLatticeSkin(Scene& scene, const Lattice& lattice, const LatticeCorners& corners,
                              Vec3 color);

/// Whether `skin` of the scene is clipped along cuts of the body of `grid`, and closed with the cut surface;
/// if not, it stretches over cuts. Both are indices.
SINEW_API bool showsInside(const Scene& scene, std::size_t skin, std::size_t grid);

/// Appends the outer faces of a voxel body, given by its grid, as triangles between its particles: solid
/// faces as thick as the radius of these particles. Objects smaller than the voxels then stay outside, and
/// the body touches itself. When a blade breaks cells, the outer faces of the remaining cells become the
/// surface in the same step.
SINEW_API void addSurfaceFaces(Scene& scene, const Grid& grid);

/// Grids of the scene that need addSurfaceFaces: voxel bodies with gaps between particles through which a
/// moving object in contact with them could pass if their surface were stretched by a fifth.
SINEW_API std::vector<std::uint32_t> gridsWithHoles(const Scene& scene);

/// Particles without links that touch each other: in rows, or at random positions in a cuboid. Their radius
/// also keeps them from colliders.
struct SINEW_API LooseParticles {
    std::string name = "particles";
    Vec3 center{};                                  ///< of the rows or the cuboid [m]
    std::array<std::uint32_t, 3> count{10, 10, 10}; ///< along x, y and z
    float spacing = 0;                              ///< of rows [m]; 0 = the smallest possible
    float jitter = 0;         ///< largest displacement of a particle along each axis [m]
    std::uint32_t random = 0; ///< > 0: this many in a cuboid at random, without overlap, in place of rows
    Vec3 size{};              ///< of the cuboid that contains the spheres [m]
    std::uint32_t seed = 1;   ///< of jitter and random positions: equal particles on every machine
    float radius = 0.05f;     ///< [m], above 0
    float mass = 1;           ///< of each [kg]
    Vec3 velocity{};          ///< [m/s]
    Vec3 color{0.62f, 0.62f, 0.60f};
};

/// Appends particles and a body, but no skin. Returns the index of the first particle. Throws
/// std::invalid_argument for values out of range, including rows so close that neighbours could overlap, and
/// std::domain_error if no positions are found: random ones fill at most about a third of a cuboid.
SINEW_API std::uint32_t addParticles(Scene& scene, const LooseParticles& particles);

} // namespace sinew::sim
