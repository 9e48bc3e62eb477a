// A program that uses the component `scenes`: it reads installed scene files, one with a mesh, and is told
// what is wrong in another.
#include "sinew/scenes/built_in.hpp"
#include "sinew/scenes/load.hpp"

#include <cstdio>
#include <string_view>

int main() {
    const std::filesystem::path folder = SCENES;
    std::size_t read = 0;
    for (const char* name : {"cloth.toml", "organ.toml", "incline.toml"}) {
        const sinew::scenes::LoadedScene loaded = sinew::scenes::load(folder / name);
        std::printf("%s: %zu particles, %u substeps\n", name, loaded.scene.particles.size(),
                    loaded.settings.substeps);
        read += loaded.scene.particles.size() > 100 && loaded.settings.substeps > 0 ? 1 : 0;
    }
    for (const std::string_view name : sinew::scenes::builtInNames())
        if (!std::filesystem::exists(folder / (std::string(name) + ".toml"))) {
            std::printf("%s is not installed\n", std::string(name).c_str());
            return 1;
        }
    try {
        sinew::scenes::loadText("[[cloht]]\n", "mine.toml");
    } catch (const sinew::scenes::SceneError& error) {
        std::puts(error.what());
        return read == 3 && std::string_view(error.what()).find("cloth") != std::string_view::npos ? 0 : 1;
    }
    return 1;
}
