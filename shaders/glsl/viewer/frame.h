// Uniforms and push constants of the picture's shaders, defined once for C++ (sinew::viewer::layout) and GLSL.
// Written once per picture.
#ifndef SINEW_VIEWER_FRAME_H
#define SINEW_VIEWER_FRAME_H

#ifdef __cplusplus
namespace sinew::viewer::layout {
struct alignas(16) vec4 {
    float x, y, z, w;
};
struct alignas(16) mat4 {
    float columns[16];
};
#endif

#define SKIN_COLORS 16
#define MAP_COLORS 17

struct FrameParams {
    mat4 clipFromWorld;
    mat4 shadowFromWorld; // the key light's map: xy in [-1, 1], z in [0, 1] growing away from the light
    mat4 planFromWorld;   // the plan map, seen from below the floor: z = 0 at the floor, 1 at the stage's top
    vec4 eye;             // xyz [m]
    vec4 rayRight; // a pixel's view ray is rayForward + x rayRight + y rayUp, with x and y in clip space
    vec4 rayUp;
    vec4 rayForward;
    vec4 toLight; // unit direction to the key light
    vec4 stage;   // centre and radius of the lit and shadowed region [m]
    vec4 ground; // height [m], grid spacing [m], distance from the stage at which it fades into haze [m], 1 = drawn
    vec4 shadow; // width and depth of the shadow map's volume [m]
    vec4 skins[SKIN_COLORS]; // linear RGB and gloss of the first skins, for the surface of cuts
    vec4 floor;  // x and z of the floor map's centre, its width, the plan map's height [m]
    vec4 mapColors[MAP_COLORS]; // linear RGB of values, from the lowest to the highest
    vec4 look;    // x: 1 = bodies have the colors of a map
    vec4 section; // unit normal and offset [m]; SECTION forms of shaders cut away everything in front of the plane
};

// Data from which the inside of a skin is drawn. `depths` of a skin: a grid of distances from it as loaded, x fastest, more
// than 0 within the body; exact near the skin, and never less than the distance that a picture needs further in.
struct SkinInside {
    vec4 low;   // first node of the grid, and the distance between its nodes [m]
    vec4 nodes; // their numbers along x, y, z; w: index of the first in all depths, -1 = there are none
    vec4 size;  // x: cube root of the volume of the skin's box [m]
};

#define ICOSAHEDRON_INNER 0.7946f // radius of the largest ball in an icosahedron whose corners are on the unit ball

struct SkinPush {
    vec4 color; // linear RGB; for a color map x: the value that has its last color; w: gloss, 1 = moist tissue
    vec4 position; // origin of the vertices' frame, 0 for skins [m]; w: 1 = sleeping bodies are paler
    vec4 rotation; // unit quaternion x, y, z, w
    vec4 scale;    // x: scale of the vertices in their frame
};

#ifdef __cplusplus
} // namespace sinew::viewer::layout
#endif
#endif
