// BC7 after Microsoft's "BC7 Format" and "BC7 Format Mode Reference", whose tables stand below: eight modes, with one
// to three pairs of colours in a block, between which each texel has an index.
#include "base/image/decode_bc7.h"

namespace wrlkit {
namespace {

struct Bc7Mode {
  unsigned subsets, partition_bits, rotation_bits, selection_bits, color_bits, alpha_bits;
  bool own_lowest, shared_lowest;  // one bit more for each colour, or for each pair
  unsigned index_bits, second_index_bits;
};

constexpr Bc7Mode bc7_modes[] = {
    {3, 4, 0, 0, 4, 0, true, false, 3, 0},  {2, 6, 0, 0, 6, 0, false, true, 3, 0},
    {3, 6, 0, 0, 5, 0, false, false, 2, 0}, {2, 6, 0, 0, 7, 0, true, false, 2, 0},
    {1, 0, 2, 1, 5, 6, false, false, 2, 3}, {1, 0, 2, 0, 7, 8, false, false, 2, 2},
    {1, 0, 0, 0, 7, 7, true, false, 4, 0},  {2, 6, 0, 0, 5, 5, true, false, 2, 0},
};

/// A bit a texel: which of two subsets it is in.
constexpr std::uint16_t partitions_of_2[64] = {
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80, 0xe800, 0xffe8,
    0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310, 0x3100, 0x8cce, 0x088c, 0x3110,
    0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c, 0xaaaa, 0xf0f0, 0x5a5a, 0x33cc, 0x3c3c, 0x55aa, 0x9696,
    0xa55a, 0x73ce, 0x13c8, 0x324c, 0x3bdc, 0x6996, 0xc33c, 0x9966, 0x0660, 0x0272, 0x04e4, 0x4e40, 0x2720,
    0xc936, 0x936c, 0x39c6, 0x639c, 0x9336, 0x9cc6, 0x817e, 0xe718, 0xccf0, 0x0fcc, 0x7744, 0xee22};

/// Two bits a texel: of three.
constexpr std::uint32_t partitions_of_3[64] = {
    0xaa685050, 0x6a5a5040, 0x5a5a4200, 0x5450a0a8, 0xa5a50000, 0xa0a05050, 0x5555a0a0, 0x5a5a5050,
    0xaa550000, 0xaa555500, 0xaaaa5500, 0x90909090, 0x94949494, 0xa4a4a4a4, 0xa9a59450, 0x2a0a4250,
    0xa5945040, 0x0a425054, 0xa5a5a500, 0x55a0a0a0, 0xa8a85454, 0x6a6a4040, 0xa4a45000, 0x1a1a0500,
    0x0050a4a4, 0xaaa59090, 0x14696914, 0x69691400, 0xa08585a0, 0xaa821414, 0x50a4a450, 0x6a5a0200,
    0xa9a58000, 0x5090a0a8, 0xa8a09050, 0x24242424, 0x00aa5500, 0x24924924, 0x24499224, 0x50a50a50,
    0x500aa550, 0xaaaa4444, 0x66660000, 0xa5a0a5a0, 0x50a050a0, 0x69286928, 0x44aaaa44, 0x66666600,
    0xaa444444, 0x54a854a8, 0x95809580, 0x96969600, 0xa85454a8, 0x80959580, 0xaa141414, 0x96960000,
    0xaaaa1414, 0xa05050a0, 0xa0a5a5a0, 0x96000000, 0x40804080, 0xa9a8a9a8, 0xaaaaaa44, 0x2a4a5254};

/// The texel of each subset but the first whose index lacks its highest bit, which is 0.
constexpr std::uint8_t anchors_of_2[64] = {15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                           15, 2,  8,  2,  2,  8,  8,  15, 2,  8,  2,  2,  8,  8,  2,  2,
                                           15, 15, 6,  8,  2,  8,  15, 15, 2,  8,  2,  2,  2,  15, 15, 6,
                                           6,  2,  6,  8,  15, 15, 2,  2,  15, 15, 15, 15, 15, 2,  2,  15};
constexpr std::uint8_t anchors_of_3[2][64] = {
    {3,  3,  15, 15, 8, 3,  15, 15, 8,  8,  6, 6,  6, 5,  3, 3,  3,  3,  8,  15, 3,  3,
     6,  10, 5,  8,  8, 6,  8,  5,  15, 15, 8, 15, 3, 5,  6, 10, 8,  15, 15, 3,  15, 5,
     15, 15, 15, 15, 3, 15, 5,  5,  5,  8,  5, 10, 5, 10, 8, 13, 15, 12, 3,  3},
    {15, 8, 8, 3,  15, 15, 3,  8,  15, 15, 15, 15, 15, 15, 15, 8,  15, 8,  15, 3,  15, 8,
     15, 8, 3, 15, 6,  10, 15, 15, 10, 8,  15, 3,  15, 10, 10, 8,  9,  10, 6,  15, 8,  15,
     3,  6, 6, 8,  15, 3,  15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 3,  15, 15, 8}};

/// How much of the second colour there is, of 64, by the number of bits of an index.
unsigned weight(unsigned bits, unsigned index) {
  static constexpr std::uint8_t of_2[] = {0, 21, 43, 64}, of_3[] = {0, 9, 18, 27, 37, 46, 55, 64};
  static constexpr std::uint8_t of_4[] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
  return bits == 2 ? of_2[index] : bits == 3 ? of_3[index] : of_4[index];
}

/// Bits of a block, the lowest of its first byte first.
class Bits {
 public:
  explicit Bits(std::string_view block) : block_(block) {}
  unsigned take(unsigned n) {
    unsigned v = 0;
    for (unsigned i = 0; i < n; ++i, ++at_)
      v |= (static_cast<unsigned char>(block_[at_ / 8 % 16]) >> at_ % 8 & 1u) << i;
    return v;
  }

 private:
  std::string_view block_;
  unsigned at_ = 0;
};

/// The upper bits come again as the lower ones.
std::uint8_t widened(unsigned v, unsigned bits) {
  const unsigned up = v << (8 - bits);
  return static_cast<std::uint8_t>(up | up >> bits);
}

class Bc7Block {
 public:
  Bc7Block(const Bc7Mode& mode, Bits bits) : mode_(mode), bits_(bits) {}

  void decode(TexelBlock& to) {
    partition_ = bits_.take(mode_.partition_bits);
    const unsigned rotation = bits_.take(mode_.rotation_bits);
    const bool swapped = bits_.take(mode_.selection_bits) != 0;
    read_ends();
    std::array<unsigned, 16> first{}, second{};
    read_indices(mode_.index_bits, first);
    if (mode_.second_index_bits > 0) read_indices(mode_.second_index_bits, second);
    for (unsigned i = 0; i < 16; ++i) {
      const unsigned color = weight(mode_.index_bits, first[i]);
      const unsigned other = mode_.second_index_bits > 0 ? weight(mode_.second_index_bits, second[i]) : color;
      to[i] = mixed(subset(i), swapped ? other : color, swapped ? color : other);
      if (rotation > 0) std::swap(to[i][3], to[i][rotation - 1]);
    }
  }

 private:
  unsigned subset(unsigned texel) const {
    if (mode_.subsets == 2) return partitions_of_2[partition_] >> texel & 1u;
    return mode_.subsets == 3 ? partitions_of_3[partition_] >> 2 * texel & 3u : 0;
  }

  bool is_anchor(unsigned texel) const {
    if (texel == 0) return true;
    if (mode_.subsets == 2) return texel == anchors_of_2[partition_];
    return mode_.subsets == 3 && (texel == anchors_of_3[0][partition_] || texel == anchors_of_3[1][partition_]);
  }

  void read_ends() {
    const unsigned ends = 2 * mode_.subsets, channels = mode_.alpha_bits > 0 ? 4 : 3;
    std::array<std::array<unsigned, 4>, 6> raw{};
    for (unsigned c = 0; c < channels; ++c)
      for (unsigned e = 0; e < ends; ++e) raw[e][c] = bits_.take(c == 3 ? mode_.alpha_bits : mode_.color_bits);
    const bool more = mode_.own_lowest || mode_.shared_lowest;
    unsigned lowest = 0;
    for (unsigned e = 0; e < ends; ++e) {
      if (mode_.own_lowest || (mode_.shared_lowest && e % 2 == 0)) lowest = bits_.take(1);
      for (unsigned c = 0; c < channels; ++c) {
        const unsigned bits = (c == 3 ? mode_.alpha_bits : mode_.color_bits) + (more ? 1 : 0);
        ends_[e][c] = widened(more ? raw[e][c] << 1 | lowest : raw[e][c], bits);
      }
      if (channels == 3) ends_[e][3] = 255;
    }
  }

  void read_indices(unsigned bits, std::array<unsigned, 16>& to) {
    for (unsigned i = 0; i < 16; ++i) to[i] = bits_.take(bits - (is_anchor(i) ? 1 : 0));
  }

  Texel mixed(unsigned subset, unsigned color, unsigned alpha) const {
    const Texel &a = ends_[2 * subset], &b = ends_[2 * subset + 1];
    Texel out{};
    for (unsigned c = 0; c < 4; ++c) {
      const unsigned w = c == 3 ? alpha : color;
      out[c] = static_cast<std::uint8_t>(((64 - w) * a[c] + w * b[c] + 32) >> 6);
    }
    return out;
  }

  const Bc7Mode& mode_;
  Bits bits_;
  unsigned partition_ = 0;
  std::array<Texel, 6> ends_{};
};

}  // namespace

void decode_bc7(std::string_view block, TexelBlock& to) {
  Bits bits(block);
  unsigned mode = 0;
  while (mode < 8 && bits.take(1) == 0) ++mode;
  if (mode == 8)
    to.fill({});
  else
    Bc7Block(bc7_modes[mode], bits).decode(to);
}

}  // namespace wrlkit
