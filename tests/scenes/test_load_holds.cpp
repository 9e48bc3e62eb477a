// Tests of [[hold]] and of the initial state of bodies.
#include "scenes/load_fixture.hpp"

#include <algorithm>

using namespace sinew;

namespace {

class LoadHolds : public test::LoadFixture {};

// A beam of 5 x 3 x 3 particles with a spacing of 0.1 m, from (0, 0, 0) to (0.4, 0.2, 0.2).
const std::string beam =
    "[[box]]\nname = \"beam\"\nparticles = [5, 3, 3]\nspacing = 0.1\norigin = [0, 0, 0]\n";
const std::string chain = "[[chain]]\nparticles = 5\nlength = 0.4\norigin = [0, 1, 0]\npinned = []\n";

std::vector<std::uint32_t> fixedOf(const scenes::LoadedScene& loaded) {
    std::vector<std::uint32_t> particles;
    for (const sim::FixedConstraint& fixed : loaded.scene.fixed) particles.push_back(fixed.particle);
    std::ranges::sort(particles);
    return particles;
}

TEST_F(LoadHolds, TakeTheSameParticlesAsAClampByAnyShapeAroundThem) {
    const auto clamped = fixedOf(load(beam + "clamped = [\"low_x\"]\n"));
    ASSERT_EQ(clamped.size(), 9u);
    write("wall.obj", "v 0 -1 -1\nv 0 2 -1\nv 0 -1 2\nf 1 2 3\n");
    write("wall_mm.obj", "v -1000 -500 -500\nv -1000 1000 -500\nv -1000 -500 1000\nf 1 2 3\n");
    for (const char* shape :
         {"shape = \"half_space\"\nnormal = [-1, 0, 0]\noffset = -0.01\n",
          "shape = \"box\"\ncenter = [0, 0.1, 0.1]\nsize = [0.1, 0.3, 0.3]\n",
          "shape = \"box\"\ncenter = [0, 0.1, 0.1]\nsize = [0.3, 0.1, 0.3]\nrotation = [0, 0, 90]\n",
          "shape = \"sphere\"\ncenter = [-0.4, 0.1, 0.1]\nradius = 0.45\n",
          "shape = \"capsule\"\ncenter = [-0.3, 0.1, 0.1]\nlength = 0.2\nradius = 0.38\n",
          "shape = \"mesh\"\nfile = \"wall.obj\"\nwithin = 0.05\n",
          "shape = \"mesh\"\nfile = \"wall_mm.obj\"\nwithin = 0.05\nunit = \"mm\"\nscale = 2\n"
          "translation = [2, 0, 0]\n"})
        EXPECT_EQ(fixedOf(load(beam + "[[hold]]\n" + shape)), clamped) << shape;
}

TEST_F(LoadHolds, TakeOfSeveralBodiesWhatIsNamed) {
    const std::string all = "[[hold]]\nshape = \"half_space\"\nnormal = [-1, 0, 0]\noffset = -0.01\n";
    EXPECT_EQ(load(chain + beam + all).scene.fixed.size(), 5u + 9);
    EXPECT_EQ(load(chain + beam + all + "bodies = [\"chain\"]\n").scene.fixed.size(), 5u);
    EXPECT_EQ(load(chain + beam + all + "bodies = [\"chain\", \"beam\"]\n" + all).scene.fixed.size(), 14u);
    const std::string copies = beam + "copies = [2, 1, 1]\npitch = [1, 1, 1]\n";
    EXPECT_EQ(load(copies + all + "bodies = [\"beam\"]\n").scene.fixed.size(), 9u);
    const auto loaded = load(copies + all + "bodies = [\"beam 1\", \"beam 2\"]\n");
    ASSERT_FALSE(loaded.warnings.empty());
    EXPECT_EQ(loaded.warnings[0],
              "hold \"hold\" takes no particle of body \"beam 2\", the nearest is 0.991 m "
              "outside of its half_space");
}

TEST_F(LoadHolds, DriveWhatHasAPath) {
    const auto loaded = load(beam + "[[hold]]\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.05\n"
                                    "[[hold.keyframe]]\ntime = 0\n[[hold.keyframe]]\ntime = 1\n"
                                    "center = [0, 1, 0]\n");
    ASSERT_EQ(loaded.scene.driven.size(), 1u);
    EXPECT_EQ(loaded.scene.driven[0].particles, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(loaded.scene.driven[0].path[1].pose.position.y, 1);
    EXPECT_EQ(loaded.scene.fixed.size(), 1u);
}

TEST_F(LoadHolds, ThatTakeNobodyOrNameNobodyAreRefusedInASentence) {
    expectError(
        beam + "[[hold]]\nname = \"left\"\nshape = \"sphere\"\ncenter = [-1, 0, 0]\nradius = 0.25\n",
        "scene.toml:8: hold[0].shape of hold \"left\" takes no particle: the nearest, of body \"beam\", "
        "is 0.75 m outside of this sphere: move it there, or make it larger");
    expectError(beam + "[[hold]]\nshape = \"sphere\"\nradius = 1\nbodies = [\"baem\"]\n",
                "scene.toml:9: hold[0].bodies names \"baem\", which is no body: did you mean \"beam\"?");
    expectError(beam + "[[hold]]\nshape = \"sphere\"\nradius = 1\nbodies = []\n",
                "scene.toml:9: hold[0].bodies names no body: name some, or leave the key out");
}

// The printed distance suffices: a radius larger by it holds a particle.
TEST_F(LoadHolds, ThatTakeNobodySayAtLeastHowFarTheNearestIs) {
    for (const double x : {-0.12341, -0.12344, -0.50001, -1.0 / 3}) {
        const auto sphere = [&](double radius) {
            return beam + "[[hold]]\nshape = \"sphere\"\ncenter = [" + std::to_string(x) +
                   ", 0, 0]\nradius = " + std::to_string(radius) + "\n";
        };
        const std::string error = errorOfText(sphere(0.05));
        const std::size_t at = error.find(" is ");
        ASSERT_NE(at, std::string::npos) << error;
        EXPECT_EQ(fixedOf(load(sphere(0.05 + std::stod(error.substr(error.find(", is ") + 5))))).size(), 1u)
            << error;
    }
}

TEST_F(LoadHolds, ThatTakeNobodyOfABodyOfOddSizeNameItsUnitFirst) {
    mesh::exportObj(folder_ / "organ.obj", test::tetrahedron(190));
    const std::string mesh = "[[mesh]]\nfile = \"organ.obj\"\nresolution = 8\ncenter = [0, 0, 0]\n",
                      hold = "[[hold]]\nname = \"grip\"\nshape = \"sphere\"\nradius = 0.05\ncenter = [0, "
                             "0.2, 0]\n",
                      cure =
                          "first, the body is 190 m long: if the file is in millimetres, say unit = \"mm\"; "
                          "then, move it there, or make it larger";
    EXPECT_NE(errorOfText(mesh + hold).find(cure), std::string::npos) << errorOfText(mesh + hold);
    EXPECT_EQ(errorOfText(mesh + "unit = \"mm\"\n" + hold).find("first"), std::string::npos);
    const std::string near = "[[hold]]\nshape = \"mesh\"\nfile = \"organ.obj\"\nwithin = 0.01\ncenter = "
                             "[900, 0, 0]\n";
    EXPECT_NE(errorOfText(beam + near).find("first, its mesh is 190 m long: if the file is in millimetres"),
              std::string::npos)
        << errorOfText(beam + near);
}

TEST_F(LoadHolds, ThatTakeAWholeBodyAreNoted) {
    const std::string all = "[[hold]]\nname = \"grip\"\nshape = \"sphere\"\nradius = 3\n",
                      left = "[[hold]]\nname = \"left\"\nshape = \"half_space\"\nnormal = [-1, 0, 0]\n"
                             "offset = -0.15\n",
                      path = "[[hold.keyframe]]\ntime = 0\n[[hold.keyframe]]\ntime = 1\ncenter = [0, 1, 0]\n";
    const auto notes = [&](const std::string& holds) { return load(beam + chain + holds).notes; };
    const std::string only = "bodies = [\"beam\"]\n", is = "body \"beam\" is held completely by hold ";
    EXPECT_EQ(notes(all + only), std::vector<std::string>{is + "\"grip\": it cannot move"});
    EXPECT_EQ(notes(all + only + path),
              std::vector<std::string>{is + "\"grip\": it moves only along the path"});
    EXPECT_TRUE(notes(left + only).empty());
    const std::string right = "[[hold]]\nname = \"right\"\nshape = \"half_space\"\nnormal = [1, 0, 0]\n"
                              "offset = 0.15\nbodies = [\"beam\"]\n";
    EXPECT_EQ(notes(left + only + right),
              std::vector<std::string>{is + "\"left\", \"right\": it cannot move"});
}

TEST_F(LoadHolds, WithKeysOfAnotherShapeAreRefused) {
    const std::string head = beam + "[[hold]]\nshape = ";
    expectError(head + "\"cube\"\n", "scene.toml:7: hold[0].shape is \"cube\": possible are sphere, capsule, "
                                     "box, half_space, mesh");
    expectError(head + "\"sphere\"\n", "scene.toml:6: hold[0].radius is missing: a sphere needs it");
    expectError(head + "\"mesh\"\nwithin = 1\n", "scene.toml:6: hold[0].file is missing: a mesh needs it");
    expectError(head + "\"sphere\"\nradius = 1\nwithin = 1\n",
                "scene.toml:9: hold[0].within is given: a sphere has none: remove it");
    for (const std::string key : {"unit = \"mm\"", "scale = 2", "translation = [0, 0, 0]"})
        expectError(head + "\"sphere\"\nradius = 1\n" + key + "\n",
                    "scene.toml:9: hold[0]." + key.substr(0, key.find(' ')) +
                        " is given: a sphere has none: remove it");
    expectError(head + "\"half_space\"\nnormal = [0, 1, 0]\nradius = 1\n",
                "scene.toml:9: hold[0].radius is given: a half_space has none: remove it");
    expectError(head + "\"half_space\"\nnormal = [0, 0.5, 0]\n",
                "scene.toml:8: hold[0].normal has length 0.5");
    expectError(head + "\"sphere\"\nradius = 1\n[[hold.keyframe]]\ntime = 1\n",
                "scene.toml:9: hold[0].keyframe is a single one, which defines no motion: give at least two, "
                "or none");
}

TEST_F(LoadHolds, ThatDriveOneParticleAlongTwoPathsAreRefused) {
    const std::string path = "[[hold.keyframe]]\ntime = 0\n[[hold.keyframe]]\ntime = 1\ncenter = [0, 1, 0]\n";
    const std::string one = "[[hold]]\nname = \"one\"\nshape = \"sphere\"\nradius = 0.05\n" + path,
                      other = "[[hold]]\nname = \"other\"\nshape = \"sphere\"\nradius = 0.15\n" + path;
    EXPECT_NE(errorOfText(beam + one + other)
                  .find("of hold \"other\" takes particles that hold \"one\" moves along its path"),
              std::string::npos);
    const std::string still = "[[hold]]\nshape = \"sphere\"\nradius = 0.15\n";
    EXPECT_EQ(load(beam + one + still).scene.fixed.size(), 7u) << "up to face diagonals";
    EXPECT_EQ(load(beam + one + still).scene.driven[0].particles.size(), 1u);
}

TEST_F(LoadHolds, AndPinsOfAClothAreOneHold) {
    const std::string cloth = "[[cloth]]\nsize = [3, 3]\nspacing = 0.1\npinned = [\"first_row\"]\n";
    EXPECT_EQ(load(cloth + "[[hold]]\nshape = \"sphere\"\nradius = 0.15\n").scene.fixed.size(), 5u);
}

TEST_F(LoadHolds, BodiesOfEveryKindBeginAsTheirTablesSay) {
    const std::string start = "velocity = [1, 2, 3]\nspin = [0, 0, 2]\n", turned = "rotation = [0, 0, 90]\n";
    for (const std::string& body :
         {"[[cloth]]\nsize = [3, 3]\nspacing = 0.1\n" + turned, chain + turned, beam + turned,
          "[[mesh]]\ngenerate = \"sphere\"\nsize = 0.2\nresolution = 4\n" + turned,
          "[[particles]]\nradius = 0.01\ncount = [2, 2, 2]\n" + turned}) {
        const auto loaded = load(body + start);
        double mass = 0, along = 0;
        for (const sim::Particle& p : loaded.scene.particles) {
            mass += 1 / double{p.inverseMass};
            along += double{p.velocity.z} / double{p.inverseMass};
            EXPECT_NEAR(double{p.velocity.z}, 3, 1e-6);
        }
        EXPECT_NEAR(along, 3 * mass, 1e-5 * mass) << body;
        const sim::Particle &first = loaded.scene.particles.front(), &last = loaded.scene.particles.back();
        EXPECT_NEAR(double{last.velocity.y} - double{first.velocity.y},
                    2 * (double{last.position.x} - double{first.position.x}), 1e-5)
            << body;
    }
    const auto loaded = load(beam + turned); // rotated about its middle, (0.2, 0.1, 0.1)
    EXPECT_NEAR(double{loaded.scene.particles[0].position.x}, 0.3, 1e-6);
    EXPECT_NEAR(double{loaded.scene.particles[0].position.y}, -0.1, 1e-6);
}

} // namespace
