// Converts sRGB colors to linear ones, for a target that encodes sRGB.

vec3 decoded(vec3 shown) {
    return mix(pow((shown + 0.055) / 1.055, vec3(2.4)), shown / 12.92, lessThanEqual(shown, vec3(0.04045)));
}
