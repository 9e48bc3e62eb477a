// The section plane that opens bodies: the SECTION form of a shader draws nothing in front of it, sample by sample.
// Other forms contain none of this.
#ifdef SECTION
layout(constant_id = 4) const bool hasOneSample = false; // 1 sample per pixel, else 4

// Sample positions in a pixel, by Vulkan's standard.
const vec2 sampleAt[4] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

// A bit for each sample behind the plane, of the triangle around `position`.
int samplesBehind(vec3 position) {
    const float before = dot(frame.section.xyz, position) - frame.section.w;
    const vec2 slope = vec2(dFdx(before), dFdy(before));
    int mask = 0;
    for (int i = 0; i < 4; ++i) mask |= before + dot(slope, sampleAt[i] - 0.5) <= 0.0 ? 1 << i : 0;
    return hasOneSample ? int(before <= 0.0) : mask;
}
#endif

void keepBehindSection(vec3 position) {
#if defined(SECTION) && defined(LINES) // lines have no reliable slope
    if (dot(frame.section.xyz, position) > frame.section.w) discard;
#elif defined(SECTION)
    const int mask = samplesBehind(position);
    if (mask == 0) discard;
    gl_SampleMask[0] = mask;
#endif
}
