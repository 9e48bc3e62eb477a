// Sets the driver's variable and restores it.
#include "app/driver_threads.hpp"

#include "vk/environment.hpp"

#include <cstdlib>

namespace sinew::app {

WithoutDriverThreads::WithoutDriverThreads() {
    if (const char* before = std::getenv(driverThreadsVariable)) before_ = before;
    vk::setVariable(driverThreadsVariable, "0");
}

WithoutDriverThreads::~WithoutDriverThreads() {
    vk::setVariable(driverThreadsVariable, before_ ? before_->c_str() : nullptr);
}

} // namespace sinew::app
