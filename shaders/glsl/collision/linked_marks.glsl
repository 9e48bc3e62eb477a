// The linked body of a particle, and the treatment of its pairs. Requires the name MARKS_BINDING.
layout(std430, binding = MARKS_BINDING) readonly buffer Marks { uint marks[]; }; // 4 x body, + 2 = may be cut, + 1 = keeps its rest distance

uint bodyOf(uint i) { return marks[i] / 4u; }

// True if both are of one body that may be cut: its links hold them nearer than the reach, and a cut makes their
// contact possible.
bool areParted(uint i, uint j) { return (marks[i] & 2u) != 0u && bodyOf(i) == bodyOf(j); }
