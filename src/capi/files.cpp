// Scene files and mesh files.
#include "capi/bodies.hpp"
#include "capi/convert.hpp"

#include "scenes/load.hpp"

#include <cmath>

namespace sinew::capi {

namespace {

/// Runs `body`; a file that cannot be read becomes SINEW_ERROR_FILE.
template <typename Body> auto readingFiles(Body&& body) {
    try {
        return body();
    } catch (const mesh::ImportError& error) {
        throw Failed{SINEW_ERROR_FILE, error.what()};
    }
}

} // namespace

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewLoadScene(const char* path, SinewScene* scene) {
    return call(__func__, [&] {
        requireNotNull(path, "path");
        requireNotNull(scene, "scene");
        scenes::LoadedScene loaded = readingFiles([&] { return scenes::load(path); });
        auto object = std::make_unique<SceneObject>();
        object->scene = std::move(loaded.scene);
        object->settings = loaded.settings;
        const std::vector<std::string> warnings = std::move(loaded.warnings);
        scene->id = addObject(std::move(object));
        for (const std::string& warning : warnings) log(SINEW_LOG_WARNING, warning);
    });
}

SinewResult sinewAddMeshFile(SinewScene scene, const char* path, float scale, const SinewMesh* mesh,
                             uint32_t* body) {
    return call(__func__, [&] {
        const SinewMesh given = described(mesh, "SinewMesh", defaultMesh);
        requireNotNull(path, "path");
        if (!(scale > 0) || !std::isfinite(scale))
            invalidArgument("scale is " + std::to_string(scale) + ", must be above 0");
        mesh::MeshDefects defects;
        mesh::TriangleMesh made = readingFiles([&] { return mesh::importMesh(path, defects); });
        for (sim::Vec3& vertex : made.positions)
            vertex = {vertex.x * scale, vertex.y * scale, vertex.z * scale};
        const Use<SceneObject> object(scene.id, Access::write);
        Addition addition(object->scene);
        const std::uint32_t index = addMeshBody(object->scene, made, given);
        addition.keep();
        if (body != nullptr) *body = index;
    });
}

} // extern "C"
