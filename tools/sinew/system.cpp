// Linux: /proc, getrusage and getloadavg. Windows: the working set.
#include "sinew/system.hpp"

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
// after windows.h
#include <psapi.h>
#else
#include <cstdlib>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>
#endif

namespace sinew::tools {

#ifdef _WIN32
namespace {

PROCESS_MEMORY_COUNTERS counters() {
    PROCESS_MEMORY_COUNTERS result{};
    K32GetProcessMemoryInfo(GetCurrentProcess(), &result, sizeof result);
    return result;
}

} // namespace

double residentMib() {
    return static_cast<double>(counters().WorkingSetSize) / (1024 * 1024);
}

double peakResidentMib() {
    return static_cast<double>(counters().PeakWorkingSetSize) / (1024 * 1024);
}

double loadAverage() {
    return 0;
}
#else
double residentMib() {
    std::ifstream stream("/proc/self/statm");
    double all = 0, resident = 0; // pages
    stream >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024);
}

double peakResidentMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024; // Linux counts KiB
}

double loadAverage() {
    double load = 0;
    return getloadavg(&load, 1) == 1 ? load : 0;
}
#endif

} // namespace sinew::tools
