// The functions of files.cpp in a library without files: it needs neither assimp nor TOML.
#include "capi/sizes.hpp"

using namespace sinew::capi;

namespace {

constexpr const char* why = "this library reads no files: build it with SINEW_C_FILES";

} // namespace

extern "C" {

SinewResult sinewLoadScene(const char* path, SinewScene* scene) {
    return call(__func__, [&] {
        requireNotNull(path, "path");
        requireNotNull(scene, "scene");
        throw Failed{SINEW_ERROR_UNSUPPORTED, why};
    });
}

SinewResult sinewAddMeshFile(SinewScene, const char* path, float, const SinewMesh* mesh, uint32_t*) {
    return call(__func__, [&] {
        requireNotNull(path, "path");
        described(mesh, "SinewMesh", defaultMesh);
        throw Failed{SINEW_ERROR_UNSUPPORTED, why};
    });
}

} // extern "C"
