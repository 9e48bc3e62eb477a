// The part of layout.h, which alone includes it, that is about the motion of bodies (collision/body_frames.hpp).

// The motion that a body is expected to have until its lists of contacts are made again (collision/body_frames.hpp): a particle
// that was at r when they were made is expected at A (r - from) + to, when the substep ends.
struct BodyFrame {
    vec4 map[3];    // rows of A; w: to - A from [m]
    vec4 before[3]; // the same when the substep began
    vec4 speed;     // velocity of `to` [m/s]; w: how far from where it is expected a particle may be [m]; below 0 = no lists stand
    vec4 rates[3];  // rows of dA/dt A^-1 [1/s]; w: to [m]
    vec4 from;      // [m]
    vec4 gravity;   // [m/s^2], 0 where the frame stands still
};

// Sums over particles of a body. x: where they are, r: where they were when lists were made, v: velocities; x and r against
// those of the body's first particle.
#define FRAME_SUMS 14
#define FRAME_SUM_R 0      // sum of r; w: particles
#define FRAME_SUM_X 1      // of x
#define FRAME_SUM_V 2      // of v
#define FRAME_SUM_RR 3     // of r r^T, three rows
#define FRAME_SUM_DR 6     // of (x - r) r^T
#define FRAME_SUM_VR 9     // of v r^T
#define FRAME_SUM_LOW 12   // the box of x
#define FRAME_SUM_HIGH 13

// A share of a body's particles that one invocation sums up: entries of a list of slots.
struct FrameChunk {
    uint first, count, body;
    uint origin; // slot of the body's first particle
};

#define FRAME_NONE -1.0 // the body of what touches nothing
#define FRAME_MOVES 0  // as it does
#define FRAME_STANDS 1 // never
struct FrameBody {
    uint firstChunk, chunks;
    uint origin; // slot of its first particle
    uint kind;
};

// One work group fits the frames of all bodies.
#define FRAME_MOST_BODIES 84 // a uniform buffer of them is small enough for any device

struct FramePush {
    uint chunks, bodies;
    float reach;  // the largest at which two touch [m]
    float margin; // beyond it, up to which a pair is listed [m]
    uint substeps; // of a step
};
