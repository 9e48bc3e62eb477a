// A source file of the host. No build option of Sinew may reach it.
#ifdef VK_NO_PROTOTYPES
#error a definition came with the target of Sinew
#endif

#include "sinew/simulation.hpp"

#ifdef VK_NO_PROTOTYPES
#error a definition came with the headers of Sinew
#endif
#if __has_include("sim/compile/compile.hpp")
#error the folder src came with the target of Sinew
#endif
#if __has_include("kernels.hpp")
#error the folder of kernels came with the target of Sinew
#endif
#ifdef _GLIBCXX_ASSERTIONS
#error a definition came with the target of Sinew
#endif

int framesInFlight() {
    return static_cast<int>(sinew::sim::Simulation::framesInFlight);
}
