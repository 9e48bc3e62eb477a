// The kind of the rows of a kernel (row.glsl).
layout(constant_id = 8) const bool areEdges = false; // else of points and faces
