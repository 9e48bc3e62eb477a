// Checks of PLY files: the header is parsed, every count is compared with the file size, then the body is
// read value by value: no list longer than the file, no index beyond the vertices, no line too short. Input
// on which assimp 5.2.5 hangs or crashes is rejected here.
#include "mesh/import_checks.hpp"
#include "mesh/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <vector>

namespace sinew::mesh {
namespace {

constexpr std::size_t mostProperties = 256;

enum class Encoding : std::uint8_t { ascii, littleEndian, bigEndian };

struct Type {
    std::uint8_t bytes = 0;
    bool isFloat = false, isSigned = false;
};

struct Property {
    std::string_view name;
    Type type;      ///< type of the value, or of the items of a list
    Type countType; ///< bytes 0 = not a list
    bool isList() const { return countType.bytes != 0; }
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::size_t line = 0;
    std::vector<Property> properties;
    bool isVertex() const { return name == "vertex"; }
    bool isFace() const { return name == "face"; }
    bool isStrips() const { return name == "tristrips"; }
    std::uint64_t leastBytes(Encoding encoding) const {
        std::uint64_t bytes = 0;
        for (const Property& property : properties)
            bytes += encoding == Encoding::ascii ? 2
                     : property.isList()         ? property.countType.bytes
                                                 : property.type.bytes;
        return bytes;
    }
};

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::size_t lines = 0;
    std::string_view body;
};

bool isIndexList(const Property& property) {
    return property.isList() && (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool isCoordinate(const Property& property) {
    return property.name == "x" || property.name == "y" || property.name == "z";
}

/// 0 for u, 1 for v, by the names that assimp knows; none for any other property.
std::optional<std::size_t> textureAxis(const Property& property) {
    const std::array<std::array<std::string_view, 3>, 2> names{
        {{"u", "s", "texture_u"}, {"v", "t", "texture_v"}}};
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (!property.isList() && std::ranges::find(names[axis], property.name) != names[axis].end())
            return axis;
    return std::nullopt;
}

[[noreturn]] void refuse(std::size_t line, const std::string& why) {
    throw Refusal(std::to_string(line), why);
}

Type typeOf(std::string_view name, std::size_t line) {
    if (name == "char" || name == "int8") return {1, false, true};
    if (name == "uchar" || name == "uint8") return {1, false, false};
    if (name == "short" || name == "int16") return {2, false, true};
    if (name == "ushort" || name == "uint16") return {2, false, false};
    if (name == "int" || name == "int32") return {4, false, true};
    if (name == "uint" || name == "uint32") return {4, false, false};
    if (name == "float" || name == "float32") return {4, true, true};
    if (name == "double" || name == "float64") return {8, true, true};
    refuse(line, "the header names an unknown type: export the mesh again");
}

Property parseProperty(std::string_view line, std::size_t number) {
    Property property;
    std::string_view word = takeWord(line);
    if (word == "list") {
        property.countType = typeOf(takeWord(line), number);
        if (property.countType.isFloat)
            refuse(number, "the length of a list is not an integer: export the mesh again");
        word = takeWord(line);
    }
    property.type = typeOf(word, number);
    property.name = takeWord(line);
    if (property.name.empty()) refuse(number, "a property has no name: export the mesh again");
    return property;
}

Element parseElement(std::string_view line, std::size_t number) {
    Element element{.name = takeWord(line), .line = number};
    const auto count = toInteger<std::uint64_t>(takeWord(line));
    if (element.name.empty() || !count)
        refuse(number, "an element has no name or no count: export the mesh again");
    element.count = *count;
    return element;
}

Encoding parseFormat(std::string_view line, std::size_t number) {
    const std::string_view name = takeWord(line), version = takeWord(line);
    if (version == "1.0" && name == "ascii") return Encoding::ascii;
    if (version == "1.0" && name == "binary_little_endian") return Encoding::littleEndian;
    if (version == "1.0" && name == "binary_big_endian") return Encoding::bigEndian;
    refuse(number, "the format line names no known format: export the mesh again");
}

Header parseHeader(std::string_view bytes) {
    Header header;
    LineScanner lines(bytes);
    bool hasFormat = false;
    std::size_t properties = 0;
    for (std::string_view line; lines.next(line);) {
        const std::size_t number = lines.number();
        const std::string_view keyword = takeWord(line);
        if (number == 1 || keyword == "comment" || keyword == "obj_info") continue;
        if (keyword == "end_header" && hasFormat) {
            header.lines = number;
            header.body = lines.rest();
            return header;
        }
        if (keyword == "format" && !hasFormat) {
            header.encoding = parseFormat(line, number);
            hasFormat = true;
        } else if (keyword == "element") {
            header.elements.push_back(parseElement(line, number));
        } else if (keyword == "property" && !header.elements.empty() && ++properties <= mostProperties) {
            header.elements.back().properties.push_back(parseProperty(line, number));
        } else {
            refuse(number, "the header has an unknown or misplaced line: export the mesh again");
        }
    }
    refuse(lines.number(), "the header does not end: export the mesh again");
}

const Element* find(const Header& header, bool (Element::*is)() const) {
    const auto found = std::ranges::find_if(header.elements, [is](const Element& e) { return (e.*is)(); });
    return found == header.elements.end() ? nullptr : &*found;
}

void checkHeader(const Header& header, const ImportLimits& limits) {
    const Element *vertices = find(header, &Element::isVertex), *faces = find(header, &Element::isFace);
    if (faces == nullptr) faces = find(header, &Element::isStrips);
    if (vertices == nullptr || std::ranges::count_if(vertices->properties, isCoordinate) != 3)
        refuse(header.lines, "the header names no vertices with x, y and z: export the mesh again");
    if (faces == nullptr || faces->count == 0) checkTriangleCount(0, limits);
    if (std::ranges::count_if(faces->properties, isIndexList) != 1)
        refuse(faces->line, "the faces have no list of vertex indices: export the mesh again");
    std::uint64_t left = header.body.size() + (header.encoding == Encoding::ascii ? 1 : 0);
    for (const Element& element : header.elements) {
        const std::uint64_t least = element.leastBytes(header.encoding);
        if (element.count > 0 && (least == 0 || element.count > left / least))
            refuse(element.line, std::to_string(element.count) + " of \"" +
                                     std::string(element.name.substr(0, 32)) + "\" do not fit in " +
                                     std::to_string(header.body.size()) + " bytes: check the header");
        left -= element.count * least;
    }
    if (faces->isFace() && faces->count > limits.triangles) checkTriangleCount(faces->count, limits);
}

/// The values of a body in order, in text or binary. Errors name the line or the element.
class Values {
public:
    Values(const Header& header)
        : encoding_(header.encoding), lines_(header.body), firstLine_(header.lines) {}

    /// Begins an item of an element; text has one item a line.
    void beginItem(const Element& element, std::uint64_t item) {
        element_ = &element;
        item_ = item;
        if (encoding_ != Encoding::ascii) return;
        do {
            if (!lines_.next(line_)) refuseShort();
        } while (std::ranges::all_of(line_, isBlank));
    }

    double next(Type type) { return encoding_ == Encoding::ascii ? nextWord() : nextBytes(type); }

    std::string where() const {
        if (encoding_ == Encoding::ascii) return std::to_string(firstLine_ + lines_.number());
        return std::string(element_->name.substr(0, 32)) + " " + std::to_string(item_);
    }

    [[noreturn]] void refuseShort() const {
        throw Refusal(where(), "the file or line ends too early: export the mesh again");
    }

    /// Unread bytes of the line or of the body: no list can be longer.
    std::size_t left() const { return encoding_ == Encoding::ascii ? line_.size() : binary().size(); }

private:
    std::string_view binary() const { return lines_.rest().substr(offset_); }

    double nextWord() {
        const std::string_view word = takeWord(line_);
        if (word.empty()) refuseShort();
        const std::optional<double> value = toNumber(word);
        if (!value) throw Refusal(where(), "a value is not a number: export the mesh again");
        return *value;
    }

    double nextBytes(Type type) {
        if (binary().size() < type.bytes) refuseShort();
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t place = encoding_ == Encoding::littleEndian ? type.bytes - 1 - i : i;
            bits = bits << 8 | static_cast<unsigned char>(binary()[place]);
        }
        offset_ += type.bytes;
        if (type.isFloat)
            return type.bytes == 8 ? std::bit_cast<double>(bits)
                                   : double{std::bit_cast<float>(static_cast<std::uint32_t>(bits))};
        const auto value = static_cast<double>(bits);
        const bool isNegative = type.isSigned && (bits >> (8 * type.bytes - 1) & 1) != 0;
        return isNegative ? value - std::ldexp(1.0, 8 * type.bytes) : value;
    }

    Encoding encoding_;
    LineScanner lines_; ///< lines of text; a binary body is the unread rest
    std::size_t firstLine_, offset_ = 0;
    std::string_view line_;
    const Element* element_ = nullptr;
    std::uint64_t item_ = 0;
};

/// Receives all vertices and faces in order; strips arrive as triangles.
class Reader {
public:
    explicit Reader(const ImportLimits& limits) : limits_(limits) {}
    virtual ~Reader() = default;

    virtual void vertex(const std::array<double, 3>&) {}
    virtual void texture(const std::array<double, 2>&) {} ///< of the vertex before
    virtual void face(std::span<const std::uint64_t>) {}

    void count(std::uint64_t triangles) {
        triangles_ += triangles;
        if (triangles_ > limits_.triangles) checkTriangleCount(triangles_, limits_);
    }
    std::uint64_t triangles() const { return triangles_; }

private:
    const ImportLimits& limits_;
    std::uint64_t triangles_ = 0;
};

/// Writes the mesh as OBJ.
class ObjWriter : public Reader {
public:
    using Reader::Reader;

    void vertex(const std::array<double, 3>& x) override {
        text_ += 'v';
        for (const double value : x) appendNumber(text_, value);
        text_ += '\n';
    }
    void texture(const std::array<double, 2>& at) override {
        isTextured_ = true;
        text_ += "vt";
        for (const double value : at) appendNumber(text_, std::abs(value) <= largestCoordinate ? value : 0);
        text_ += '\n';
    }
    void face(std::span<const std::uint64_t> corners) override {
        text_ += 'f';
        for (const std::uint64_t corner : corners) {
            (text_ += ' ') += std::to_string(corner + 1);
            if (isTextured_) (text_ += '/') += std::to_string(corner + 1);
        }
        text_ += '\n';
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
    bool isTextured_ = false;
};

constexpr double stripEnd = -1; // an index that ends a strip within its list

/// Reads one list; a list of indices goes to `indices`, with nullopt at the end of each strip.
void walkList(Values& values, const Property& property, bool isStrips, std::uint64_t vertices,
              std::vector<std::optional<std::uint64_t>>& indices) {
    const double length = values.next(property.countType);
    if (!(length >= 0) || length != std::floor(length) || length > static_cast<double>(values.left()))
        values.refuseShort();
    const bool isChecked = isIndexList(property);
    if (isChecked) indices.clear();
    for (double i = 0; i < length; ++i) {
        const double index = values.next(property.type);
        if (!isChecked) continue;
        if (isStrips && index == stripEnd) {
            indices.emplace_back();
            continue;
        }
        if (!(index >= 0 && index < static_cast<double>(vertices) && index == std::floor(index)))
            throw Refusal(values.where(), "a face names a vertex that does not exist: export the mesh again");
        indices.emplace_back(static_cast<std::uint64_t>(index));
    }
}

void readFace(std::span<const std::optional<std::uint64_t>> indices, Reader& reader) {
    if (indices.size() < 3) return;
    std::vector<std::uint64_t> corners;
    for (const auto& index : indices) corners.push_back(*index);
    reader.count(corners.size() - 2);
    reader.face(corners);
}

/// Converts strips to triangles: every second one is reversed; those without area join two strips and are
/// dropped.
void readStrips(std::span<const std::optional<std::uint64_t>> indices, Reader& reader) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (!indices[i]) start = i + 1;
        if (i < start + 2) continue;
        std::array<std::uint64_t, 3> corners{*indices[i - 2], *indices[i - 1], *indices[i]};
        if ((i - start) % 2 == 1) std::swap(corners[0], corners[1]);
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        reader.count(1);
        reader.face(corners);
    }
}

/// Reads all items of an element.
void walk(Values& values, const Element& element, std::uint64_t vertices, Reader& reader) {
    std::vector<std::optional<std::uint64_t>> indices;
    const auto hasAxis = [&](std::size_t axis) {
        return std::ranges::any_of(
            element.properties, [axis](const Property& property) { return textureAxis(property) == axis; });
    };
    const bool isTextured = element.isVertex() && hasAxis(0) && hasAxis(1);
    for (std::uint64_t item = 0; item < element.count; ++item) {
        values.beginItem(element, item);
        std::array<double, 3> x{};
        std::array<double, 2> at{};
        for (const Property& property : element.properties) {
            if (property.isList()) {
                walkList(values, property, element.isStrips(), vertices, indices);
                continue;
            }
            const double value = values.next(property.type);
            if (const auto axis = isTextured ? textureAxis(property) : std::nullopt) at[*axis] = value;
            if (!element.isVertex() || !isCoordinate(property)) continue;
            if (!(std::abs(value) <= largestCoordinate)) checkCoordinate(value, values.where());
            x[static_cast<std::size_t>(property.name.front() - 'x')] = value;
        }
        if (element.isVertex()) reader.vertex(x);
        if (isTextured) reader.texture(at);
        if (element.isFace()) readFace(indices, reader);
        if (element.isStrips()) readStrips(indices, reader);
    }
}

void read(const Header& header, Reader& reader) {
    const std::uint64_t vertices = find(header, &Element::isVertex)->count;
    Values values(header);
    for (const Element& element : header.elements) walk(values, element, vertices, reader);
}

} // namespace

std::string checkPly(std::string_view bytes, const ImportLimits& limits) {
    const Header header = parseHeader(bytes);
    checkHeader(header, limits);
    const bool isReadByAssimp =
        header.encoding != Encoding::ascii && find(header, &Element::isStrips) == nullptr;
    Reader counter(limits);
    ObjWriter writer(limits);
    Reader& reader = isReadByAssimp ? counter : writer;
    read(header, reader);
    checkTriangleCount(reader.triangles(), limits);
    return writer.take();
}

} // namespace sinew::mesh
