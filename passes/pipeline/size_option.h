// A size of files as an option of a pass: 2MB, 500k.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/text/amounts.h"

namespace wrlkit {

struct SizeOption {
  static constexpr std::string_view type = "size", examples = "500k, 2MB";
  std::uint64_t bytes = 0;

  bool read(std::string_view text) {
    bytes = size_of(std::string(text));
    return bytes > 0 || text == "0";
  }
  std::string print() const { return std::to_string(bytes); }
};

}  // namespace wrlkit
