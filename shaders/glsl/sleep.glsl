// What the passes of sleeping share. A particle that sleeps is to all other passes one that never moves: its velocity and
// the inverse mass beside it are 0, what it weighs stands in a table. An island is what touches or is linked, named by its
// first slot; it sleeps and wakes as one (contacts: 6).

// Whether a particle of this inverse mass sleeps whose velocity is `velocity`.
bool isAsleep(float weight, vec4 velocity) { return weight > 0.0 && velocity.w == 0.0; }
