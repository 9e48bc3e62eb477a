// Part of gather_lattice: volume energy of cells. V = det(e), where e are the cell's mean edges, each the mean of
// four. The gradient at a corner is +-c_x +-c_y +-c_z, a quarter each, where c are the cofactors of e. Opposite
// corners receive bit-equal, opposite impulses, whichever invocation computes the cell, so momentum is exact. This
// is the one-point quadrature rule, which locks least; it does not see the hourglass modes, which links resist;
// V is signed, and its gradient is that of the exact volume in every affine state, flattened and mirrored ones too.
// Tetrahedra would see each corner by itself, at five times the arithmetic, and prefer a diagonal.
//
//   energy per V0:   lambda_v fill / 2 (J - 1)^2,  J = V / V0;  clamped to 2 k~ min tau / q (solvers/shares.hpp)
//   recovery:        a pressure that is whole where J < 0 and falls to nothing at J = 1/2
layout(constant_id = 8) const bool hasRecovery = false;
layout(constant_id = 9) const bool hasStiffness = true; // lambda_v is not 0

// Impulses of a cell on its corners: +-x +-y +-z, with minus where the corner is low [kg m].
struct CellImpulse {
    vec3 x, y, z;
};

vec3 ofCorner(CellImpulse impulse, int corner) {
    return ((corner & 1) != 0 ? impulse.x : -impulse.x) + ((corner & 2) != 0 ? impulse.y : -impulse.y)
           + ((corner & 4) != 0 ? impulse.z : -impulse.z);
}

float smallest(vec4 p[8]) {
    return min(min(min(p[0].w, p[1].w), min(p[2].w, p[3].w)), min(min(p[4].w, p[5].w), min(p[6].w, p[7].w)));
}

// Corners in the order of layout.h; `fill` in 1/15.
CellImpulse pressCell(vec4 p[8], float fill, float hh) {
    const float spacing = push.restLengths[0], quarter = 0.25 / spacing;
    // differences first: those of neighbours are exact
    const vec3 ex = quarter * (((p[1] - p[0]) + (p[3] - p[2])) + ((p[5] - p[4]) + (p[7] - p[6]))).xyz;
    const vec3 ey = quarter * (((p[2] - p[0]) + (p[3] - p[1])) + ((p[6] - p[4]) + (p[7] - p[5]))).xyz;
    const vec3 ez = quarter * (((p[4] - p[0]) + (p[5] - p[1])) + ((p[6] - p[2]) + (p[7] - p[3]))).xyz;
    const vec3 cx = cross3(ey, ez), cy = cross3(ez, ex), cz = cross3(ex, ey);
    const float j = dot3(ex, cx);
    const float gradient = 0.5 * (dot3(cx, cx) + dot3(cy, cy) + dot3(cz, cz)) + 1e-30;
    const float turning = (dot3(ex, ex) + dot3(ey, ey) + dot3(ez, ez)) * (1.0 / 6.0) + 0.5;
    const float tau = smallest(p);
    float pressure = 0.0;
    if (hasStiffness)
        pressure = (1.0 - j) * min(push.volumeUnit * hh, push.volumeShare * tau / (gradient + abs(1.0 - j) * turning));
    if (hasRecovery) {
        const float missing = max(RECOVERY_START - j, 0.0);
        pressure += min(push.recoveryUnit * hh * min(missing / RECOVERY_START, 1.0),
                        push.recoveryShare * tau * missing / (gradient + missing * turning));
    }
    const float scale = fill * pressure * (0.25 * spacing);
    const vec3 onX = scale * cx, onY = scale * cy, onZ = scale * cz;
    return CellImpulse(onX, onY, onZ);
}

// Impulses of the cells between two slices on the nodes of both, in the order y, x. `fill` is that of the lower
// slice's nodes if isLower, else of the upper's.
void pressCells(vec4 low[SLICE], vec4 high[SLICE], Fill fill[NODES], bool isLower, float hh, out vec3 onLow[NODES],
                out vec3 onHigh[NODES]) {
    [[unroll]] for (int n = 0; n < NODES; ++n) onLow[n] = onHigh[n] = vec3(0.0);
    [[unroll]] for (int y = 0; y <= COLUMNS_Y; ++y)
        [[unroll]] for (int x = 0; x <= COLUMNS_X; ++x) {
            const int s = x + WIDTH * y; // the cell's lowest corner in the window
            const int nx = min(x, COLUMNS_X - 1), ny = min(y, COLUMNS_Y - 1); // a node of the block that has this cell
            const float held = fill[nx + COLUMNS_X * ny].cells[(x - nx) + 2 * (y - ny) + (isLower ? 4 : 0)];
            const CellImpulse impulse =
                pressCell(vec4[8](low[s], low[s + 1], low[s + WIDTH], low[s + WIDTH + 1], high[s], high[s + 1],
                                  high[s + WIDTH], high[s + WIDTH + 1]), held, hh);
            [[unroll]] for (int n = 0; n < NODES; ++n) {
                const int cornerX = n % COLUMNS_X + 1 - x, cornerY = n / COLUMNS_X + 1 - y;
                if (min(cornerX, cornerY) < 0 || max(cornerX, cornerY) > 1) continue;
                onLow[n] += ofCorner(impulse, cornerX + 2 * cornerY);
                onHigh[n] += ofCorner(impulse, cornerX + 2 * cornerY + 4);
            }
        }
}
