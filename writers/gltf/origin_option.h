// Which place of the world becomes the origin of a glTF file, as one option.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/math/digits.h"
#include "base/math/vec.h"

namespace wrlkit {

/// automatic: a place in the middle of a scene that is far away (origin.h), else the origin that it has. given: `at`,
/// in metres, y up, for files that belong together.
struct GltfOrigin {
  static constexpr std::string_view type = "X,Y,Z|auto|none";
  enum class Kind : std::uint8_t { automatic, none, given };

  Kind kind = Kind::automatic;
  Vec3 at{};

  bool read(std::string_view text) {
    at = {};
    kind = text == "auto" ? Kind::automatic : text == "none" ? Kind::none : Kind::given;
    return kind != Kind::given || read_place(text);
  }
  std::string print() const {
    if (kind != Kind::given) return kind == Kind::none ? "none" : "auto";
    return shortest_text(at[0]) + ',' + shortest_text(at[1]) + ',' + shortest_text(at[2]);
  }

 private:
  static constexpr double farthest = 1e12;  // metres: light takes an hour

  bool read_place(std::string_view text) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto comma = text.find(',');
      const auto number = text.substr(0, comma);
      if ((comma == text.npos) != (i == 2) || !read_number(number, at[i]) || !(std::abs(at[i]) <= farthest))
        return false;
      text.remove_prefix(i == 2 ? text.size() : comma + 1);
    }
    return true;
  }
};

}  // namespace wrlkit
