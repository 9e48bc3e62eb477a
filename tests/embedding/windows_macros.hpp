// Macros of <windows.h> that break C++ programs.
#pragma once

#define interface struct
#define near
#define far
#define small char
#define hyper
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define IN
#define OUT
#define OPTIONAL
#define ERROR 0
#define DELETE 0x00010000L
#define IGNORE 0
#define STRICT 1
#define CALLBACK
#define CreateWindow CreateWindowA
#define GetObject GetObjectA
