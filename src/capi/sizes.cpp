// Checks of sizes, and default values in structs of any size that the library accepts.
#include "capi/sizes.hpp"

namespace sinew::capi {

namespace {

constexpr std::uint32_t largestSize = 4096; // [B]

template <typename T> void setDefaults(void* description, std::size_t size, const char* type, const T& from) {
    requireSize(type, static_cast<std::uint32_t>(std::min<std::size_t>(size, largestSize + 1)), sizeof(T),
                formerSizes<T>);
    copyTo(description, static_cast<std::uint32_t>(size), from);
}

} // namespace

void requireSize(const char* type, std::uint32_t size, std::size_t known,
                 std::span<const std::uint32_t> former) {
    if (size >= known && size <= largestSize) return;
    if (std::ranges::find(former, size) != former.end()) return;
    std::string sizes = std::to_string(known);
    for (const std::uint32_t earlier : former) sizes += ", " + std::to_string(earlier);
    invalidArgument("the size of " + std::string(type) + " is " + std::to_string(size) +
                    ", and this library knows " + sizes +
                    ": set it by its sinewDefault function or by sizeof");
}

void requireZeros(const char* type, const void* pointer, std::uint32_t size, std::size_t known) {
    const auto* bytes = static_cast<const unsigned char*>(pointer);
    for (std::size_t i = known; i < size; ++i)
        if (bytes[i] != 0)
            invalidArgument("the size of " + std::string(type) + " is " + std::to_string(size) +
                            ", this library knows " + std::to_string(known) + ", and byte " +
                            std::to_string(i) +
                            " is not 0: what a newer header has beyond must be 0 for this library");
}

} // namespace sinew::capi

using namespace sinew::capi;

extern "C" {

SinewResult sinewSetDefaults(uint32_t type, void* description, size_t size) {
    return call(__func__, [&] {
        requireNotNull(description, "description");
        if (size >= sizeof(std::uint32_t)) // a refused description is refused wherever it is used
            std::memset(description, 0, sizeof(std::uint32_t));
        switch (type) {
        case SINEW_TYPE_DEVICE_REQUEST:
            return setDefaults(description, size, "SinewDeviceRequest", defaultDeviceRequest());
        case SINEW_TYPE_HOST_DEVICE:
            return setDefaults(description, size, "SinewHostDevice", defaultHostDevice());
        case SINEW_TYPE_PLANE:
            return setDefaults(description, size, "SinewPlane", defaultPlane());
        case SINEW_TYPE_COLLIDER:
            return setDefaults(description, size, "SinewCollider", defaultCollider());
        case SINEW_TYPE_CLOTH:
            return setDefaults(description, size, "SinewCloth", defaultCloth());
        case SINEW_TYPE_LATTICE:
            return setDefaults(description, size, "SinewLattice", defaultLattice());
        case SINEW_TYPE_MESH:
            return setDefaults(description, size, "SinewMesh", defaultMesh());
        case SINEW_TYPE_SETTINGS:
            return setDefaults(description, size, "SinewSettings", defaultSettings());
        case SINEW_TYPE_STEP:
            return setDefaults(description, size, "SinewStep", defaultStep());
        default:
            invalidArgument("there is no type " + std::to_string(type));
        }
    });
}

} // extern "C"
