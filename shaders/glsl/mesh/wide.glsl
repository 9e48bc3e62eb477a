// Integers of 64 and 96 bits in two's complement, low word first, for kernels that need exact signs: 64-bit integers
// are an optional feature of a device, these are not.
struct Int64 {
    uint low;
    int high;
};

struct Int96 {
    uint low, middle;
    int high;
};

Int64 multiply(int a, int b) {
    int high, low;
    imulExtended(a, b, high, low);
    return Int64(uint(low), high);
}

Int64 add(Int64 a, Int64 b) {
    const uint low = a.low + b.low;
    return Int64(low, a.high + b.high + int(low < a.low));
}

Int64 subtract(Int64 a, Int64 b) {
    return Int64(a.low - b.low, a.high - b.high - int(a.low < b.low));
}

// a.x b.y - a.y b.x
Int64 cross(ivec2 a, ivec2 b) {
    return subtract(multiply(a.x, b.y), multiply(a.y, b.x));
}

bool isZero(Int64 a) {
    return a.low == 0u && a.high == 0;
}

bool isPositive(Int64 a) {
    return a.high >= 0 && !isZero(a);
}

Int96 add(Int96 a, Int96 b) {
    const uint low = a.low + b.low;
    const uint carry = uint(low < a.low);
    const uint sum = a.middle + b.middle;
    const uint middle = sum + carry;
    return Int96(low, middle, a.high + b.high + int(sum < a.middle) + int(middle < carry));
}

Int96 negative(Int96 a) {
    return add(Int96(~a.low, ~a.middle, ~a.high), Int96(1u, 0u, 0));
}

Int96 multiply(Int64 a, int b) {
    uint highOfLow, low;
    umulExtended(a.low, uint(b), highOfLow, low);
    highOfLow -= b < 0 ? a.low : 0u; // uint(b) is b + 2^32
    int high, lowOfHigh;
    imulExtended(a.high, b, high, lowOfHigh);
    const uint middle = highOfLow + uint(lowOfHigh);
    return Int96(low, middle, high + (int(highOfLow) >> 31) + int(middle < highOfLow));
}

bool isPositive(Int96 a) {
    return a.high >= 0 && (a.low | a.middle | uint(a.high)) != 0u;
}
