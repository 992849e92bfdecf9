// The file format of pictures that a pass makes, as an option: format=png.
#pragma once
#include <cstdint>

#include "base/choice.h"

namespace wrlkit {

enum class PictureFormat : std::uint8_t { png, jpg, webp };
template <>
inline constexpr auto choices<PictureFormat> = choice_row({{"png"}, {"jpg"}, {"webp"}});

/// Why this build cannot write it; empty when it can.
std::string why_missing(PictureFormat);

}  // namespace wrlkit
