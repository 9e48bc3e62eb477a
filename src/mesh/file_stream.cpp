// Writes full buffers with write(2) until it fails for the first time.
#include "mesh/file_stream.hpp"

#include <cerrno>
#include <unistd.h>

namespace sinew::mesh {

DescriptorBuffer::DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type character) {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(character, traits_type::eof())) sputc(traits_type::to_char_type(character));
    return traits_type::not_eof(character);
}

int DescriptorBuffer::sync() {
    for (const char* next = pbase(); next != pptr() && error_ == 0;) {
        const ssize_t written = write(descriptor_, next, static_cast<unsigned>(pptr() - next)); // one buffer
        if (written >= 0)
            next += written;
        else if (errno != EINTR)
            error_ = errno;
    }
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return error_ == 0 ? 0 : -1;
}

} // namespace sinew::mesh
