// A buffer of points outside of the grid, and of wide faces. A point is apart if it is too wide or too fast for the grid;
// a face is wide if it has too many points around it. For edges the points are their midpoints. Elements: counters, all 0
// before lists are made; the points; from FACE_POINTS_FIRST + FaceFindPush::points on the pairs of faces of patches that
// search; behind FaceFindPush::searched of those wide faces.
#define FACE_POINTS_APART 0  // number of points apart
#define FACE_POINTS_WIDEST 1 // largest radius + motion of all other points; bits of a float [m]
#define FACE_POINTS_WIDE 2   // number of wide faces
#define FACE_POINTS_UNIT 3   // motion at which the first class of motions begins; bits of a float [m]
#define FACE_POINTS_CLASS 4  // number of points by how far they move (motion_classes.glsl)
#define MOTION_CLASSES 10u
#define FACE_POINTS_SEARCHING (FACE_POINTS_CLASS + 10) // number of pairs of faces of patches that search
#define FACE_POINTS_FIRST (FACE_POINTS_SEARCHING + 1)
