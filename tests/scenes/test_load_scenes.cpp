// Tests of the conversion of a file's tables to a scene.
#include "scenes/load_fixture.hpp"

#include "sinew/validate.hpp"

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace sinew;
namespace fs = std::filesystem;
using test::smallCloth;

namespace {

class Load : public test::LoadFixture {};

} // namespace

TEST_F(Load, ReadsEveryShippedScene) {
    for (const auto& [name, particles] : std::map<std::string, std::size_t>{
             {"cloth_links", 4096}, {"cube", 4096}, {"organ", 2013}, {"cloth_links_on_sphere", 4096}}) {
        const scenes::LoadedScene loaded =
            scenes::load(fs::path(SINEW_SOURCE_FOLDER "/scenes") / (name + ".toml"));
        EXPECT_EQ(loaded.scene.name, name);
        EXPECT_TRUE(sim::validate(loaded.scene, loaded.settings).empty());
        EXPECT_TRUE(loaded.warnings.empty()) << name << ": " << loaded.warnings.front();
        EXPECT_TRUE(loaded.camera.has_value());
        EXPECT_EQ(loaded.scene.particles.size(), particles) << name;
    }
}

TEST_F(Load, ReadsTheScenesOfTheStudy) {
    struct Expected {
        const char* name;
        std::size_t particles, links, held;
    };
    for (const auto& [name, particles, links, held] :
         {Expected{"beam", 864, 6228, 36}, Expected{"beam_stiff", 864, 6228, 36},
          Expected{"cloth_study", 1089, 6206, 2}, Expected{"chain", 100, 99, 1},
          Expected{"cube_load", 1000, 2700 + 2 * 3 * 10 * 81, 100}}) {
        const scenes::LoadedScene file =
            scenes::load(fs::path(SINEW_SOURCE_FOLDER "/scenes") / (std::string(name) + ".toml"));
        EXPECT_EQ(file.scene.name, name);
        EXPECT_EQ(file.scene.particles.size(), particles) << name;
        EXPECT_EQ(file.scene.distances.size(), links) << name;
        EXPECT_EQ(file.scene.fixed.size(), held) << name;
        EXPECT_TRUE(file.warnings.empty()) << name << ": " << file.warnings.front();
        EXPECT_TRUE(file.scene.planes.empty());
        EXPECT_EQ(file.scene.damping, 0);
        EXPECT_EQ(scenes::loadBuiltIn(name).scene.distances.size(), links) << name;
    }
}

TEST_F(Load, FindsTheSameSceneInsideTheProgram) {
    const scenes::LoadedScene built = scenes::loadBuiltIn("cube");
    const scenes::LoadedScene file = scenes::load(SINEW_SOURCE_FOLDER "/scenes/cube.toml");
    EXPECT_EQ(built.scene.particles.size(), file.scene.particles.size());
    EXPECT_EQ(built.scene.name, file.scene.name);
    EXPECT_EQ(built.settings.substeps, file.settings.substeps);
}

TEST_F(Load, TakesClothByItsMembraneStiffnessOrByItsCompliances) {
    const sim::Scene scene = load(smallCloth + "membrane_stiffness = 300\n").scene;
    EXPECT_FLOAT_EQ(scene.grids[0].compliance[0], 4.0f / 900);
    EXPECT_FLOAT_EQ(scene.grids[0].compliance[1], 8.0f / 900);
    EXPECT_THROW(load(smallCloth + "membrane_stiffness = 300\nshear_compliance = 1e-3\n"),
                 scenes::SceneError);
}

TEST_F(Load, LetsBodiesSleepWhereTheSceneAsksForIt) {
    EXPECT_FALSE(load(smallCloth).settings.sleeps);
    EXPECT_TRUE(load("[solver]\nsleep = true\n" + smallCloth).settings.sleeps);
    EXPECT_THROW(load("[solver]\nsleep = true\nname = \"jacobi\"\n" + smallCloth), std::exception);
    EXPECT_THROW(load("[solver]\nsleep = 1\n" + smallCloth), scenes::SceneError);
}

TEST_F(Load, ClampsSharplyUnlessTheSceneOrTheUserAsksForTheSum) {
    const std::string sum = "[solver]\nsharp_clamp = false\n" + smallCloth;
    EXPECT_TRUE(load(smallCloth).settings.hasSharpClamp);
    EXPECT_FALSE(load(sum).settings.hasSharpClamp);
    EXPECT_TRUE(scenes::load(write("sum.toml", sum), {.hasSharpClamp = true}).settings.hasSharpClamp);
    EXPECT_FALSE(
        scenes::load(write("plain.toml", smallCloth), {.hasSharpClamp = false}).settings.hasSharpClamp);
}

TEST_F(Load, TakesEveryNumberOfAClothFromTheFile) {
    const scenes::LoadedScene loaded = load(
        "name = \"n\"\ngravity = [1, 2, 3]\ndt = 0.01\ndamping = 0.5\n"
        "[solver]\nname = \"jacobi\"\nsubsteps = 7\niterations = 3\nomega = 1.5\n"
        "theta = 0.25\nweight = 0.5\nover_relaxation = 1.25\nwarm_start = 0.75\n" +
        smallCloth +
        "name = \"sheet\"\norigin = [1, 2, 3]\narea_density = 0.4\n"
        "stretch_compliance = 1e-3\nshear_compliance = 2e-3\nskip_stiffness = 50\ncolor = [0.1, 0.2, 0.3]\n"
        "[[plane]]\nnormal = [0, 0, 1]\noffset = -2\nfriction = 0.25\nrestitution = 0.75\n"
        "[camera]\neye = [9, 8, 7]\ntarget = [6, 5, 4]\nfield_of_view = 55\n"
        "[tools]\nblade_depth = 0.04\n");
    const sim::Scene& scene = loaded.scene;
    EXPECT_EQ(scene.name, "n");
    EXPECT_EQ(scene.gravity.z, 3);
    EXPECT_EQ(scene.dt, 0.01f);
    EXPECT_EQ(scene.damping, 0.5f);
    EXPECT_EQ(loaded.settings.solver, sim::Solver::jacobi);
    EXPECT_EQ(loaded.settings.substeps, 7u);
    EXPECT_EQ(loaded.settings.iterations, 3u);
    EXPECT_EQ(loaded.settings.omega, 1.5f);
    EXPECT_EQ(loaded.settings.theta, 0.25f);
    EXPECT_EQ(loaded.settings.weight, 0.5f);
    EXPECT_EQ(loaded.settings.overRelaxation, 1.25f);
    EXPECT_EQ(loaded.settings.warmStart, 0.75f);
    ASSERT_EQ(scene.particles.size(), 12u);
    EXPECT_EQ(scene.particles[0].position.y, 2);
    EXPECT_FLOAT_EQ(scene.particles[0].inverseMass, 1 / (0.4f * 0.1f * 0.1f / 4));
    EXPECT_EQ(scene.bodies[0].name, "sheet");
    EXPECT_EQ(scene.distances[0].compliance, 1e-3f);
    EXPECT_EQ(scene.distances.back().compliance, 1 / 50.0f);
    EXPECT_EQ(scene.skins[0].color.z, 0.3f);
    ASSERT_EQ(scene.planes.size(), 1u);
    EXPECT_EQ(scene.planes[0].normal.z, 1);
    EXPECT_EQ(scene.planes[0].offset, -2);
    EXPECT_EQ(scene.planes[0].friction, 0.25f);
    EXPECT_EQ(scene.planes[0].restitution, 0.75f);
    ASSERT_TRUE(loaded.camera.has_value());
    EXPECT_EQ(loaded.camera->eye.x, 9);
    EXPECT_EQ(loaded.camera->target.y, 5);
    EXPECT_EQ(loaded.camera->fieldOfView, 55);
    EXPECT_EQ(loaded.bladeDepth, 0.04f);
}

TEST_F(Load, NamesASceneAfterItsFile) {
    EXPECT_EQ(load(smallCloth).scene.name, "scene");
}

TEST_F(Load, PinsByNameAndByPair) {
    const auto pinned = [&](const std::string& pins) {
        std::vector<std::uint32_t> particles;
        for (const sim::FixedConstraint& fixed : load(smallCloth + "pinned = " + pins + "\n").scene.fixed)
            particles.push_back(fixed.particle);
        return particles;
    };
    using List = std::vector<std::uint32_t>;
    EXPECT_EQ(pinned("[\"first_row_start\", \"first_row_end\"]"), (List{0, 2}));
    EXPECT_EQ(pinned("[\"last_row_start\", \"last_row_end\"]"), (List{9, 11}));
    EXPECT_EQ(pinned("[\"first_row\"]"), (List{0, 1, 2}));
    EXPECT_EQ(pinned("[\"last_row\"]"), (List{9, 10, 11}));
    EXPECT_EQ(pinned("[\"first_column\"]"), (List{0, 3, 6, 9}));
    EXPECT_EQ(pinned("[\"last_column\"]"), (List{2, 5, 8, 11}));
    EXPECT_EQ(pinned("[[1, 2], \"first_row_start\", [0, 0]]"), (List{0, 7}));
    EXPECT_EQ(pinned("[]"), List{});
}

TEST_F(Load, RefusesPinsThatTheSheetLacks) {
    expectError(smallCloth + "pinned = [[3, 0]]\n",
                "scene.toml:4: cloth[0].pinned has [3, 0], but the sheet has 3 columns and 4 rows");
    expectError(smallCloth + "pinned = [[0, -1]]\n", "scene.toml:4: cloth[0].pinned has [0, -1]");
    expectError(smallCloth + "pinned = [\"top\"]\n",
                "scene.toml:4: cloth[0].pinned names \"top\": possible are first_row_start");
    expectError(smallCloth + "pinned = [[0.5, 1]]\n",
                "scene.toml:4: cloth[0].pinned is a list of 1: write a list of corner");
}

TEST_F(Load, RefusesSheetsThatAreNoRectangle) {
    expectError(smallCloth + "right = [0.5, 0, 0]\n", "scene.toml:4: cloth[0].right has length 0.5");
    expectError(smallCloth + "right = [0, 0, 1]\n", "scene.toml:1: cloth[0].down is not at right angles");
}

TEST_F(Load, PlacesABoxByCenterOrOrigin) {
    const std::string box = "[[box]]\nparticles = [3, 5, 2]\nspacing = 0.5\n";
    const sim::Scene centered = load(box + "center = [1, 2, 3]\n").scene,
                     placed = load(box + "origin = [0.5, 1, 2.75]\n").scene;
    ASSERT_EQ(centered.particles.size(), 30u);
    EXPECT_EQ(centered.particles[0].position.x, 0.5f);
    EXPECT_EQ(centered.particles[0].position.y, 1);
    EXPECT_EQ(centered.particles[0].position.z, 2.75f);
    EXPECT_EQ(centered.particles[29].position.y, placed.particles[29].position.y);
    EXPECT_EQ(centered.skins.size(), 1u);
    expectError(box, "scene.toml:1: box[0].center is missing: give center or origin");
    expectError(box + "center = [0, 0, 0]\norigin = [0, 0, 0]\n",
                "scene.toml:5: box[0].origin is given beside center");
}

TEST_F(Load, ClampsFacesOfABoxAndLaysALoadOnTop) {
    const std::string box = "[[box]]\nparticles = [2, 3, 4]\nspacing = 0.5\norigin = [0, 0, 0]\n";
    const auto held = [&](const std::string& faces) {
        return load(box + "clamped = " + faces + "\n").scene.fixed.size();
    };
    EXPECT_EQ(held("[]"), 0u);
    EXPECT_EQ(held("[\"low_x\"]"), 12u);
    EXPECT_EQ(held("[\"low_y\"]"), 8u);
    EXPECT_EQ(held("[\"high_z\"]"), 6u);
    EXPECT_EQ(held("[\"low_y\", \"high_y\", \"low_y\"]"), 16u);
    EXPECT_EQ(held("[\"low_x\", \"low_y\"]"), 12u + 8 - 4) << "faces share an edge";
    const sim::Scene plain = load(box).scene, loaded = load(box + "load = 4\n").scene;
    for (std::size_t i = 0; i < plain.particles.size(); ++i) {
        const double extra = plain.particles[i].position.y > 0.9f ? 4.0 / 8 : 0;
        EXPECT_NEAR(1 / double{loaded.particles[i].inverseMass},
                    1 / double{plain.particles[i].inverseMass} + extra, 1e-4);
    }
    expectError(box + "clamped = [\"top\"]\n",
                "scene.toml:5: box[0].clamped names \"top\": possible are low_x, high_x, low_y");
    expectError(box + "clamped = [1]\n",
                "scene.toml:5: box[0].clamped is a list of 1: write a list of names in quotes");
    expectError(box + "clamped = \"low_x\"\n", "scene.toml:5: box[0].clamped is text \"low_x\"");
    expectError(box + "load = -1\n", "scene.toml:5: box[0].load is -1 kg: must be from 0");
}

TEST_F(Load, TakesEveryNumberOfAChainFromTheFile) {
    const std::string chain = "[[chain]]\nlength = 2\n";
    const sim::Scene scene = load(chain + "name = \"c\"\norigin = [1, 2, 3]\ndirection = [0, 0, -1]\n"
                                          "particles = 5\nmass = 0.5\nend_mass = 3\n"
                                          "stretch_compliance = 1e-4\npinned = [\"last\", \"first\"]\n")
                                 .scene;
    ASSERT_EQ(scene.particles.size(), 5u);
    EXPECT_EQ(scene.bodies[0].name, "c");
    EXPECT_EQ(scene.particles[0].position.x, 1);
    EXPECT_EQ(scene.particles[4].position.z, 1);
    EXPECT_FLOAT_EQ(scene.particles[0].inverseMass, 10);
    EXPECT_FLOAT_EQ(scene.particles[4].inverseMass, 1 / 3.0f);
    EXPECT_EQ(scene.distances[0].compliance, 1e-4f);
    EXPECT_EQ(scene.distances[0].restLength, 0.5f);
    ASSERT_EQ(scene.fixed.size(), 2u);
    EXPECT_EQ(scene.fixed[0].particle, 4u);
    EXPECT_EQ(load(chain).scene.fixed.size(), 1u) << "held at its first particle unless told otherwise";
    EXPECT_TRUE(load(chain + "pinned = []\n").scene.fixed.empty());
    expectError("[[chain]]\n", "scene.toml:1: chain[0].length is missing");
    expectError(chain + "particles = 1\n", "scene.toml:3: chain[0].particles is 1");
    expectError(chain + "end_mass = 0\n", "scene.toml:3: chain[0].end_mass is 0 kg: must be above 0");
    expectError(chain + "direction = [2, 0, 0]\n", "scene.toml:3: chain[0].direction is 2");
    expectError(chain + "direction = [0.5, 0, 0]\n", "scene.toml:3: chain[0].direction has length 0.5");
    expectError(chain + "pinned = [\"middle\"]\n",
                "scene.toml:3: chain[0].pinned names \"middle\": possible are first, last");
}

TEST_F(Load, GivesCellsTheVolumesThatABodyAsksFor) {
    const std::string box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 0, 0]\n";
    EXPECT_FALSE(sim::hasCellVolumes(load(box).scene.grids[0]));
    EXPECT_FALSE(sim::hasCellVolumes(load(box + "poisson_ratio = 0.25\n").scene.grids[0]));
    const sim::Grid grid = load(box + "poisson_ratio = 0.45\nrecovery = 2\n").scene.grids[0];
    const float shear = 1e5f / 2.9f;
    EXPECT_NEAR(grid.volumeStiffness / shear, 8, 1e-5);
    EXPECT_NEAR(grid.recoveryPressure / shear, 2, 1e-6);
    EXPECT_NEAR(grid.compliance[0] * shear * 0.1f, 1, 1e-6);
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n";
    EXPECT_FALSE(sim::hasCellVolumes(load(mesh + "recovery = 0\n").scene.grids[0]));
    EXPECT_GT(load(mesh + "poisson_ratio = 0.3\n").scene.grids[0].volumeStiffness, 0);
    EXPECT_EQ(load(mesh + "young_modulus = 1e5\n").scene.grids[0].recoveryPressure,
              load(mesh + "young_modulus = 1e5\nrecovery = 2\n").scene.grids[0].recoveryPressure);
}

TEST_F(Load, LeavesOutTheRecoveryOfAMeshThatNobodyAskedForAndNothingComputes) {
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n";
    const auto recoveries = [&](const std::string& text) {
        const scenes::LoadedScene loaded = load(text);
        const bool isNoted = std::ranges::any_of(loaded.notes, [](const std::string& note) {
            return note.find("mesh sphere: no recovery, ") == 0;
        });
        const bool recovers = std::ranges::any_of(loaded.scene.grids, sim::hasCellVolumes);
        EXPECT_NE(isNoted, recovers) << text;
        return recovers;
    };
    EXPECT_TRUE(recoveries(mesh));
    EXPECT_TRUE(recoveries(smallCloth + mesh));
    const std::string unfit[] = {"[solver]\nname = \"jacobi\"\n", "[solver]\nname = \"gauss_seidel\"\n",
                                 "damping_time = 0.01\n", "[solver]\nomega = 3.7\ntheta = 0\n",
                                 smallCloth + "bending_stiffness = 1\n"};
    for (const std::string& before : unfit) {
        EXPECT_FALSE(recoveries(before + mesh)) << before;
        EXPECT_NE(errorOfText(before + mesh + "recovery = 2\n"), "") << before;
    }
    const std::string far = smallCloth +
                            "origin = [0, 0, 0]\n[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\n"
                            "voxel = 0.3\ncenter = [9e5, 0, 0]\n";
    EXPECT_FALSE(recoveries(far));
    EXPECT_NE(errorOfText(far + "recovery = 2\n"), "");
    EXPECT_NE(errorOfText(far + "cuttable = true\n"), "");
    EXPECT_EQ(load(far).scene.particles.size(), load(far + "recovery = 0\n").scene.particles.size());
    EXPECT_EQ(load(far).scene.distances.size(), load(far + "recovery = 0\n").scene.distances.size());
}

TEST_F(Load, RefusesVolumesThatItCannotCompute) {
    const std::string atHome = smallCloth + "origin = [0, 0, 0]\n"; // relative to the first body
    const std::string box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\n";
    const std::string here = box + "center = [0, 0, 0]\n", far = atHome + box + "center = [9e5, 0, 0]\n";
    expectError(here + "poisson_ratio = 0.5\n", "scene.toml:5: box[0].poisson_ratio is 0.5: ");
    expectError(here + "poisson_ratio = 0.2\n",
                "scene.toml:5: box[0].poisson_ratio is 0.2: must be from 0.25 to 0.49");
    expectError(here + "recovery = -1\n", "scene.toml:5: box[0].recovery is -1: ");
    expectError(here + "poisson_ratio = 0.3\n[solver]\nname = \"jacobi\"\n",
                "scene.toml: body \"box\": has cell volumes (a Poisson ratio above 1/4 or recovery), "
                "which solver jacobi "
                "does not support: use split");
    expectError(far + "poisson_ratio = 0.3\n", "scene.toml:9: box[0].poisson_ratio is not possible: ");
    expectError(atHome + "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.2\n"
                         "center = [1e6, 0, 0]\nrecovery = 2\n",
                "scene.toml:11: mesh[0].recovery is not possible: ");
}

TEST_F(Load, TakesEveryNumberOfACollider) {
    const std::string common = "center = [1, 2, 3]\nmargin = 0.01\nfriction = 0.25\nstatic_friction = 0.5\n"
                               "restitution = 0.75\ncolor = [0.1, 0.2, 0.3]\nrotation = [0, 90, 0]\n";
    const sim::Scene scene =
        load(smallCloth + "[[collider]]\nshape = \"sphere\"\nradius = 0.5\n" + common +
             "[[collider]]\nshape = \"capsule\"\nradius = 0.5\nlength = 3\npath_end = \"loop\"\n"
             "[[collider.keyframe]]\ntime = 1\n[[collider.keyframe]]\ntime = 2\ncenter = [0, 1, 0]\n"
             "rotation = [0, 0, 90]\n[[collider.keyframe]]\ntime = 3\n"
             "[[collider]]\nshape = \"box\"\nsize = [2, 4, 6]\n")
            .scene;
    ASSERT_EQ(scene.colliders.size(), 3u);
    const sim::Collider &sphere = scene.colliders[0], &capsule = scene.colliders[1],
                        &box = scene.colliders[2];
    EXPECT_EQ(sphere.shape, sim::ColliderShape::sphere);
    EXPECT_EQ(sphere.radius, 0.5f);
    EXPECT_EQ(sphere.pose.position.z, 3);
    EXPECT_FLOAT_EQ(sphere.pose.rotation.y, std::sqrt(0.5f));
    EXPECT_FLOAT_EQ(sphere.pose.rotation.w, std::sqrt(0.5f));
    EXPECT_EQ(sphere.margin, 0.01f);
    EXPECT_EQ(sphere.friction, 0.25f);
    EXPECT_EQ(sphere.staticFriction, 0.5f);
    EXPECT_EQ(sphere.restitution, 0.75f);
    EXPECT_EQ(sphere.color.y, 0.2f);
    EXPECT_TRUE(sphere.path.empty());
    EXPECT_EQ(capsule.shape, sim::ColliderShape::capsule);
    EXPECT_EQ(capsule.halfLength, 1.5f);
    EXPECT_EQ(capsule.pathEnd, sim::PathEnd::loop);
    ASSERT_EQ(capsule.path.size(), 3u);
    EXPECT_EQ(capsule.path[1].time, 2);
    EXPECT_EQ(capsule.path[1].pose.position.y, 1);
    EXPECT_FLOAT_EQ(capsule.path[1].pose.rotation.z, std::sqrt(0.5f));
    EXPECT_EQ(capsule.path[2].pose.position.y, 0);
    EXPECT_EQ(box.shape, sim::ColliderShape::box);
    EXPECT_EQ(box.halfExtents.z, 3);
}

TEST_F(Load, RefusesCollidersThatAreNone) {
    const std::string head = smallCloth + "[[collider]]\n", key = "[[collider.keyframe]]\n";
    const std::string ball = head + "shape = \"sphere\"\nradius = 1\n";
    for (
        const auto& [text, error] : std::vector<std::pair<std::string, std::string>>{
            {head, "scene.toml:4: collider[0].shape is missing"},
            {head + "shape = \"cube\"\n",
             "scene.toml:5: collider[0].shape is \"cube\": possible are sphere, capsule, box"},
            {head + "shape = \"sphere\"\n", "scene.toml:4: collider[0].radius is missing: a sphere needs it"},
            {head + "shape = \"capsule\"\nradius = 1\n", "scene.toml:4: collider[0].length is missing"},
            {head + "shape = \"box\"\n", "scene.toml:4: collider[0].size is missing"},
            {ball + "size = [1, 1, 1]\n", "scene.toml:7: collider[0].size is given: a sphere has none"},
            {head + "shape = \"box\"\nsize = [1, 0, 1]\n", "scene.toml:6: collider[0].size is 0 m: must be"},
            {ball + "path_end = \"stop\"\n", "scene.toml:7: collider[0].path_end is \"stop\""},
            {ball + "speed = 1\n", "scene.toml:7: unknown key collider[0].speed"},
            {ball + key, "scene.toml:7: collider[0].keyframe[0].time is missing"},
            {ball + key + "time = 1\nradius = 2\n",
             "scene.toml:9: unknown key collider[0].keyframe[0].radius"},
            {ball + key + "time = 0\n" + key + "time = 1\nrotation = [0, 180, 0]\n",
             "scene.toml:11: collider[0].keyframe[1].rotation is more than 170 degrees"},
            {ball + key + "time = 1\n" + key + "time = 1\n",
             "scene.toml:10: collider[0].keyframe[1].time is 1 s, which is not later than the 1 s of"},
            {ball + "path_end = \"loop\"\n" + key + "time = 0\n" + key + "time = 1\ncenter = [1, 0, 0]\n",
             "scene.toml:7: collider[0].path_end is \"loop\", but the last keyframe is not where the first"}})
        expectError(text, error);
}

TEST_F(Load, RefusesPlanesWithoutUnitNormal) {
    expectError(smallCloth + "[[plane]]\nnormal = [0, 1, 1]\n",
                "scene.toml:5: plane[0].normal has length 1.414");
    expectError(smallCloth + "[[plane]]\nnormal = [0, 0, 0]\n",
                "scene.toml:5: plane[0].normal has length 0.0");
}

TEST_F(Load, RefusesWhatTheSimulationCannotTake) {
    expectError("[solver]\nomega = 3.9\n" + smallCloth,
                "scene.toml: solver.omega: is 3.9, but split is stable only below");
    std::string planes;
    for (int i = 0; i < 33; ++i) planes += "[[plane]]\n";
    expectError(smallCloth + planes, "scene.toml: planes: are 33, at most 32 are possible");
    expectError("[solver]\nname = \"magic\"\n" + smallCloth,
                "scene.toml: no solver is called \"magic\": possible are jacobi, split, gauss_seidel");
    expectError("", "scene.toml: has no body: add [[cloth]], [[chain]], [[box]], [[mesh]] or [[particles]]");
    expectError("[[box]]\nparticles = [4096, 4096, 4096]\nspacing = 1\ncenter = [0, 0, 0]\n",
                "scene.toml:2: box[0].particles brings the scene to 68719476736 particles: at most 2000000");
}

TEST_F(Load, LetsTheCommandLineHaveItsSay) {
    const scenes::LoadedScene loaded =
        scenes::load(write("scene.toml", smallCloth),
                     {.solver = "jacobi", .substeps = 9, .iterations = 5, .dt = 0.02f, .isReversed = true});
    EXPECT_EQ(loaded.settings.solver, sim::Solver::jacobi);
    EXPECT_EQ(loaded.settings.substeps, 9u);
    EXPECT_EQ(loaded.settings.iterations, 5u);
    EXPECT_EQ(loaded.scene.dt, 0.02f);
    EXPECT_TRUE(loaded.settings.isReversed);
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.5\n";
    EXPECT_EQ(scenes::load(write("scene.toml", mesh), {.voxel = 0.25f}).meshes[0].voxels.spacing, 0.25f);
    EXPECT_NE(
        errorOf(write("scene.toml", smallCloth), {.solver = "magic"}).find("--solver: no solver is called"),
        std::string::npos);
    EXPECT_EQ(errorOf(write("scene.toml", smallCloth), {.substeps = 1001}),
              "scene.toml: solver.substeps: is 1001, must be from 1 to 1000, or 0 for as many as it takes: "
              "correct this");
}

TEST_F(Load, ChoosesLevelsWhereTheFileAsksForIt) {
    const std::string box = "[[box]]\nparticles = [16, 16, 16]\nspacing = 0.02\ncenter = [0, 1, 0]\n";
    const std::string sum = "sharp_clamp = false\n";
    EXPECT_EQ(load("[solver]\nsubsteps = 8\nlevels = \"auto\"\n" + sum + box).settings.levels, 2u);
    EXPECT_EQ(load("[solver]\nsubsteps = 8\n" + sum + box).settings.levels, 0u);
    const scenes::LoadedScene both = load("[solver]\nlevels = \"auto\"\n" + sum + box);
    EXPECT_EQ(both.settings.substeps, 8u);
    EXPECT_EQ(both.settings.levels, 2u);
    const std::string eleven = "[solver]\nsubsteps = 11\n";
    EXPECT_EQ(
        scenes::load(write("scene.toml", eleven + sum + box), {.levels = sim::autoLevels}).settings.levels,
        1u);
    // The sharp clamp, which is the default, wins up to a lack of 3.2 times the substeps.
    EXPECT_EQ(scenes::load(write("scene.toml", eleven + box), {.levels = sim::autoLevels}).settings.levels,
              0u);
    EXPECT_EQ(load("[solver]\nsubsteps = 6\nlevels = \"auto\"\n" + box).settings.levels, 2u);
    const scenes::LoadedScene sharp = load("[solver]\nlevels = \"auto\"\n" + box);
    EXPECT_EQ(sharp.settings.substeps, 17u);
    EXPECT_EQ(sharp.settings.levels, 0u);
}

TEST_F(Load, ChoosesSubstepsWhereTheFileDoesNotSay) {
    const std::string box = "[[box]]\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter = [0, 1, 0]\n";
    for (const char* solver : {"", "[solver]\nsubsteps = \"auto\"\n"}) {
        const scenes::LoadedScene loaded = load(solver + box);
        // With 1e5 Pa, 16.8 substeps would be exact, with the clamp by the sum 22.4.
        EXPECT_EQ(loaded.settings.substeps, 17u);
        EXPECT_EQ(loaded.substeps.reason, sim::SubstepReason::stiffness);
    }
    EXPECT_EQ(load("[solver]\nsubsteps = 9\n" + box).substeps.reason, sim::SubstepReason::asked);
    EXPECT_EQ(scenes::load(write("scene.toml", "[solver]\nsubsteps = 9\n" + box), {.substeps = 0})
                  .settings.substeps,
              17u);
    EXPECT_EQ(load("[solver]\nsharp_clamp = false\n" + box).settings.substeps, 22u);
    EXPECT_LT(load("[solver]\ntolerance = 0.5\n" + box).settings.substeps, 13u);
    expectError("[solver]\nsubsteps = 0\n" + box,
                "scene.toml:2: solver.substeps is 0: must be from 1 to 1000");
    expectError("[solver]\nsubsteps = 1000000000\n" + box,
                "scene.toml:2: solver.substeps is 1e+09: must be from 1 to 1000");
    expectError("[solver]\nsubsteps = \"many\"\n" + box,
                "scene.toml:2: solver.substeps is text \"many\": write a whole number or \"auto\"");
    expectError("[solver]\nlevels = \"many\"\n" + box,
                "scene.toml:2: solver.levels is text \"many\": write a whole number or \"auto\"");
    expectError("[solver]\nlevels = 7\n" + box, "scene.toml:2: solver.levels is 7: must be from 0 to 6");
    expectError("[solver]\ntolerance = 0\n" + box,
                "scene.toml:2: solver.tolerance is 0: must be above 0 and below 1");
    expectError("dt = 1e-7\n" + box, "scene.toml:1: dt is 1e-07 s: must be from 1e-06 to 0.1 s");
}
