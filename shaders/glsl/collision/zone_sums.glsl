// Sums over the members of a zone. A value is a coarse and a fine integer, in units of a power of two above the largest
// value of a member: sums of integers have no order. Requires the names and buffers of solve_zones.

void clearZone(uint zone) {
    zones[zone].early = zones[zone].driven = 0u;
    for (uint k = 0u; k < 3u; ++k) zones[zone].most[k] = 0u;
    for (uint k = 0u; k < ZONE_SUMS; ++k) zones[zone].coarse[k] = zones[zone].fine[k] = 0;
}

// Displacement of a particle in the substep [m].
vec3 wayOf(uint i) {
    const vec3 moved = step.h * predictedVelocities[i].xyz;
    return positions[i].xyz - step.thetaH * velocities[i].xyz - (predicted[i].xyz - moved);
}

float largestOf(vec3 value) { return max(abs(value.x), max(abs(value.y), abs(value.z))); }

void measureMember(uint zone, uint i) {
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0) {
        atomicMax(zones[zone].driven, ~i);
        return;
    }
    const float mass = 1.0 / velocity.w;
    atomicMax(zones[zone].most[0], floatBitsToUint(mass));
    atomicMax(zones[zone].most[1], floatBitsToUint(mass * largestOf(wayOf(i))));
    atomicMax(zones[zone].most[2], floatBitsToUint(mass * largestOf(velocity.xyz)));
}

// Bits of a coarse or fine integer of which so many can be added.
int bitsFor(uint count) { return 29 - findMSB(count); }

// A power of two above a value, in kind k of `most`.
float unitOf(uint zone, uint k) { return uintBitsToFloat(max((zones[zone].most[k] & 0x7f800000u) + 0x00800000u, 0x0d800000u)); }

void addValue(uint zone, uint sum, float value, float unit, int bits) {
    const float scaled = ldexp(value / unit, bits), coarse = round(scaled);
    atomicAdd(zones[zone].coarse[sum], int(coarse));
    atomicAdd(zones[zone].fine[sum], int(round(ldexp(scaled - coarse, bits))));
}

void addMember(uint zone, uint i, int bits) {
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0) return;
    const float mass = 1.0 / velocity.w;
    const vec3 way = mass * wayOf(i), speed = mass * velocity.xyz;
    addValue(zone, ZONE_MASS, mass, unitOf(zone, 0u), bits);
    for (uint k = 0u; k < 3u; ++k) {
        addValue(zone, ZONE_WAY + k, way[k], unitOf(zone, 1u), bits);
        addValue(zone, ZONE_SPEED + k, speed[k], unitOf(zone, 2u), bits);
    }
}

float sumOf(uint zone, uint sum, float unit, int bits) {
    return ldexp(float(zones[zone].coarse[sum]) + ldexp(float(zones[zone].fine[sum]), -bits), -bits) * unit;
}

vec3 sumsOf(uint zone, uint first, float unit, int bits) {
    return vec3(sumOf(zone, first, unit, bits), sumOf(zone, first + 1u, unit, bits), sumOf(zone, first + 2u, unit, bits));
}

// The motion that a zone's members have in common.
struct Common {
    vec3 way;      // displacement in the substep [m]
    vec3 velocity; // [m/s]
    vec3 impulse;  // on the member that never gives way [N s]
};

Common commonOf(uint zone, int bits) {
    const float mass = sumOf(zone, ZONE_MASS, unitOf(zone, 0u), bits);
    const vec3 way = sumsOf(zone, ZONE_WAY, unitOf(zone, 1u), bits), speed = sumsOf(zone, ZONE_SPEED, unitOf(zone, 2u), bits);
    if (zones[zone].driven == 0u) return Common(way / mass, speed / mass, vec3(0.0));
    const vec3 velocity = predictedVelocities[~zones[zone].driven].xyz;
    return Common(step.h * velocity, velocity, speed - mass * velocity);
}
