// Tests of the faces of voxel bodies that a cut or a tear opens: which faces exist, and that they do not
// change uncut bodies.
#include "common/layout.h"
#include "sim/compile/compile.hpp"
#include "sim/cutting/cut_body.hpp"
#include "sim/cutting/cut_gaps.hpp"
#include "sim/cutting/faced_bodies.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "sinew/holds.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <set>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::CutBody;
using test::particlesWhere;
using test::poseAt;
using test::surfaceOf;
using test::sweepOf;
using test::Triangle;

namespace {

constexpr float spacing = test::facedSpacing;
constexpr double voxel = double{spacing};

Lattice latticeOf(std::array<std::uint32_t, 3> cells, float youngModulus) {
    return test::facedLattice(cells, youngModulus, true);
}

template <typename T> std::vector<T> contentsOf(CutBody& body, const std::string& label) {
    const StepProgram& program = body.runner().simulation().program();
    const auto found =
        std::ranges::find_if(program.buffers, [&](const auto& buffer) { return buffer.label == label; });
    const BufferId id{static_cast<std::uint32_t>(found - program.buffers.begin())};
    return test::queue().download<T>(body.runner().simulation().view(id));
}

// Rotates the corners of a triangle so that the lowest comes first.
Triangle fromLowest(Triangle t) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    return t;
}

// Faces on the device that search for points, as particles in their front-facing order.
std::set<Triangle> facesOnDevice(CutBody& body, const Settings& settings) {
    const auto slots = stateLayout(body.scene(), settings).slot;
    std::map<std::uint32_t, std::uint32_t> particles;
    for (std::uint32_t i = 0; i < slots.size(); ++i) particles[slots[i]] = i;
    const auto faces = contentsOf<layout::ContactFace>(body, "faces");
    std::set<Triangle> result;
    for (const std::uint32_t f : contentsOf<std::uint32_t>(body, "faces.searched")) {
        if (f == ~0u) continue;
        const auto& [a, b, c, thickness] = faces[f];
        Triangle t{particles[a], particles[b], particles[c]};
        if (thickness < 0) std::swap(t[1], t[2]);
        result.insert(fromLowest(t));
    }
    return result;
}

// A square as twice its middle and its normal, because it may be split along either diagonal.
using Square = std::array<long, 6>;

std::set<Square> squaresOf(const CutBody& body, const auto& triangles) {
    std::map<Square, int> halves;
    for (const Triangle& t : triangles) {
        const Vector3d a = body.at(t[0]) / voxel, b = body.at(t[1]) / voxel, c = body.at(t[2]) / voxel;
        const Vector3d n = (b - a).cross(c - a),
                       middle = a.cwiseMin(b).cwiseMin(c) + a.cwiseMax(b).cwiseMax(c);
        Square square;
        for (int axis = 0; axis < 3; ++axis) {
            square[axis] = std::lround(middle[axis]);
            square[axis + 3] = std::lround(n[axis]);
        }
        ++halves[square];
    }
    std::set<Square> squares;
    for (const auto& [square, count] : halves) {
        EXPECT_EQ(count, 2);
        squares.insert(square);
    }
    return squares;
}

// Expects the device to search exactly the faces of intact cells.
void expectFaces(CutBody& body, const Settings& settings, const char* what) {
    const auto onDevice = squaresOf(body, facesOnDevice(body, settings)),
               expected = squaresOf(body, surfaceOf(body));
    std::printf("%s: %zu squares\n", what, expected.size());
    EXPECT_TRUE(onDevice == expected) << what;
}

// A block on a plane. After an oblique cut, its upper half slides down. Nothing in the scene depends on time.
Scene slidingHalves() {
    Scene scene{.name = "halves", .damping = 1};
    addLattice(scene, latticeOf({5, 5, 5}, 1e5f));
    addSurfaceFaces(scene, scene.grids[0]);
    scene.planes = {{.normal = {0, 1, 0}, .offset = -spacing / 2, .friction = 0.5f}};
    return scene;
}

const test::CutPlane aslant{Vector3d(0.12, 2.4 * voxel, 0.12), Vector3d(0.3, 1, 0.2).normalized()};
const test::CutPlane across{Vector3d(0.12, 0.12, 2.4 * voxel), Vector3d::UnitZ()};

} // namespace

// Compares with the surface of all intact cells, after flat, oblique and partial cuts of a body with a
// cavity. An undo restores the first surface.
TEST(CutFaces, HasTheFacesOfTheCellsThatAreWhole) {
    Lattice lattice = latticeOf({6, 5, 7}, 1e5f);
    lattice.fill = test::raggedFill(6 * 5 * 7);
    Scene scene{.name = "ragged"};
    scene.gravity = {};
    addLattice(scene, lattice);
    addSurfaceFaces(scene, scene.grids[0]);
    const Settings settings{.substeps = 4, .contactRoom = 64};
    CutBody body(scene, settings);
    const vk::Buffer uncut = body.runner().saveTopology();
    expectFaces(body, settings, "uncut");
    const double reaches[] = {1, 1, 0.06};
    const test::CutPlane planes[] = {{{0.15, 3.45 * voxel, 0.15}, Vector3d::UnitY()},
                                     {{0.14, 0.12, 0.17}, Vector3d(1, 0.6, -0.8).normalized()},
                                     {{0.2, 0.06, 0.3}, Vector3d(0.1, 0.2, 1).normalized()}};
    for (int n = 0; n < 3; ++n) {
        const std::size_t before = surfaceOf(body).size();
        body.cut(sweepOf(planes[n], reaches[n]));
        EXPECT_NE(surfaceOf(body).size(), before);
        expectFaces(body, settings, "cut");
    }
    body.runner().loadTopology(uncut);
    body.runner().run(1);
    expectFaces(body, settings, "undone");
}

// State hashes after a cut, after loading a state, after an undone cut and after a second cut, and the same
// again after a reset.
TEST(CutFaces, EndInTheSameBitsForAnyOrderAndMarginAndAfterAReset) {
    const Scene scene = slidingHalves();
    const Settings settings[] = {{.substeps = 12, .contactRoom = 64},
                                 {.substeps = 12, .contactRoom = 64, .isReversed = true},
                                 {.substeps = 12, .contactMargin = 0.8f, .contactRoom = 64},
                                 {.substeps = 12, .contactRoom = 64, .forms = {.usesTexels = false}}};
    std::vector<std::vector<std::uint64_t>> hashes;
    const auto play = [&](CutBody& body) {
        std::vector<std::uint64_t>& all = hashes.emplace_back();
        const auto run = [&](int steps) {
            const Status status = body.runner().run(steps);
            EXPECT_EQ(status.nonFinite, 0u);
            EXPECT_EQ(status.contactRoom, 0u);
            all.push_back(body.runner().stateHash());
        };
        run(2);
        const vk::Buffer uncut = body.runner().saveTopology();
        EXPECT_EQ(body.cut(sweepOf(aslant, 1)).pieces, 2u);
        run(12);
        const auto saved = body.runner().save();
        run(12);
        body.runner().load(saved);
        run(12);
        EXPECT_EQ(all[3], all[2]) << "a state that was loaded";
        body.runner().loadTopology(uncut);
        run(6);
        EXPECT_NE(body.cut(sweepOf(across, 1)).linksCut, 0u);
        run(12);
    };
    for (const Settings& each : settings) {
        CutBody body(scene, each);
        play(body);
        if (hashes.size() > 1) continue;
        body.runner().reset();
        play(body);
    }
    for (const auto& each : hashes) EXPECT_EQ(each, hashes[0]);
}

TEST(CutFaces, EndInTheSameBitsAfterACutThatWasUndone) {
    const Settings settings{.substeps = 12, .contactRoom = 64};
    CutBody body(slidingHalves(), settings), other(slidingHalves(), settings);
    for (CutBody* each : {&body, &other}) {
        each->runner().run(2);
        each->cut(sweepOf(aslant, 1));
        each->runner().run(4);
    }
    body.runner().writePosition(60, std::numeric_limits<float>::quiet_NaN());
    EXPECT_GT(body.cut(sweepOf(across, 1)).nonFinite, 0u);
    EXPECT_EQ(facesOnDevice(body, settings), facesOnDevice(other, settings));
    EXPECT_EQ(body.runner().stateHash(), other.runner().stateHash()) << "undone";
    for (CutBody* each : {&body, &other}) {
        each->runner().run(6);
        EXPECT_EQ(each->cut(sweepOf(across, 1)).nonFinite, 0u);
        each->runner().run(10);
    }
    EXPECT_EQ(facesOnDevice(body, settings), facesOnDevice(other, settings));
    EXPECT_EQ(body.runner().stateHash(), other.runner().stateHash());
}

// Balls lie just above the faces of a block, and others hit them at different times. The impact on a face
// between two steps must give the same bits with and without a blade that moves through air.
TEST(CutFaces, AreNoSofterForABladeThatMeetsNothing) {
    std::vector<Vector3d> x[2];
    for (const bool hasBlade : {false, true}) {
        Scene scene{.name = "block"};
        scene.gravity = {};
        addLattice(scene, latticeOf({8, 2, 8}, 1e6f));
        addSurfaceFaces(scene, scene.grids[0]);
        const float radius = 0.25f * spacing, height = 2.5f * spacing + radius + 1e-4f;
        for (int n = 0; n < 16; ++n) {
            const Vec3 place{(0.7f + 2 * static_cast<float>(n % 4)) * spacing, height,
                             (0.6f + 2 * static_cast<float>(n / 4)) * spacing};
            const float above = 2 * radius + 5e-4f * static_cast<float>(n + 1);
            scene.particles.push_back({.position = place, .inverseMass = 1e2f, .radius = radius});
            scene.particles.push_back({.position = {place.x, height + above, place.z},
                                       .velocity = {0, -0.5f, 0},
                                       .inverseMass = 1e2f,
                                       .radius = radius});
        }
        test::Runner runner(scene, {.substeps = 4, .contactRoom = 64});
        const test::Sweep air = sweepOf({Vector3d(3, 3, 3), Vector3d::UnitY()}, 0.1);
        for (int step = 0; step < 3; ++step) {
            const Status status = hasBlade ? runner.cut(air.blade()) : runner.run(1);
            ASSERT_EQ(status.nonFinite, 0u);
            ASSERT_EQ(status.linksCutInAll, 0u);
        }
        x[hasBlade ? 1 : 0] = runner.positions();
    }
    double most = 0;
    for (std::size_t i = 0; i < x[0].size(); ++i) most = std::max(most, (x[1][i] - x[0][i]).norm());
    std::printf("%.1e m elsewhere for a blade in air\n", most);
    EXPECT_EQ(most, 0);
}

// Overlaps at load part at the scene's speed, also beside a cuttable body.
TEST(CutFaces, LeaveTheSpeedAtWhichOthersRecover) {
    Scene scene{.name = "balls"};
    scene.gravity = {};
    constexpr float radius = 0.03f;
    for (const Vec3& corner : {Vec3{-1, 0, -1}, Vec3{0, 0, 1}, Vec3{1, 0, -1}})
        scene.particles.push_back({.position = corner, .inverseMass = 0});
    scene.faces = {{.particles = {0, 1, 2}, .thickness = 0.01f}};
    for (const Vec3& place : {Vec3{0.01f, 0.02f, 0.013f}, Vec3{2, 0, 0}, Vec3{2, 0.04f, 0}})
        scene.particles.push_back({.position = place, .inverseMass = 1, .radius = radius});
    const auto ball = static_cast<std::uint32_t>(scene.particles.size() - 3);
    Lattice block = latticeOf({3, 3, 3}, 1e5f);
    block.origin = {3, 0, 0};
    addLattice(scene, block);
    addSurfaceFaces(scene, scene.grids[0]);
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 64});
    double fromFace = 0, fromEachOther = 0;
    for (int step = 0; step < 8; ++step) {
        ASSERT_EQ(runner.run(1).nonFinite, 0u);
        const auto v = runner.velocities();
        fromFace = std::max(fromFace, v[ball].norm());
        fromEachOther = std::max(fromEachOther, (v[ball + 2] - v[ball + 1]).norm());
    }
    const double speed = double{scene.contacts.recoverySpeed};
    EXPECT_NEAR(fromFace, speed, 1e-2 * speed);
    EXPECT_NEAR(fromEachOther, speed, 1e-2 * speed);
}

// A face that the scene defines between cells of a body is not one of the cells' faces.
TEST(CutFaces, LeaveAFaceOfTheScenesOwnInsideOfABody) {
    Scene scene{.name = "cube"};
    scene.gravity = {};
    addLattice(scene, latticeOf({4, 4, 4}, 1e5f));
    addSurfaceFaces(scene, scene.grids[0]);
    const auto own = static_cast<std::uint32_t>(scene.faces.size());
    const auto node = [](std::uint32_t px, std::uint32_t py, std::uint32_t pz) {
        return px + 5 * (py + 5 * pz);
    };
    scene.faces.push_back({{node(2, 2, 2), node(3, 2, 2), node(3, 3, 2)}, spacing / 2, true});
    CutBody body(scene, {.substeps = 4, .contactRoom = 64});
    const auto isSearched = [&] {
        const auto searched = contentsOf<std::uint32_t>(body, "faces.searched");
        return std::ranges::find(searched, own) != searched.end();
    };
    EXPECT_TRUE(isSearched());
    EXPECT_EQ(body.cut(sweepOf({Vector3d(3, 3, 3), Vector3d::UnitY()}, 0.1)).linksCut, 0u);
    EXPECT_TRUE(isSearched()) << "a blade that cuts nothing";
    EXPECT_GT(body.cut(sweepOf({Vector3d(0.1, 0.6 * voxel, 0.1), Vector3d::UnitY()}, 1)).linksCut, 0u);
    EXPECT_TRUE(isSearched()) << "a blade that cuts elsewhere";
}

// A ball hits the lower side of a lifted half, whose faces have the thickness of its particles: zero.
TEST(CutFaces, OfNoThicknessKnowTheirFront) {
    Scene scene{.name = "open"};
    scene.gravity = {};
    Lattice lattice = latticeOf({6, 6, 6}, 1e5f);
    lattice.radius = 0;
    addLattice(scene, lattice);
    addSurfaceFaces(scene, scene.grids[0]);
    hold(scene, particlesWhere(scene, [](const Vec3& p) { return p.y < 3.45f * spacing; }));
    drive(scene, particlesWhere(scene, [](const Vec3& p) { return p.y > 3.45f * spacing; }),
          {{0, poseAt({})}, {0.05f, poseAt({})}, {0.15f, poseAt({0, 3 * spacing, 0})}});
    const auto ball = static_cast<std::uint32_t>(scene.particles.size());
    const float radius = 0.3f * spacing;
    scene.particles.push_back({.position = {-0.15f, 0.25f, 0.13f},
                               .velocity = {0.8f, 0.3f, 0},
                               .inverseMass = 1e2f,
                               .radius = radius});
    const Settings settings{.substeps = 8, .contactRoom = 64};
    CutBody body(scene, settings);
    ASSERT_EQ(body.cut(sweepOf({Vector3d(0.15, 3.45 * voxel, 0.15), Vector3d::UnitY()}, 1)).pieces, 2u);
    double highest = 0;
    for (int step = 0; step < 28; ++step) {
        ASSERT_EQ(body.runner().run(1).nonFinite, 0u);
        const Vector3d p = body.runner().positions()[ball];
        if (p.x() > 0 && p.x() < 0.3) highest = std::max(highest, p.y());
    }
    const double below = 7 * voxel - double{radius};
    std::printf("ball up to %.4f m, touches at %.4f m\n", highest, below);
    EXPECT_NEAR(highest, below, 1e-3);
}

// A tear opens faces, too. Only one layer of cells is stretched, because with equal cells rounding would
// select the tear.
TEST(CutFaces, AreThereOnTheEndsOfABarThatTears) {
    Scene scene{.name = "bar", .gravity = {0, 0, 0}, .damping = 2};
    Lattice lattice = latticeOf({3, 10, 3}, 2e4f);
    lattice.tearStrain = 0.3f;
    lattice.tearsPerStep = 8;
    addLattice(scene, lattice);
    addSurfaceFaces(scene, scene.grids[0]);
    std::vector<std::uint32_t> ends =
        particlesWhere(scene, [](const Vec3& p) { return p.y < 0.5f * spacing || p.y > 9.5f * spacing; });
    for (const std::uint32_t i : ends) scene.fixed.push_back({i});
    for (Particle& particle : scene.particles)
        if (particle.position.y > 4.5f * spacing) particle.position.y += 3.5f * spacing;
    const Settings settings{.substeps = 16, .contactRoom = 64};
    CutBody body(scene, settings);
    const std::size_t before = surfaceOf(body).size();
    Status status;
    for (int step = 0; step < 60; ++step) {
        status = body.runner().run(1);
        ASSERT_EQ(status.nonFinite, 0u);
        ASSERT_EQ(status.contactRoom, 0u);
    }
    EXPECT_GE(status.pieces, 2u);
    EXPECT_NE(surfaceOf(body).size(), before);
    expectFaces(body, settings, "torn");
}

// The faces of removed fragments are removed.
TEST(CutFaces, OfDebrisAreGone) {
    Scene scene{.name = "cube", .gravity = {0, 0, 0}};
    addLattice(scene, latticeOf({4, 4, 4}, 1e5f));
    addSurfaceFaces(scene, scene.grids[0]);
    scene.debris = 60;
    const Settings settings{.substeps = 4, .contactRoom = 64};
    CutBody body(scene, settings);
    const Status status = body.cut(sweepOf({Vector3d(0.1, 2.5 * voxel, 0.1), Vector3d::UnitY()}, 1));
    EXPECT_EQ(status.debris, 1u) << "50 of 125 particles";
    body.runner().run(1);
    const auto pieces = body.pieces();
    std::vector<Triangle> triangles;
    for (const Triangle& t : surfaceOf(body))
        if (pieces[t[0]] != REMOVED_PIECE) triangles.push_back(t);
    EXPECT_TRUE(squaresOf(body, facesOnDevice(body, settings)) == squaresOf(body, triangles));
    EXPECT_LT(triangles.size(), surfaceOf(body).size());
}

namespace {

// A block with faces on a plane, and one without faces on it, shifted by half a voxel. One blade cuts both.
Scene mixedBlocks() {
    Scene scene{.name = "blocks", .damping = 2};
    for (const bool isUpper : {false, true}) {
        Lattice lattice = latticeOf({8, 2, 4}, 1e5f);
        if (isUpper) lattice.origin = {spacing / 2, 3 * spacing, spacing / 2};
        addLattice(scene, lattice);
    }
    addSurfaceFaces(scene, scene.grids[0]);
    scene.planes = {{.normal = {0, 1, 0}, .offset = -spacing / 2, .friction = 0.8f}};
    scene.contacts.friction = 0.8f;
    return scene;
}

} // namespace

TEST(CutFaces, HoldABodyWithoutFaces) {
    const Scene scene = mixedBlocks();
    test::Runner runner(scene, {.substeps = 16, .contactRoom = 64});
    runner.run(2);
    const Status cut = runner.cut(sweepOf({Vector3d(4.4 * voxel, 0.1, 0.1), Vector3d::UnitX()}, 1).blade());
    EXPECT_EQ(cut.pieces, 4u);
    std::vector<Triangle> faces;
    for (const Face& face : scene.faces)
        if (std::ranges::none_of(face.particles, [&](std::uint32_t i) {
                const float place = scene.particles[i].position.x;
                return place > 3.5f * spacing && place < 5.5f * spacing; // cells that the blade has cut
            }))
            faces.push_back(face.particles);
    const std::uint32_t upper = scene.grids[1].firstParticle;
    double most = -9, end = -9;
    for (int step = 0; step < 60; ++step) {
        const Status status = runner.run(1);
        ASSERT_EQ(status.nonFinite, 0u);
        ASSERT_EQ(status.contactRoom, 0u);
        end = test::deepest(voxel, runner.positions(), faces,
                            [&](std::uint32_t i, const Triangle&) { return i >= upper; });
        most = std::max(most, end);
    }
    std::printf("block at most %.4f voxels nearer than touching, %.4f at the end\n", most, end);
    EXPECT_LT(most, 0.05);
    EXPECT_GT(end, -0.02) << "it lies on the faces";
}

namespace {

// The numbers with which a pass of the search for faces runs, the first with that label.
template <typename Push> Push searchOf(const char* label, bool isCuttable) {
    Scene scene{.name = "mixed"};
    addCloth(scene, {.size = {12, 12}, .spacing = 0.4f, .thickness = 0.01f});
    Lattice lattice = latticeOf({4, 4, 4}, 1e5f);
    lattice.isCuttable = isCuttable;
    addLattice(scene, lattice);
    addSurfaceFaces(scene, scene.grids.back());
    const StepProgram program = compile(scene, {.substeps = 4});
    const auto pass = std::ranges::find_if(program[List::step],
                                           [&](const Pass& each) { return each.label.starts_with(label); });
    EXPECT_NE(pass, program[List::step].end());
    Push push;
    EXPECT_EQ(pass->push.size(), sizeof(push));
    std::memcpy(&push, pass->push.data(), sizeof(push));
    return push;
}

} // namespace

// Faces that do not exist yet change no margin and no grid of others, and are not compared with every point.
TEST(CutFaces, ChangeNoSearchUntilTheyAreThere) {
    const auto grid = searchOf<layout::GridPush>("plan_grid", false),
               cuttableGrid = searchOf<layout::GridPush>("plan_grid", true);
    EXPECT_EQ(cuttableGrid.edge, grid.edge);
    EXPECT_EQ(cuttableGrid.quietEdge, grid.quietEdge);
    const auto whole = searchOf<layout::FaceFindPush>("find_faces", false),
               cuttable = searchOf<layout::FaceFindPush>("find_faces", true);
    EXPECT_EQ(cuttable.most, whole.most);
    EXPECT_EQ(cuttable.margin, whole.margin);
    EXPECT_EQ(cuttable.large, whole.large);
    EXPECT_GT(cuttable.moving, whole.moving);
}

// In a body two nodes wide, the next slot may be the next node along x or another one along z.
TEST(CutFaces, LeavesOutWhatIsStillLinkedInABodyOfOneLayerThatIsCut) {
    Scene scene{.name = "plate"};
    scene.gravity = {};
    addLattice(scene, latticeOf({1, 6, 6}, 1e5f));
    const Settings settings{.substeps = 4};
    CutBody body(scene, settings);
    const std::size_t uncut = body.links().size();
    ASSERT_EQ(body.cut(sweepOf({Vector3d(0.02, 3.45 * voxel, 0.15), Vector3d::UnitY()}, 1)).pieces, 2u);
    const std::vector<test::LiveLink> links = body.links();
    ASSERT_LT(links.size(), uncut);
    const auto slots = stateLayout(scene, settings).slot;
    const auto excluded = contentsOf<std::uint32_t>(body, "contacts.excluded");
    const auto has = [&](std::uint32_t a, std::uint32_t b) { // in the row of the first of the two
        const auto [of, partner] = std::minmax(slots[a], slots[b]);
        const auto first = excluded.begin() + excluded[of], end = excluded.begin() + excluded[of + 1];
        return std::find(first, end, partner) != end;
    };
    std::size_t missing = 0, dead = 0;
    for (const test::LiveLink& link : links) {
        const bool isStiff = (body.at(link.a) - body.at(link.b)).norm() < 1.5 * voxel; // is also a constraint
        missing += !isStiff || has(link.a, link.b) ? 0 : 1;
    }
    for (std::uint32_t z = 0; z < 7; ++z)
        dead += has(body.particleAt(0, 3, z), body.particleAt(0, 4, z)) ? 1 : 0;
    EXPECT_EQ(missing, 0u);
    EXPECT_EQ(dead, 0u) << "what the blade has parted may touch";
}
