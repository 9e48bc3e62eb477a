// A fixture that loads scene files from a folder of its own for each test.
#pragma once

#include "mesh/export.hpp"
#include "scenes/load.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

namespace sinew::test {

namespace fs = std::filesystem;

class LoadFixture : public testing::Test {
protected:
    LoadFixture() : folder_(fs::temp_directory_path() / ("sinew-load-" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~LoadFixture() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    scenes::LoadedScene load(const std::string& text) const {
        return scenes::load(write("scene.toml", text));
    }

    /// The error's text after "cannot read scene: <folder>/"; "" if the file loads.
    std::string errorOf(const fs::path& file, const scenes::Overrides& overrides = {}) const {
        try {
            scenes::load(file, overrides);
        } catch (const mesh::ImportError& error) {
            const std::string message = error.what(), head = "cannot read scene: " + folder_.string() + "/";
            return message.starts_with(head) ? message.substr(head.size()) : message;
        }
        return "";
    }
    std::string errorOfText(const std::string& text) const { return errorOf(write("scene.toml", text)); }
    void expectError(const std::string& text, const std::string& error) const {
        EXPECT_EQ(errorOfText(text).substr(0, error.size()), error) << text.substr(0, 200);
    }

    fs::path folder_;
};

inline const std::string smallCloth = "[[cloth]]\nsize = [3, 4]\nspacing = 0.1\n";

inline mesh::TriangleMesh tetrahedron(float size) {
    return {.name = "tetrahedron",
            .positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
            .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

} // namespace sinew::test
