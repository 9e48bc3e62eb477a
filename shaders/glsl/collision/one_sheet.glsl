// Whether two corners are of one sheet, of which separations let no part pass another. A contact of the two acts on the
// side on which the substep begins. A side that is remembered may be that of before contacts moved one around the other.
// SHEETS_BINDING: empty without such sheets.
layout(constant_id = 6) const bool hasSheets = false;
layout(std430, binding = SHEETS_BINDING) readonly buffer Sheets { uint sheets[]; }; // by slot: 0 = corner of no sheet (sheet_marks.h)
bool areOneSheet(uint i, uint j) { return hasSheets && sheets[i] != 0u && sheets[i] == sheets[j]; }
