// Stream buffer on a file descriptor that stores the errno of a failed write; std::ofstream would lose it.
#pragma once

#include <array>
#include <streambuf>

namespace sinew::mesh {

class DescriptorBuffer : public std::streambuf {
public:
    /// Writes to `descriptor`, which the caller owns.
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
