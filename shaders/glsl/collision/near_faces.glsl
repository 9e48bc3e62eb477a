// Buffers of kernels that look at a point and the faces in its list: bindings 0 to 3.
#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer predicted;
layout(binding = 1) uniform samplerBuffer predictedVelocities;
layout(binding = 2) uniform usamplerBuffer faces;
layout(binding = 3) uniform usamplerBuffer contacts;
#define PREDICTED(i) texelFetch(predicted, int(i))
#define PREDICTED_VELOCITY(i) texelFetch(predictedVelocities, int(i))
#define CONTACT(k) texelFetch(contacts, int(k)).xy
ContactFace faceAt(uint f) {
    const uvec4 words = texelFetch(faces, int(f));
    return ContactFace(words.x, words.y, words.z, uintBitsToFloat(words.w));
}
#else
layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer PredictedVelocities { vec4 predictedVelocities[]; }; // that led to those positions [m/s]
layout(std430, binding = 2) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 3) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
#define PREDICTED(i) predicted[i]
#define PREDICTED_VELOCITY(i) predictedVelocities[i]
#define CONTACT(k) contacts[k]
ContactFace faceAt(uint f) { return faces[f]; }
#endif
