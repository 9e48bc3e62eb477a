// Tests of the inside of tissue in pictures: its rind, its fat, and the walls of a cut.
#include "scene_shot.hpp"

#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace sinew::viewer {
namespace {

// A ball around the origin. A cut at x = 0 parts it into two halves, which fly apart: there is room for
// a camera between them.
struct OpenBall {
    static constexpr float speed = 1; // [m/s]

    OpenBall() : scene(whole()), radius(0.5f * skinBox().sizes().y()), shot(scene, viewOf(scene), quality()) {
        VkCommandBuffer commands = test::queue().begin();
        shot.document.recordReset(commands);
        const std::array<sim::Vec3, 2> from{{{0, 1, -1}, {0, 1, 1}}}, to{{{0, -1, -1}, {0, -1, 1}}};
        shot.document.recordStep(commands, nullptr, {}, {.from = from, .to = to});
        for (int i = 0; i < 100; ++i) shot.document.recordStep(commands);
        test::queue().wait(test::queue().submit(commands));
        EXPECT_LT(moved(-1).x(), -5 * radius);
    }

    static Quality quality() {
        Quality quality = quick;
        quality.samples = VK_SAMPLE_COUNT_1_BIT;
        return quality;
    }
    static sim::Scene whole() {
        sim::Scene scene{.name = "ball", .gravity = {0, 0, 0}};
        mesh::MeshBody body{.name = "ball", .youngModulus = 1e5f, .density = 1050, .isCuttable = true};
        body.voxels.resolution = 12;
        body.color = {0.62f, 0.16f, 0.14f};
        mesh::addMesh(scene, mesh::generate("sphere", 32), body);
        for (sim::Particle& particle : scene.particles)
            particle.velocity = {particle.position.x < 0 ? -speed : speed, 0, 0};
        return scene;
    }
    Box skinBox() const {
        Box box;
        for (const sim::CellEmbedding& cell : scene.skins[0].cells) {
            Vector3 place = Vector3::Zero();
            for (std::size_t k = 0; k < 8; ++k) {
                const sim::Vec3& x = scene.particles[cell.particles[k]].position;
                place += cell.share(k) * Vector3(x.x, x.y, x.z);
            }
            box.extend(place);
        }
        return box;
    }
    // How far the half at that side of x = 0 has moved.
    Vector3 moved(float side) {
        const auto positions =
            test::queue().download<sim::layout::vec4>(shot.document.simulation().positions());
        Vector3 sum = Vector3::Zero();
        float count = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const sim::Vec3& x = scene.particles[i].position;
            if (side * x.x < 0.1f * radius) continue; // those beside the cut are placed by it
            sum += Vector3(positions[i].x, positions[i].y, positions[i].z) - Vector3(x.x, x.y, x.z);
            count += 1;
        }
        return sum / count;
    }
    // Looks straight at a place from that side of x = 0, from a distance in radii.
    Picture lookAt(float side, const Vector3& target, float distance, const Overlay& overlay = {}) {
        shot.camera.azimuth = side * std::numbers::pi_v<float> / 2;
        shot.camera.elevation = 0;
        shot.camera.target = target;
        shot.camera.distance = distance * radius;
        shot.offscreen.prepare(overlay.layers);
        Picture picture = shot.SceneShot::take(0, overlay);
        if (const char* folder = std::getenv("SINEW_PICTURES")) // to look at
            writePng(std::filesystem::path(folder) / ("inside-" + std::to_string(pictures++) + ".png"),
                     picture, {});
        return picture;
    }

    sim::Scene scene;
    float radius;
    SceneShot shot;
    inline static int pictures = 0;
};

// Green / red: of flesh low, of skin and fat high.
float paleness(const Color& color) {
    return static_cast<float>(color[1]) / static_cast<float>(std::max(color[0], 1));
}
bool isFlesh(const Color& color) {
    return paleness(color) < 0.5f;
}

// Along lines from the rim of a face at x = 0 inwards, where the picture shows `offset` + the place at rest.
void expectRind(const Picture& picture, const OpenBall& ball, const Vector3& offset) {
    const float size = 2 * ball.radius;
    int lines = 0, banded = 0, below = 0, fleshy = 0;
    std::vector<float> widths; // [size]
    for (float angle = -0.25f; angle < 0.25f; angle += 0.01f, ++lines) {
        const auto at = [&](float depth) {
            const float r = ball.radius - depth * size;
            return colorAt(picture, ball.shot.camera,
                           offset + r * Vector3(0, std::cos(angle), std::sin(angle)));
        };
        banded += !isFlesh(at(0.006f)) && !isFlesh(at(0.012f)) ? 1 : 0;
        float depth = 0.006f;
        while (depth < 0.08f && !isFlesh(at(depth))) depth += 0.0005f;
        widths.push_back(depth);
        for (float d = 0.035f; d < 0.1f; d += 0.002f, ++below) fleshy += isFlesh(at(d)) ? 1 : 0;
    }
    EXPECT_GE(banded, 0.95 * lines) << "a pale band along the rim";
    EXPECT_GE(fleshy, 0.8 * below) << "flesh below it";
    std::ranges::sort(widths);
    const float median = widths[widths.size() / 2];
    EXPECT_NEAR(median, 0.021f, 0.006f);
    EXPECT_GT(widths[widths.size() / 10], 0.7f * median) << "of even width";
    EXPECT_LT(widths[widths.size() * 8 / 10], 1.3f * median) << "of even width";
}

TEST(Insides, HaveARindOfEvenWidthAlongACut) {
    OpenBall ball;
    const Vector3 moved = ball.moved(-1);
    expectRind(ball.lookAt(1, moved + Vector3(0, 0.9f * ball.radius, 0), 0.9f), ball, moved);
}

TEST(Insides, HaveARindInASection) {
    OpenBall ball;
    const Vector3 moved = ball.moved(-1);
    const float plane = moved.x() - 0.02f * ball.radius;
    const Picture picture = ball.lookAt(1, moved + Vector3(0, 0.9f * ball.radius, 0), 0.9f,
                                        {.layers = {.section = Section{Vector3::UnitX(), plane}}});
    expectRind(picture, ball, Vector3(plane, moved.y(), moved.z()));
}

// The face that is lit: fat is yellow there.
TEST(Insides, HaveLittleFat) {
    OpenBall ball;
    const Vector3 moved = ball.moved(1);
    const Picture picture = ball.lookAt(-1, moved, 3);
    int all = 0, fat = 0, flesh = 0;
    for (float y = -1; y < 1; y += 0.01f)
        for (float z = -1; z < 1; z += 0.01f) {
            if (y * y + z * z > 1) continue;
            const Color color = colorAt(picture, ball.shot.camera, moved + ball.radius * Vector3(0, y, z));
            ++all;
            flesh += isFlesh(color) ? 1 : 0;
            fat += !isFlesh(color) && color[0] > color[1] && 100 * color[2] < 92 * color[1] ? 1 : 0;
        }
    EXPECT_GT(fat, 0.03 * all) << "below its skin alone";
    EXPECT_LT(fat, 0.15 * all);
    EXPECT_GT(flesh, 0.8 * all);
}

TEST(Insides, MatchOnBothWallsOfACut) {
    OpenBall ball;
    const Vector3 left = ball.moved(-1), right = ball.moved(1);
    const Picture ofLeft = ball.lookAt(1, left, 3);
    const Camera toLeft = ball.shot.camera;
    const Picture ofRight = ball.lookAt(-1, right, 3);
    const Camera toRight = ball.shot.camera;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-0.7f, 0.7f);
    std::vector<std::array<float, 2>> seen;
    for (int i = 0; i < 4000; ++i) {
        const Vector3 x = ball.radius * Vector3(0, place(random), place(random));
        seen.push_back(
            {paleness(colorAt(ofLeft, toLeft, left + x)), paleness(colorAt(ofRight, toRight, right + x))});
    }
    std::array<float, 2> mean{}, spread{};
    float common = 0;
    for (const auto& pair : seen)
        for (std::size_t k = 0; k < 2; ++k) mean[k] += pair[k] / static_cast<float>(seen.size());
    for (const auto& pair : seen) {
        for (std::size_t k = 0; k < 2; ++k) spread[k] += (pair[k] - mean[k]) * (pair[k] - mean[k]);
        common += (pair[0] - mean[0]) * (pair[1] - mean[1]);
    }
    EXPECT_GT(common / std::sqrt(spread[0] * spread[1]), 0.8f) << "correlation of the two";
}

TEST(Insides, KnowTheDepthOfPlacesBelowTheirSkin) {
    const sim::Scene scene = OpenBall::whole();
    const SkinDepths all = skinDepths(scene, {true});
    const layout::SkinInside& inside = all.skins[0];
    const int nx = static_cast<int>(inside.nodes.x), ny = static_cast<int>(inside.nodes.y),
              nz = static_cast<int>(inside.nodes.z);
    ASSERT_EQ(all.depths.size(), static_cast<std::size_t>(nx * ny * nz));
    const float spacing = inside.low.w, radius = 0.5f * inside.size.x;
    int near = 0;
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x) {
                const Vector3 place =
                    Vector3(inside.low.x, inside.low.y, inside.low.z) +
                    spacing * Vector3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
                const float depth = radius - place.norm(),
                            found = all.depths[static_cast<std::size_t>(x + nx * (y + ny * z))];
                if (std::abs(depth) < 1.8f * spacing) {
                    EXPECT_NEAR(found, depth, 0.2f * spacing);
                    ++near;
                } else if (depth > 0) {
                    EXPECT_GE(found, 1.7f * spacing) << "the ball has edges";
                }
            }
    EXPECT_GT(near, 1000);
    EXPECT_EQ(skinDepths(scene, {false}).skins[0].nodes.w, -1) << "of rubber";
    EXPECT_FLOAT_EQ(skinDepths(scene, {false}).skins[0].size.x, inside.size.x);
    sim::Scene firm = scene;
    firm.grids[0].isCuttable = false;
    EXPECT_EQ(skinDepths(firm, {true}).skins[0].nodes.w, -1) << "of what cannot be cut";
}

} // namespace
} // namespace sinew::viewer
