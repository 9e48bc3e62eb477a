#version 460
// Where the colliders are at the ends of all substeps of a step: evenly from where they were before it to where their paths
// lead by its end, once a step. Pose c of row s is that after s substeps.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Ways { ColliderPose ways[]; }; // of each collider: where from, where to
layout(std430, binding = 1) writeonly buffer Poses { ColliderPose poses[]; };
layout(push_constant) uniform Push { PlacePush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint c = item % push.colliders;
    const float fraction = float(item / push.colliders) / float(push.substeps);
    const ColliderPose from = ways[2u * c], to = ways[2u * c + 1u];
    // What stands still must do so to the last bit, as where nothing moves, which a mix of two equal numbers does not.
    if (from.position.xyz == to.position.xyz && from.rotation == to.rotation)
        poses[item] = from;
    else
        poses[item] = ColliderPose(mix(from.position, to.position, fraction), normalize(mix(from.rotation, to.rotation, fraction)));
}
