#version 460
// Poses of the colliders at the ends of all substeps of a step, once a step: evenly spaced from the pose before the
// step to the pose of their paths at its end. Pose c of row s is that after s substeps.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Ways { ColliderPose ways[]; }; // one per collider: start and end of the step
layout(std430, binding = 1) writeonly buffer Poses { ColliderPose poses[]; };
layout(push_constant) uniform Push { PlacePush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint c = item % push.colliders;
    const float fraction = float(item / push.colliders) / float(push.substeps);
    const ColliderPose from = ways[2u * c], to = ways[2u * c + 1u];
    // A collider at rest must have bit-equal poses, as if nothing moved; a mix of two equal numbers need not be equal
    // to them.
    if (from.position.xyz == to.position.xyz && from.rotation == to.rotation)
        poses[item] = from;
    else
        poses[item] = ColliderPose(mix(from.position, to.position, fraction), normalize(mix(from.rotation, to.rotation, fraction)));
}
