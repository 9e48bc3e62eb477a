// Environment variables, on POSIX systems and on Windows.
#pragma once

#include <cstdlib>

namespace sinew::vk {

/// Sets an environment variable of the process; null removes it. No thread may read the environment
/// meanwhile.
inline void setVariable(const char* name, const char* value) noexcept {
#ifdef _WIN32
    _putenv_s(name, value != nullptr ? value : "");
#else
    if (value != nullptr)
        setenv(name, value, 1);
    else
        unsetenv(name);
#endif
}

} // namespace sinew::vk
