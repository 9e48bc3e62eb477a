// The commands of `sinew`. Each function adds its options to the command line; if the user asks for that
// command, it sets `chosen` to the function to run after parsing. The closure owns the options.
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
