// Tests of cloth, chain and lattice bodies: mass, topology and the elastic constants of the per-cell assembly
// (cases 11 and 23).
#include "sim/reference/implicit_step.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"

#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace sinew;
using namespace sinew::sim;

namespace {

/// Energy density [Pa] of a small homogeneous strain in a body of the given volume [m^3].
double energyDensity(const Scene& scene, double volume, const Eigen::Matrix3d& strain) {
    double energy = 0;
    for (const DistanceConstraint& link : scene.distances) {
        const Eigen::Vector3d edge = test::toVector(scene.particles[link.b].position) -
                                     test::toVector(scene.particles[link.a].position);
        const double stretch = edge.normalized().dot(strain * edge);
        energy += stretch * stretch / (2 * double{link.compliance});
    }
    return energy / volume;
}

Eigen::Matrix3d strainOf(double xx, double yy, double xy) {
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    strain(0, 0) = xx, strain(1, 1) = yy, strain(0, 1) = strain(1, 0) = xy;
    return strain;
}

/// Displacements of a bar along y by linearised statics. Rollers hold its lower end and two side planes, and
/// `force` [N] acts on the upper end as a uniform traction.
Eigen::VectorXd solveBar(const Scene& scene, double top, double force) {
    const auto size = static_cast<Eigen::Index>(3 * scene.particles.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (const DistanceConstraint& link : scene.distances) {
        const Eigen::Vector3d n = (test::toVector(scene.particles[link.b].position) -
                                   test::toVector(scene.particles[link.a].position))
                                      .normalized();
        const Eigen::Matrix3d block = n * n.transpose() / double{link.compliance};
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                for (const std::uint32_t p : {link.a, link.b})
                    for (const std::uint32_t q : {link.a, link.b})
                        entries.emplace_back(3 * p + row, 3 * q + column,
                                             (p == q ? 1 : -1) * block(row, column));
    }
    Eigen::VectorXd load = Eigen::VectorXd::Zero(size);
    double topMass = 0;
    for (const Particle& particle : scene.particles)
        topMass += double{particle.position.y} > top - 1e-4 ? 1 / double{particle.inverseMass} : 0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const Eigen::Vector3d x = test::toVector(scene.particles[i].position);
        for (int axis = 0; axis < 3; ++axis)
            if (x(axis) < 1e-6) // the roller is a very stiff spring to the wall
                entries.emplace_back(3 * i + axis, 3 * i + axis, 1e12);
        if (x.y() > top - 1e-4) // corner masses have the shares of the areas around the corners
            load(static_cast<Eigen::Index>(3 * i + 1)) =
                force / double{scene.particles[i].inverseMass} / topMass;
    }
    Eigen::SparseMatrix<double> stiffness(size, size);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness).solve(load);
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Names vertices by their particles' positions, so that creased and two-sided skins count as one surface.
std::map<Edge, int> directedEdges(const Skin& skin) {
    std::map<Edge, int> edges;
    for (const auto& triangle : skin.triangles)
        for (std::size_t corner = 0; corner < 3; ++corner)
            ++edges[{skin.particles[triangle[corner]], skin.particles[triangle[(corner + 1) % 3]]}];
    return edges;
}

double enclosedVolume(const Scene& scene, const Skin& skin) {
    double volume = 0;
    for (const auto& [a, b, c] : skin.triangles)
        volume += test::toVector(scene.particles[skin.particles[a]].position)
                      .dot(test::toVector(scene.particles[skin.particles[b]].position)
                               .cross(test::toVector(scene.particles[skin.particles[c]].position))) /
                  6;
    return volume;
}

Lattice block(std::array<std::uint32_t, 3> cells) {
    return {.cells = cells, .spacing = 0.1f};
}

} // namespace

TEST(Cloth, WeighsItsAreaTimesItsDensity) {
    Scene scene;
    addCloth(scene, {.size = {5, 9}, .spacing = 0.25f, .areaDensity = 0.3f});
    EXPECT_NEAR(test::massOf(scene), 0.3 * (4 * 0.25) * (8 * 0.25), 1e-6);
}

TEST(Cloth, LinksEveryNeighbourAndBothDiagonalsOfACellOnce) {
    Scene scene;
    addCloth(scene, {.size = {4, 3}, .spacing = 0.5f, .stretchCompliance = 1e-4f, .shearCompliance = 2e-3f});
    EXPECT_EQ(scene.distances.size(), 3 * 3 + 4 * 2 + 2 * 3 * 2u);
    std::set<Edge> seen;
    for (const DistanceConstraint& link : scene.distances) {
        EXPECT_TRUE(seen.insert(std::minmax(link.a, link.b)).second);
        const double length = (test::toVector(scene.particles[link.a].position) -
                               test::toVector(scene.particles[link.b].position))
                                  .norm();
        EXPECT_NEAR(double{link.restLength}, length, 1e-6);
        EXPECT_EQ(link.compliance, length < 0.6 ? 1e-4f : 2e-3f);
    }
}

TEST(Cloth, LinksTheNextButOneWhereItResistsFolding) {
    Scene plain, stiff;
    addCloth(plain, {.size = {5, 4}, .spacing = 0.5f});
    addCloth(stiff, {.size = {5, 4}, .spacing = 0.5f, .skipStiffness = 10});
    ASSERT_EQ(stiff.distances.size(), plain.distances.size() + 3 * 4 + 5 * 2);
    for (std::size_t i = plain.distances.size(); i < stiff.distances.size(); ++i) {
        const DistanceConstraint& link = stiff.distances[i];
        const Eigen::Vector3d between = test::toVector(stiff.particles[link.b].position) -
                                        test::toVector(stiff.particles[link.a].position);
        EXPECT_NEAR(between.norm(), 1, 1e-6);
        EXPECT_NEAR(between.lpNorm<1>(), 1, 1e-6) << "along a row or a column";
        EXPECT_EQ(link.restLength, 1);
        EXPECT_FLOAT_EQ(link.compliance, 0.1f);
    }
}

// A strip of 8 x 40 cells hangs from its first row; its middle is far from both ends. The edges on its rims
// carry as much as those inside, which makes it stiffer by 3 / (4 x 8).
TEST(Cloth, HasTheMembraneStiffnessAskedForAndPoissonRatioAThird) {
    constexpr std::uint32_t cells = 8, rows = 40, columns = cells + 1;
    constexpr double spacing = 0.1, stiffness = 1000, load = 0.8; // [m], [N/m], [N]
    ClothSheet strip{.down = {0, -1, 0}, .size = {columns, rows + 1}, .spacing = 0.1f, .areaDensity = 1e-5f};
    strip.membraneStiffness = 1000;
    for (std::uint32_t i = 0; i < columns; ++i) strip.pinned.push_back(i);
    Scene scene;
    addCloth(scene, strip);
    double parts = 0; // a corner of the last row has half a cell
    for (std::uint32_t i = 0; i < columns; ++i) parts += i == 0 || i == cells ? 0.5 : 1;
    for (std::uint32_t i = 0; i < columns; ++i) {
        const double part = (i == 0 || i == cells ? 0.5 : 1) / parts;
        scene.particles[columns * rows + i].inverseMass = static_cast<float>(9.81 / (load * part));
    }
    const std::vector<Eigen::Vector3d> x = reference::staticEquilibrium(scene).x;
    const auto height = [&](std::uint32_t row) { return x[columns * row + cells / 2].y(); };
    const double strain = (height(12) - height(28)) / (16 * spacing) - 1;
    const double width = (x[columns * 20 + cells] - x[columns * 20]).norm() / (cells * spacing) - 1;
    const double expected = load / (cells * spacing * stiffness) / (1 + 3.0 / (4 * cells));
    EXPECT_NEAR(strain / expected, 1, 0.01);
    EXPECT_NEAR(-width / strain, 1.0 / 3, 0.005);
}

TEST(Cloth, LiesInThePlaneOfItsDirectionsAndPinsWhatIsAsked) {
    Scene scene;
    scene.particles.resize(7);
    const std::uint32_t first = addCloth(scene, {.origin = {1, 2, 3},
                                                 .right = {0, 0, 1},
                                                 .down = {0, -1, 0},
                                                 .size = {3, 4},
                                                 .spacing = 0.5f,
                                                 .pinned = {0, 2}});
    EXPECT_EQ(first, 7u);
    EXPECT_NEAR(scene.particles[7 + 5].position.y, 1.5f, 1e-6f);
    EXPECT_NEAR(scene.particles[7 + 5].position.z, 4.0f, 1e-6f);
    ASSERT_EQ(scene.fixed.size(), 2u);
    EXPECT_EQ(scene.fixed[1].particle, 9u);
    EXPECT_EQ(scene.bodies.back().particleCount, 12u);
}

TEST(Cloth, HasASkinOnBothSides) {
    Scene scene;
    addCloth(scene, {.size = {4, 5}});
    for (const auto& [edge, count] : directedEdges(scene.skins.back())) {
        EXPECT_EQ(directedEdges(scene.skins.back()).at({edge.second, edge.first}), count);
    }
    std::map<std::uint32_t, std::set<bool>> sides; // signs of the normals around each vertex
    const Skin& skin = scene.skins.back();
    for (const auto& triangle : skin.triangles) {
        const auto x = [&](int corner) {
            return test::toVector(scene.particles[skin.particles[triangle[corner]]].position);
        };
        for (const std::uint32_t vertex : triangle)
            sides[vertex].insert((x(1) - x(0)).cross(x(2) - x(0)).y() > 0);
    }
    for (const auto& [vertex, signs] : sides)
        EXPECT_EQ(signs.size(), 1u) << "vertex " << vertex << " belongs to both sides";
}

TEST(Cloth, RefusesWhatIsNoSheet) {
    Scene scene;
    EXPECT_THROW(addCloth(scene, {.size = {1, 5}}), std::invalid_argument);
    EXPECT_THROW(addCloth(scene, {.spacing = 0}), std::invalid_argument);
    EXPECT_THROW(addCloth(scene, {.size = {2, 2}, .pinned = {4}}), std::invalid_argument);
    EXPECT_THROW(addCloth(scene, {.size = {2, 2}, .skipStiffness = -1}), std::invalid_argument);
    EXPECT_TRUE(scene.particles.empty());
}

TEST(Chain, LinksEachMassToTheNextInALine) {
    Scene scene;
    scene.particles.resize(3);
    EXPECT_EQ(addChain(scene, {.origin = {1, 2, 3},
                               .direction = {0, 0, 1},
                               .particles = 5,
                               .length = 2,
                               .compliance = 1e-5f,
                               .pinned = {0, 4}}),
              3u);
    ASSERT_EQ(scene.particles.size(), 8u);
    EXPECT_EQ(scene.particles[3].position.z, 3);
    EXPECT_EQ(scene.particles[7].position.z, 5);
    EXPECT_EQ(scene.particles[7].position.y, 2);
    ASSERT_EQ(scene.distances.size(), 4u);
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(scene.distances[i].a, 3 + i);
        EXPECT_EQ(scene.distances[i].b, 4 + i);
        EXPECT_EQ(scene.distances[i].restLength, 0.5f);
        EXPECT_EQ(scene.distances[i].compliance, 1e-5f);
    }
    ASSERT_EQ(scene.fixed.size(), 2u);
    EXPECT_EQ(scene.fixed[1].particle, 7u);
    EXPECT_EQ(scene.bodies.at(0).particleCount, 5u);
}

TEST(Chain, GivesItsLastMassAWeightOfItsOwn) {
    Scene even, loaded;
    addChain(even, {.particles = 10, .mass = 0.1f});
    addChain(loaded, {.particles = 10, .mass = 0.1f, .endMass = 10});
    EXPECT_NEAR(test::massOf(even), 0.1, 1e-7);
    EXPECT_NEAR(test::massOf(loaded), 0.09 + 10, 1e-5);
    EXPECT_FLOAT_EQ(loaded.particles[9].inverseMass, 0.1f);
}

TEST(Chain, RefusesWhatIsNoChain) {
    Scene scene;
    EXPECT_THROW(addChain(scene, {.particles = 1}), std::invalid_argument);
    EXPECT_THROW(addChain(scene, {.length = 0}), std::invalid_argument);
    EXPECT_THROW(addChain(scene, {.mass = 0}), std::invalid_argument);
    EXPECT_THROW(addChain(scene, {.endMass = -1}), std::invalid_argument);
    EXPECT_THROW(addChain(scene, {.compliance = -1}), std::invalid_argument);
    EXPECT_THROW(addChain(scene, {.particles = 3, .pinned = {3}}), std::invalid_argument);
    EXPECT_TRUE(scene.particles.empty());
}

TEST(Lattice, WeighsItsFillTimesItsDensity) {
    Scene scene;
    Lattice lattice = block({3, 2, 2});
    lattice.fill.assign(12, 0.5f);
    lattice.fill[0] = 0;
    lattice.fill[3] = 0.01f; // its corners have a share of 1/8, without more mass of the body
    addLattice(scene, lattice);
    EXPECT_NEAR(test::massOf(scene), 1000 * 1e-3 * (10 * 0.5 + 0.01), 1e-5);
    EXPECT_NEAR(double{scene.bodies[0].restVolume}, 1e-3 * (10 * 0.5 + 0.01), 1e-8);
}

TEST(Lattice, GivesAParticleToTheCornersOfFilledCellsOnly) {
    Scene scene;
    Lattice lattice = block({3, 1, 1});
    lattice.fill = {1, 0, 0};
    const LatticeCorners corners = addLattice(scene, lattice);
    EXPECT_EQ(scene.particles.size(), 8u);
    EXPECT_EQ(corners.at(0, 0, 0), 0u);
    EXPECT_EQ(corners.at(1, 1, 1), 7u);
    EXPECT_EQ(corners.at(2, 0, 0), LatticeCorners::noParticle);
    EXPECT_EQ(scene.distances.size(), 12u + 12u);
}

TEST(Lattice, GivesEachCellAQuarterOfAnEdgeAndHalfOfADiagonal) {
    const double k = 0.4 * 1e5 * 0.1;
    Scene one;
    addLattice(one, block({1, 1, 1}));
    for (const DistanceConstraint& link : one.distances)
        EXPECT_NEAR(1 / double{link.compliance}, link.restLength < 0.12f ? k / 4 : k / 2, 1e-3);

    Scene eight;
    const LatticeCorners corners = addLattice(eight, block({2, 2, 2}));
    const auto stiffness = [&](std::uint32_t a, std::uint32_t b) {
        for (const DistanceConstraint& link : eight.distances)
            if (std::minmax(link.a, link.b) == std::minmax(a, b)) return 1 / double{link.compliance};
        return 0.0;
    };
    EXPECT_NEAR(stiffness(corners.at(1, 1, 0), corners.at(1, 1, 1)), k, 1e-3);     // inside: 4 cells
    EXPECT_NEAR(stiffness(corners.at(1, 0, 0), corners.at(1, 0, 1)), k / 2, 1e-3); // in a face: 2 cells
    EXPECT_NEAR(stiffness(corners.at(1, 0, 0), corners.at(1, 1, 1)), k, 1e-3);     // between two cells
    EXPECT_NEAR(stiffness(corners.at(0, 0, 0), corners.at(0, 1, 1)), k / 2, 1e-3); // on the outside
    EXPECT_EQ(stiffness(corners.at(0, 0, 0), corners.at(1, 1, 1)), 0);             // no body diagonals
}

TEST(Lattice, LinksEachPairOnceInGridOrder) {
    Scene scene;
    Lattice lattice = block({4, 3, 5});
    lattice.fill.assign(60, 1);
    for (const std::size_t hole : {0, 7, 22, 23, 41}) lattice.fill[hole] = 0;
    addLattice(scene, lattice);
    std::set<Edge> seen;
    std::uint32_t last = 0;
    for (const DistanceConstraint& link : scene.distances) {
        EXPECT_LT(link.a, link.b);
        EXPECT_LE(last, link.a);
        last = link.a;
        EXPECT_TRUE(seen.insert({link.a, link.b}).second);
        const double length = (test::toVector(scene.particles[link.a].position) -
                               test::toVector(scene.particles[link.b].position))
                                  .norm();
        EXPECT_NEAR(double{link.restLength}, length, 1e-7);
        EXPECT_TRUE(std::abs(length - 0.1) < 1e-6 || std::abs(length - 0.1 * std::sqrt(2.0)) < 1e-6);
    }
}

TEST(Lattice, IsIsotropicWithPoissonRatioOneQuarter) {
    Scene scene;
    addLattice(scene, block({3, 4, 2}));
    const double volume = 24e-3, strain = 1e-3, unit = strain * strain;
    const double c11 = 2 * energyDensity(scene, volume, strainOf(strain, 0, 0)) / unit;
    const double c12 = energyDensity(scene, volume, strainOf(strain, strain, 0)) / unit - c11;
    const double c44 = energyDensity(scene, volume, strainOf(0, 0, strain)) / (2 * unit);
    EXPECT_NEAR(2 * c44 / (c11 - c12), 1, 0.02);
    EXPECT_NEAR(c12 / (c11 + c12), 0.25, 0.01);
    EXPECT_NEAR((c11 - c12) * (c11 + 2 * c12) / (c11 + c12), 1e5, 1e3); // Young's modulus
}

TEST(Lattice, StretchesUnderLoadByItsYoungsModulus) {
    for (const std::array<std::uint32_t, 3> cells : {std::array{1u, 6u, 1u}, std::array{3u, 8u, 2u}}) {
        Scene scene;
        const LatticeCorners corners = addLattice(scene, block(cells));
        const double area = cells[0] * cells[2] * 0.01, length = cells[1] * 0.1, width = cells[0] * 0.1;
        const double stress = 100;
        const Eigen::VectorXd moved = solveBar(scene, length, stress * area);
        const std::uint32_t top = corners.at(cells[0], cells[1], 0);
        const double strain = moved(3 * top + 1) / length;
        EXPECT_NEAR(stress / strain, 1e5, 1e3) << cells[0] << " cells wide";
        EXPECT_NEAR(-moved(3 * top) / width / strain, 0.25, 0.01) << cells[0] << " cells wide";
    }
}

TEST(Lattice, StartsAsGoodAsWithoutStressFarFromTheOrigin) {
    Scene scene;
    Lattice lattice = block({2, 2, 2});
    lattice.origin = {3000.3f, 0.1f, -700.7f};
    addLattice(scene, lattice);
    for (const DistanceConstraint& link : scene.distances) {
        const double length = (test::toVector(scene.particles[link.a].position) -
                               test::toVector(scene.particles[link.b].position))
                                  .norm();
        EXPECT_NEAR(double{link.restLength} / length, 1, 1e-4);
    }
}

TEST(Lattice, RefusesWhatIsNoBody) {
    Scene scene;
    Lattice wrong = block({2, 2, 2});
    wrong.fill = {1, 1};
    EXPECT_THROW(addLattice(scene, wrong), std::invalid_argument);
    wrong.fill.assign(8, 0);
    EXPECT_THROW(addLattice(scene, wrong), std::invalid_argument);
    wrong.fill[3] = std::nanf("");
    EXPECT_THROW(addLattice(scene, wrong), std::invalid_argument);
    wrong.fill[3] = 1.5f;
    EXPECT_THROW(addLattice(scene, wrong), std::invalid_argument);
    wrong = block({0, 2, 2});
    EXPECT_THROW(addLattice(scene, wrong), std::invalid_argument);
    wrong = block({100'000, 100'000, 100'000});
    EXPECT_THROW(addLattice(scene, wrong), std::length_error);
    EXPECT_TRUE(scene.particles.empty());
}

TEST(LatticeSkin, EnclosesTheFilledCells) {
    Scene scene;
    Lattice lattice = block({3, 3, 3});
    lattice.fill.assign(27, 1);
    lattice.fill[13] = 0; // an inner cavity
    lattice.fill[26] = 0; // a missing corner
    const LatticeCorners corners = addLattice(scene, lattice);
    addLatticeSkin(scene, lattice, corners, {1, 0, 0});
    const Skin& skin = scene.skins.at(0);
    EXPECT_NEAR(enclosedVolume(scene, skin), 25e-3, 1e-7);
    const auto edges = directedEdges(skin);
    for (const auto& [edge, count] : edges)
        EXPECT_EQ(edges.at({edge.second, edge.first}), count) << "the skin is open";
}

TEST(LatticeSkin, IsCreasedAtItsEdges) {
    Scene scene;
    const Lattice lattice = block({2, 2, 2});
    addLatticeSkin(scene, lattice, addLattice(scene, lattice), {1, 0, 0});
    const Skin& skin = scene.skins.at(0);
    EXPECT_EQ(skin.vertexCount(), 6u * 9u);
    std::map<std::uint32_t, Eigen::Vector3d> normals;
    for (const auto& triangle : skin.triangles) {
        const auto x = [&](int corner) {
            return test::toVector(scene.particles[skin.particles[triangle[corner]]].position);
        };
        const Eigen::Vector3d normal = (x(1) - x(0)).cross(x(2) - x(0)).normalized();
        for (const std::uint32_t vertex : triangle)
            EXPECT_NEAR(normals.try_emplace(vertex, normal).first->second.dot(normal), 1, 1e-6);
    }
}

TEST(LooseParticles, AreRefusedWhereTheyCannotBePlaced) {
    Scene scene;
    EXPECT_THROW(addParticles(scene, {.radius = 0}), std::invalid_argument);
    EXPECT_THROW(addParticles(scene, {.mass = 0}), std::invalid_argument);
    EXPECT_THROW(addParticles(scene, {.count = {0, 1, 1}}), std::invalid_argument);
    EXPECT_THROW(addParticles(scene, {.spacing = 0.09f, .radius = 0.05f}), std::invalid_argument);
    EXPECT_THROW(addParticles(scene, {.spacing = 0.1f, .jitter = 0.01f, .radius = 0.05f}),
                 std::invalid_argument);
    EXPECT_THROW(addParticles(scene, {.jitter = -1}), std::invalid_argument);
    EXPECT_THROW(addParticles(scene, {.random = 100, .size = {0.2f, 0.2f, 0.2f}, .radius = 0.05f}),
                 std::domain_error);
}

TEST(Bodies, HaveARadiusOfAtMostHalfOfTheirSpacing) {
    Scene scene;
    addLattice(scene, {.cells = {1, 1, 1}, .spacing = 0.1f, .radius = 0.05f});
    addCloth(scene, {.size = {2, 2}, .spacing = 0.1f, .radius = 0.02f});
    EXPECT_EQ(scene.particles.front().radius, 0.05f);
    EXPECT_EQ(scene.particles.back().radius, 0.02f);
    for (const float radius : {0.051f, -0.01f, NAN}) {
        EXPECT_THROW(addLattice(scene, {.cells = {1, 1, 1}, .spacing = 0.1f, .radius = radius}),
                     std::invalid_argument);
        EXPECT_THROW(addCloth(scene, {.size = {2, 2}, .spacing = 0.1f, .radius = radius}),
                     std::invalid_argument);
    }
}
