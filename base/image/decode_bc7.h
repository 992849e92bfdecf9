// One block of BC7, of 16 bytes.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace wrlkit {

using Texel = std::array<std::uint8_t, 4>;
using TexelBlock = std::array<Texel, 16>;

/// Transparent black where its mode is reserved. Every block of 16 bytes is one.
void decode_bc7(std::string_view block, TexelBlock& to);

}  // namespace wrlkit
