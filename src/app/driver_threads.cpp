// setenv() and unsetenv().
#include "app/driver_threads.hpp"

#include <cstdlib>

namespace sinew::app {

WithoutDriverThreads::WithoutDriverThreads() {
    if (const char* before = std::getenv(driverThreadsVariable)) before_ = before;
    setenv(driverThreadsVariable, "0", 1);
}

WithoutDriverThreads::~WithoutDriverThreads() {
    if (before_)
        setenv(driverThreadsVariable, before_->c_str(), 1);
    else
        unsetenv(driverThreadsVariable);
}

} // namespace sinew::app
