// Fits the light's maps to the scene.
#include "viewer/render/scene_light.hpp"

#include "viewer/render/layers.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

constexpr float keyAzimuth =
    -1.30f; // azimuth of the key light from the camera's [rad]: from the left, a little in front
constexpr float keyElevation = 0.80f; // [rad]
constexpr float tissueGloss = 1;
constexpr float hazeRadii = 30; // radius at which the ground has faded, in radii of the scene

layout::vec4 packed(const Vector3& v, float w) {
    return {v.x(), v.y(), v.z(), w};
}

layout::mat4 packed(const Matrix4& matrix) {
    layout::mat4 result;
    std::copy_n(matrix.data(), 16, result.columns);
    return result;
}

// A mesh is drawn as tissue, wet inside; a body without a mesh of its own as rubber, the same inside.
float glossOf(const sim::Skin& skin) {
    constexpr float ofRubber = 0.3f;
    return skin.particles.empty() ? tissueGloss : ofRubber;
}

// The grid of the sheet whose particles the skin shows; null = it is of no sheet.
const sim::Grid* sheetOf(const sim::Scene& scene, const sim::Skin& skin) {
    if (skin.particles.empty()) return nullptr;
    const auto found = std::ranges::find_if(scene.grids, [&](const sim::Grid& grid) {
        return grid.nodes[1] == 1 && skin.particles[0] - grid.firstParticle < grid.node.size();
    });
    return found == scene.grids.end() ? nullptr : &*found;
}

// Appends the places of a skin's vertices in its sheet, if it has one. Returns whether it has.
bool addSheet(std::vector<layout::vec4>& places, const sim::Scene& scene, const sim::Skin& skin) {
    const sim::Grid* grid = sheetOf(scene, skin);
    const std::size_t first = places.size();
    places.resize(first + skin.vertexCount());
    if (grid == nullptr) return false;
    const float spacing = grid->restLength[0];
    const auto length = [&](std::uint32_t steps) { return spacing * static_cast<float>(steps); };
    for (std::size_t v = 0; v < skin.particles.size(); ++v) {
        const std::uint32_t i = skin.particles[v] - grid->firstParticle;
        const std::uint32_t node = i < grid->node.size() ? grid->node[i] : 0;
        places[first + v] = {length(node % grid->nodes[0]), length(node / grid->nodes[0]),
                             length(grid->nodes[0] - 1), length(grid->nodes[2] - 1)};
    }
    return true;
}

// The square of floor that bodies in `bounds` can darken: below them, where their shadows fall, with a small
// margin.
layout::vec4 floorSquare(const Box& bounds, float ground, const Vector3& toLight) {
    const float height = std::max(bounds.max().y() - ground, 1e-3f);
    const Vector3 fall = height / toLight.y() * toLight;
    Box shaded = bounds;
    shaded.extend(Box(bounds.min() - fall, bounds.max() - fall));
    const float width = 1.15f * std::max(shaded.sizes().x(), shaded.sizes().z());
    return {shaded.center().x(), shaded.center().z(), width, height};
}

// Plan view from below: x and z become the map's x and y, depth grows with the height above the floor.
Matrix4 planMatrix(const layout::vec4& floor, float ground) {
    Matrix4 clip = Matrix4::Zero();
    clip(0, 0) = clip(1, 2) = 2 / floor.z;
    clip(0, 3) = -floor.x * 2 / floor.z;
    clip(1, 3) = -floor.y * 2 / floor.z;
    clip(2, 1) = 1 / floor.w;
    clip(2, 3) = -ground / floor.w;
    clip(3, 3) = 1;
    return clip;
}

} // namespace

SceneLight lightFor(const sim::Scene& scene, const Camera& camera) {
    SceneLight light{.bounds = sceneBounds(scene), .ground = groundHeight(scene)};
    const float room = std::max(0.4f * light.bounds.sizes().maxCoeff(), 1e-3f);
    light.bounds.extend(Vector3(light.bounds.min() - Vector3(room, light.ground ? 0 : room, room)));
    light.bounds.extend(Vector3(light.bounds.max() + Vector3(room, 0.5f * room, room)));
    const float azimuth = camera.azimuth + keyAzimuth, level = std::cos(keyElevation);
    for (const sim::Skin& skin : scene.skins) {
        light.gloss.push_back(glossOf(skin));
        light.isSheet.push_back(addSheet(light.sheets, scene, skin));
        light.skins.push_back(skin.color);
    }
    if (std::ranges::count(light.isSheet, true) == 0) light.sheets.clear();
    light.isClosed = closedSkins(scene);
    light.isOutward = outwardSkins(scene);
    std::vector<bool> hasLayers;
    for (std::size_t i = 0; i < light.gloss.size(); ++i)
        hasLayers.push_back(light.isClosed[i] && light.gloss[i] >= tissueGloss);
    light.depths = skinDepths(scene, hasLayers);
    light.balls = ballsOf(scene);
    light.insides = insidesOf(scene);
    light.colliders = scene.colliders;
    light.walls = wallsOf(scene, light.bounds);
    light.toLight = {level * std::sin(azimuth), std::sin(keyElevation), level * std::cos(azimuth)};
    return light;
}

float gridSpacing(float size) {
    const float wanted = size / 5;
    const float decade = std::pow(10.0f, std::floor(std::log10(wanted)));
    return decade * (wanted < 2 * decade ? 1.0f : wanted < 5 * decade ? 2.0f : 5.0f);
}

bool SceneLight::areSolidsOutward() const {
    return std::ranges::equal(isClosed, isOutward,
                              [](bool closed, bool outward) { return !closed || outward; });
}

layout::FrameParams frameParams(const SceneLight& light, const Camera& camera, float aspect,
                                const std::optional<Section>& section) {
    const Vector3 center = light.bounds.center(), at = eye(camera);
    const float radius = light.radius(), haze = hazeRadii * radius;
    const float ground = light.ground.value_or(light.bounds.min().y());
    const float reach = (at - center).norm() + 1.5f * haze;

    const Matrix4 fromLight = lookAt(center + light.toLight, center, Vector3::UnitY());
    Box seen = transformed(light.bounds, fromLight);
    const float width = seen.sizes().head<2>().maxCoeff();
    seen.extend(Vector3(seen.center().x() - width / 2, seen.center().y() - width / 2, seen.min().z()));
    seen.extend(Vector3(seen.center().x() + width / 2, seen.center().y() + width / 2, seen.max().z()));

    const layout::vec4 floor = floorSquare(light.bounds, ground, light.toLight);
    const Eigen::Matrix3f axes = viewMatrix(camera).block<3, 3>(0, 0);
    const float tall = std::tan(camera.fieldOfView / 2);
    const Vector3 forward = -axes.row(2) - 2 * camera.shift * tall * axes.row(0);
    layout::FrameParams params{.clipFromWorld = packed(clipMatrix(camera, aspect, reach)),
                               .shadowFromWorld = packed(Matrix4(orthographic(seen) * fromLight)),
                               .planFromWorld = packed(planMatrix(floor, ground)),
                               .eye = packed(at, 1),
                               .rayRight = packed(Vector3(axes.row(0)) * tall * aspect, 0),
                               .rayUp = packed(Vector3(axes.row(1)) * -tall, 0),
                               .rayForward = packed(forward, 0),
                               .toLight = packed(light.toLight, 0),
                               .stage = packed(center, radius),
                               .ground = {ground, gridSpacing(2 * radius), haze, light.ground ? 1.0f : 0.0f},
                               .shadow = {width, seen.sizes().z(), 0, 0},
                               .skins = {},
                               .floor = floor,
                               .mapColors = {},
                               .look = {},
                               .section =
                                   section ? packed(section->normal, section->offset) : layout::vec4{}};
    for (std::size_t i = 0; i < std::min<std::size_t>(light.skins.size(), SKIN_COLORS); ++i) {
        const sim::Vec3& color = light.skins[i];
        params.skins[i] = {color.x, color.y, color.z, light.gloss[i]};
    }
    const auto valueColors = mapColors();
    static_assert(mapColorCount == MAP_COLORS);
    for (std::size_t i = 0; i < mapColorCount; ++i)
        params.mapColors[i] = {valueColors[i][0], valueColors[i][1], valueColors[i][2], 1};
    return params;
}

} // namespace sinew::viewer
