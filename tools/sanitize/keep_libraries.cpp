// Linked into every program of a sanitized build: libraries stay loaded until the process ends. The leak
// sanitizer looks at the end, and knows the name of a library, which a suppression needs, only while the
// library is loaded.
#include <dlfcn.h>

int dlclose(void*) noexcept {
    return 0;
}
