// Macros of <X11/Xlib.h> and <X11/X.h>, for machines without these headers.
#pragma once

#define Status int
#define Bool int
#define True 1
#define False 0
#define None 0L
#define Always 2
#define Success 0
#define Above 0
#define Below 1
#define Complex 0
#define Convex 2
#define Unsorted 0
#define CursorShape 0
#define KeyPress 2
#define FocusIn 9
#define FocusOut 10
#define Expose 12
#define GrayScale 1
