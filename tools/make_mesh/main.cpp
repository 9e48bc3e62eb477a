// sinew-make-mesh: writes one of the generated shapes as OBJ or PLY.
#include "mesh/export.hpp"
#include "mesh/generate.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace {

using namespace sinew;

constexpr int wrongUsage = 2, outputFailed = 6, internalFault = 70;

std::string shapeList() {
    std::string text = "Shapes:";
    for (const mesh::Shape& shape : mesh::shapes()) {
        text += "\n  " + std::string(shape.name);
        text.append(std::max<std::size_t>(16, shape.name.size() + 1) - shape.name.size(), ' ');
        text += shape.description;
    }
    return text;
}

std::string checkShape(const std::string& name) {
    for (const mesh::Shape& shape : mesh::shapes())
        if (shape.name == name) return "";
    return "no shape is called \"" + name + "\"";
}

std::string checkFile(const std::string& file) {
    return file.ends_with(".obj") || file.ends_with(".ply") ? "" : "the name must end in .obj or .ply";
}

void make(const std::string& shape, const std::string& file, std::uint32_t resolution) {
    const mesh::TriangleMesh made = mesh::generate(shape, resolution);
    if (file.ends_with(".obj"))
        mesh::exportObj(file, made);
    else
        mesh::exportPly(file, made);
    std::printf("%s: %zu vertices, %zu triangles\n", file.c_str(), made.positions.size(),
                made.triangles.size());
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Writes a generated triangle mesh, deterministic and in metres.", "sinew-make-mesh");
    std::string shape, file;
    std::uint32_t resolution = 64;
    app.footer(shapeList());
    app.add_option("NAME", shape, "which shape")->required()->check(CLI::Validator(checkShape, "SHAPE"));
    app.add_option("OUT", file, "the file to write, .obj or .ply")
        ->required()
        ->check(CLI::Validator(checkFile, "FILE"));
    app.add_option("--resolution", resolution, "edges along the longest side")
        ->check(CLI::Range(8, 256))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
        make(shape, file, resolution);
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return wrongUsage;
    } catch (const mesh::ExportError& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return outputFailed;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return internalFault;
    }
}
