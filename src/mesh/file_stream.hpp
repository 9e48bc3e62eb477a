// An output stream on a file descriptor that remembers why a write failed; std::ofstream would not say.
#pragma once

#include <array>
#include <streambuf>

namespace sinew::mesh {

class DescriptorBuffer : public std::streambuf {
public:
    /// Writes to `descriptor`, which stays the caller's.
    explicit DescriptorBuffer(int descriptor);

    /// errno of the first failure, 0 if there was none.
    int error() const { return error_; }

private:
    int_type overflow(int_type character) override;
    int sync() override;

    int descriptor_;
    int error_ = 0;
    std::array<char, 1 << 16> buffer_;
};

} // namespace sinew::mesh
