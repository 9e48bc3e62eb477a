// Checks that a mesh file must pass before assimp reads any of it: one per format, without allocations sized
// by a header. They run in the child, like everything that reads the bytes.
#pragma once

#include "mesh/import.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::mesh {

/// Reason for rejecting a file: where in it (a line, an element; may be empty), then "<why>: <what to do>".
class Refusal : public std::runtime_error {
public:
    Refusal(std::string where, const std::string& whyAndAdvice)
        : std::runtime_error(whyAndAdvice), where_(std::move(where)) {}
    const std::string& where() const { return where_; }

private:
    std::string where_;
};

/// Number of object names kept; further objects have no name.
constexpr std::size_t mostObjects = 4096;

/// Unique names of the objects of a file, reduced to printable characters and a limited length.
class ObjectNames {
public:
    /// Index of the name; TriangleMesh's noObject for a blank name and for one beyond the limit.
    std::uint32_t add(std::string_view name);
    const std::vector<std::string>& all() const { return names_; }

private:
    std::vector<std::string> names_;
    std::map<std::string, std::uint32_t> numbers_;
};

/// A reduced text that replaces a file, and the objects of its triangles.
struct Reduced {
    std::string text;
    ObjectNames names;
    /// OBJ: each run of faces is an object named by the run's number; this is the file's object of each run.
    /// STL: the object of each facet.
    std::vector<std::uint32_t> objects;
};

/// The child's answer: the corners of all triangles, 3 x 3 floats each, counter-clockwise from outside, and
/// the object of each triangle, an index in `names`. Without names there are no objects. Texture coordinates
/// are empty, or 3 x 2 floats a triangle.
struct Soup {
    std::vector<float> corners;
    std::vector<float> textureCoordinates;
    std::vector<std::uint32_t> objects;
    std::vector<std::string> names;
};

/// Coordinates beyond this [m], or not finite, are rejected.
constexpr double largestCoordinate = 1e9;

/// Throws Refusal unless the value is usable as a coordinate.
void checkCoordinate(double value, const std::string& where);

/// Converts the word to a coordinate. Throws Refusal unless it is a number usable as one.
double checkCoordinate(std::string_view word, std::size_t line);

/// Appends a blank and the number in a notation that assimp reads correctly: it reads "-.5" as the end of the
/// line.
void appendNumber(std::string& text, double value);

/// Throws Refusal if there are no triangles, or more than the limit.
void checkTriangleCount(std::uint64_t count, const ImportLimits& limits);

/// The four bytes at `offset`, little endian; they must exist.
std::uint32_t readUint32(std::string_view bytes, std::size_t offset);

/// Detects the format by content alone; nothing if no known one matches.
std::optional<Format> sniff(std::string_view bytes);

/// Checks every vertex and face and returns an OBJ with these and valid texture coordinates alone, without
/// materials, normals or names, in runs of one object each if the file names objects ("o", or "g" if it has
/// no "o").
Reduced reduceObj(std::string_view bytes, const ImportLimits& limits);

/// Checks of STL, text or binary. Both return the part to read: for text every facet in one solid, for binary
/// the triangles that the header counts (files may contain more data after them).
bool isTextStl(std::string_view bytes);
Reduced reduceTextStl(std::string_view bytes, const ImportLimits& limits);
std::string_view checkBinaryStl(std::string_view bytes, const ImportLimits& limits);

/// Checks header, sizes, coordinates and indices of PLY. Returns a replacement for files that assimp would
/// misread, text files (numbers such as "-.5") or files with triangle strips: an OBJ of the same faces.
/// Empty: read the file itself.
std::string checkPly(std::string_view bytes, const ImportLimits& limits);

/// Facts of a file that assimp does not tell.
struct Announced {
    /// Triangles that the file must contain, each mesh counted once; 0 = not known. Assimp silently drops
    /// those with an index out of range.
    std::uint64_t triangles = 0;
    /// Whether some texture coordinates are whole numbers, which assimp takes for the bits of floats.
    bool hasIntegerTexture = false;
};

/// Check chunks and JSON of GLB, and the JSON of glTF: version 2, sizes, nesting, no buffer outside the file.
Announced checkGlb(std::string_view bytes, const ImportLimits& limits);
Announced checkGltf(std::string_view json, std::uint64_t fileBytes, const ImportLimits& limits);

} // namespace sinew::mesh
