// Positions that a frame maps: those when lists were made, moved along headings. Requires the names bounds and headings
// of a kernel. hasHeadings: else particles have none.
layout(constant_id = 1) const bool hasHeadings = false;

vec3 alongHeading(vec3 r, uint i) { return hasHeadings ? r + bounds.age * headings[i].xyz : r; }
