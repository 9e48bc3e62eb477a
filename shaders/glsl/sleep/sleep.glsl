// Shared by the passes of sleep. To all other passes a sleeping particle is static: its velocity and the inverse mass
// beside it are 0; its own inverse mass is in a table. An island is a set of particles that touch each other or are
// linked, named by its first slot; it sleeps and wakes as one.

// True if a particle with this inverse mass and velocity sleeps.
bool isAsleep(float weight, vec4 velocity) { return weight > 0.0 && velocity.w == 0.0; }
