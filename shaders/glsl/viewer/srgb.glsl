// Colors as they look, to what a target that encodes sRGB takes.

vec3 decoded(vec3 shown) {
    return mix(pow((shown + 0.055) / 1.055, vec3(2.4)), shown / 12.92, lessThanEqual(shown, vec3(0.04045)));
}
