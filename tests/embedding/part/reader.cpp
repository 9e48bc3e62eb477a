// A source file of a host that reads scene files, by the names of the package.
#include "sinew/mesh/to_scene.hpp"
#include "sinew/scenes/load.hpp"

#if __has_include("scenes/load.hpp")
#error the folder src came with the target of Sinew
#endif

std::size_t particlesOf(const std::filesystem::path& file) {
    return sinew::scenes::load(file).scene.particles.size();
}
