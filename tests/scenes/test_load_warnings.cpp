// Tests of the warnings for scenes that load.
#include "scenes/load_fixture.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace sinew;
namespace fs = std::filesystem;

namespace {

class LoadWarnings : public test::LoadFixture {};

} // namespace

TEST_F(LoadWarnings, WarnsOfOddSizes) {
    const auto warnings = [&](const std::string& spacing) {
        return load("[[cloth]]\nsize = [2, 2]\nspacing = " + spacing + "\n").warnings;
    };
    EXPECT_TRUE(warnings("1").empty());
    ASSERT_EQ(warnings("1001").size(), 1u);
    EXPECT_EQ(warnings("1001")[0], "body \"cloth\" is larger than 1 km: lengths are in metres");
    ASSERT_EQ(warnings("9e-5").size(), 1u);
    EXPECT_EQ(warnings("9e-5")[0], "body \"cloth\" is smaller than 0.1 mm: lengths are in metres");
}

TEST_F(LoadWarnings, MeasuresFreeParticlesByTheirDiameter) {
    const auto warnings = [&](const std::string& particles) {
        return load("[[particles]]\n" + particles).warnings;
    };
    EXPECT_TRUE(warnings("count = [1, 1, 1]\nradius = 0.05\n").empty());
    const std::string small = "body \"particles\" is smaller than 0.1 mm: lengths are in metres";
    EXPECT_EQ(warnings("count = [2, 1, 1]\nspacing = 0.001\nradius = 1e-5\n"), std::vector{small});
    EXPECT_EQ(warnings("count = [1, 1, 1]\nradius = 4e-5\n"), std::vector{small});
    EXPECT_TRUE(warnings("count = [1, 1, 1]\nradius = 6e-5\n").empty());
    EXPECT_TRUE(warnings("count = [1, 10, 1]\nspacing = 150\nradius = 0.05\n").empty());
    const std::vector<std::string> scattered = warnings("count = [1, 10, 1]\nspacing = 300\nradius = 0.05\n");
    ASSERT_EQ(scattered.size(), 1u); // positions are rounded, but no body is large
    EXPECT_TRUE(scattered[0].starts_with("positions are rounded to 0.12 mm at 1350 m")) << scattered[0];
}

TEST_F(LoadWarnings, WarnsWherePositionsAreTooCoarse) {
    const auto warnings = [&](const std::string& x, const std::string& substeps) {
        const std::string box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.05\ncenter = [";
        return load("[solver]\nsubsteps = " + substeps + "\n" + box + "0, 0, 0]\n" + box + x + ", 0, 0]\n")
            .warnings;
    };
    EXPECT_TRUE(warnings("15", "16").empty());
    EXPECT_TRUE(warnings("15", "256").empty()); // slow motion is handled (tests/sim/test_slow_motion.cpp)
    EXPECT_EQ(warnings("1000", "10"),
              std::vector<std::string>{
                  "positions are rounded to 0.061 mm at 1000 m from the origin, where body \"box\" is, which "
                  "is coarse against the spacing of particles: place all within 512 m of the origin"});
    EXPECT_TRUE(warnings("511.5", "10").empty());
    EXPECT_EQ(warnings("512.5", "10").size(), 1u) << "512 m is where they become coarse";
    EXPECT_EQ(warnings("20000", "10").size(), 1u);
    EXPECT_EQ(warnings("900000", "10").size(), 1u);
}

// A plate without contacts is never compared with a position, so its thickness is irrelevant.
TEST_F(LoadWarnings, HoldsRoundingAgainstWhatMoves) {
    mesh::exportObj(folder_ / "t.obj", test::tetrahedron(0.1f));
    const auto coarse = [&](const std::string& more) {
        std::size_t found = 0;
        const std::string box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.05\ncenter = ";
        for (const std::string& warning : load(box + "[0, 0, 0]\n" + box + "[40, 0, 0]\n" + more).warnings)
            found += warning.starts_with("positions are rounded");
        return found;
    };
    const std::string plate = "[[mesh_collider]]\nfile = \"t.obj\"\nthickness = 0.001\ncenter = [40, 1, 0]\n";
    EXPECT_EQ(coarse(""), 0u);
    EXPECT_EQ(coarse(plate), 0u);
    EXPECT_EQ(coarse("collides = true\n" + plate), 1u);
}

TEST_F(LoadWarnings, SaysWhatContactsAskForWhereANumberIsGiven) {
    const auto few = [&](const std::string& substeps) {
        std::string found;
        for (const std::string& warning :
             load("[solver]\nsubsteps = " + substeps +
                  "\n[[cloth]]\nsize = [33, 33]\nspacing = 0.03\n"
                  "thickness = 0.004\norigin = [0, 0.5, 0]\nright = [0, 1, 0]\n[[plane]]\n")
                 .warnings)
            if (warning.find("for these contacts") != std::string::npos) found = warning;
        return found;
    };
    const std::string said = few("4");
    const std::string start = "4 substeps are few for these contacts: ",
                      end = " substeps would keep a falling sheet from passing through its own folds";
    ASSERT_TRUE(said.starts_with(start) && said.ends_with(end)) << said;
    const std::string wanted = said.substr(start.size(), said.size() - start.size() - end.size());
    EXPECT_GT(std::stoul(wanted), 8u);
    EXPECT_EQ(few(wanted), "");
    EXPECT_EQ(few(std::to_string((std::stoul(wanted) + 1) / 2)), "");
    EXPECT_NE(few(std::to_string((std::stoul(wanted) - 1) / 2)), "");
    EXPECT_EQ(few("\"auto\""), "");
}

TEST_F(LoadWarnings, NamesKeysOfOtherSolvers) {
    const std::string chain = "[[chain]]\nlength = 1\nparticles = 4\nstretch_compliance = 1e-3\n";
    const auto ignored = [&](const std::string& keys, const scenes::Overrides& overrides = {}) {
        std::vector<std::string> found;
        for (const std::string& warning :
             scenes::load(write("scene.toml", "[solver]\nsubsteps = 64\n" + keys + chain), overrides)
                 .warnings)
            if (warning.find(" is ignored by ") != std::string::npos) found.push_back(warning);
        return found;
    };
    EXPECT_EQ(ignored("weight = 0.5\nomega = 1\n"),
              std::vector<std::string>{"solver.weight is ignored by solver split: only jacobi has it"});
    EXPECT_EQ(ignored("name = \"gauss_seidel\"\nwarm_start = 0.5\ntheta = 0\n"),
              std::vector<std::string>{"solver.theta is ignored by solver gauss_seidel: only split has it"});
    EXPECT_EQ(
        ignored("name = \"jacobi\"\nover_relaxation = 1.2\nwarm_start = 0\n"),
        std::vector<std::string>{"solver.warm_start is ignored by solver jacobi: only gauss_seidel has it"});
    EXPECT_TRUE(ignored("theta = 0\n", {.solver = "jacobi"}).empty()) << "asked for from outside";
}

TEST_F(LoadWarnings, SaysHowManySubstepsAStiffBodyNeeds) {
    const std::string box = "[solver]\nsubsteps = 32\n[[box]]\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter "
                            "= [0, 1, 0]\nyoung_modulus = 2e7\n";
    const std::vector<std::string> warnings = load(box).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(" elastic links are softer than asked"), std::string::npos);
    // Stiffness and mass are assembled alike, so each particle has sum k / m = 18 x 0.4 E a / (density a^3).
    // The condition h^2 sum k / m <= 1 gives 1/60 s sqrt(7.2 E / density) / spacing = 316.2 substeps. At a
    // corner, the strictest place, the largest eigenvalue of the links is 0.56 of their sum; sqrt(0.56) of
    // these substeps leave all links whole, sqrt(0.95) of that leave them at most 5 % too soft.
    EXPECT_NE(warnings[0].find(": 231 substeps would keep all links of the scene within 5 %"),
              std::string::npos)
        << warnings[0];
    EXPECT_TRUE(scenes::load(write("scene.toml", box), {.substeps = 231}).warnings.empty());
    const std::string bySum = "[solver]\nsharp_clamp = false\n" + box.substr(box.find("substeps"));
    EXPECT_NE(load(bySum).warnings[0].find(": 309 substeps would keep"), std::string::npos);
    EXPECT_TRUE(
        scenes::load(write("scene.toml", box), {.solver = "jacobi", .iterations = 200}).warnings.empty());
}

TEST_F(LoadWarnings, WarnsOfSoftBodiesUnderEverySolver) {
    const std::string box = "[[box]]\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter = [0, 1, 0]\n"
                            "young_modulus = 2e6\n";
    const auto warnings = [&](const std::string& solver, std::uint32_t substeps, std::uint32_t iterations) {
        return scenes::load(write("scene.toml", box),
                            {.solver = solver, .substeps = substeps, .iterations = iterations})
            .warnings;
    };
    ASSERT_EQ(warnings("gauss_seidel", 8, 1).size(), 1u);
    EXPECT_NE(warnings("gauss_seidel", 8, 1)[0].find(" elastic links are softer than asked, down to "),
              std::string::npos);
    ASSERT_EQ(warnings("jacobi", 8, 1).size(), 1u);
    EXPECT_NE(warnings("jacobi", 8, 1)[0].find(" elastic links are softer than asked, down to "),
              std::string::npos);
    EXPECT_TRUE(warnings("gauss_seidel", 100, 1).empty());
    EXPECT_EQ(warnings("jacobi", 8, 200).size(), 1u) << "such a box hangs 1.8 times too far";
    EXPECT_TRUE(warnings("jacobi", 8, 1000).empty()) << "iterations make links as stiff as asked";
    EXPECT_EQ(warnings("gauss_seidel", 8, 4).size(), 1u) << "a warning goes with the figure alone";
    EXPECT_TRUE(warnings("gauss_seidel", 8, 100).empty());
}

TEST_F(LoadWarnings, WarnsOfASoftBodyBesideALargerOne) {
    const auto box = [](const std::string& name, int x, int particles, const std::string& stiffness) {
        return "[[box]]\nname = \"" + name + "\"\nparticles = [4, 4, " + std::to_string(particles) +
               "]\nspacing = 0.02\ncenter = [" + std::to_string(x) + ", 1, 0]\nyoung_modulus = " + stiffness +
               "\n";
    };
    const auto warnings = [&](const std::string& bodies) {
        return load("[solver]\nsubsteps = 32\n" + bodies).warnings;
    };
    const std::string liver = box("liver", 0, 200, "2e4"), bone = box("bone", 1, 4, "2e7");
    const std::vector<std::string> both = warnings(liver + bone);
    ASSERT_EQ(both.size(), 1u);
    EXPECT_EQ(both[0], "360 of 360 elastic links of body \"bone\" are softer than asked, down to 2 %: 231 "
                       "substeps would keep all links of the scene within 5 %");
    EXPECT_TRUE(warnings(liver).empty());
    std::string bones;
    for (int b = 1; b < 8; ++b) bones += box("bone " + std::to_string(b), b, 4, "2e7");
    const std::vector<std::string> many = warnings(liver + bones);
    ASSERT_EQ(many.size(), 5u);
    EXPECT_EQ(many[4], "so are most elastic links of 3 other bodies");
}

TEST_F(LoadWarnings, WarnsOfPathsThatAreShorterThanAStep) {
    const auto warnings = [&](const std::string& time) {
        return load(
                   "dt = 0.01\n[[particles]]\nradius = 0.05\ncount = [1, 1, 1]\nspacing = 0.2\n[[collider]]\n"
                   "shape = \"sphere\"\nradius = 0.1\ncenter = [0, -1, 0]\n"
                   "[[collider.keyframe]]\ntime = 0\n[[collider.keyframe]]\ntime = " +
                   time + "\ncenter = [0, -0.9, 0]\n")
            .warnings;
    };
    EXPECT_TRUE(warnings("0.01").empty());
    EXPECT_EQ(warnings("0.004"),
              std::vector<std::string>{
                  "the path of collider[0] has keyframes 4 ms apart, which is less than a step "
                  "of 10 ms: within a step it goes straight from its beginning to its end, "
                  "give dt = 0.004 or keyframes farther apart"});
}

TEST_F(LoadWarnings, NamesTheItemOfAPathThatIsShorterThanAStep) {
    mesh::exportObj(folder_ / "t.obj", test::tetrahedron(0.1f));
    const auto keyframes = [](const std::string& table, const std::string& time) {
        return "[[" + table + ".keyframe]]\ntime = 0\n[[" + table + ".keyframe]]\ntime = " + time + "\n";
    };
    const std::string still = "[[mesh_collider]]\nfile = \"t.obj\"\ncenter = [9, 0, 0]\n",
                      hold = "[[hold]]\nshape = \"sphere\"\nradius = 0.2\ncenter = ";
    const std::vector<std::string> warnings =
        load("dt = 0.01\n[[cloth]]\nsize = [9, 3]\nspacing = 0.1\n" + hold + "[0, 0, 0]\n" +
             keyframes("hold", "1") + hold + "[0.8, 0, 0]\nname = \"grip\"\n" + keyframes("hold", "0.002") +
             still + still + keyframes("mesh_collider", "0.003"))
            .warnings;
    const auto says = [&](const std::string& text) {
        return std::ranges::count_if(
            warnings, [&](const std::string& warning) { return warning.starts_with("the path of " + text); });
    };
    EXPECT_EQ(says("hold[1] \"grip\" has keyframes 2 ms apart"), 1);
    EXPECT_EQ(says("mesh_collider[1] has keyframes 3 ms apart"), 1);
    EXPECT_EQ(says(""), 2);
}

TEST_F(LoadWarnings, NamesTheBodyThatAsksForMoreSubsteps) {
    const auto box = [](const std::string& name, const std::string& x, const std::string& stiffness) {
        return "[[box]]\nname = \"" + name + "\"\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter = [" + x +
               ", 1, 0]\nyoung_modulus = " + stiffness + "\n";
    };
    const auto which = [&](const std::string& head, const std::string& bodies, const std::string& said) {
        for (const std::string& warning : load(head + bodies).warnings)
            if (warning.find(said) != std::string::npos) return warning;
        return std::string();
    };
    const std::string asked = "[solver]\nsubsteps = 32\n";
    const std::string two = which(asked, box("liver", "0", "2e7") + box("bone", "1", "4e7"), "softer");
    EXPECT_TRUE(two.starts_with("360 of 360 elastic links of body \"bone\" are softer than asked")) << two;
    const std::string most = which("", box("bone", "0", "2e8") + box("liver", "1", "2e4"), "stops at");
    EXPECT_NE(most.find(" would keep the tolerance of 5 % in body \"bone\": give "), std::string::npos)
        << most;
    for (const std::string& head : {std::string(), asked}) {
        const std::string one = which(head, box("bone", "0", "2e8"), "");
        EXPECT_EQ(one.find("bone"), std::string::npos) << "there is no other: " << one;
    }
    const scenes::LoadedScene loaded = load(box("liver", "0", "2e5") + box("bone", "1", "2e6"));
    EXPECT_TRUE(sim::toText(loaded.substeps, loaded.settings).ends_with(", body \"bone\" decides"))
        << sim::toText(loaded.substeps, loaded.settings);
}

TEST_F(LoadWarnings, WarnsOfTerminalSpeedsThatAreOff) {
    const auto warnings = [&](const std::string& damping) {
        return load("damping = " + damping +
                    "\n[solver]\nsubsteps = 4\n[[particles]]\nradius = 0.05\ncount = [1, 1, 1]\nspacing = "
                    "0.2\n")
            .warnings;
    };
    EXPECT_TRUE(warnings("20").empty()); // 4 %
    EXPECT_EQ(warnings("200"), std::vector<std::string>{
                                   "damping is so strong for 4 substeps that terminal speeds of bodies are "
                                   "off by 36 %: 34 substeps keep them within 5 %"});
}

TEST_F(LoadWarnings, SaysWhereTheChoiceOfSubstepsStops) {
    const std::string box = "[[box]]\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter = [0, 1, 0]\n"
                            "young_modulus = 2e8\n";
    const scenes::LoadedScene loaded = load(box);
    EXPECT_EQ(loaded.settings.substeps, 256u);
    const std::string sentence =
        "solver.substeps = \"auto\" stops at 256, 728 would keep the tolerance of 5 %: ";
    EXPECT_TRUE(std::ranges::any_of(loaded.warnings, [&](const std::string& warning) {
        return warning.starts_with(sentence);
    })) << (loaded.warnings.empty() ? "" : loaded.warnings.back());
    EXPECT_TRUE(load("[solver]\nsubsteps = 728\n" + box).warnings.empty());
}

TEST_F(LoadWarnings, WarnsOfRelaxationOutsideItsProvenRange) {
    const auto warnings = [&](const std::string& keys) {
        return load("[solver]\nname = \"jacobi\"\n" + keys + "[[chain]]\nlength = 1\nparticles = 4\n")
            .warnings;
    };
    const std::string why = ", jacobi is proven stable only below 4/3: it may diverge";
    EXPECT_TRUE(warnings("over_relaxation = 1.33\n").empty());
    EXPECT_EQ(warnings("over_relaxation = 1.5\n"),
              std::vector<std::string>{"solver.over_relaxation is 1.500" + why});
    EXPECT_TRUE(warnings("weight = 0.5\nover_relaxation = 1.25\n").empty());
    EXPECT_EQ(warnings("weight = 1\n"),
              std::vector<std::string>{
                  "solver.over_relaxation x solver.weight x constraints of a particle is 2.000" + why});
}

// Averaging over 18 links takes 1/18 of each correction.
TEST_F(LoadWarnings, NamesNoNumberOfSubstepsWhereAveragingIsTooSoft) {
    const std::string box = "[[box]]\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter = [0, 1, 0]\n";
    const scenes::LoadedScene loaded =
        scenes::load(write("scene.toml", box), {.solver = "jacobi", .substeps = 1000});
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_NE(loaded.warnings[0].find("no number of substeps reaches 5 %, use weight or iterations"),
              std::string::npos)
        << loaded.warnings[0];
    EXPECT_EQ(loaded.warnings[0].find("would keep"), std::string::npos);
}

// The advised dt gives no warning, a longer one does.
TEST_F(LoadWarnings, NameTheStepThatCures) {
    const std::string stiff = "[[box]]\nparticles = [4, 4, 4]\nspacing = 0.02\ncenter = [0, 1, 0]\n";
    const auto saying = [&](const std::string& head, const std::string& said) {
        for (const std::string& warning : load(head + stiff + "young_modulus = 2e8\n").warnings)
            if (warning.find(said) != std::string::npos) return warning;
        return std::string();
    };
    const std::string most = saying("", "stops at 256");
    EXPECT_NE(most.find("give that number, dt = 0.0058, larger voxels"), std::string::npos) << most;
    EXPECT_EQ(saying("dt = 0.0058\n", "stops at"), "");
    EXPECT_NE(saying("dt = 0.0060\n", "stops at"), "");
    const std::string asked = "[solver]\nsubsteps = 1000\n";
    const std::string soft = saying("dt = 0.1\n" + asked, "softer");
    const std::size_t at = soft.find("1000 substeps with dt = ");
    ASSERT_NE(at, std::string::npos) << soft;
    const std::string dt = soft.substr(at + 24, soft.find(" would") - at - 24);
    EXPECT_EQ(saying("dt = " + dt + "\n" + asked, "softer"), "");
}

TEST_F(LoadWarnings, SayWhatNothingCanTouch) {
    mesh::exportObj(folder_ / "t.obj", test::tetrahedron(0.1f));
    const std::string plate = "[[mesh_collider]]\nname = \"plate\"\nfile = \"t.obj\"\ncenter = [9, 0, 0]\n",
                      box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 1, 0]\n",
                      cloth = "[[cloth]]\nsize = [4, 4]\nspacing = 0.1\n", plane = "[[plane]]\n";
    const auto says = [&](const std::string& scene) {
        std::string found;
        for (const std::string& warning : load(scene).warnings)
            if (warning.starts_with("nothing can touch ")) found += warning.substr(18) + ";";
        return found;
    };
    const std::string cure = ": give a box or mesh collides = true, a cloth collides = true or a thickness, "
                             "or take a collider;";
    EXPECT_EQ(says(box + plate), "mesh collider \"plate\"" + cure);
    EXPECT_EQ(says(cloth + plane + plate), "mesh collider \"plate\"" + cure) << "the plane stops it";
    EXPECT_EQ(says(box + "collides = true\n" + plate), "");
    EXPECT_EQ(says(cloth + "collides = true\n" + plate), "");
    EXPECT_EQ(says(cloth + "thickness = 0.01\n" + plate), "");
    EXPECT_EQ(says("[[particles]]\nradius = 0.02\ncount = [1, 1, 1]\nspacing = 0.1\n" + plate), "");
    const std::string hold = "[[hold]]\nshape = \"half_space\"\nnormal = [0, 1, 0]\noffset = -9\n";
    EXPECT_EQ(says(box + "collides = true\n" + hold + plane + plane + plate),
              "the 2 planes and 1 mesh collider of this scene: all its particles are held;");
    EXPECT_EQ(says(box + plane), "");
}

// Terms of the API occur only in validate(); these messages use the words of the file.
TEST_F(LoadWarnings, AreRefusalsInTheWordsOfTheFileWhereASolverHasNoForm) {
    mesh::exportObj(folder_ / "t.obj", test::tetrahedron(0.1f));
    const std::string solver = "[solver]\nname = \"gauss_seidel\"\n",
                      none = "scene.toml: solver gauss_seidel does not support ",
                      box = "[[box]]\nname = \"liver\"\nparticles = [3, 3, 3]\nspacing = 0.1\n"
                            "center = [0, 1, 0]\n",
                      path = "[[hold.keyframe]]\ntime = 0\n[[hold.keyframe]]\ntime = 1\n";
    expectError(solver + box + "collides = true\nfaces = false\n",
                none + "particles that touch each other, as those of body \"liver\" do: use split, or leave "
                       "out collides and [[particles]]");
    expectError(solver + box +
                    "[[hold]]\nname = \"grip\"\nshape = \"sphere\"\nradius = 0.2\ncenter = [0, "
                    "1, 0]\n" +
                    path,
                none + "keyframes of holds and mesh colliders, as those of hold \"grip\": use split, or "
                       "leave them out");
    expectError(solver + "sleep = true\n" + box, none + "bodies that sleep, as solver.sleep asks");
    expectError(solver + box + "cuttable = true\n",
                "scene.toml: body \"liver\": may be cut, which solver gauss_seidel does not support");
    expectError(box + "cuttable = true\n[[cloth]]\nname = \"drape\"\nsize = [4, 4]\nspacing = 0.1\n"
                      "bending_stiffness = 1\n",
                "scene.toml: body \"liver\": may be cut, but body \"drape\" has a bending stiffness (bends), "
                "beside which split does not support that: make it 0");
    expectError(
        "damping_time = 0.01\n" + box + "cuttable = true\n",
        "scene.toml: body \"liver\": may be cut, but the scene has a damping time (internal damping), "
        "beside which split does not support that: make it 0");
}

TEST_F(LoadWarnings, AreRefusalsInTheWordsOfTheFileWhereAPathIsNone) {
    const std::string ball = "[[particles]]\nradius = 0.05\ncount = [1, 1, 1]\nspacing = 0.2\n[[collider]]\n"
                             "shape = \"sphere\"\nradius = 0.1\ncenter = [0, -1, 0]\n",
                      at = "[[collider.keyframe]]\ntime = ";
    expectError(ball + at + "1\n" + at + "1\n",
                "scene.toml:12: collider[0].keyframe[1].time is 1 s, which is not later than the 1 s of the "
                "keyframe before: give a later time");
    expectError(
        ball + "path_end = \"loop\"\n" + at + "0\n" + at + "1\ncenter = [0, -2, 0]\n",
        "scene.toml:9: collider[0].path_end is \"loop\", but the last keyframe is not where the first "
        "one is: give it the same center and rotation, or say \"hold\"");
}
