// Checks and rewrites OBJ files: every vertex and face is checked and written again, so that assimp reads
// only `v x y z`, `vt u v` and `f i j k` or `f i/m j/n k/o`. Texture coordinates of a file are dropped if one
// of them is no number or missing. Material libraries are dropped: setting a texture before any material
// crashes assimp 5.2.5.
#include "mesh/import_checks.hpp"
#include "mesh/text_scanner.hpp"

#include <algorithm>
#include <cmath>

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

enum class Texture { keep, drop };

class ObjReducer {
public:
    ObjReducer(const ImportLimits& limits, Texture texture) : limits_(limits), texture_(texture) {}

    Reduced reduce(std::string_view bytes) {
        const std::string_view nameWord = wordOfObjects(bytes);
        JoinedLines lines(bytes);
        for (std::string_view line; lines.next(line);) {
            const std::string_view word = takeWord(line);
            if (word == "v")
                addVertex(line, lines.number());
            else if (word == "vt" && texture_ == Texture::keep)
                addTexturePoint(line);
            else if (word == "f")
                addFace(line, lines.number());
            else if (word == nameWord)
                object_ = reduced_.names.add(line);
        }
        if (highest_ > vertices_) refuseIndex(highestLine_);
        checkTriangleCount(triangles_, limits_);
        return std::move(reduced_);
    }

    /// Whether texture coordinates were found, all of them valid. False also if there are none.
    bool isTextured() const {
        return points_ > 0 && !hasFault_ && highestPoint_ > 0 && highestPoint_ <= points_;
    }
    bool hasTexturePoints() const { return points_ > 0; }

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

    void addTexturePoint(std::string_view line) {
        result_ += "vt";
        for (int axis = 0; axis < 2; ++axis) {
            const std::string_view word = takeWord(line);
            const std::optional<double> value = word.empty() && axis == 1 ? 0.0 : toNumber(word);
            hasFault_ = hasFault_ || !value || !(std::abs(*value) <= largestCoordinate);
            appendNumber(result_, hasFault_ ? 0.0 : *value);
        }
        result_ += '\n';
        ++points_;
    }

    /// The texture coordinates of a face corner, "i/n" or "i/n/m", from 1; 0 if it has none.
    std::uint64_t pointOf(std::string_view corner) const {
        const std::size_t slash = corner.find('/');
        if (texture_ == Texture::drop || slash == std::string_view::npos) return 0;
        const std::string_view rest = corner.substr(slash + 1);
        const auto index = toInteger<std::int64_t>(rest.substr(0, rest.find('/')));
        if (!index) return 0;
        const std::int64_t point = *index < 0 ? *index + static_cast<std::int64_t>(points_) + 1 : *index;
        return static_cast<std::uint64_t>(std::max<std::int64_t>(point, 0));
    }

    /// Assimp takes them for other corners if some corners of a face have none.
    void writeFace() {
        const bool isTextured = std::ranges::find(corners_, 0u, &Corner::point) == corners_.end();
        result_ += 'f';
        for (const Corner& corner : corners_) {
            (result_ += ' ') += std::to_string(corner.vertex);
            if (!isTextured) continue;
            (result_ += '/') += std::to_string(corner.point);
            highestPoint_ = std::max(highestPoint_, corner.point);
        }
        result_ += '\n';
    }

    void addFace(std::string_view line, std::size_t number) {
        beginRun();
        corners_.clear();
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
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
            corners_.push_back({static_cast<std::uint64_t>(vertex), pointOf(word)});
        }
        writeFace();
        if (corners_.size() < 3)
            throw Refusal(std::to_string(number), "a face has fewer than 3 corners: export the mesh again");
        triangles_ += corners_.size() - 2;
        if (triangles_ > limits_.triangles) checkTriangleCount(triangles_, limits_);
    }

    [[noreturn]] void refuseIndex(std::size_t line) const {
        throw Refusal(std::to_string(line),
                      "a face names a vertex that does not exist: export the mesh again");
    }

    const ImportLimits& limits_;
    Texture texture_;
    bool hasFault_ = false;                       ///< of texture coordinates
    std::uint64_t points_ = 0, highestPoint_ = 0; ///< the same
    struct Corner {
        std::uint64_t vertex = 0, point = 0;
    };
    std::vector<Corner> corners_; ///< of the face that is read
    Reduced reduced_;
    std::string& result_ = reduced_.text;
    std::uint32_t object_ = noObject; ///< object of the faces to come
    std::uint64_t vertices_ = 0, triangles_ = 0, highest_ = 0;
    std::size_t highestLine_ = 0;
};

} // namespace

Reduced reduceObj(std::string_view bytes, const ImportLimits& limits) {
    ObjReducer reducer(limits, Texture::keep);
    Reduced reduced = reducer.reduce(bytes);
    if (reducer.isTextured() || !reducer.hasTexturePoints()) return reduced;
    return ObjReducer(limits, Texture::drop).reduce(bytes);
}

} // namespace sinew::mesh
