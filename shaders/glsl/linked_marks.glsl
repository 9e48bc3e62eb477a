// The linked body of a particle, and the treatment of its pairs. In the name MARKS_BINDING.
layout(std430, binding = MARKS_BINDING) readonly buffer Marks { uint marks[]; }; // 4 x body, + 2 = may be cut, + 1 = keeps its rest distance

uint bodyOf(uint i) { return marks[i] / 4u; }

// Whether a cut alone can have let two touch that are so near: both are of one body that may be cut.
bool areParted(uint i, uint j) { return (marks[i] & 2u) != 0u && bodyOf(i) == bodyOf(j); }
