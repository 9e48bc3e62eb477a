// Keeps shared libraries loaded until a process ends; linked into every program of a sanitized build. The
// leak sanitizer runs at the end, and knows the name of a library, which a suppression needs, only while the
// library is loaded.
#include <dlfcn.h>

int dlclose(void*) noexcept {
    return 0;
}
