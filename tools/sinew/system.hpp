// Memory of this process and load of the machine, as the system counts them.
#pragma once

namespace sinew::tools {

double residentMib();     ///< in RAM now
double peakResidentMib(); ///< most so far

/// Mean number of processes that ran or waited in the last minute; 0 where the system does not count them.
double loadAverage();

} // namespace sinew::tools
