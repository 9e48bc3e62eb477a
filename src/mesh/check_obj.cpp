// Checks and rewrites OBJ files: every vertex and face is checked and written again, so that assimp reads
// only `v x y z` and `f i j k`. Material libraries are dropped: setting a texture before any material crashes
// assimp 5.2.5.
#include "mesh/import_checks.hpp"
#include "mesh/text_scanner.hpp"

namespace sinew::mesh {
namespace {

/// Line scanner that joins lines ending in a backslash with the next one, and keeps the count of lines.
class JoinedLines {
public:
    explicit JoinedLines(std::string_view text) : lines_(text) {}

    bool next(std::string_view& line) {
        if (!lines_.next(line)) return false;
        number_ = lines_.number();
        if (!line.ends_with('\\')) return true;
        joined_ = line;
        for (std::string_view more; joined_.ends_with('\\') && lines_.next(more);) {
            joined_.back() = ' ';
            joined_ += more;
        }
        line = joined_;
        return true;
    }

    std::size_t number() const { return number_; }

private:
    LineScanner lines_;
    std::string joined_;
    std::size_t number_ = 0;
};

class ObjReducer {
public:
    explicit ObjReducer(const ImportLimits& limits) : limits_(limits) {}

    Reduced reduce(std::string_view bytes) {
        const std::string_view nameWord = wordOfObjects(bytes);
        JoinedLines lines(bytes);
        for (std::string_view line; lines.next(line);) {
            const std::string_view word = takeWord(line);
            if (word == "v")
                addVertex(line, lines.number());
            else if (word == "f")
                addFace(line, lines.number());
            else if (word == nameWord)
                object_ = reduced_.names.add(line);
        }
        if (highest_ > vertices_) refuseIndex(highestLine_);
        checkTriangleCount(triangles_, limits_);
        return std::move(reduced_);
    }

private:
    static bool hasObjects(std::string_view bytes) {
        JoinedLines lines(bytes);
        for (std::string_view line; lines.next(line);)
            if (takeWord(line) == "o") return true;
        return false;
    }

    static std::string_view wordOfObjects(std::string_view bytes) { return hasObjects(bytes) ? "o" : "g"; }

    /// Begins a run if the object differs from that of the face before. Assimp is slow with many objects:
    /// beyond the limit one run without a name takes the rest.
    void beginRun() {
        std::vector<std::uint32_t>& runs = reduced_.objects;
        if (runs.size() > mostObjects || object_ == (runs.empty() ? noObject : runs.back())) return;
        runs.push_back(runs.size() == mostObjects ? noObject : object_);
        result_ += "o " + std::to_string(runs.size() - 1) + '\n';
    }

    void addVertex(std::string_view line, std::size_t number) {
        result_ += 'v';
        for (int axis = 0; axis < 3; ++axis) appendNumber(result_, checkCoordinate(takeWord(line), number));
        result_ += '\n';
        ++vertices_;
    }

    void addFace(std::string_view line, std::size_t number) {
        std::uint64_t corners = 0;
        beginRun();
        result_ += 'f';
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line), ++corners) {
            const auto index = toInteger<std::int64_t>(word.substr(0, word.find('/')));
            if (!index)
                throw Refusal(std::to_string(number), "a face corner is not a number: export the mesh again");
            const std::int64_t vertex =
                *index < 0 ? *index + static_cast<std::int64_t>(vertices_) + 1 : *index;
            if (vertex <= 0) refuseIndex(number);
            if (static_cast<std::uint64_t>(vertex) > highest_) { // may be defined further below
                highest_ = static_cast<std::uint64_t>(vertex);
                highestLine_ = number;
            }
            (result_ += ' ') += std::to_string(vertex);
        }
        result_ += '\n';
        if (corners < 3)
            throw Refusal(std::to_string(number), "a face has fewer than 3 corners: export the mesh again");
        triangles_ += corners - 2;
        if (triangles_ > limits_.triangles) checkTriangleCount(triangles_, limits_);
    }

    [[noreturn]] void refuseIndex(std::size_t line) const {
        throw Refusal(std::to_string(line),
                      "a face names a vertex that does not exist: export the mesh again");
    }

    const ImportLimits& limits_;
    Reduced reduced_;
    std::string& result_ = reduced_.text;
    std::uint32_t object_ = noObject; ///< object of the faces to come
    std::uint64_t vertices_ = 0, triangles_ = 0, highest_ = 0;
    std::size_t highestLine_ = 0;
};

} // namespace

Reduced reduceObj(std::string_view bytes, const ImportLimits& limits) {
    return ObjReducer(limits).reduce(bytes);
}

} // namespace sinew::mesh
