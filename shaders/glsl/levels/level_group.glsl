// A work group for each body: its body, the lane of an invocation, and a barrier that shows what others have written.
uint bodyOfGroup() { return isReversed ? gl_NumWorkGroups.x - 1u - gl_WorkGroupID.x : gl_WorkGroupID.x; }

uint laneOfGroup() { return isReversed ? LEVEL_GROUP - 1u - gl_LocalInvocationID.x : gl_LocalInvocationID.x; }

void waitForGroup() {
    memoryBarrierBuffer();
    barrier();
}
