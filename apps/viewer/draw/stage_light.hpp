// Where the light of a scene comes from and which volume its maps cover: fixed when the scene is opened, so
// that shadows do not swim as bodies move.
#pragma once

#include "viewer/draw/balls.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/section.hpp"
#include "viewer/frame.h"

namespace sinew::viewer {

constexpr float pinShare = 0.02f; ///< radius of the ball of a hand or pin, of that of the stage

struct StageLight {
    Box bounds;                           ///< where bodies are expected [m]
    std::optional<float> ground;          ///< its height [m]; none = no floor is drawn
    Vector3 toLight = Vector3::UnitY();   ///< unit direction to the key light
    std::vector<float> gloss;             ///< of each skin: 1 moist tissue, less for cloth
    std::vector<sim::Vec3> skins;         ///< their colors, linear RGB
    std::vector<bool> isClosed;           ///< likewise: whether it encloses something (closedSkins)
    std::vector<bool> isOutward;          ///< likewise: and its triangles face outwards
    BallList balls;                       ///< what is drawn of bodies that have none
    BallList marks;                       ///< of what the scene holds
    bool showsSleep = false;              ///< bodies that sleep are paler
    std::vector<sim::Collider> colliders; ///< drawn where the simulation has them

    /// Whether triangles of all skins that enclose something face outwards, as those of their cuts do.
    bool areSolidsOutward() const;
    float radius() const { return 0.5f * bounds.diagonal().norm(); }
};

/// A key light to the left of `camera`, and room around the bodies to fall, spread and bounce.
StageLight lightFor(const sim::Scene& scene, const Camera& camera);

/// The numbers of one picture.
layout::FrameParams frameParams(const StageLight& light, const Camera& camera, float aspect,
                                const std::optional<Section>& section = {});

/// Distance between the fine lines of the ground's grid: 1, 2 or 5 times a power of ten near a fifth of
/// `size` [m].
float gridSpacing(float size);

} // namespace sinew::viewer
