// Tests of scene files with particle contacts: colliding bodies, loose particles, [contacts].
#include "scenes/load_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace sinew;
namespace fs = std::filesystem;
using test::smallCloth;

namespace {

class LoadContacts : public test::LoadFixture {};

const std::string box = "[[box]]\nparticles = [3, 4, 5]\nspacing = 0.1\ncenter = [0, 1, 0]\n";
const std::string balls = "[[particles]]\nradius = 0.05\ncount = [2, 3, 4]\n";

double nearest(const sim::Scene& scene) {
    double least = INFINITY;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const sim::Vec3 &a = scene.particles[i].position, &b = scene.particles[j].position;
            least = std::min(least, std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z));
        }
    return least;
}

std::set<std::uint32_t> surfacesOf(const sim::Scene& scene) {
    std::set<std::uint32_t> surfaces;
    for (const sim::Particle& particle : scene.particles) surfaces.insert(particle.surface);
    return surfaces;
}

std::set<float> radiiOf(const sim::Scene& scene) {
    std::set<float> radii;
    for (const sim::Particle& particle : scene.particles) radii.insert(particle.radius);
    return radii;
}

} // namespace

TEST_F(LoadContacts, GivesParticlesOfABodyARadiusOnlyWhereItCollides) {
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n";
    for (const std::string& body : {smallCloth, box, mesh}) {
        EXPECT_EQ(radiiOf(load(body).scene), std::set<float>{0}) << body;
        EXPECT_EQ(radiiOf(load(body + "collides = false\n").scene), std::set<float>{0}) << body;
    }
    EXPECT_EQ(radiiOf(load(smallCloth + "collides = true\n").scene), std::set<float>{0.05f});
    EXPECT_EQ(radiiOf(load(box + "collides = true\n").scene), std::set<float>{0.05f});
    EXPECT_EQ(radiiOf(load(mesh + "collides = true\n").scene), std::set<float>{0.125f});
    EXPECT_EQ(radiiOf(load(box + "collides = true\nradius = 0.03\n").scene), std::set<float>{0.03f});
    EXPECT_EQ(radiiOf(load(smallCloth + "collides = true\nradius = 0.01\n").scene), std::set<float>{0.01f});
}

// The pieces of a cut must not fall through each other. Only `split` supports contacts and cuts.
TEST_F(LoadContacts, LetsWhatIsCuttableCollideByDefault) {
    const std::string mesh =
        "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\ncuttable = true\n";
    for (const auto& [body, radius] :
         {std::pair{smallCloth + "cuttable = true\n", 0.05f}, std::pair{box + "cuttable = true\n", 0.05f},
          std::pair{mesh, 0.125f}}) {
        EXPECT_EQ(radiiOf(load(body).scene), std::set<float>{radius}) << body;
        EXPECT_EQ(radiiOf(load(body + "collides = false\n").scene), std::set<float>{0}) << body;
        EXPECT_TRUE(load(body + "collides = false\n").scene.grids[0].isCuttable);
        scenes::Overrides jacobi;
        jacobi.solver = "jacobi";
        EXPECT_EQ(radiiOf(scenes::load(write("other.toml", body), jacobi).scene), std::set<float>{0}) << body;
    }
    const scenes::LoadedScene thick = load(smallCloth + "thickness = 0.02\ncuttable = true\n");
    EXPECT_EQ(radiiOf(thick.scene), std::set<float>{0.01f})
        << "a sheet with a thickness touches by its faces";
    EXPECT_FALSE(thick.scene.faces.empty());
}

// Covers all shipped scenes with cuttable bodies.
TEST_F(LoadContacts, LetsAllCuttableBodiesOfTheScenesTouch) {
    std::size_t count = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(SINEW_SOURCE_FOLDER "/scenes")) {
        if (file.path().extension() != ".toml") continue;
        if (file.path().stem() == "drop_mesh") continue; // needs the mesh of the command line
        const scenes::LoadedScene loaded = scenes::load(file.path());
        if (loaded.settings.solver != sim::Solver::split) continue;
        for (const sim::Grid& grid : loaded.scene.grids) {
            if (!grid.isCuttable) continue;
            ++count;
            const auto first = loaded.scene.particles.begin() + grid.firstParticle;
            const auto touching =
                std::count_if(first, first + static_cast<std::ptrdiff_t>(grid.node.size()),
                              [](const sim::Particle& particle) { return particle.radius > 0; });
            EXPECT_EQ(touching, static_cast<std::ptrdiff_t>(grid.node.size())) << file.path().filename();
        }
    }
    EXPECT_GT(count, 3u);
}

TEST_F(LoadContacts, TakesRestContactOfABodyOrOfAll) {
    const auto keeping = [&](const std::string& text) {
        std::set<bool> keeps;
        for (const sim::Particle& particle : load(text).scene.particles) keeps.insert(particle.keepsRest);
        return keeps;
    };
    const std::string body = box + "collides = true\n", keep = "rest_contact = \"keep\"\n";
    EXPECT_EQ(keeping(body), std::set<bool>{false});
    EXPECT_EQ(keeping(body + keep), std::set<bool>{true});
    EXPECT_EQ(keeping(body + keep + balls), (std::set<bool>{false, true}));
    EXPECT_EQ(keeping(body + balls + "[contacts]\n" + keep), std::set<bool>{true});
    EXPECT_EQ(keeping(body + "rest_contact = \"part\"\n" + balls + "[contacts]\n" + keep),
              (std::set<bool>{false, true}));
    expectError(body + "rest_contact = \"stay\"\n",
                "scene.toml:6: box[0].rest_contact is \"stay\": possible are keep, part");
    expectError(box + keep, "scene.toml:5: box[0].rest_contact is given, but the body touches nothing: write "
                            "collides = true");
    expectError("[solver]\nname = \"jacobi\"\n" + box + "cuttable = true\n" + keep,
                "scene.toml:8: box[0].rest_contact is given, but the body touches nothing: only the solver "
                "split has contacts");
}

TEST_F(LoadContacts, RefusesRadiiThatABodyCannotHave) {
    expectError(
        box + "collides = true\nradius = 0.051\n",
        "scene.toml:6: box[0].radius is more than half of the spacing: linked particles would overlap");
    expectError(
        smallCloth + "radius = 0.05\n",
        "scene.toml:4: cloth[0].radius is given, but the body touches nothing: write collides = true");
    expectError(box + "collides = 1\n",
                "scene.toml:5: box[0].collides is the whole number 1: write true or false");
    expectError(box + "collides = \"yes\"\n", "scene.toml:5: box[0].collides is text \"yes\": write true");
    expectError(box + "collides = true\nradius = 0\n",
                "scene.toml:6: box[0].radius is 0 m: must be above 0 and at most");
}

TEST_F(LoadContacts, GivesFacesToClothWithAThickness) {
    EXPECT_TRUE(load(smallCloth).scene.faces.empty());
    const sim::Scene scene = load(smallCloth + "thickness = 0.04\n").scene;
    const auto [columns, middle, rows] = scene.grids.at(0).nodes;
    ASSERT_EQ(scene.faces.size(), std::size_t{2} * (columns - 1) * (rows - 1));
    for (const sim::Face& face : scene.faces) EXPECT_EQ(face.thickness, 0.02f);
    EXPECT_EQ(radiiOf(scene), std::set<float>{0.02f});
    EXPECT_EQ(scene.particles[0].contactOffset, 0.02f);
    expectError(smallCloth + "thickness = 0.04\ncollides = true\n",
                "scene.toml:4: cloth[0].thickness is given beside collides: leave one of them out");
    expectError(smallCloth + "thickness = 0\n", "scene.toml:4: cloth[0].thickness is 0 m: must be above 0");
}

TEST_F(LoadContacts, MakesMeshesThatNeverMoveFaces) {
    const std::string mesh =
        "[[mesh_collider]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 0.5\ncenter = [0, 2, 0]\n";
    const sim::Scene scene = load(balls + mesh + "thickness = 0.01\n").scene;
    ASSERT_EQ(scene.bodies.size(), 2u);
    EXPECT_EQ(scene.bodies[1].name, "sphere");
    ASSERT_GT(scene.faces.size(), 100u);
    for (const sim::Face& face : scene.faces) {
        EXPECT_EQ(face.thickness, 0.01f);
        for (const std::uint32_t corner : face.particles) {
            const sim::Particle& particle = scene.particles.at(corner);
            EXPECT_EQ(particle.inverseMass, 0);
            EXPECT_NEAR(std::hypot(particle.position.x, particle.position.y - 2, particle.position.z), 0.25,
                        0.01);
        }
    }
    expectError(balls + "[[mesh_collider]]\n", "scene.toml:4: mesh_collider[0].file is missing");
    expectError(balls + "[[mesh_collider]]\nfile = \"../x.obj\"\n",
                "scene.toml:5: mesh_collider[0].file leaves the scene's folder");
    expectError(balls + mesh + "thickness = -1\n",
                "scene.toml:9: mesh_collider[0].thickness is -1 m: must be above 0");
    expectError(balls + mesh + "[solver]\nname = \"jacobi\"\n",
                "scene.toml: solver jacobi does not support particles that touch");
}

TEST_F(LoadContacts, ReadsThePathOfAMeshCollider) {
    const std::string knot = "[[particles]]\nradius = 0.01\ncenter = [0, 3, 0]\n[[mesh_collider]]\ngenerate "
                             "= \"sphere\"\ndetail = 8\n"
                             "size = 0.5\ncenter = [0, 2, 0]\n";
    const sim::Scene still = load(knot).scene;
    EXPECT_TRUE(still.driven.empty());
    const sim::Scene scene =
        load(knot + "path_end = \"loop\"\n[[mesh_collider.keyframe]]\ntime = 0\ncenter = [1, 2, 0]\n"
                    "[[mesh_collider.keyframe]]\ntime = 2\nrotation = [0, 90, 0]\n"
                    "[[mesh_collider.keyframe]]\ntime = 3\ncenter = [1, 2, 0]\n")
            .scene;
    ASSERT_EQ(scene.driven.size(), 1u);
    const sim::DrivenBody& body = scene.driven[0];
    EXPECT_EQ(body.firstParticle, scene.bodies[1].firstParticle);
    EXPECT_EQ(body.particleCount, scene.bodies[1].particleCount);
    EXPECT_EQ(body.pathEnd, sim::PathEnd::loop);
    ASSERT_EQ(body.path.size(), 3u);
    EXPECT_EQ(body.path[1].time, 2);
    EXPECT_EQ(body.path[1].pose.position.x, 0);
    EXPECT_NEAR(body.path[1].pose.rotation.y, std::sqrt(0.5), 1e-6);
    for (std::uint32_t i = body.firstParticle; i < scene.particles.size(); ++i) {
        EXPECT_NEAR(scene.particles[i].position.x, still.particles[i].position.x + 1, 1e-6);
        EXPECT_NEAR(scene.particles[i].position.y, still.particles[i].position.y, 1e-6);
    }
    expectError(knot + "[[mesh_collider.keyframe]]\ntime = 0\n[[mesh_collider.keyframe]]\ntime = 1\nrotation "
                       "= [0, 0, 175]\n",
                "scene.toml:13: mesh_collider[0].keyframe[1].rotation is more than 170 degrees from the "
                "keyframe before");
}

TEST_F(LoadContacts, RepeatsABoxInRows) {
    const std::string corner = "[[box]]\nparticles = [2, 2, 2]\nspacing = 0.1\norigin = [1, 2, 3]\n";
    const sim::Scene one = load(corner).scene, six = load(corner + "copies = [1, 2, 3]\n").scene;
    ASSERT_EQ(six.skins.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) // copies along y and z, every second one darker
        EXPECT_EQ(six.skins[i].color.x,
                  (i / 3 + i % 3) % 2 == 0 ? one.skins[0].color.x : 0.7f * one.skins[0].color.x)
            << i;
    EXPECT_EQ(one.bodies[0].name, "box");
    ASSERT_EQ(six.bodies.size(), 6u);
    EXPECT_EQ(six.skins.size(), 6u);
    EXPECT_EQ(six.grids.size(), 6u);
    EXPECT_EQ(six.bodies[0].name, "box 1");
    EXPECT_EQ(six.bodies[5].name, "box 6");
    EXPECT_EQ(six.particles[0].position.z, 3);
    EXPECT_FLOAT_EQ(six.particles[8].position.z, 3.3f) << "the side and two spacings further";
    EXPECT_FLOAT_EQ(six.particles[24].position.y, 2.3f);
    const sim::Scene row =
        load("[[box]]\nparticles = [3, 2, 2]\nspacing = 0.1\ncenter = [0, 1, 0]\ncopies = [3, 1, 1]\n"
             "pitch = [0.5, 0, 0]\nclamped = [\"low_x\"]\n")
            .scene;
    EXPECT_FLOAT_EQ(row.particles[0].position.x, -0.6f) << "all of them are about the center";
    EXPECT_FLOAT_EQ(row.particles[24].position.x, 0.4f);
    EXPECT_EQ(row.fixed.size(), 12u);
    expectError(corner + "copies = [0, 1, 1]\n", "scene.toml:5: box[0].copies is 0: must be from 1 to 4096");
    expectError(corner + "copies = [4096, 4096, 1]\n",
                "scene.toml:2: box[0].particles brings the scene to 16000008 particles: at most 2000000");
}

TEST_F(LoadContacts, PutsLooseParticlesInRows) {
    const sim::Scene scene = load(balls + "name = \"b\"\ncenter = [1, 2, 3]\nspacing = 0.2\nmass = 0.5\n"
                                          "velocity = [1, 2, 3]\ncolor = [0.1, 0.2, 0.3]\n")
                                 .scene;
    ASSERT_EQ(scene.particles.size(), 24u);
    EXPECT_TRUE(scene.skins.empty());
    EXPECT_TRUE(scene.distances.empty());
    ASSERT_EQ(scene.bodies.size(), 1u);
    EXPECT_EQ(scene.bodies[0].name, "b");
    EXPECT_EQ(scene.bodies[0].particleCount, 24u);
    EXPECT_EQ(scene.bodies[0].color.z, 0.3f);
    const sim::Particle &first = scene.particles.front(), &last = scene.particles.back();
    EXPECT_FLOAT_EQ(first.position.x, 0.9f);
    EXPECT_FLOAT_EQ(first.position.y, 1.8f);
    EXPECT_FLOAT_EQ(last.position.y, 2.2f);
    EXPECT_FLOAT_EQ(last.position.z, 3.3f);
    EXPECT_EQ(first.inverseMass, 2);
    EXPECT_EQ(first.velocity.y, 2);
    EXPECT_EQ(first.radius, 0.05f);
    EXPECT_EQ(first.contactOffset, 0.05f) << "planes are as far off as other balls";
    EXPECT_NEAR(nearest(scene), 0.2, 1e-6);
}

TEST_F(LoadContacts, WeighsABallByItsDensity) {
    const double ball = 4.0 / 3 * std::numbers::pi * std::pow(0.05, 3);
    EXPECT_NEAR(1 / load(balls).scene.particles[0].inverseMass, 1000 * ball, 1e-6);
    EXPECT_NEAR(1 / load(balls + "density = 500\n").scene.particles[0].inverseMass, 500 * ball, 1e-6);
}

TEST_F(LoadContacts, MovesLooseParticlesOffTheirPlacesBySeedAndNeverIntoEachOther) {
    const auto at = [&](const std::string& keys) { return load(balls + "jitter = 0.02\n" + keys).scene; };
    const sim::Scene scene = at("");
    EXPECT_GE(nearest(scene), 0.1 * (1 - 1e-6));
    EXPECT_EQ(at("").particles[7].position.x, scene.particles[7].position.x);
    EXPECT_NE(at("seed = 2\n").particles[7].position.x, scene.particles[7].position.x);
    double most = 0;
    for (std::uint32_t i = 0; i < 24; ++i) {
        const float place = i % 2 == 0 ? -0.07f : 0.07f; // spacing 2 (0.05 + 0.02)
        most = std::max(most, std::abs(double{scene.particles[i].position.x} - double{place}));
    }
    EXPECT_LE(most, 0.02 + 1e-6);
    EXPECT_GE(most, 0.015) << "of 24 places one is far off";
}

TEST_F(LoadContacts, ScattersLooseParticlesInACuboid) {
    const std::string random =
        "[[particles]]\nradius = 0.05\nrandom = 200\nsize = [1, 0.5, 1]\ncenter = [0, 2, 0]\n";
    const sim::Scene scene = load(random).scene;
    ASSERT_EQ(scene.particles.size(), 200u);
    EXPECT_GE(nearest(scene), 0.1 * (1 - 1e-6));
    for (const sim::Particle& particle : scene.particles) {
        EXPECT_LE(std::abs(particle.position.x), 0.45f);
        EXPECT_LE(std::abs(particle.position.y - 2), 0.2f + 1e-6f);
    }
    EXPECT_EQ(load(random).scene.particles[99].position.z, scene.particles[99].position.z);
    expectError(
        "[[particles]]\nradius = 0.05\nrandom = 2000\nsize = [1, 0.5, 1]\n",
        "scene.toml:3: particles[0].random cannot be placed: particles \"particles\": no place is free "
        "for number ");
}

TEST_F(LoadContacts, RefusesLooseParticlesThatSayTooMuchOrTooLittle) {
    expectError("[[particles]]\n", "scene.toml:1: particles[0].radius is missing");
    expectError(
        balls + "spacing = 0.09\n",
        "scene.toml:4: particles[0].spacing lets neighbours overlap: must be at least 2 (radius + jitter)");
    expectError(balls + "mass = 1\ndensity = 1\n", "scene.toml:5: particles[0].density is given beside mass");
    expectError(balls + "size = [1, 1, 1]\n", "scene.toml:4: particles[0].size is the cuboid of random");
    expectError(balls + "random = 9\nsize = [1, 1, 1]\n",
                "scene.toml:3: particles[0].count is given beside random");
    expectError("[[particles]]\nradius = 0.05\nrandom = 9\n",
                "scene.toml:3: particles[0].random has no cuboid");
    expectError("[[particles]]\nradius = -1\n", "scene.toml:2: particles[0].radius is -1 m: must be above 0");
    expectError("[[particles]]\nradius = 1e-15\n",
                "scene.toml:2: particles[0].radius makes balls of a mass that float32 cannot hold");
    expectError("[[particles]]\nradius = 0.05\ncount = [2000, 2000, 2]\n",
                "scene.toml:3: particles[0].count brings the scene to 8000000 particles");
    expectError("[[particles]]\nradius = 0.05\ncount = [0, 2, 2]\n",
                "scene.toml:3: particles[0].count is 0 particles: must be from 1 to 4096");
}

TEST_F(LoadContacts, GivesBodiesSurfacesOfTheirOwn) {
    const std::string mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\n";
    for (const std::string& body :
         {smallCloth + "collides = true\n", box + "collides = true\n", mesh + "collides = true\n", balls}) {
        EXPECT_EQ(surfacesOf(load(body).scene), std::set<std::uint32_t>{0}) << body;
        EXPECT_TRUE(load(body).scene.contacts.surfaces.empty()) << body;
        const sim::Scene scene =
            load(body + "restitution = 0.75\n[contacts]\nfriction = 0.25\nrestitution = 0.5\n").scene;
        EXPECT_EQ(surfacesOf(scene), std::set<std::uint32_t>{1}) << body;
        ASSERT_EQ(scene.contacts.surfaces.size(), 1u) << body;
        EXPECT_EQ(scene.contacts.surfaces[0].friction, 0.25f) << "as in [contacts]: " << body;
        EXPECT_EQ(scene.contacts.surfaces[0].restitution, 0.75f) << body;
    }
    const sim::Scene scene = load(box + "collides = true\ncopies = [2, 1, 1]\nfriction = 0.5\n" + balls +
                                  "friction = 0.125\nrestitution = 1\n" + balls + "friction = 0.5\n" + balls +
                                  "friction = 0.25\n[contacts]\nfriction = 0.25\n")
                                 .scene;
    ASSERT_EQ(scene.contacts.surfaces.size(), 2u) << "equal ones are one";
    EXPECT_EQ(scene.contacts.surfaces[1].friction, 0.125f);
    EXPECT_EQ(scene.contacts.surfaces[1].restitution, 1);
    const auto surfaceOf = [&](std::size_t body) {
        return scene.particles[scene.bodies.at(body).firstParticle].surface;
    };
    const std::uint32_t expected[] = {1, 1, 2, 1, 0};
    for (std::size_t body = 0; body < 5; ++body) EXPECT_EQ(surfaceOf(body), expected[body]) << body;
}

TEST_F(LoadContacts, GivesWhatRestsAFrictionOfItsOwn) {
    const sim::Scene scene = load(balls + "static_friction = 0.5\n" + balls + "friction = 0.125\n" + balls +
                                  "restitution = 1\n[[plane]]\nfriction = 0.25\nstatic_friction = 0.75\n" +
                                  "[contacts]\nfriction = 0.25\nstatic_friction = 0.375\n")
                                 .scene;
    EXPECT_EQ(scene.contacts.staticFriction, 0.375f);
    EXPECT_EQ(scene.planes[0].staticFriction, 0.75f);
    ASSERT_EQ(scene.contacts.surfaces.size(), 3u);
    EXPECT_EQ(scene.contacts.surfaces[0].friction, 0.25f) << "as in [contacts]";
    EXPECT_EQ(scene.contacts.surfaces[0].staticFriction, 0.5f);
    EXPECT_EQ(scene.contacts.surfaces[1].staticFriction, 0) << "its own friction, then";
    EXPECT_EQ(scene.contacts.surfaces[2].staticFriction, 0.375f) << "as in [contacts]";
    expectError(balls + "static_friction = -1\n",
                "scene.toml:4: particles[0].static_friction is -1: must be at least 0");
    expectError(balls + "[contacts]\nstatic_friction = -1\n",
                "scene.toml:5: contacts.static_friction is -1: must be at least 0");
    expectError(balls + "[[plane]]\nstatic_friction = -1\n",
                "scene.toml:5: plane[0].static_friction is -1: must be at least 0");
    expectError(box + "static_friction = 0.5\n",
                "scene.toml:5: box[0].static_friction is given, but the body touches nothing");
}

TEST_F(LoadContacts, GivesSurfacesToFaces) {
    const sim::Scene scene =
        load(smallCloth + "thickness = 0.04\nfriction = 0.5\n" +
             "[[mesh_collider]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 0.5\nrestitution = 0.25\n")
            .scene;
    ASSERT_EQ(scene.contacts.surfaces.size(), 2u);
    EXPECT_EQ(scene.contacts.surfaces[0].friction, 0.5f);
    EXPECT_EQ(scene.contacts.surfaces[1].restitution, 0.25f);
    for (std::size_t body = 0; body < 2; ++body)
        EXPECT_EQ(scene.particles[scene.bodies.at(body).firstParticle].surface, body + 1);
    expectError(balls + "[[mesh_collider]]\ngenerate = \"sphere\"\nfriction = -1\n",
                "scene.toml:6: mesh_collider[0].friction is -1: must be at least 0");
}

TEST_F(LoadContacts, RefusesSurfacesOfWhatHasNone) {
    expectError(
        box + "friction = 0.5\n",
        "scene.toml:5: box[0].friction is given, but the body touches nothing: write collides = true");
    expectError(smallCloth + "restitution = 0.5\n",
                "scene.toml:4: cloth[0].restitution is given, but the body touches nothing");
    expectError(balls + "friction = -0.5\n",
                "scene.toml:4: particles[0].friction is -0.5: must be at least 0");
    expectError(balls + "restitution = 1.5\n",
                "scene.toml:4: particles[0].restitution is 1.5: must be from 0 to 1");
    expectError(balls + "friction = \"rough\"\n", "scene.toml:4: particles[0].friction is text \"rough\"");
    std::string many;
    for (int i = 0; i < 64; ++i) many += balls + "friction = 0." + std::to_string(100 + i) + "\n";
    EXPECT_EQ(load(many).scene.contacts.surfaces.size(), 64u);
    many += balls + "friction = 0.5\n";
    expectError(many,
                "scene.toml:260: particles[64].friction makes more than 64 different surfaces: let bodies");
}

// Four words of memory a candidate: a storage buffer holds 128 MiB on every Vulkan device.
TEST_F(LoadContacts, LeavesRoomForCandidatesThatEveryDeviceHas) {
    const scenes::LoadedScene many =
        load("[[particles]]\nradius = 0.01\nspacing = 0.03\ncount = [100, 100, 120]\n");
    EXPECT_EQ(many.settings.contactRoom, 6u);
    const scenes::LoadedScene wide =
        load("[[cloth]]\nsize = [700, 700]\nspacing = 0.01\nthickness = 0.005\n");
    EXPECT_EQ(wide.settings.contactRoom, 4u) << "edges, three a particle";
}

TEST_F(LoadContacts, TakesWhatHoldsForAllFromTheirTable) {
    const scenes::LoadedScene plain = load(balls);
    EXPECT_EQ(plain.scene.contacts.friction, 0);
    EXPECT_EQ(plain.scene.contacts.restitution, 0);
    EXPECT_EQ(plain.scene.contacts.recoverySpeed, sim::ContactSettings{}.recoverySpeed);
    EXPECT_EQ(plain.settings.contactMargin, sim::Settings{}.contactMargin);
    EXPECT_EQ(plain.settings.contactRoom, sim::Settings{}.contactRoom);
    const scenes::LoadedScene loaded =
        load(balls + "[contacts]\nfriction = 0.25\nrestitution = 0.5\nrecovery_speed = 2\nmargin = 0.75\n"
                     "room = 40\n");
    EXPECT_EQ(loaded.scene.contacts.friction, 0.25f);
    EXPECT_EQ(loaded.scene.contacts.restitution, 0.5f);
    EXPECT_EQ(loaded.scene.contacts.recoverySpeed, 2);
    EXPECT_EQ(loaded.settings.contactMargin, 0.75f);
    EXPECT_EQ(loaded.settings.contactRoom, 40u);
    expectError(balls + "[contacts]\nfriction = -1\n",
                "scene.toml:5: contacts.friction is -1: must be at least 0");
    expectError(balls + "[contacts]\nrestitution = 1.1\n",
                "scene.toml:5: contacts.restitution is 1.1: must be from 0 to 1");
    expectError(balls + "[contacts]\nrecovery_speed = 0\n",
                "scene.toml:5: contacts.recovery_speed is 0 m/s: must be above 0");
    expectError(balls + "[contacts]\nmargin = 0\n",
                "scene.toml:5: contacts.margin is 0 median radii: must be above 0 and at most 10");
    expectError(balls + "[contacts]\nroom = 1025\n",
                "scene.toml:5: contacts.room is 1025 candidates: must be from 1");
    expectError(balls + "[solver]\nname = \"jacobi\"\n",
                "scene.toml: solver jacobi does not support particles that touch each other");
}

TEST_F(LoadContacts, ReadsEveryShippedSceneOfContacts) {
    struct Expected {
        const char* name;
        std::size_t particles, bodies;
    };
    for (const auto& [name, particles, bodies] :
         {Expected{"clutter", 1000, 1}, Expected{"clutter_bodies", 25 * (125 + 256 + 160 + 216), 100},
          Expected{"stack", 5 * 512, 5}, Expected{"pile_8000", 8000, 1}, Expected{"pile_100k", 100'000, 1}}) {
        const scenes::LoadedScene file =
            scenes::load(fs::path(SINEW_SOURCE_FOLDER "/scenes") / (std::string(name) + ".toml"));
        EXPECT_EQ(file.scene.name, name);
        EXPECT_EQ(file.scene.particles.size(), particles) << name;
        EXPECT_EQ(file.scene.bodies.size(), bodies) << name;
        EXPECT_TRUE(file.warnings.empty()) << name << ": " << file.warnings.front();
        EXPECT_EQ(radiiOf(file.scene).size(), 1u);
        EXPECT_GT(*radiiOf(file.scene).begin(), 0);
        EXPECT_TRUE(file.camera.has_value());
        EXPECT_EQ(scenes::loadBuiltIn(name).scene.particles.size(), particles) << name;
    }
}

// A body has faces if an object smaller than the gaps between its particles collides, or if the file requests
// them.
TEST_F(LoadContacts, GivesVoxelBodiesFacesWhereTheyNeedThem) {
    const std::string
        touching = box + "collides = true\n",
        small = "[[particles]]\nradius = 0.02\n",
        mesh = "[[mesh]]\ngenerate = \"sphere\"\ndetail = 8\nsize = 1\nvoxel = 0.25\ncollides = true\n";
    const auto faces = [&](const std::string& text) { return load(text).scene.faces.size(); };
    const std::size_t all = 2 * 2 * (2 * 3 + 3 * 4 + 4 * 2);
    EXPECT_EQ(faces(touching), 0u);
    EXPECT_EQ(faces(touching + "faces = true\n"), all);
    EXPECT_EQ(faces(touching + small), all);
    EXPECT_EQ(faces(touching + "faces = false\n" + small), 0u);
    EXPECT_EQ(faces(touching + balls), 0u) << "too wide to pass";
    EXPECT_EQ(faces(box + small), 0u) << "touches nothing";
    EXPECT_EQ(faces(touching + "copies = [2, 1, 1]\nfaces = true\n"), 2 * all);
    EXPECT_EQ(faces(mesh), 0u);
    EXPECT_GT(faces(mesh + balls), 0u) << "coarser voxels";
    expectError(box + "faces = true\n",
                "scene.toml:5: box[0].faces is given, but the body touches nothing: write collides = true");
}
