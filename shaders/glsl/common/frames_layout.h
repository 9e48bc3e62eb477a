// The part of layout.h for the motion of bodies (collision/body_frames.hpp); only layout.h includes it.

// The motion that a body is expected to have until its contact lists are rebuilt: a particle that was at r when they
// were made is expected at A (r + age w - from) + to at the end of the substep, where w is its heading.
struct BodyFrame {
    vec4 map[3];    // rows of A; w: to - A from [m]
    vec4 before[3]; // the same at the start of the substep
    vec4 speed;     // velocity of `to` [m/s]; w: slack [m], below 0 = no valid lists
    vec4 rates[3];  // rows of dA/dt A^-1 [1/s]; w: to [m]
    vec4 from;      // [m]
    vec4 gravity;   // [m/s^2], 0 where the frame stands still; w: change of A in the substep
};

// Sums over particles of a body. x: positions, r: positions when lists were made, v: velocities; x and r are relative
// to the body's first particle.
#define FRAME_SUMS 15
#define FRAME_SUM_R 0      // sum of r; w: particles
#define FRAME_SUM_X 1      // sum of x
#define FRAME_SUM_V 2      // sum of v; w: particles that sleep
#define FRAME_SUM_RR 3     // sum of r r^T, three rows
#define FRAME_SUM_DR 6     // sum of (x - r) r^T
#define FRAME_SUM_VR 9     // sum of v r^T
#define FRAME_SUM_LOW 12   // the box of x
#define FRAME_SUM_HIGH 13
#define FRAME_SUM_SPEED 14  // sum of velocities without headings: it does not depend on when lists were made

// The particles that one invocation adds up: entries of a list of slots, all of one body.
struct FrameChunk {
    uint first, count, body;
    uint origin; // slot of the body's first particle
};

#define FRAME_NONE -1.0 // body of particles without contacts
#define FRAME_MOVES 0  // follows its particles
#define FRAME_STANDS 1 // always stands still
struct FrameBody {
    uint firstChunk, chunks;
    uint origin; // slot of its first particle
    uint kind;
};

// One work group fits the frames of all bodies.
#define FRAME_MOST_BODIES 84 // a uniform buffer of 84 frames is small enough for any device

struct FramePush {
    uint chunks, bodies;
    float reach;  // the largest contact distance [m]
    float margin; // distance beyond the reach up to which a pair is listed [m]
    float ahead, pace, leeway; // see GridPush
    uint substeps; // per step
};
