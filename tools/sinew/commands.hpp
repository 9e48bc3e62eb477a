// The commands of `sinew`. Each adds its options to the command line and, when it is the one asked for, sets
// `chosen` to what shall run after parsing. The options live in the closure.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace sinew::tools {

using Chosen = std::function<int()>;

void addRun(CLI::App& app, Chosen& chosen);
void addDescribe(CLI::App& app, Chosen& chosen);
void addMesh(CLI::App& app, Chosen& chosen);
void addDevices(CLI::App& app, Chosen& chosen);
void addBench(CLI::App& app, Chosen& chosen);
void addStudy(CLI::App& app, Chosen& chosen);

} // namespace sinew::tools
