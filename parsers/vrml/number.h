// Numbers of VRML text (annex A: float, int32, hexadecimal int32), and the spellings that real exporters add.
#pragma once
#include <cstdint>
#include <string_view>

namespace wrlkit::vrml {

enum class NumberResult : std::uint8_t { exact, repaired, none };

/// Reads the number at `p`; on success `p` is behind it. `exact` also means that a separator follows. Correctly
/// rounded.
NumberResult read_double(const char*& p, const char* end, double& out);
/// The same for integers; a real number or one beyond 32 bits is `repaired`.
NumberResult read_int32(const char*& p, const char* end, std::int32_t& out);

}  // namespace wrlkit::vrml
