// SINEW_API marks the public classes and functions, which a shared library exports; SINEW_LOCAL marks private
// classes inside of these. SINEW_SHARED comes with the target sinew::core and with sinew.pc if the library is
// shared.
#pragma once

#if defined(SINEW_SHARED) && defined(_WIN32) && defined(SINEW_BUILDS)
#define SINEW_API __declspec(dllexport)
#elif defined(SINEW_SHARED) && defined(_WIN32)
#define SINEW_API __declspec(dllimport)
#elif defined(SINEW_SHARED)
#define SINEW_API __attribute__((visibility("default")))
#else
#define SINEW_API
#endif

#if defined(SINEW_SHARED) && !defined(_WIN32)
#define SINEW_LOCAL __attribute__((visibility("hidden")))
#else
#define SINEW_LOCAL
#endif
