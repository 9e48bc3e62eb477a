// Bodies that a motion spawns or despawns in this step. Requires changes[], by body of the scene (plan_pool).

bool comesOrGoes(uint body) { return body != MOTION_NO_BODY && changes[body] >= POOL_GONE; }
