// PNG by stb_image_write, which writes no text chunks: they are inserted after the header.
#include "viewer/render/png.hpp"

#include "mesh/export.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

#include <memory>
#include <new>
#include <ostream>
#include <stdexcept>

namespace sinew::viewer {

namespace {

constexpr std::size_t headerEnd = 8 + 25; // signature and IHDR chunk [B]

void appendBigEndian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

// CRC-32 of ISO 3309, as the PNG specification requires.
std::uint32_t checksum(const std::vector<std::uint8_t>& bytes, std::size_t first) {
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = first; i < bytes.size(); ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
    }
    return ~crc;
}

void appendText(std::vector<std::uint8_t>& bytes, const std::string& keyword, const std::string& text) {
    appendBigEndian(bytes, static_cast<std::uint32_t>(keyword.size() + 1 + text.size()));
    const std::size_t typeStart = bytes.size();
    for (const std::string& part : {std::string("tEXt"), keyword, std::string(1, '\0'), text})
        bytes.insert(bytes.end(), part.begin(), part.end());
    appendBigEndian(bytes, checksum(bytes, typeStart));
}

std::vector<std::uint8_t> withoutAlpha(const Picture& picture) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(picture.pixels.size() / 4 * 3);
    for (std::size_t i = 0; i + 3 < picture.pixels.size(); i += 4)
        rgb.insert(rgb.end(), picture.pixels.begin() + static_cast<std::ptrdiff_t>(i),
                   picture.pixels.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    return rgb;
}

} // namespace

Picture decodePng(std::span<const unsigned char> bytes) {
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels) throw std::runtime_error(std::string("not a PNG file: ") + stbi_failure_reason());
    const auto size = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {.width = static_cast<std::uint32_t>(width),
            .height = static_cast<std::uint32_t>(height),
            .pixels = {pixels.get(), pixels.get() + size}};
}

std::vector<std::uint8_t> encodePng(const Picture& picture, const PictureText& text) {
    const std::vector<std::uint8_t> rgb = withoutAlpha(picture);
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
    int size = 0;
    std::uint8_t* encoded = stbi_write_png_to_mem(rgb.data(), 3 * width, width, height, 3, &size);
    if (encoded == nullptr) throw std::bad_alloc();
    std::vector<std::uint8_t> bytes(encoded, encoded + headerEnd);
    for (const auto& [keyword, value] : text) appendText(bytes, keyword, value);
    bytes.insert(bytes.end(), encoded + headerEnd, encoded + size);
    STBIW_FREE(encoded);
    return bytes;
}

void writePng(const std::filesystem::path& file, const Picture& picture, const PictureText& text) {
    const std::vector<std::uint8_t> bytes = encodePng(picture, text);
    mesh::writeWhole(file, [&](std::ostream& out) {
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    });
}

} // namespace sinew::viewer
