// Draws an organ with its own texture, a checker, and cuts it: texture coordinates of the skin, of the pieces
// beside the cut, and solid ones inside. It reads the buffers as a vertex shader would, and fills triangles
// on the host, so that it needs no window. Writes both pictures, side by side, as a PPM file.
//   checker [FILE]    checker.ppm by default
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/device.hpp"
#include "sinew/vk/loader.hpp"
#include "sinew/vk/queue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace {

using namespace sinew;
using Indices = std::vector<std::uint32_t>;

constexpr std::uint32_t size = 480; // of a picture [pixels]

struct Vertex { // as SINEW_SKIN_VERTICES
    float position[4], normal[4];
};
struct CutPoint { // the first of 64 bytes is the place in the uncut body
    float rest[4];
    std::uint32_t others[12];
};
struct Draw { // VkDrawIndexedIndirectCommand
    std::uint32_t indexCount, instanceCount, firstIndex;
    std::int32_t vertexOffset;
    std::uint32_t firstInstance;
};

// A texture around the longest axis, with one seam.
void addTexture(mesh::TriangleMesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
        sim::TextureCorners& at = mesh.textureCoordinates.emplace_back();
        for (std::size_t n = 0; n < 3; ++n) {
            const sim::Vec3& x = mesh.positions[triangle[n]];
            at[n] = {std::atan2(x.z, x.y) / (2 * std::numbers::pi_v<float>), 3 * x.x};
        }
        for (std::size_t n = 1; n < 3; ++n)
            if (std::abs(at[n].u - at[0].u) > 0.5f) at[n].u += at[0].u > 0 ? 1.0f : -1.0f;
    }
}

struct Color {
    float r = 1, g = 1, b = 1;
};

Color skinColor(float u, float v, float) {
    const bool isLight =
        (static_cast<int>(std::floor(16 * u)) + static_cast<int>(std::floor(10 * v))) % 2 == 0;
    if (std::abs(u - 0.5f) < 0.01f || std::abs(u + 0.5f) < 0.01f)
        return {0.1f, 0.2f, 0.8f}; // beside the seam
    return isLight ? Color{0.95f, 0.85f, 0.75f} : Color{0.55f, 0.15f, 0.12f};
}

// Cubes of the uncut body.
Color insideColor(float x, float y, float z) {
    const auto cube = [](float at) { return static_cast<int>(std::floor(at / 0.03f)); };
    return (cube(x) + cube(y) + cube(z)) % 2 == 0 ? Color{0.85f, 0.8f, 0.35f} : Color{0.45f, 0.42f, 0.2f};
}

struct Corner {
    const Vertex* vertex = nullptr;
    std::array<float, 3> texture{}; // u, v or a place in the body
};

class Picture {
public:
    Picture() : pixels_(size * size), depths_(size * size, -1e30f) {}

    template <typename ColorAt> void draw(const std::array<Corner, 3>& corners, const ColorAt& colorAt) {
        std::array<std::array<float, 3>, 3> at{};
        for (std::size_t n = 0; n < 3; ++n) at[n] = seen(corners[n].vertex->position);
        const float area = cross(at[0], at[1], at[2]);
        if (area == 0) return;
        const auto bounds = [&](std::size_t axis) {
            const auto [low, high] = std::minmax({at[0][axis], at[1][axis], at[2][axis]});
            return std::pair(std::max(0, static_cast<int>(low)),
                             std::min<int>(size - 1, static_cast<int>(high) + 1));
        };
        const auto [left, right] = bounds(0);
        const auto [top, bottom] = bounds(1);
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                const std::array<float, 3> pixel{static_cast<float>(x), static_cast<float>(y), 0};
                const std::array<float, 3> weights{cross(pixel, at[1], at[2]) / area,
                                                   cross(at[0], pixel, at[2]) / area,
                                                   cross(at[0], at[1], pixel) / area};
                if (std::ranges::min(weights) < 0) continue;
                std::array<float, 7> value{}; // depth, normal, texture
                for (std::size_t n = 0; n < 3; ++n) {
                    value[0] += weights[n] * at[n][2];
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        value[1 + axis] += weights[n] * corners[n].vertex->normal[axis];
                        value[4 + axis] += weights[n] * corners[n].texture[axis];
                    }
                }
                float& depth = depths_[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)];
                if (value[0] <= depth) continue;
                depth = value[0];
                const float light =
                    0.35f + 0.65f * std::max(0.0f, 0.3f * value[1] + 0.7f * value[2] + 0.65f * value[3]);
                const Color color = colorAt(value[4], value[5], value[6]);
                pixels_[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)] = {
                    light * color.r, light * color.g, light * color.b};
            }
    }

    void writeRow(std::ostream& to, std::uint32_t y) const {
        for (std::uint32_t x = 0; x < size; ++x) {
            const Color& color = pixels_[std::size_t{y} * size + x];
            for (const float value : {color.r, color.g, color.b})
                to.put(static_cast<char>(static_cast<unsigned char>(255 * std::clamp(value, 0.0f, 1.0f))));
        }
    }

    // Whether both colors of the skin have about half of its pixels, and the inside is seen as asked.
    bool isChecker(bool showsInside) const {
        int light = 0, dark = 0, inside = 0;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            if (depths_[i] < -1e29f) continue;
            const Color& color = pixels_[i];
            const bool isInside = color.b < 0.6f * color.g;
            inside += isInside ? 1 : 0;
            light += !isInside && color.g > 0.8f * color.r ? 1 : 0;
            dark += !isInside && color.g < 0.4f * color.r ? 1 : 0;
        }
        return 3 * light > 2 * dark && 3 * dark > 2 * light && light > 5000 &&
               (showsInside ? 50 * inside > light + dark : inside == 0);
    }

private:
    // Turned by 35 degrees about y and tilted: pixels, and the distance towards the eye.
    static std::array<float, 3> seen(const float (&x)[4]) {
        const float right = 0.82f * x[0] - 0.57f * x[2], ahead = 0.57f * x[0] + 0.82f * x[2];
        const float up = 0.87f * x[1] - 0.5f * ahead, near = 0.5f * x[1] + 0.87f * ahead;
        return {size * (0.5f + 2.2f * right), size * (0.5f - 2.2f * up), near};
    }
    static float cross(const std::array<float, 3>& a, const std::array<float, 3>& b,
                       const std::array<float, 3>& c) {
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    std::vector<Color> pixels_;
    std::vector<float> depths_;
};

// The skin without an index buffer: corner n is at index n, with texture coordinate n.
void drawSkin(vk::Queue& queue, const sim::Simulation& simulation, Picture& picture) {
    const auto vertices = queue.download<Vertex>(simulation.skinVertices());
    const auto skins = simulation.drawnSkins();
    const auto indices = queue.download<std::uint32_t>(skins.indices);
    const auto texture = queue.download<sim::TexturePoint>(skins.textureCoordinates);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::array<Corner, 3> corners;
        for (std::size_t n = 0; n < 3; ++n)
            corners[n] = {&vertices[indices[i + n]], {texture[i + n].u, texture[i + n].v, 0}};
        picture.draw(corners, skinColor);
    }
}

// The surface of cuts: every vertex has its own coordinates.
void drawCuts(vk::Queue& queue, const sim::Simulation& simulation, Picture& picture) {
    const sim::CutSurface cut = simulation.cutSurface();
    const auto vertices = queue.download<Vertex>(cut.vertices);
    const auto rest = queue.download<CutPoint>(cut.rest);
    const auto indices = queue.download<std::uint32_t>(cut.indices);
    const auto texture = queue.download<sim::TexturePoint>(cut.textureCoordinates);
    const auto draws = queue.download<Draw>(cut.draws);
    for (std::size_t part = 0; part < 2; ++part) // inside, pieces of skins
        for (std::uint32_t i = draws[part].firstIndex; i < draws[part].firstIndex + draws[part].indexCount;
             i += 3) {
            std::array<Corner, 3> corners;
            for (std::size_t n = 0; n < 3; ++n) {
                const std::uint32_t v = indices[i + n];
                const auto& x = rest[v].rest;
                corners[n].vertex = &vertices[v];
                corners[n].texture =
                    part == 0 ? std::array{x[0], x[1], x[2]} : std::array{texture[v].u, texture[v].v, 0.0f};
            }
            if (part == 0)
                picture.draw(corners, insideColor);
            else
                picture.draw(corners, skinColor);
        }
}

Picture pictureOf(vk::Queue& queue, sim::Simulation& simulation) {
    const VkCommandBuffer commands = queue.begin();
    simulation.recordSkin(commands, sim::SkinDetail::drawn);
    queue.wait(queue.submit(commands));
    Picture picture;
    drawSkin(queue, simulation, picture);
    drawCuts(queue, simulation, picture);
    return picture;
}

} // namespace

int main(int argc, char** argv) try {
    mesh::TriangleMesh organ = mesh::generate("organ", 30);
    addTexture(organ);
    sim::Scene scene{.name = "checker", .gravity = {0, 0, 0}};
    mesh::addMesh(scene, organ, {.mostParticles = 2000, .youngModulus = 3e3f, .isCuttable = true});
    for (sim::Particle& particle : scene.particles) // apart, to both sides of the cut
        particle.velocity.x = particle.position.x > 0.04f ? 0.12f : -0.12f;

    const vk::Loader loader;
    const vk::Device device = vk::Device::create(loader.getInstanceProcAddr(), {});
    vk::Queue queue(device);
    sim::Simulation simulation(device, scene, {});
    vk::Drain drain(queue);
    const VkCommandBuffer first = queue.begin();
    simulation.recordReset(first);
    queue.wait(queue.submit(first));
    const Picture uncut = pictureOf(queue, simulation);
    const std::array<sim::Vec3, 2> from{{{-0.02f, 1, -1}, {0.1f, 1, 1}}},
        to{{{-0.02f, -1, -1}, {0.1f, -1, 1}}};
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
        const VkCommandBuffer commands = queue.begin();
        sim::Step step{.dt = scene.dt, .gravity = scene.gravity, .frame = frame};
        if (frame == 0) step.blade = {.from = from, .to = to};
        simulation.record(commands, step);
        queue.wait(queue.submit(commands));
    }
    const Picture cut = pictureOf(queue, simulation);
    std::ofstream file(argc > 1 ? argv[1] : "checker.ppm", std::ios::binary);
    file << "P6\n" << 2 * size << ' ' << size << "\n255\n";
    for (std::uint32_t y = 0; y < size; ++y) {
        uncut.writeRow(file, y);
        cut.writeRow(file, y);
    }
    if (!file.flush()) throw std::runtime_error("cannot write the picture");
    if (!uncut.isChecker(false) || !cut.isChecker(true))
        throw std::runtime_error("the checker is not seen on the skin and in the cut");
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
}
