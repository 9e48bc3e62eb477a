// Numbers of sheets, by slot of a corner, for kernels and C++. 0 = corner of no sheet, or of one without a frame of its own.
#define SHEET_HELD 0x80000000u // flag beside the number: some particle of the sheet never moves, or is driven
