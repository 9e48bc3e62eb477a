// What a mesh file must look like before assimp may see a byte of it: own checks, one per format, that
// allocate nothing by what a header claims. They run in the child, like all that touches the bytes.
#pragma once

#include "mesh/import.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::mesh {

/// Why a file is refused: where in it (a line, an element; may be empty), then "<why>: <what to do>".
class Refusal : public std::runtime_error {
public:
    Refusal(std::string where, const std::string& whyAndAdvice)
        : std::runtime_error(whyAndAdvice), where_(std::move(where)) {}
    const std::string& where() const { return where_; }

private:
    std::string where_;
};

/// Names of a file with more objects than that are not kept for those beyond.
constexpr std::size_t mostObjects = 4096;

/// Names of the objects of a file, each once, as a person may write them: of printable characters and not
/// long.
class ObjectNames {
public:
    /// Its index; TriangleMesh's noObject for a name of blanks and for one beyond the limit.
    std::uint32_t add(std::string_view name);
    const std::vector<std::string>& all() const { return names_; }

private:
    std::vector<std::string> names_;
    std::map<std::string, std::uint32_t> numbers_;
};

/// The text that is read in place of a file, and the objects of its triangles.
struct Reduced {
    std::string text;
    ObjectNames names;
    /// OBJ: each run of faces is an object that is called by its number; this is the object of the file that
    /// the run is of. STL: the object of each facet.
    std::vector<std::uint32_t> objects;
};

/// The child's answer: the corners of all triangles, 3 x 3 floats each, counter-clockwise from outside, and
/// the object of each in `names`. No objects where none has a name.
struct Soup {
    std::vector<float> corners;
    std::vector<std::uint32_t> objects;
    std::vector<std::string> names;
};

/// Beyond this [m], or not finite, a coordinate is refused.
constexpr double largestCoordinate = 1e9;

/// Throws Refusal unless the value is usable as a coordinate.
void checkCoordinate(double value, const std::string& where);

/// The word as a coordinate. Throws Refusal unless it is a number usable as one.
double checkCoordinate(std::string_view word, std::size_t line);

/// Appends a blank and the number in digits that assimp reads right: "-.5" it takes for an end of the line.
void appendNumber(std::string& text, double value);

/// Throws Refusal where there are no triangles, or more than the limit.
void checkTriangleCount(std::uint64_t count, const ImportLimits& limits);

/// The four bytes at `offset`, which must be there, little endian.
std::uint32_t readUint32(std::string_view bytes, std::size_t offset);

/// The format by content alone; nothing where no known one matches.
std::optional<Format> sniff(std::string_view bytes);

/// Checks every vertex and face and returns an OBJ of nothing but those, no materials, normals or names, in
/// runs of one object each where the file names objects ("o", or "g" where it has no "o").
Reduced reduceObj(std::string_view bytes, const ImportLimits& limits);

/// STL comes as text or binary; `bytes` are one of the two. Both checks return what to read: of text every
/// facet in one solid, of binary what the header counts (files may carry something behind it).
bool isTextStl(std::string_view bytes);
Reduced reduceTextStl(std::string_view bytes, const ImportLimits& limits);
std::string_view checkBinaryStl(std::string_view bytes, const ImportLimits& limits);

/// Checks header, sizes, coordinates and indices of PLY. Returns what to read in place of a file that assimp
/// would misread, one of text (numbers such as "-.5") or with triangle strips: an OBJ of the same faces.
/// Empty: the file.
std::string checkPly(std::string_view bytes, const ImportLimits& limits);

/// Checks chunks and JSON of GLB, the JSON of glTF: version 2, sizes, nesting, no buffer outside the file.
/// Both return the number of triangles that the meshes announce: assimp drops those with an index out of
/// range without a word.
std::uint64_t checkGlb(std::string_view bytes, const ImportLimits& limits);
std::uint64_t checkGltf(std::string_view json, std::uint64_t fileBytes, const ImportLimits& limits);

} // namespace sinew::mesh
