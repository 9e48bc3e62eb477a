// Checks of STL files: binary files state their number of triangles; text files are read word by word and
// rewritten as one solid (assimp refuses a file with an empty one).
#include "mesh/import_checks.hpp"
#include "mesh/text_scanner.hpp"

namespace sinew::mesh {
namespace {

constexpr std::size_t headBytes = 84, triangleBytes = 50;

} // namespace

bool isTextStl(std::string_view bytes) {
    if (bytes.substr(0, headBytes).find('\0') != std::string_view::npos) return false;
    return bytes.size() < headBytes ||
           bytes.size() != headBytes + triangleBytes * std::uint64_t{readUint32(bytes, headBytes - 4)};
}

Reduced reduceTextStl(std::string_view bytes, const ImportLimits& limits) {
    Reduced reduced{.text = "solid mesh\n"};
    std::string& result = reduced.text;
    std::uint32_t object = noObject;
    LineScanner lines(bytes);
    std::uint64_t facets = 0, vertices = 0;
    bool isEnded = false;
    for (std::string_view line; lines.next(line);) {
        const std::string_view word = takeWord(line);
        if (word == "solid") object = reduced.names.add(line);
        isEnded = isEnded || word == "endsolid" || (word == "end" && takeWord(line) == "solid");
        if (word == "facet") {
            if (vertices != 3 * facets++)
                throw Refusal(std::to_string(lines.number()),
                              "the facet before has no 3 vertices: export the mesh again");
            reduced.objects.push_back(object);
            result += "facet normal 0 0 0\nouter loop\n";
        } else if (word == "vertex") {
            if (++vertices > 3 * facets)
                throw Refusal(std::to_string(lines.number()),
                              "a vertex lies outside a facet of 3: export the mesh again");
            result += "vertex";
            for (int axis = 0; axis < 3; ++axis)
                appendNumber(result, checkCoordinate(takeWord(line), lines.number()));
            result += vertices == 3 * facets ? "\nendloop\nendfacet\n" : "\n";
        }
    }
    if (vertices != 3 * facets || !isEnded)
        throw Refusal(std::to_string(lines.number()), "the file ends too early: export the mesh again");
    checkTriangleCount(facets, limits);
    result += "endsolid mesh\n";
    return reduced;
}

std::string_view checkBinaryStl(std::string_view bytes, const ImportLimits& limits) {
    const std::uint64_t count = bytes.size() >= headBytes ? readUint32(bytes, headBytes - 4) : 0;
    const std::uint64_t needed = headBytes + triangleBytes * count;
    if (needed > bytes.size())
        throw Refusal("", "it claims " + std::to_string(count) + " triangles, which do not fit in " +
                              std::to_string(bytes.size()) + " bytes: export the mesh again");
    checkTriangleCount(count, limits);
    return bytes.substr(0, needed);
}

} // namespace sinew::mesh
