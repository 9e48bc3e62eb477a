// The light of a scene and the volume that its maps cover. Both are fixed when the scene is opened, so that
// shadows do not shift as bodies move.
#pragma once

#include "viewer/frame.h"
#include "viewer/render/balls.hpp"
#include "viewer/render/camera.hpp"
#include "viewer/render/section.hpp"
#include "viewer/render/skin_depths.hpp"
#include "viewer/render/walls.hpp"

namespace sinew::viewer {

constexpr float pinShare = 0.02f; ///< radius of the ball of a hand or pin / radius of the scene

struct SceneLight {
    Box bounds;                         ///< box in which bodies are expected [m]
    std::optional<float> ground;        ///< height of the floor [m]; empty = no floor
    Vector3 toLight = Vector3::UnitY(); ///< unit direction to the key light
    std::vector<float> gloss;           ///< one per skin: 1 moist tissue, less for cloth
    std::vector<sim::Vec3> skins;       ///< colour of each skin, linear RGB
    std::vector<bool> isSheet;          ///< whether each skin is of a cloth
    /// Place in its sheet and size of the sheet, by vertex of all skins [m]; empty if no skin is of a cloth.
    std::vector<layout::vec4> sheets;
    std::vector<bool> isClosed;           ///< whether each skin is closed (closedSkins)
    std::vector<bool> isOutward;          ///< whether it is closed and its triangles face outwards
    SkinDepths depths;                    ///< of tissue that can be cut
    BallList balls;                       ///< balls for bodies without a skin
    BallList insides;                     ///< particles of the others, as far as their values reach
    BallList marks;                       ///< marks of the particles that the scene holds
    bool showsSleep = false;              ///< sleeping bodies are paler
    std::vector<sim::Collider> colliders; ///< drawn at the poses of the simulation
    WallMesh walls;

    /// Whether the triangles of all closed skins face outwards, as those of their cuts do.
    bool areSolidsOutward() const;
    float radius() const { return 0.5f * bounds.diagonal().norm(); }
};

/// Places a key light to the left of `camera`, and adds room around the bodies to fall, spread and bounce.
SceneLight lightFor(const sim::Scene& scene, const Camera& camera);

/// Shader parameters of one picture.
layout::FrameParams frameParams(const SceneLight& light, const Camera& camera, float aspect,
                                const std::optional<Section>& section = {});

/// Distance between the fine lines of the ground's grid: 1, 2 or 5 times a power of ten near a fifth of
/// `size` [m].
float gridSpacing(float size);

} // namespace sinew::viewer
