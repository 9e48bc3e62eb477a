// Narrow phase of two edges in a substep: their contact, and their sides. Requires the names and buffers of
// find_edge_contacts.
const float leastSine = 1e-3; // squared sine; edges at a smaller angle count as parallel

// Two edges at one time of the substep.
struct Lines {
    vec3 ca, ab, cd;
};

struct Touch {
    vec3 n; // towards the first edge
    float depth, remembered;
    vec2 st;
};

// True if two lines that swapped sides did so inside both edges. The triple product is a cubic in time; its root is
// bracketed by bisection and chords in turn.
bool hasPassed(Lines lines, Lines rates, out vec2 st) {
    float low = 0.0, high = 1.0;
    const float atLow = dot(cross(lines.ab - rates.ab, lines.cd - rates.cd), lines.ca - rates.ca);
    float fLow = atLow, fHigh = dot(cross(lines.ab, lines.cd), lines.ca);
    for (uint turn = 0u; turn < 8u; ++turn) {
        const float chord = low + (high - low) * fLow / (fLow - fHigh);
        const float t = (turn & 1u) == 0u && chord > low && chord < high ? chord : 0.5 * (low + high), back = 1.0 - t;
        const float f = dot(cross(lines.ab - back * rates.ab, lines.cd - back * rates.cd), lines.ca - back * rates.ca);
        if (f * atLow > 0.0) {
            low = t;
            fLow = f;
        } else {
            high = t;
            fHigh = f;
        }
    }
    const float back = 1.0 - high;
    const Crossing crossing = crossingOf(lines.ca - back * rates.ca, lines.ab - back * rates.ab, lines.cd - back * rates.cd, leastSine);
    st = clamp(vec2(crossing.s, crossing.t), 0.0, 1.0);
    return isInside(crossing, 1e-3);
}

#include "collision/edge_meeting.glsl"

// The rest distance of an edge's contact with another [m]; large if they do not overlap.
float restWith(uint e, uint other, uint element) {
    const float remembered = MEMORY(element).w;
    if (abs(remembered) <= 1.0 || !keeps(edgeAt(e).a, edgeAt(other).a)) return 3e38;
    return restOf(uintBitsToFloat(CONTACT(element).y), remembered);
}

// The smallest rest distance among all contacts of an edge.
float leastRestOf(uint e) {
    const uvec2 list = lists[e], linked = linkLists[e];
    float least = 3e38;
    for (uint element = list.x; element < list.x + list.y; ++element) least = min(least, restWith(e, CONTACT(element).x, element));
    for (uint link = linked.x; link < linked.x + linked.y; ++link) least = min(least, restWith(e, owners[links[link]], links[link]));
    return least;
}

// The overlap that a pair with a kept rest distance still has. Two edges that slide over each other from the side,
// where their ends met other edges, keep no more of it than those contacts do: else they would be pushed apart
// violently.
float keptOf(uvec2 both, float remembered, float overlap, float before, float reach) {
    if (remembered == 0.0 && !isAtLoad() && before > 0.0 && overlap > 0.0)
        return min(before + REST_SLACK * reach, max(0.0, reach - min(leastRestOf(both.x), leastRestOf(both.y))));
    return overlapKept(remembered, overlap, before, reach);
}

// Contact of the two edges `both`.
Touch touchOf(uvec2 both, float reach, float remembered) {
    const ContactEdge first = edgeAt(both.x), second = edgeAt(both.y);
    const uint a = first.a, b = first.b, c = second.a, d = second.b;
    const float h = step.h;
    const vec3 xa = PREDICTED(a).xyz, xc = PREDICTED(c).xyz, va = VELOCITY(a).xyz, vc = VELOCITY(c).xyz;
    const Lines lines = Lines(xa - xc, PREDICTED(b).xyz - xa, PREDICTED(d).xyz - xc);
    const Lines rates = Lines(h * (va - vc), h * (VELOCITY(b).xyz - va), h * (VELOCITY(d).xyz - vc));
    const Crossing now = crossingOf(lines.ca, lines.ab, lines.cd, leastSine);
    const Crossing before = crossingOf(lines.ca - rates.ca, lines.ab - rates.ab, lines.cd - rates.cd, leastSine);
    Touch touch = Touch(vec3(0.0), 0.0, 0.0, vec2(now.s, now.t));
    // Balls around midpoints, as in the lists: an edge stretched beyond its ball touches nothing with its ends.
    const vec3 middles = lines.ca + 0.5 * (lines.ab - lines.cd);
    const float wayFirst = max(length(VELOCITY(a).xyz), length(VELOCITY(b).xyz));
    const float waySecond = max(length(VELOCITY(c).xyz), length(VELOCITY(d).xyz));
    const float outer = first.radius + second.radius + h * (wayFirst + waySecond);
    if (dot(middles, middles) >= outer * outer) return touch;
    if (hasZones && areTwoSheets(a, c)) noteMeeting(lines, rates, reach);
    if (!now.exists || !before.exists || dot(now.n, before.n) <= 0.0) return touch;
    const bool isSideKept = remembered != 0.0 && !areOneSheet(a, c);
    float side = isSideKept ? sideOf(remembered) : before.height < 0.0 ? -1.0 : 1.0;
    const bool isKept = keeps(a, c);
    bool isInReach = isInside(now, 0.0) && abs(now.height) < (isKept ? (1.0 + REST_SLACK) * reach : reach);
    if (side * now.height < 0.0 && !(isSideKept && side * before.height < 0.0 && isInReach)) {
        vec2 passed = touch.st;
        // Outside of the reach and on the wrong side since the substep before: released, since the pair may be in no
        // list.
        if (side * before.height >= 0.0 && hasPassed(lines, rates, passed)) {
            if (!isInside(now, 0.0)) touch.st = passed;
            isInReach = true;
        } else {
            side = -side; // it moved around the other edge
        }
    }
    touch.n = side * now.n;
    if (!isInReach) return touch;
    const float overlap = reach - side * now.height;
    const float approach = -dot(touch.n, rates.ca + touch.st.x * rates.ab - touch.st.y * rates.cd);
    float left = overlapLeft(remembered, overlap, approach, push.recoverySpeed * h);
    if (isKept) left = keptOf(both, remembered, overlap, reach - side * before.height, reach);
    touch.depth = max(0.0, overlap - left);
    touch.remembered = isKept ? rememberedKept(side, touch.depth, left) : rememberedOf(side, touch.depth, left);
    return touch;
}
