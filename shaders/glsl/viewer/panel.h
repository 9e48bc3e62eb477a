// Push constants of the panel shaders, defined once for C++ (sinew::viewer::layout) and GLSL.
#ifndef SINEW_VIEWER_PANEL_H
#define SINEW_VIEWER_PANEL_H

#ifdef __cplusplus
namespace sinew::viewer::layout {
struct alignas(8) vec2 {
    float x, y;
};
#endif

struct PanelPush {
    vec2 scale; // 2 / size of the picture [1/pixel]
    vec2 atlas; // size of the atlas, or of the sheet of pictures [texels]
    vec2 full; // texel of the atlas with full coverage, used for everything but glyphs [texels]
    float pictureHeight; // height of each picture in the sheet [texels]
};

#ifdef __cplusplus
} // namespace sinew::viewer::layout
#endif
#endif
