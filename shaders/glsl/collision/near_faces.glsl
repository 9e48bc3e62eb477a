// Buffers of kernels that look at a point and the faces in its list: bindings 0 to 3.
#include "common/fetched.glsl"
FETCHED_VEC4(0, Predicted, predictedAt)
FETCHED_VEC4(1, PredictedVelocities, predictedVelocityAt) // that led to those positions [m/s]
layout(std430, binding = 2) readonly buffer Faces { ContactFace faces[]; };
TEXEL_TWIN(2, usamplerBuffer, faceTexels);
FETCHED_UVEC2(3, Contacts, contactAt) // ContactCandidate
#define PREDICTED(i) predictedAt(i)
#define PREDICTED_VELOCITY(i) predictedVelocityAt(i)
#define CONTACT(k) contactAt(k)
ContactFace faceAt(uint f) {
    if (!usesTexels) return faces[f];
    const uvec4 words = texelFetch(faceTexels, int(f));
    return ContactFace(words.x, words.y, words.z, uintBitsToFloat(words.w));
}
