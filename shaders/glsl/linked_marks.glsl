// The linked body of a particle, and the treatment of its pairs. In the name MARKS_BINDING.
layout(std430, binding = MARKS_BINDING) readonly buffer Marks { uint marks[]; }; // 4 x body, + 2 = may be cut, + 1 = keeps its rest distance

uint bodyOf(uint i) { return marks[i] / 4u; }

// Whether both are of one body that may be cut: links hold them nearer than touching, and a cut lets them touch.
bool areParted(uint i, uint j) { return (marks[i] & 2u) != 0u && bodyOf(i) == bodyOf(j); }
